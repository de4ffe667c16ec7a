"""Motions made to fool a simulation, each with its truth: fast drives, pulses, switches, walls, bad masses, friction.

What they have in common is that steps can agree with each other without having seen what matters. The truth is a closed
form wherever there is one (superposition, error functions, elliptic functions, eigenvectors by mpmath), else SciPy's
DOP853 in pieces that begin and end where the force does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from random import Random
from typing import cast

import mpmath
import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erf, fresnel, ive
from tests.simulation.judging import Floats, Longs, Motion, Trial, Truth
from tests.simulation.scenes import WEIGHT, document

from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import run

SPANS = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0)
DETUNED = (0.0, 0.0, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2)
FIRST_STEPS = (50, 100, 200, 400, 500, 800)  # parts of the span that first steps, or samples, may be
NUMERIC = 1e-10  # doubt of a truth by SciPy over the spans here
Shares = Sequence[tuple[float, float]]  # (time, height): what begins to act then
Draw = Callable[[Random], Motion]
PI = np.longdouble("3.14159265358979323846264")


def on_line(
    force: str, initial: tuple[float, float], parameters: Mapping[str, float], mass: float = 1.0
) -> dict[str, object]:
    """One particle on a line under one force."""
    load = {"kind": "force", "name": "pull", "at": "mass", "force": [force, "0"]}
    return document({"x": initial}, {"m": mass, **parameters}, {"mass": ("m", ["x", "0"])}, [load])


def log_uniform(random: Random, low: float, high: float) -> float:
    return float(math.exp(random.uniform(math.log(low), math.log(high))))


def some_sign(random: Random) -> float:
    return random.choice((-1.0, 1.0))


def _start(random: Random) -> tuple[float, float]:
    """At rest, now and then."""
    return random.uniform(-1.5, 1.5), random.choice((0.0, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)))


def _long(times: Floats) -> Longs:
    return np.asarray(times, dtype=np.longdouble)


def _column(values: Longs | Floats) -> Longs:
    return np.asarray(values, dtype=np.longdouble)[:, None]


# Linear motions in closed form. `stiffness` is ω₀² of the oscillator; 0 is a free particle.


def free_swing(stiffness: float, initial: tuple[float, float], t: Longs) -> Longs:
    """x₀ cos ω₀t + u₀/ω₀ sin ω₀t."""
    x0, u0 = map(np.longdouble, initial)
    if stiffness == 0.0:
        return np.asarray(x0 + u0 * t)
    w = np.sqrt(np.longdouble(stiffness))
    return np.asarray(x0 * np.cos(w * t) + u0 / w * np.sin(w * t))


def after_step(stiffness: float, t: Longs) -> Longs:
    """The response to a force 1 that begins at 0."""
    late = np.maximum(t, 0)
    if stiffness == 0.0:
        return np.asarray(late**2 / 2)
    w = np.sqrt(np.longdouble(stiffness))
    return np.asarray(2 * np.sin(w * late / 2) ** 2 / w**2)


def after_ramp(stiffness: float, t: Longs) -> Longs:
    """The response to a force t that begins at 0."""
    late = np.maximum(t, 0)
    if stiffness == 0.0:
        return np.asarray(late**3 / 6)
    w = np.sqrt(np.longdouble(stiffness))
    return np.asarray((late - np.sin(w * late) / w) / w**2)


def superposed(
    stiffness: float, initial: tuple[float, float], times: Floats, steps: Shares, ramps: Shares = ()
) -> Longs:
    """The swing with steps and ramps of the force, each from its time on."""
    t = _long(times)
    found = free_swing(stiffness, initial, t)
    for begin, height in steps:
        found = found + np.longdouble(height) * after_step(stiffness, t - np.longdouble(begin))
    for begin, slope in ramps:
        found = found + np.longdouble(slope) * after_ramp(stiffness, t - np.longdouble(begin))
    return _column(found)


Wave = tuple[np.longdouble, np.longdouble, np.longdouble]  # amplitude, frequency, phase of a cosine


def under_waves(stiffness: float, initial: tuple[float, float], waves: Iterable[Wave], times: Floats) -> Longs:
    """The swing under a sum of forces A cos(Ωt + θ)."""
    t = _long(times)
    parts = [_under_wave(stiffness, wave, t) for wave in waves]
    return _column(free_swing(stiffness, initial, t) + np.sum(parts, axis=0))


def _under_wave(stiffness: float, wave: Wave, t: Longs) -> Longs:
    """From rest: the particular solution less what it begins with."""
    size, pace, phase = wave
    if pace == 0:
        return np.asarray(size * np.cos(phase) * after_step(stiffness, t))
    share = size / (np.longdouble(stiffness) - pace**2)
    begin, rate = share * np.cos(phase), -share * pace * np.sin(phase)
    w = np.sqrt(np.longdouble(stiffness))
    swing = begin * np.cos(w * t) + (rate * t if stiffness == 0.0 else rate / w * np.sin(w * t))
    return np.asarray(share * np.cos(pace * t + phase) - swing)


# Fast drives


def aligned_pace(random: Random, span: float) -> float:
    """A circular frequency of which the first steps of a run, or halves of them, meet only zeros; or almost only."""
    parts = random.choice(FIRST_STEPS) * random.choice((0.5, 1.0, 2.0, 3.0))
    return 2.0 * math.pi * parts / span * (1.0 + random.choice(DETUNED))


def _traps(pace: float) -> tuple[float, ...]:
    """Steps of halves of periods."""
    return tuple(math.pi / pace * halves for halves in (1, 2, 4, 8, 16, 64))


def _stiffness(random: Random) -> float:
    return random.uniform(0.3, 4.0)


def driven_oscillator(random: Random) -> Motion:
    """m = 1: x″ = −k x + a ω sin ωt, or with cos, at frequencies that steps may miss."""
    span = random.choice(SPANS)
    return driven("driven oscillator", random, _stiffness(random), span, _pace(random, span))


def driven_free_mass(random: Random) -> Motion:
    """x″ = a ω sin ωt: no swing of its own."""
    span = random.choice(SPANS)
    return driven("driven free mass", random, 0.0, span, _pace(random, span))


def driven(family: str, random: Random, stiffness: float, span: float, pace: float) -> Motion:
    """x″ = −k x + a wave, a square of one, or a beat."""
    size, other = random.choice((0.1, 0.5, 1.0, 1.0)), pace * (1.0 + random.uniform(0.001, 0.02))
    form, initial = random.choice(tuple(_WAVES)), _start(random)
    waves = _WAVES[form](size, np.longdouble(pace), np.longdouble(other))
    scene = on_line(f"-k*x + {form}", initial, {"k": stiffness, "a": size, "omega": pace, "nu": other})
    return Motion(family, scene, span, ("x",), partial(under_waves, stiffness, initial, waves), 1e-15, _traps(pace))


def aimed_drive(random: Random) -> Trial:
    """A drive whose zeros are the steps that the same question took with a slow drive: whatever the steps are made by.

    Only such methods are asked as take steps of one size.
    """
    method = random.choice([name for name in method_ids() if not get_method(name).is_adaptive])
    stiffness, span = random.choice((0.0, 0.0, _stiffness(random))), random.choice(SPANS[:5])
    accuracy, samples = ("tolerance", random.choice((1e-2, 1e-3, 1e-4))), random.choice((51, 201, 501))
    slow = Trial(driven("slow drive", random, stiffness, span, 2.0 / span), method, accuracy, samples)
    steps = cast("dict[str, int]", run(slow.request)["cost"])["steps"]
    pace = math.pi * steps / span * random.choice((0.5, 1.0, 1.0, 2.0, 4.0)) * (1.0 + random.choice(DETUNED))
    return Trial(driven("aimed drive", random, stiffness, span, pace), method, accuracy, samples)


def _pace(random: Random, span: float) -> float:
    """Aligned with the span, or so and so many Hz."""
    if span > 30.0 or random.random() < 0.6:
        return aligned_pace(random, span)
    return 2.0 * math.pi * random.choice((20.0, 40.0, 50.0, 100.0, 400.0)) * (1.0 + random.choice(DETUNED))


_QUARTER, _HALF, _ZERO = PI / 2, np.longdouble(0.5), np.longdouble(0)
# sin² and a beat have a mean, or a slow part, that is lost where samples meet zeros
_WAVES: Mapping[str, Callable[[float, np.longdouble, np.longdouble], list[Wave]]] = {
    "a*omega*sin(omega*t)": lambda a, w, _: [(a * w, w, -_QUARTER)],
    "a*omega*cos(omega*t)": lambda a, w, _: [(a * w, w, _ZERO)],
    "a*sin(omega*t)^2": lambda a, w, _: [(_HALF * a, _ZERO, _ZERO), (-_HALF * a, 2 * w, _ZERO)],
    "a*sin(omega*t)*sin(nu*t)": lambda a, w, v: [(_HALF * a, v - w, _ZERO), (-_HALF * a, v + w, _ZERO)],
}


def chirp(random: Random) -> Motion:
    """x″ = a cos(b t²): a frequency that runs through all others. Fresnel's integrals."""
    span = random.choice((1.0, 3.0, 10.0))
    rate, size, initial = random.uniform(3.0, 300.0) / span, random.uniform(0.5, 3.0), _start(random)

    def truth(times: Floats) -> Longs:
        unit = math.sqrt(2.0 * rate / math.pi)
        speed = size / unit * fresnel(unit * times)[1]
        return _column(initial[0] + initial[1] * times + times * speed - size * np.sin(rate * times**2) / (2.0 * rate))

    scene = on_line("a*cos(b*t^2)", initial, {"a": size, "b": rate})
    return Motion("chirp", scene, span, ("x",), truth, 1e-12)


