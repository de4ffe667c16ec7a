"""The verdict on an answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..errors import Problem
from ..vocabulary import Outcome, PartOutcome, SlipKind


@dataclass(frozen=True)
class Counterexample:
    """A state at which two answers have different values, in the scene's values of the parameters."""

    state: Mapping[str, float]
    yours: float
    right: float
    of: str = ""


@dataclass(frozen=True)
class Slip:
    """One term that differs from what it should be: by its sign, a factor 2 or ½, or it is missing (`slips.KINDS`)."""

    kind: SlipKind
    term: str


@dataclass(frozen=True)
class Verdict:
    """The outcome, what was understood, and what can be said about it.

    `remark` tells in which sense a correct answer is equal, or why a wrong one is; `misconceptions` are all that lead
    to exactly this answer, the likeliest first; `about` fills the texts; `parts` are the outcomes of components, of the
    equations of a set, or of several frequencies.
    """

    outcome: Outcome
    understood_as: str = ""
    remark: str = ""
    misconceptions: tuple[str, ...] = ()
    about: str = ""
    slip: Slip | None = None
    counterexample: Counterexample | None = None
    problems: tuple[Problem, ...] = ()
    parts: tuple[PartOutcome, ...] = ()
    parameters: Mapping[str, str] = field(default_factory=dict)
