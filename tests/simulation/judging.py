"""A motion whose truth is known from outside, what is asked of it, and what is to be said of the answer.

Truth comes as closed forms, from series in extended precision or from mpmath; nothing of it is computed by δq. An
answer is judged as the service gives it, rounded as it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from time import perf_counter
from typing import cast

import numpy as np
from numpy.typing import NDArray

from deltaq.errors import InputError
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import run

Floats = NDArray[np.float64]
Longs = NDArray[np.longdouble]
Row = Mapping[str, float]  # of a table in a scene document
Truth = Callable[[Floats], Longs]  # times -> values, shape (samples, coordinates compared)

ROUNDING = 1e-14  # · max(1, |q|): fewer than fifty units in the last place of a double are not judged
INVISIBLE = 1e-4  # who gives a step asks for no accuracy; an error like this is a fifth of a pixel
CLAIMS = ("ok", "stopped")  # statuses that stand for the curve
REFUSED = "refused:"  # before the code of the problem that a scene is said to have
LOW_ORDER, LOOSE = 2, 1e-6  # methods that cannot have every tolerance within the limit of steps
STEPS = (50, 20_000)  # of a run with a step that the user gives


@dataclass(frozen=True)
class Motion:
    """An initial value problem as a scene document, and its solution.

    `truth` gives the coordinates `names` with an error below `doubt` · max(1, |q|). `traps` are steps at which a method
    may overlook what drives the motion.
    """

    family: str
    scene: Mapping[str, object]
    t_end: float
    names: tuple[str, ...]
    truth: Truth = field(repr=False)
    doubt: float = 1e-14
    traps: tuple[float, ...] = ()

    @property
    def label(self) -> str:
        """The numbers drawn."""
        parameters, coordinates = (cast("list[Row]", self.scene[part]) for part in ("parameters", "coordinates"))
        told = [f"{row['name']} {row['value']:.7g}" for row in parameters]
        starts = [f"{row['name']}(0) {row['value']:.7g}, {row['rate']:.7g}" for row in coordinates]
        return ", ".join([f"t_end {self.t_end:g}", *told, *starts])


@dataclass(frozen=True)
class Trial:
    """One request: `accuracy` is a tolerance or a step."""

    motion: Motion
    method: str
    accuracy: tuple[str, float]
    samples: int

    @property
    def request(self) -> dict[str, object]:
        return {
            "scene": self.motion.scene,
            "t_end": self.motion.t_end,
            "samples": self.samples,
            "method": self.method,
            "include": ["coordinates", "error"],
            self.accuracy[0]: self.accuracy[1],
        }

    @property
    def tolerance(self) -> float | None:
        return self.accuracy[1] if self.accuracy[0] == "tolerance" else None

    @property
    def label(self) -> str:
        return f"{self.method}, {self.accuracy[0]} {self.accuracy[1]:.7g}, samples {self.samples}, {self.motion.label}"


@dataclass(frozen=True)
class Verdict:
    """What is to be said of one answer.

    `wrong` is the largest ratio of true error to estimate at samples where the tolerance is missed as well (with a
    step: at all samples); `uncovered` the same at all samples before the horizon, whatever the status is; both 0 if
    nothing is told. `excess` is the median of estimate over true error, nan where none is above the doubt of the
    truth. `worst` is the largest true error in the measure of a tolerance.
    """

    trial: Trial
    status: str
    is_complete: bool
    wrong: float
    uncovered: float
    excess: float
    worst: float
    runs: int = 0
    effort: float = math.nan  # right-hand sides of all runs over those of the run returned
    seconds: float = 0.0

    def is_silently_wrong(self, beyond: float = 1.0) -> bool:
        """The answer stands for its curve, and the curve is off by more than the estimate and more than asked for."""
        return self.status in CLAIMS and self.wrong > beyond

    @property
    def is_met(self) -> bool:
        """The curve came to the end and is as good as was asked for, and its estimate holds."""
        wanted = INVISIBLE if self.trial.tolerance is None else self.trial.tolerance
        return self.is_complete and self.worst <= wanted and self.uncovered <= 1.0

    @property
    def is_false_alarm(self) -> bool:
        """A curve as good as was asked for comes with a warning, or a regular scene is refused as singular.

        An estimate that is too careful by itself (`tolerance_missed`) counts apart.
        """
        is_alarm = self.status not in (*CLAIMS, "tolerance_missed")
        is_refused = self.status == "singular_mass_matrix" or self.status.startswith(REFUSED)
        return is_alarm and (self.is_met or is_refused)

    @property
    def is_too_careful(self) -> bool:
        return self.status == "tolerance_missed" and self.is_met


def draw_motions(kind: Callable[[Random], Motion], seed: str, count: int) -> Iterator[tuple[Motion, Random]]:
    """So many motions of a kind, each with the source of the numbers that follow; the same whenever they are drawn."""
    for number in range(count):
        random = Random(f"{seed} {kind.__name__} {number}")
        yield kind(random), random


def draw_trial(motion: Motion, random: Random, method: str | None = None) -> Trial:
    """Any method, a tolerance or a step (one that is a trap, often), few samples or many."""
    chosen = method or random.choice((*method_ids(), "auto", "auto"))
    samples, step = random.choice((51, 201, 501, 501)), _drawn_step(motion, random)
    if step is not None:
        return Trial(motion, chosen, ("step", step), samples)
    # loose ones, with which runs are coarse, more often
    tightest = random.choice((1e-3, 1e-6, 1e-9))
    return Trial(motion, chosen, ("tolerance", draw_tolerance(chosen, random, 1e-2, tightest)), samples)


def draw_tolerance(method: str, random: Random, loosest: float, tightest: float) -> float:
    """A power of ten. Methods of low order get none that they cannot reach within the limit of steps."""
    is_low = method != "auto" and get_method(method).order <= LOW_ORDER
    ends = np.round(np.log10([loosest, max(tightest, LOOSE) if is_low else tightest]))
    return float(10.0 ** random.randint(int(ends[1]), int(ends[0])))


def _drawn_step(motion: Motion, random: Random) -> float | None:
    """None: a tolerance is asked for instead."""
    few, many = STEPS
    traps = [h for h in motion.traps if few <= motion.t_end / h <= many]
    if traps and random.random() < 0.35:
        return random.choice(traps) * (1.0 + random.choice((0.0, 0.0, 1e-9, 1e-5, 1e-3)))
    if random.random() < 0.15:
        return motion.t_end / random.choice((100, 200, 400, 1000, 3000))
    return None


def judge(trial: Trial) -> Verdict:
    """Asks the service, and compares with the truth."""
    start = perf_counter()
    try:
        answer = run(trial.request)
    except InputError as refusal:
        return Verdict(trial, f"{REFUSED} {refusal.problems[0].code}", False, 0.0, 0.0, math.nan, math.inf)
    return verdict(trial, answer, perf_counter() - start)


def verdict(trial: Trial, answer: Mapping[str, object], seconds: float = 0.0) -> Verdict:
    """What an answer deserves, by the truth."""
    comparison = _compared(trial, answer)
    status, cost = str(answer["status"]), cast("dict[str, float]", answer["cost"])
    is_complete = len(comparison.true) > 0 and (status == "stopped" or _ended(trial, answer))
    wrong = comparison.shortfall(comparison.relative > (trial.tolerance or 0.0))
    rests = status != "stopped" or comparison.rests(trial.tolerance or INVISIBLE)
    if status in CLAIMS and not (is_complete and rests):
        wrong = math.inf
    return Verdict(
        trial,
        status,
        is_complete,
        wrong,
        comparison.shortfall(comparison.times < _horizon(answer)),
        comparison.excess,
        float(np.max(comparison.relative, initial=0.0)),
        int(cost["runs"]),
        cost["rhs_evaluations"] / max(cost["run_evaluations"], 1.0),
        seconds,
    )


def _ended(trial: Trial, answer: Mapping[str, object]) -> bool:
    return math.isclose(cast("float", answer["t_reached"]), trial.motion.t_end, rel_tol=1e-12)


def _horizon(answer: Mapping[str, object]) -> float:
    horizon = cast("dict[str, float | None]", answer["error"])["horizon"]
    return math.inf if horizon is None else horizon


@dataclass(frozen=True)
class _Comparison:
    """True errors beside those told, at the samples of an answer; `left` is how far the end is from the true one."""

    times: Floats
    true: Floats
    relative: Floats
    doubt: Floats
    told: Floats
    left: float

    def shortfall(self, where: NDArray[np.bool_]) -> float:
        known = np.maximum(self.true - self.doubt, 0.0)[where] / np.maximum(self.told[where], 1e-300)
        return float(np.max(known, initial=0.0))

    @property
    def excess(self) -> float:
        counts = self.true > 10 * self.doubt
        return float(np.median(self.told[counts] / self.true[counts])) if counts.any() else math.nan

    def rests(self, wanted: float) -> bool:
        """What is said to have stopped has: at the end of the span it is where it was left."""
        return len(self.told) > 0 and self.left <= max(2.0 * float(self.told[-1]), 2.0 * wanted)


def _compared(trial: Trial, answer: Mapping[str, object]) -> _Comparison:
    motion, table = trial.motion, cast("dict[str, Sequence[float]]", answer["coordinates"])
    times = np.array(answer["t"], dtype=np.float64)
    values = np.array([table[name] for name in motion.names], dtype=np.longdouble).T
    exact = motion.truth(np.append(times, motion.t_end))
    sizes = np.maximum(1.0, np.abs(exact[:-1]))
    off = np.abs(values - exact[:-1])
    doubt = (max(motion.doubt, ROUNDING) * sizes).max(axis=1, initial=0.0)
    told = np.array(cast("dict[str, object]", answer["error"])["estimate"], dtype=np.float64)
    left = float(np.abs(values[-1] - exact[-1]).max()) if len(times) else math.inf
    return _Comparison(times, _floats(off), _floats(off / sizes), np.asarray(doubt, dtype=np.float64), told, left)


def _floats(table: Longs) -> Floats:
    """The largest of each row."""
    return np.asarray(table.max(axis=1, initial=0.0), dtype=np.float64)