# Pulses


def _pulse(random: Random, span: float) -> tuple[float, float]:
    """Middle and width; all of it within the span."""
    width = log_uniform(random, 1e-5, 1e-1)
    return random.uniform(min(0.3 * span, 10 * width), span - 10 * width), width


_ROOT = math.sqrt(math.pi)
_PULSE = f"J/(w*{_ROOT!r})*exp(-((t - t0)/w)^2)"


def pulse_on_free_mass(random: Random) -> Motion:
    """An impulse J in the time w."""
    return _pulsed(random, "pulse on free mass", 0.0)


def pulse_on_oscillator(random: Random) -> Motion:
    """A hammer blow."""
    return _pulsed(random, "pulse on oscillator", _stiffness(random))


def burst(random: Random) -> Motion:
    """The same with a fast wave inside."""
    return _pulsed(random, "burst", _stiffness(random), random.uniform(0.5, 4.0))


def _pulsed(random: Random, family: str, stiffness: float, waves: float = 0.0) -> Motion:
    span, blow = random.choice((1.0, 10.0, 100.0, 1000.0)), some_sign(random) * random.uniform(0.3, 3.0)
    return replace(pulse(stiffness, span, _pulse(random, span), _start(random), blow, waves), family=family)


def pulse(
    stiffness: float,
    span: float,
    place: tuple[float, float],
    initial: tuple[float, float],
    blow: float,
    waves: float = 0.0,
) -> Motion:
    """x″ = −k x + F, F a Gauss function with middle, width and impulse; `waves` is Ωw of a factor cos Ω(t − t₀)."""
    middle, width = place
    push = partial(_kick, place) if stiffness == 0.0 else partial(_blow, place, math.sqrt(stiffness), waves / width)

    def truth(times: Floats) -> Longs:
        return _column(free_swing(stiffness, initial, _long(times)) + blow * push(times))

    inside = "*cos(Omega*(t - t0))" if waves else ""
    values = {"k": stiffness, "J": blow, "w": width, "t0": middle, "Omega": waves / width}
    scene = on_line(f"-k*x + {_PULSE}{inside}", initial, values)
    traps = (*beside(width), *(_traps(waves / width) if waves else ()))
    return Motion("pulse", scene, span, ("x",), truth, 1e-13, traps)


