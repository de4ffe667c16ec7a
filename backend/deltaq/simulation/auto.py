"""Which method `auto` takes, and why."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

import numpy as np

from ..language.functions import KINKED
from ..language.tree import Call, Node, walk
from ..mechanics.contributions import Contribution
from ..mechanics.scene import Scene
from ..model.modes import modes_of_model
from ..vocabulary import AUTO
from .choice import Choice
from .hybrid import in_first_mode
from .library import get_method
from .problem import Problem
from .refinement import AHEAD, LARGEST_OF_SERIES
from .run import Steps, run
from .stiffness import drive, spectra

SERIES_REACH = 4.0  # of the real axis, about
LEAST_STEPS = 140.0  # of any run, since no step may be longer than a part of the span
LOOSE = 1e-3
SHORT, SHORT_STEPS = 0.05, 500


@dataclass(frozen=True)
class Candidate:
    """A cost model of a method: about factor · tolerance^(−1/power) steps per radian of the fastest lasting motion.

    Stability needs at least one step per `reach`/|λ|; `cost` is the number of right-hand sides of a step. The factors
    were measured on the built-in scenes (medians).
    """

    id: str
    reason: str
    factor: float
    power: int
    reach: float
    cost: float

    def effort(self, span: float, tolerance: float, lasting: float, size: float) -> float:
        """The estimated number of right-hand sides of one run.

        `span` in seconds; `lasting` and `size` are the largest |λ| of what lasts and of all, in 1/s.
        """
        accurate = span * lasting * self.factor * float(tolerance ** (-1.0 / self.power))
        return self.cost * max(accurate, span * size / self.reach, LEAST_STEPS)


@dataclass(frozen=True)
class SeriesCandidate:
    """A cost model of Taylor series: `per_radian` steps for each radian, whatever the tolerance, of an order by it.

    A step costs `per_order` right-hand sides for each order; code for the series must be compiled first, which takes
    as long as `start` right-hand sides.
    """

    id: str
    reason: str
    per_radian: float
    per_order: float
    start: float

    def effort(self, span: float, tolerance: float, lasting: float, size: float) -> float:
        """The estimated number of right-hand sides of one run, for the arguments of `Candidate.effort`."""
        order = 1.0 - 0.5 * float(np.log(AHEAD * tolerance))
        steps = max(span * max(lasting, size / SERIES_REACH) * self.per_radian, 1.0 / LARGEST_OF_SERIES)
        return self.start + self.per_order * order * steps


# Factors measured on the library of scenes (medians).
SERIES = SeriesCandidate("taylor", "auto_series", 2.5, 1.05, 60_000.0)
BEYOND = 1e-11  # a tolerance from here on only series reach in most scenes
SMOOTH = Candidate("dop853", "auto_smooth", 0.35, 8, 6.3, 13.0)
MIDDLING = Candidate("dormand-prince-54", "auto_short", 0.47, 5, 3.3, 6.0)
STIFF = Candidate("radau-5", "auto_stiff", 0.75, 4, np.inf, 22.0)
KINKED_ONES = (replace(MIDDLING, reason="auto_kinks"), STIFF)
ALL = (SMOOTH, MIDDLING, STIFF)


def choose(wanted: str, scene: Scene, problem: Problem, step: float | None, tolerance: float | None) -> Choice:
    """The method wanted, or the one that suits scene, span and tolerance.

    The linearized scene tells how fast the motion is and which parts of it die out, and what drives it how fast that
    is; the effort follows. Forces that jump are those of one side: beside a jump all would look stiff.
    Symplectic methods are not among the candidates: over the spans allowed they never cost least (measured).
    """
    if wanted != AUTO:
        return Choice(get_method(wanted))
    if step is not None:
        return Choice(get_method("rk4"), "auto_fixed_step")
    modes = modes_of_model(problem.model)
    size, lasting = _speeds(problem if modes is None else in_first_mode(problem, modes))

    def effort(candidate: Candidate | SeriesCandidate) -> float:
        return candidate.effort(problem.t_end, tolerance or LOOSE, lasting, size)

    best = min(_candidates(scene, problem, tolerance or LOOSE), key=effort)
    return Choice(get_method(best.id), best.reason)


def _candidates(scene: Scene, problem: Problem, tolerance: float) -> tuple[Candidate | SeriesCandidate, ...]:
    if _has_kinks(scene):
        return KINKED_ONES
    if problem.is_constrained:  # which series cannot do
        return ALL
    return (*ALL, SERIES) if tolerance > BEYOND else (replace(SERIES, start=0.0), STIFF)


def _speeds(problem: Problem) -> tuple[float, float]:
    """Of all that goes on at the start and shortly after, and of what lasts: by itself, or because it is driven."""
    times = np.linspace(0.0, SHORT * problem.t_end, 5)
    short = replace(problem, t_end=float(times[-1]), step_limit=SHORT_STEPS)
    run_in = run(short, get_method("dop853"), times, np.zeros(1, dtype=np.int64), Steps(short.t_end, 1e-3))
    begun = len(run_in.times) > 0
    at, states = (run_in.times, run_in.states) if begun else (np.zeros(1), problem.state[None, :])
    found = spectra(problem, at, states)
    return max(each.size for each in found), max(drive(problem, states[-1]), *(each.lasting for each in found))


def _has_kinks(scene: Scene) -> bool:
    """Whether forces jump or bend, which high orders do not profit from."""
    guides = [guide.value.tree for guide in scene.guides]
    forces = [node for part in scene.contributions for node in _nodes(part)]
    return any(isinstance(n, Call) and n.function in KINKED for tree in guides + forces for n in walk(tree))


def _nodes(part: Contribution) -> Iterator[Node]:
    """All expressions of a contribution, whatever its kind."""
    for item in fields(part):
        value = getattr(part, item.name)
        yield from (node for node in (value if isinstance(value, tuple) else (value,)) if isinstance(node, Node))
