"""Where the motions of an ensemble pass a section, each with the errors of its points.

Every motion is followed to rounding, and so is a twin that begins some units in the last place away and goes other
steps: what lies between the points of both is what rounding, the steps and the motion's own sensitivity do to them. A
point whose twin has none near it, as of a motion that grazes the section, is told without an error.
Source: see `section` and `march`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..language.expression import Expression
from ..mechanics.scene import Scene
from ..model.observables import Observable, Observables
from ..vocabulary import SectionStatus
from .audit import USUAL, Audit
from .ensemble import Ensemble
from .integration import Flag
from .kernels.motion import FINE
from .library import get_method
from .march import Integers, March
from .outcome import Number, outcome_of
from .problem import Floats, Problem
from .rounding import short
from .run import Steps
from .section import LARGEST_STEP, ORDER, STAYS, TOLERANCE, Crossings, Standing, Surface, follow, nearest

MOST_STEPS = 20_000  # of one motion: one that comes close to a pole would keep all others waiting
FACTOR, ROUNDING = 6.0, 2.0**-51  # of the difference of two runs that are both as wrong; of a point by itself
GRAZES = 0.1  # |ḣ| over that of most points, below which a point is as wrong as h is slow
NEAR = 0.25  # of the time between points: what is farther away is another point
LOST = 0.1  # an error this large, absolute below 1 and relative above, leaves no digit


@dataclass(frozen=True)
class Section:
    """h = 0, passed in a `direction` (1 rising, −1 falling, 0 both), up to so many times by each motion.

    Of the scene's parameters those at the places `varied` have values of their own in each motion.
    """

    scene: Scene
    value: Expression
    direction: int
    most: int
    varied: tuple[int, ...] = ()

    @cached_property
    def function(self) -> Observable:
        """h with its derivatives. Raises SceneError where it has no real value whatever the state."""
        kept = tuple(self.scene.parameters[place].name for place in self.varied)
        return Observables(self.scene, kept).observable(self.value)

    def surface(self, ensemble: Ensemble) -> Surface:
        """The section as the motions meet it; a turn of an angle that stands in h by itself changes nothing."""
        function = self.function
        turns = any(ensemble.problem.angular[place] for place in function.turning)
        own = np.ascontiguousarray(ensemble.parameters[:, self.varied]) if self.varied else None
        return Surface(function.jet.table, self.direction, math.tau if turns else math.inf, own)


@dataclass(frozen=True)
class Points:
    """Where one motion passed: `times`, shape (points,), and `states` (q, q̇), shape (points, 2n), with their errors.

    `errors` of the states are the largest of any component, absolute below 1 and relative above, `time_errors` are
    seconds; both are NaN where they are not known. How the search ended is the `status`, and `code` with `parameters`
    in words.
    """

    times: Floats
    states: Floats
    errors: Floats
    time_errors: Floats
    status: SectionStatus
    code: str
    parameters: Mapping[str, Number]


@dataclass(frozen=True)
class _Ended:
    """How the search along one motion ended: the kernels' `code`, the time `reached`, whether h was zero all along."""

    code: int
    reached: float
    is_contained: bool


def points_of(ensemble: Ensemble, section: Section, largest: float, flag: Flag) -> tuple[Points, ...]:
    """The points of each motion, by steps up to the largest."""
    problem, surface, parts = ensemble.limited(MOST_STEPS).problem, section.surface(ensemble), list[Crossings]()
    steps = _steps(problem, largest)
    standing: Standing | None = None
    found = follow(
        problem, surface, ensemble.states, steps, section.most, flag, twins=True, parameters=ensemble.parameters
    )
    for crossings, standing in found:  # noqa: B007  the last one counts
        parts.append(crossings)
    if standing is None:
        raise LookupError("nothing was followed")
    motions = np.concatenate([one.motions for one in parts])
    rows, speeds = np.concatenate([one.rows for one in parts]), np.concatenate([one.speeds for one in parts])
    order = np.lexsort((rows[:, -1], motions))
    motions, rows, speeds = motions[order], rows[order], speeds[order]
    rounding, scales = _rounded(surface, motions, rows, speeds)
    count, ends = len(ensemble), np.searchsorted(motions, np.arange(1, 2 * len(ensemble)))
    of_rows, of_speeds, of_rounding, of_scales = (np.split(each, ends) for each in (rows, speeds, rounding, scales))
    begins = np.column_stack([ensemble.states, np.zeros(count)])
    first = _scale(surface.at(begins, np.arange(count)), begins)
    told = []
    for index in range(count):
        errors = _errors(of_rows[index], of_speeds[index], of_rounding[index], of_rows[count + index])
        contained = standing.reach[index] <= STAYS * max(first[index], of_scales[index].max(initial=0.0))
        ended = _Ended(int(standing.outcomes[index]), float(standing.reached[index]), bool(contained))
        told.append(_told(ended, section, problem.t_end, of_rows[index], errors))
    return tuple(told)


