"""What climbing the ladder finds, in the order in which it is found; plain data throughout."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...contract.experiments.fidelity import Ending
from ...errors import Problem
from ...model.operations import Operations
from ...simulation.outcome import Outcome

FULL = "full"  # the id of the rung on which nothing is left out


@dataclass(frozen=True)
class Part:
    """One simplification: the kind, and what it is done to. `ladder.kinds.<kind>` in the catalogs describes it.

    `parameters` fill the sentence: the coordinate, the load, the body.
    """

    kind: str
    parameters: Mapping[str, str]

    @property
    def id(self) -> str:
        """`frozen:y`, `linearized`"""
        return ":".join((self.kind, *self.parameters.values())).replace(" ", "")


@dataclass(frozen=True)
class Rung:
    """One rung: its simplifications in their order (none: the full model) and the scene they lead to.

    `scene` is a document of format 1 that can be opened like any other. It is None where there is no such scene; then
    `problems` say why.
    """

    id: str
    parts: tuple[Part, ...]
    degrees: int
    scene: Mapping[str, object] | None
    problems: tuple[Problem, ...] = ()


@dataclass(frozen=True)
class Ladder:
    """The rungs there are, the full model first; found before anything is measured.

    `amplitudes` are factors of the initial deviation from `centre`: coordinates at rest, or in steady motion where
    coordinates are cyclic. They are 1 alone, and `centre` empty, where there is no such state. `count` is the number
    of findings that follow, unless the climb is cancelled.
    """

    rungs: tuple[Rung, ...]
    centre: Mapping[str, float]
    span: float
    amplitudes: tuple[float, ...]
    count: int


@dataclass(frozen=True)
class Timing:
    """Seconds: the median of `repeats` and their quartiles."""

    median: float
    low: float
    high: float
    repeats: int


@dataclass(frozen=True)
class Cost:
    """What a rung costs: operations and seconds of one right-hand side, right-hand sides and seconds of the run."""

    operations: Operations
    method: str
    evaluations: int
    steps: int
    per_evaluation: Timing
    per_run: Timing


@dataclass(frozen=True)
class Deviation:
    """How far a rung is from the full model over time (`distance.py` has the norm).

    `errors` are in metres, one for each of `times`; `largest` is the largest of them and `relative` that as a part of
    the extent of the full motion, a thousand at most, None where that stands still. `floor` is what the integrations
    themselves may err by, as a part of the same. `until` is how long both could be compared, in seconds.
    """

    times: tuple[float, ...]
    errors: tuple[float, ...]
    largest: float
    relative: float | None
    floor: float
    until: float


@dataclass(frozen=True)
class Measured:
    """A rung at the initial values of the scene; what could not be computed is None, and `outcome` says why.

    `nudged` is its relative error after a nudge of all initial values by 10⁻⁶ (`nudge.py`), tried where the rung is
    within the tolerance, and `survives` whether the verdict stands then; None where nothing was tried.
    """

    rung: str
    outcome: Outcome
    cost: Cost | None
    deviation: Deviation | None
    nudged: float | None = None
    survives: bool | None = None


@dataclass(frozen=True)
class Growth:
    """How the error of a rung grows with the initial amplitude: relative ~ amplitude^slope.

    `relative` and `largest` (metres) hold one number for each amplitude of the ladder, None where there is none; so is
    `slope` where fewer than two of them are above the error of the integration.
    """

    rung: str
    relative: tuple[float | None, ...]
    largest: tuple[float | None, ...]
    slope: float | None


@dataclass(frozen=True)
class Least:
    """Of the rungs within the tolerance that survive a nudge, the one with the fewest degrees of freedom.

    Of several with as many, one with linear equations, one that leaves something out, the most accurate one. None where
    the full motion is not known, so that there is nothing to judge by. The verdict is for times up to `until`;
    `ending` says why that is not the whole span (`ending.py`), empty where it is.
    """

    tolerance: float
    rung: str | None
    until: float
    ending: Ending


Finding = Ladder | Measured | Growth | Least
