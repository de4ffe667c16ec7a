"""The verdict on an answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..errors import Problem
from ..language.tree import Span
from ..vocabulary import Outcome, PartOutcome, SlipKind


@dataclass(frozen=True)
class Counterexample:
    """A state at which two answers have different values, in the scene's values of the parameters.

    Of a quantity that is known up to a constant `right` has the one with which both agree at the `reference`.
    """

    state: Mapping[str, float]
    yours: float
    right: float
    of: str = ""
    reference: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Slip:
    """One term that is not what it should be: in which way, the term in LaTeX as it was written ("" if it is missing),
    its place in the answer, None if it has none, the part of the answer that it is in, and whether it is a sum of terms
    that all have the same fault.
    """

    kind: SlipKind
    term: str
    place: Span | None = None
    part: int = 0
    is_sum: bool = False


@dataclass(frozen=True)
class ShownReading:
    """One way to read an answer, as LaTeX and as plain text; `taken` is the one that was judged."""

    latex: str
    plain: str
    taken: bool


@dataclass(frozen=True)
class BlockTold:
    """A block of an ordering: its letter, and what the title of its step is made of."""

    id: str
    rule: str
    about: Mapping[str, str]


@dataclass(frozen=True)
class Verdict:
    """The outcome, what was understood, and what can be said about it.

    `remark` tells in which sense a correct answer is equal, or why a wrong one is; `misconceptions` are all that lead
    to exactly this answer, the likeliest first; `about` fills the texts; `slips` are the terms that are wrong, one for
    each wrong part; `parts` are the outcomes of components, of the
    equations of a set, or of several frequencies; `partial` is the share of them that is right in a
    wrong answer; `nonzero` is what must not be zero for a right answer to be so; `marked` is the answer as it was
    written, in LaTeX, with the terms marked that are wrong; `source` are the tasks
    of the lines that a following one has been made easier by; `readings` are all that make
    sense, where there is more than one; `blocks` are those of an ordering that the remark speaks of, the first one
    being where it goes wrong.
    """

    outcome: Outcome
    understood_as: str = ""
    remark: str = ""
    misconceptions: tuple[str, ...] = ()
    about: str = ""
    slips: tuple[Slip, ...] = ()
    counterexample: Counterexample | None = None
    problems: tuple[Problem, ...] = ()
    parts: tuple[PartOutcome, ...] = ()
    partial: float = 0.0
    nonzero: tuple[str, ...] = ()
    marked: str = ""
    source: tuple[str, ...] = ()
    parameters: Mapping[str, str] = field(default_factory=dict)
    readings: tuple[ShownReading, ...] = ()
    blocks: tuple[BlockTold, ...] = ()

    @property
    def slip(self) -> Slip | None:
        """The first of the slips."""
        return self.slips[0] if self.slips else None
