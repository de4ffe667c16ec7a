"""Is a motion chaotic? Its largest Lyapunov exponent with an interval, and a second, independent witness.

The exponent is the mean rate at which a small deviation grows, after a transient. Its interval joins the statistics of
the mean (batch means with Student's t, for batches of several lengths, since rates are correlated in time) with what a
regular motion's growth like a power of the time would feign. The second witness, the 0–1 test, sees the motion alone.
A verdict needs both; where they disagree, there is none.
Source: Benettin et al. (1976); Law, Simulation Modeling and Analysis, §9.5 (batch means); Gottwald, Melbourne, SIAM J.
Appl. Dyn. Syst. 8 (2009) 129 (0–1 test); Skokos, Lect. Notes Phys. 790 (2010) 63 (growth of regular motions).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..contract.experiments.chaos import ChaosReason as Reason
from ..contract.experiments.chaos import ChaosVerdict as Verdict
from ..simulation.problem import Floats
from .divergence import IN_PERIOD, Followed

TRANSIENT = 0.25  # of all that is followed
BATCHES = {8: 3.499, 16: 2.947, 32: 2.744}  # how many, and Student's t for 99 %
CONFIDENCE = 0.99
NUMERIC = 1e-6  # error of a rate by the steps, in parts of the typical frequency
FEWEST = 800  # stretches
ENOUGH, NARROW = 16_000, 0.1  # stretches of a chaotic motion, and its interval in parts of the exponent, that will do
ANGLES, SAMPLES = 50, 8192  # of the 0–1 test
IRREGULAR, REGULAR = 0.7, 0.4  # 0–1 test: beyond, below
FLAT = 0.02  # growth in a typical period that may pass for none
TREND, CHANGE = 4.0, 0.02  # t of a trend of the mean square speed, and its size: the motion has not settled
AT_REST = 1e-9  # of the scales


@dataclass(frozen=True)
class Exponent:
    """λ in 1/s with an interval (99 %), measured from the time `transient` on.

    `times` and `values`, the mean rate since then, have shape (stretches,). `power` is p if the growth is read as t^p
    instead of e^(λt); `misfits` are how far ln(growth) stays from a line over t, and over ln t (root mean square).
    """

    times: Floats
    values: Floats
    lower: float
    upper: float
    transient: float
    power: float
    misfits: tuple[float, float]

    @property
    def last(self) -> float:
        """The mean over all that was followed, in 1/s."""
        return float(self.values[-1])

    @property
    def spread(self) -> float:
        """The range of the later half of the values, in 1/s."""
        return float(np.ptp(self.values[self.values.size // 2 :]))


@dataclass(frozen=True)
class Judgement:
    """What is said of a motion; `irregularity` is K of the 0–1 test: near 0 regular, near 1 chaotic."""

    verdict: Verdict
    reason: Reason
    irregularity: float


def exponent_of(motion: Followed) -> Exponent | None:
    """The exponent of a motion; None where too little of it could be followed."""
    count, stretch = len(motion.growths), motion.rhythm.stretch
    if count < FEWEST:
        return None
    first = int(TRANSIENT * count)
    late = motion.growths[first:]
    number = np.arange(1.0, late.size + 1)
    grown, times = np.cumsum(late), np.asarray(stretch * (first + number), dtype=np.float64)
    rate, reach = float(late.mean()) / stretch, _reach(late / stretch)
    feigned = math.log(count / first) / (late.size * stretch)
    numeric = NUMERIC * motion.rhythm.frequency
    power, *misfits = _readings(times, grown)
    interval = rate - reach - feigned - numeric, rate + reach + numeric
    return Exponent(
        times, np.asarray(grown / (stretch * number)), *interval, first * stretch, power, (misfits[0], misfits[1])
    )


def _reach(rates: Floats) -> float:
    """Half the interval of a mean: the widest that batches of several lengths give."""
    return max(_batch_reach(rates, count, t) for count, t in BATCHES.items())


def _batch_reach(rates: Floats, count: int, t: float) -> float:
    """Of so many batches; means that still follow one another count for less."""
    means = rates[: rates.size // count * count].reshape(count, -1).mean(axis=1)
    off = means - means.mean()
    square = float(off @ off)
    if square == 0.0:
        return 0.0
    follow = min(max(float(off[:-1] @ off[1:]) / square, 0.0), 0.8)
    return t * math.sqrt(square / (count - 1) / count * (1.0 + follow) / (1.0 - follow))


def _readings(times: Floats, grown: Floats) -> tuple[float, float, float]:
    """The power p of growth like t^p, and the misfits of e^(λt) and of t^p (least squares)."""
    lines = [np.polyfit(x, grown, 1) for x in (times, np.log(times))]
    misfits = [
        float(np.std(grown - np.polyval(line, x))) for line, x in zip(lines, (times, np.log(times)), strict=True)
    ]
    return float(lines[1][0]), misfits[0], misfits[1]


def irregularity(signal: Floats) -> float:
    """K of the 0–1 test, median over random angles c: how closely the spread of Σ x e^{icj} grows with the time.

    `signal` has shape (samples,). Bounded for a regular signal (K near 0), like a random walk for a chaotic one (K near
    1); 0 for one that is at rest.
    Source: Gottwald, Melbourne, SIAM J. Appl. Dyn. Syst. 8 (2009) 129.
    """
    off = signal - signal.mean()
    size = float(off.std())
    if size <= AT_REST:
        return 0.0
    angles = np.random.default_rng(0).uniform(math.pi / 5, 4 * math.pi / 5, ANGLES)
    return float(np.median([_diffusion(off / size, float(angle)) for angle in angles]))


def _diffusion(signal: Floats, angle: float) -> float:
    """The correlation of the mean square displacement with the lag, up to a tenth of all."""
    count = signal.size
    place = np.cumsum(signal * np.exp(1j * angle * np.arange(1, count + 1)))
    lags = np.arange(1, count // 10 + 1)
    spectrum = np.fft.fft(place, 2 * count)
    products = np.fft.ifft(np.abs(spectrum) ** 2)[lags].real
    squares = np.concatenate([[0.0], np.cumsum(np.abs(place) ** 2)])
    ends = squares[count - lags] + squares[count] - squares[lags]
    displaced = (ends - 2.0 * products) / (count - lags)
    return float(np.corrcoef(lags, displaced)[0, 1]) if np.ptp(displaced) > 0.0 else 0.0


def judge(motion: Followed, exponent: Exponent | None) -> Judgement:
    """Regular or chaotic where exponent and 0–1 test agree and the motion has settled, else undecided and why."""
    if motion.status != "ok":
        return Judgement(Verdict.UNDECIDED, Reason.ENDED, math.nan)
    if exponent is None:
        return Judgement(Verdict.UNDECIDED, Reason.SHORT, math.nan)
    k = irregularity(_signal(motion))
    if exponent.lower > 0.0:
        return _chaotic(motion, k)
    return _regular(motion, exponent, k)


def is_enough(motion: Followed, exponent: Exponent | None) -> bool:
    """Whether a chaotic motion is known well enough; one that seems regular is followed as long as can be."""
    if exponent is None or len(motion.growths) < ENOUGH or exponent.lower <= 0.0:
        return False
    is_narrow = exponent.upper - exponent.lower < NARROW * exponent.last
    return is_narrow and judge(motion, exponent).verdict == Verdict.CHAOTIC


def _chaotic(motion: Followed, k: float) -> Judgement:
    if k < IRREGULAR:
        return Judgement(Verdict.UNDECIDED, Reason.DISAGREE, k)
    if not is_settled(motion):
        return Judgement(Verdict.UNDECIDED, Reason.UNSETTLED, k)
    return Judgement(Verdict.CHAOTIC, Reason.NONE, k)


def _regular(motion: Followed, exponent: Exponent, k: float) -> Judgement:
    if exponent.upper * motion.rhythm.stretch * IN_PERIOD > FLAT:
        return Judgement(Verdict.UNDECIDED, Reason.WIDE, k)
    if k > REGULAR:
        return Judgement(Verdict.UNDECIDED, Reason.DISAGREE, k)
    return Judgement(Verdict.REGULAR, Reason.NONE, k)


def _signal(motion: Followed) -> Floats:
    """One signal after the transient: rates with weights that no symmetry cancels, spread over all of it."""
    rates = motion.rates[int(TRANSIENT * len(motion.growths)) :]
    weights = 0.618 ** np.arange(rates.shape[1])
    return np.asarray((rates @ weights)[:: max(1, math.ceil(len(rates) / SAMPLES))])


def is_settled(motion: Followed) -> bool:
    """Whether the mean square speed after the transient has no trend (least squares over batches)."""
    squares = (motion.rates[int(TRANSIENT * len(motion.growths)) :] ** 2).sum(axis=1)
    count = 16
    means = squares[: squares.size // count * count].reshape(count, -1).mean(axis=1)
    place = np.arange(count) - 0.5 * (count - 1)
    slope = float(place @ means) / float(place @ place)
    left = float(np.sum((means - means.mean() - slope * place) ** 2)) / (count - 2)
    is_steep = abs(slope) * count > CHANGE * float(means.mean())
    return not (is_steep and abs(slope) > TREND * math.sqrt(left / float(place @ place)))