def _kick(place: tuple[float, float], times: Floats) -> Floats:
    """Of a free mass: u = (erf((t − t₀)/w) + erf(t₀/w))/2, integrated once more."""
    middle, width = place

    def integral(t: Floats) -> Floats:
        z = (t - middle) / width
        return np.asarray(width * (z * erf(z) + np.exp(-(z**2)) / _ROOT))

    return np.asarray((integral(times) - integral(np.zeros(1)) + times * erf(middle / width)) / 2.0)


def _blow(place: tuple[float, float], own: float, pace: float, times: Floats) -> Floats:
    """Of an oscillator: Im(e^{iω₀t} ∫ F e^{−iω₀s} ds)/ω₀, error functions of complex numbers."""
    middle, width = place
    late = times - middle
    parts = [_within(width, own + way * pace, -middle, late) for way in (-1.0, 1.0)]
    return np.asarray(np.imag(np.exp(1j * own * late) * (parts[0] + parts[1]) / 2.0) / own)


def beside(length: float) -> tuple[float, ...]:
    """Steps about as long as something short."""
    return tuple(length * parts for parts in (0.1, 1.0, 3.0, 10.0, 30.0))


def _within(width: float, pace: float, begin: float, end: Floats) -> Floats:
    """∫ exp(−(s/w)²) e^{−iΩs} ds / (w √π) from `begin` to `end`, by completing the square."""
    shift = 0.5j * pace * width
    found = np.exp(shift**2) * (erf(end / width + shift) - erf(begin / width + shift)) / 2.0
    return np.asarray(found)