def prepare(problem: Problem) -> None:
    """Compiles the code that follows motions of a model to sections, which is kept."""
    March(problem, problem.state[None, : 2 * problem.degrees], _steps(problem, problem.t_end), 1)


def _steps(problem: Problem, largest: float) -> Steps:
    """How to step: to rounding, up to the largest step; that is 0 where a drive is very fast."""
    size = LARGEST_STEP * problem.t_end
    if largest > 0.0:
        return Steps(min(size, largest), TOLERANCE, order=ORDER)
    return Steps(size, TOLERANCE, Audit(problem, get_method("taylor")).before(USUAL), order=ORDER)


def _scale(jets: Floats, rows: Floats) -> Floats:
    """How large what makes up h is, shape (rows,): of that some units in the last place are lost."""
    with np.errstate(all="ignore"):
        return np.asarray(np.nan_to_num(np.abs(jets[:, 0]) + (np.abs(jets[:, 1:]) * np.abs(rows)).sum(axis=1)))


def _rounded(surface: Surface, motions: Integers, rows: Floats, speeds: Floats) -> tuple[Floats, Floats]:
    """By how many seconds rounding of h moves each point, and the scale of h there: shape (points,)."""
    scales = _scale(surface.at(rows, motions), rows) if len(rows) else np.zeros(0)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = ROUNDING * (scales / np.abs(speeds) + np.abs(rows[:, -1]))
    return np.nan_to_num(found, nan=np.inf), scales


def _errors(mine: Floats, speeds: Floats, rounding: Floats, theirs: Floats) -> Floats:
    """Errors of states and of times, shape (2, points), by the twin's point next to each in time; NaN without one.

    What h is wrong by never falls with time, nor does what states are wrong by where the section is not grazed: twins
    come close to each other by chance.
    """
    errors = np.full((2, len(mine)), np.nan)
    if not len(mine) or not len(theirs):
        return errors
    times, others = mine[:, -1], theirs[:, -1]
    which = nearest(times, others)
    apart, sizes = np.abs(theirs[which] - mine), np.maximum(1.0, np.abs(mine[:, :-1]))
    gaps = np.diff(times, prepend=-np.inf, append=np.inf)
    is_near = apart[:, -1] <= NEAR * np.minimum(np.minimum(gaps[:-1], gaps[1:]), max(times[-1], 1.0))
    fast, of_states = np.abs(speeds), (apart[:, :-1] / sizes).max(axis=1)
    is_clear = is_near & (fast >= GRAZES * np.median(fast))
    lasting = np.maximum.accumulate(np.where(is_clear, of_states, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        late = np.maximum.accumulate(np.where(is_near, fast * apart[:, -1], 0.0)) / fast
    errors[0, is_near] = (FACTOR * np.maximum(of_states, lasting) + ROUNDING)[is_near]
    errors[1, is_near] = (FACTOR * np.maximum(apart[:, -1], late) + rounding)[is_near]
    return errors


def _told(ended: _Ended, section: Section, t_end: float, rows: Floats, errors: Floats) -> Points:
    """The points of one motion up to where no digit of them is left, and how the search ended."""
    told: dict[str, Number] = {"method": "taylor", "t": short(ended.reached), "t_end": t_end, "steps": MOST_STEPS}
    told |= {"value": section.value.text[:80], "points": section.most}
    known = 0 if ended.is_contained else _known(errors[0])
    outcome = outcome_of(ended.code, told)
    words: tuple[SectionStatus, str] = "ok", "ok"
    if ended.is_contained:
        words = "contained", "section_contained"
    elif known < len(rows):
        words, told["t"] = ("horizon_reached", "horizon_reached"), short(float(rows[known, -1]))
    elif ended.code != FINE:
        words = outcome.status, outcome.code
    elif not len(rows):
        words = "never_met", "section_never_met"
    elif len(rows) >= section.most and ended.reached < t_end:
        words = "full", "section_full"
    return Points(rows[:known, -1], rows[:known, :-1], errors[0, :known], errors[1, :known], *words, told)


def _known(errors: Floats) -> int:
    """How many points have a digit left: up to two that have not, or one at the end. Alone it may graze the section."""
    lost = ~(errors < LOST)
    pairs = lost[:-1] & lost[1:]
    if pairs.any():
        return int(np.argmax(pairs))
    return len(errors) - int(len(errors) > 0 and lost[-1] and np.isfinite(errors[-1]))