def pulse_on_pendulum(random: Random) -> Motion:
    """A blow on a pendulum that swings widely."""
    span = random.choice((3.0, 10.0))
    (middle, width), blow = _pulse(random, span), some_sign(random) * random.uniform(0.3, 2.0)
    initial, ratio = (random.uniform(0.3, 2.0), random.uniform(-0.5, 0.5)), random.uniform(4.0, 12.0)

    def rhs(t: float, y: Floats) -> tuple[float, float]:
        z = (t - middle) / width
        push = blow / (width * _ROOT) * math.exp(-(z**2)) if abs(z) < 25.0 else 0.0
        return y[1], -ratio * math.sin(y[0]) + push

    truth = in_pieces(rhs, initial, (middle - 9 * width, middle + 9 * width), width)
    moment = {"kind": "moment", "name": "blow", "angle": "phi", "moment": _PULSE}
    values = {"m": 1.0, "l": 1.0, "g": ratio, "J": blow, "w": width, "t0": middle}
    bodies = {"bob": ("m", ["l*sin(phi)", "l*cos(phi)"])}
    scene = document({"phi": initial}, values, bodies, [WEIGHT, moment])
    return Motion("pulse on pendulum", scene, span, ("phi",), truth, NUMERIC, beside(width))


def in_pieces(
    rhs: Callable[[float, Floats], tuple[float, float]],
    initial: tuple[float, float],
    short: tuple[float, float],
    unit: float,
) -> Truth:
    """x(t) of a motion whose force has a short part: the steps within are below `unit`."""
    begin, end = short

    def truth(times: Floats) -> Longs:
        ends = np.unique(np.concatenate([[0.0], times, [at for at in short if 0.0 < at < times.max()]]))
        states = {0.0: np.array(initial)}
        for a, b in pairwise(ends):
            longest = unit if a < end and b > begin else np.inf
            with np.errstate(invalid="ignore"):  # SciPy divides 0 by 0 where a step has no error at all
                found = solve_ivp(rhs, (a, b), states[a], "DOP853", rtol=1e-13, atol=1e-15, max_step=longest)
            states[b] = found.y[:, -1]
        return _column(np.array([states[t][0] for t in times]))

    return truth


# Switches


def window(random: Random) -> Motion:
    """A force that is on between two times, by sign(t)."""
    span, stiffness, initial = _switched(random)
    length = span * log_uniform(random, 1e-5, 1e-1)
    begin, height = random.uniform(0.05, 0.85) * span, some_sign(random) / length
    end = begin + length
    scene = on_line(
        "-k*x + F*(sign(t - ta) - sign(t - tb))/2", initial, {"k": stiffness, "F": height, "ta": begin, "tb": end}
    )
    truth = partial(superposed, stiffness, initial, steps=[(begin, height), (end, -height)])
    return Motion("window", scene, span, ("x",), truth, 1e-13, beside(length))


def switch(random: Random) -> Motion:
    """A force that begins at some time, by sign(t), and grows from then on, by |t|."""
    span, stiffness, initial = _switched(random)
    begin, height, slope = random.uniform(0.05, 0.95) * span, random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)
    force = "F*(1 + sign(t - ta))/2 + b*(abs(t - ta) + t - ta)/2"
    scene = on_line(f"-k*x + {force}", initial, {"k": stiffness, "F": height, "b": slope / span, "ta": begin})
    truth = partial(superposed, stiffness, initial, steps=[(begin, height)], ramps=[(begin, slope / span)])
    return Motion("switch", scene, span, ("x",), truth, 1e-13)


def _switched(random: Random) -> tuple[float, float, tuple[float, float]]:
    return random.choice((1.0, 10.0, 100.0)), random.choice((0.0, _stiffness(random))), _start(random)


def ramped_window(random: Random) -> Motion:
    """A force that rises, stays and falls, by |t|: four bends."""
    span, stiffness, initial = _switched(random)
    length, begin = span * log_uniform(random, 1e-3, 1e-1), random.uniform(0.05, 0.6) * span
    slope = some_sign(random) / length**2
    corners = [begin + n * length for n in range(4)]
    ramps = list(zip(corners, (slope, -slope, -slope, slope), strict=True))
    values = {"k": stiffness, "b": slope, **dict(zip(("ta", "tb", "tc", "td"), corners, strict=True))}
    scene = on_line("-k*x + b*(abs(t - ta) - abs(t - tb) - abs(t - tc) + abs(t - td))/2", initial, values)
    # the corners are rounded: before the first of them a force is left
    left = slope * float(np.longdouble(corners[0]) - corners[1] - corners[2] + corners[3]) / 2
    truth = partial(superposed, stiffness, initial, steps=[(0.0, left)], ramps=ramps)
    return Motion("ramped window", scene, span, ("x",), truth, 1e-9, beside(length))


def switched_train(random: Random) -> Motion:
    """A force that is on for a part of each period: (1 + sign(cos Ωt − c))/2."""
    span, stiffness, initial = _switched(random)
    pulses, limit = random.choice((3, 10, 50, 100, 200)), math.cos(math.pi * log_uniform(random, 1e-3, 0.7))
    period, height = span / pulses * (1.0 + random.choice(DETUNED)), some_sign(random) * random.uniform(0.5, 2.0)
    pace = 2.0 * math.pi / period
    angle, turn = mpmath.acos(limit), 2 * mpmath.pi
    off = [(float((n * turn + angle) / pace), -height) for n in range(pulses + 2)]
    on = [(float((n * turn - angle) / pace), height) for n in range(1, pulses + 2)]
    scene = on_line(
        "-k*x + F*(1 + sign(cos(Omega*t) - c))/2", initial, {"k": stiffness, "F": height, "Omega": pace, "c": limit}
    )
    truth = partial(superposed, stiffness, initial, steps=[(0.0, height), *on, *off])
    return Motion(
        "switched train", scene, span, ("x",), truth, 1e-12, tuple(period * part for part in (0.25, 0.5, 1.0))
    )


def smooth_train(random: Random) -> Motion:
    """Smooth pulses exp(b (cos Ω(t − t₀) − 1)): a Fourier series of Bessel functions."""
    span, stiffness, initial = random.choice((3.0, 10.0, 100.0)), _stiffness(random), _start(random)
    pulses, sharp = random.choice((5, 20, 100, 200)), log_uniform(random, 3.0, 3e4)
    pace = 2.0 * math.pi * pulses / span * (1.0 + random.choice(DETUNED))
    size = some_sign(random) * random.uniform(0.5, 2.0) * math.sqrt(sharp) / 5.0
    shift, count = random.uniform(0.1, 0.9) * 2.0 * math.pi / pace, int(9.0 * math.sqrt(sharp)) + 40
    sizes = size * ive(np.arange(count), sharp) * np.where(np.arange(count), 2.0, 1.0)
    turn, late = np.longdouble(pace), np.longdouble(shift)
    waves = [(np.longdouble(a), n * turn, -n * turn * late) for n, a in enumerate(sizes)]
    values = {"k": stiffness, "F": size, "b": sharp, "Omega": pace, "t0": shift}
    scene = on_line("-k*x + F*exp(b*(cos(Omega*(t - t0)) - 1))", initial, values)
    truth = partial(under_waves, stiffness, initial, waves)
    return Motion("smooth train", scene, span, ("x",), truth, 1e-12, _traps(pace))


# Guides


@dataclass(frozen=True)
class _End:
    """The moving end of a spring: y(t) as text, with its parameters, as numbers, and its rate in the beginning."""

    guide: str
    values: Mapping[str, float]
    place: Callable[[Floats], Floats]
    rate: float = 0.0


def guided_by_step(random: Random) -> Motion:
    """A mass on a spring whose other end jumps: x″ = −k (x − y), y = a sign(t − t₀)."""
    span, stiffness, initial = _guided(random)
    begin, jump = random.uniform(0.1, 0.9) * span, some_sign(random) * random.uniform(0.2, 2.0)
    truth = partial(superposed, stiffness, initial, steps=[(0.0, -stiffness * jump), (begin, 2.0 * stiffness * jump)])
    end = _End("a*sign(t - t0)", {"a": jump, "t0": begin}, lambda t: jump * np.sign(t - begin))
    return Motion("guide with a step", *_on_spring(random, span, stiffness, initial, truth, end), 1e-13)


def guided_by_kink(random: Random) -> Motion:
    """The other end comes and goes: y = v |t − t₀|."""
    span, stiffness, initial = _guided(random)
    begin, speed = random.uniform(0.1, 0.9) * span, some_sign(random) * random.uniform(0.2, 2.0)
    steps, ramps = [(0.0, stiffness * speed * begin)], [(0.0, -stiffness * speed), (begin, 2.0 * stiffness * speed)]
    truth = partial(superposed, stiffness, initial, steps=steps, ramps=ramps)
    end = _End("v*abs(t - t0)", {"v": speed, "t0": begin}, lambda t: speed * np.abs(t - begin), -speed)
    return Motion("guide with a kink", *_on_spring(random, span, stiffness, initial, truth, end), 1e-13)


def guided_steeply(random: Random) -> Motion:
    """The other end goes over in a short time: y = a tanh((t − t₀)/w)."""
    span, stiffness, initial = _guided(random)
    begin, jump, width = (
        random.uniform(0.2, 0.8) * span,
        random.uniform(0.2, 2.0),
        log_uniform(random, 1e-5, 5e-3) * span,
    )

    def rhs(t: float, y: Floats) -> tuple[float, float]:
        return y[1], -stiffness * (y[0] - jump * math.tanh((t - begin) / width))

    truth = in_pieces(rhs, initial, (begin - 20.0 * width, begin + 20.0 * width), width)
    values = {"a": jump, "t0": begin, "w": width}
    end = _End("a*tanh((t - t0)/w)", values, lambda t: jump * np.tanh((t - begin) / width))
    return Motion("guide that is steep", *_on_spring(random, span, stiffness, initial, truth, end), NUMERIC)


def _guided(random: Random) -> tuple[float, float, tuple[float, float]]:
    return random.choice((3.0, 10.0, 30.0)), _stiffness(random), _start(random)


def _on_spring(
    random: Random, span: float, stiffness: float, initial: tuple[float, float], truth: Truth, end: _End
) -> tuple[dict[str, object], float, tuple[str], Truth]:
    """Scene, span, coordinate and its truth: the place x itself, or s = x − y, of whose inertia ÿ is a part."""
    values = {"m": 1.0, "k": stiffness, **end.values}
    guided, guide = {"y": (0.0, 0.0)}, {"y": end.guide}
    if random.random() < 0.5:
        spring = {"kind": "potential", "name": "spring", "energy": "k/2*(x - y)^2"}
        scene = document({**guided, "x": initial}, values, {"mass": ("m", ["x", "0"])}, [spring], guide)
        return scene, span, ("x",), truth
    start = (initial[0] - float(end.place(np.zeros(1))[0]), initial[1] - end.rate)
    spring = {"kind": "potential", "name": "spring", "energy": "k/2*s^2"}
    scene = document({**guided, "s": start}, values, {"mass": ("m", ["y + s", "0"])}, [spring], guide)
    return scene, span, ("s",), lambda times: truth(times) - end.place(times)[:, None]


IN_TIME: tuple[Draw, ...] = (
    driven_oscillator,
    driven_free_mass,
    chirp,
    pulse_on_free_mass,
    pulse_on_oscillator,
    pulse_on_pendulum,
    burst,
    window,
    switch,
    ramped_window,
    switched_train,
    smooth_train,
    guided_by_step,
    guided_by_kink,
    guided_steeply,
)
