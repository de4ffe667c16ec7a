"""Motions made to fool a simulation by where they are and how they move: walls, contacts, masses, friction, long spans.

See `adversaries` for the forces that depend on time. KINDS has all of both.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from itertools import accumulate, pairwise
from random import Random

import mpmath
import numpy as np
from tests.simulation.adversaries import IN_TIME, NUMERIC, PI, Draw, in_pieces, log_uniform, on_line, some_sign
from tests.simulation.judging import Floats, Longs, Motion
from tests.simulation.scenes import WEIGHT, document

# Walls and wells


def wall(random: Random) -> Motion:
    """A particle flies over a narrow hill or well of its potential, or is thrown back."""
    span, speed, width = random.choice((3.0, 10.0, 100.0)), random.uniform(0.5, 3.0), log_uniform(random, 1e-5, 1e-1)
    height = random.choice((-3.0, -0.5, 0.3, 0.7, 1.4, 1.4, 3.0, 3.0)) * speed**2 / 2.0
    place = random.uniform(0.2, 0.8) * speed * span
    reach = 7.0 * width
    start = (0.0, speed)

    def rhs(_: float, y: Floats) -> tuple[float, float]:
        z = y[0] / width
        return y[1], 2.0 * height * z / width * math.exp(-(z**2)) if abs(z) < 25.0 else 0.0

    # fast in, slow at the top, out: no passage here takes longer than four times the free one
    short = ((place - reach) / speed, (place - reach) / speed + 8.0 * reach / speed)
    # from the hill, so that the truth does not lose the digits that x - x0 loses
    beside = in_pieces(rhs, (-place, speed), short, 0.2 * width / speed)

    def truth(times: Floats) -> Longs:
        return np.asarray(beside(times) + np.longdouble(place))

    values = {"V0": height, "w": width, "x0": place}
    scene = on_line("2*V0*(x - x0)/w^2*exp(-((x - x0)/w)^2)", start, values)
    traps = tuple(width / speed * part for part in (0.3, 1.0, 3.0, 10.0))
    return Motion("wall", scene, span, ("x",), truth, NUMERIC, traps)


def contact(random: Random) -> Motion:
    """A ball bounces on a stiff spring: parabolas, and halves of an ellipse (x + m g/k, ẋ/ω) in between."""
    stiffness, height, g = log_uniform(random, 1e3, 1e8), random.uniform(0.2, 2.0), 9.81
    span = random.uniform(1.5, 12.0) * math.sqrt(2.0 * height / g)
    scene = on_line("-g + k*(abs(x) - x)/2", (height, 0.0), {"g": g, "k": stiffness})
    pace, speed = np.sqrt(np.longdouble(stiffness)), np.sqrt(2 * np.longdouble(g) * np.longdouble(height))
    sag, fall = np.longdouble(g) / stiffness, speed / np.longdouble(g)
    touching = (2 * PI - 2 * np.arctan2(speed / pace, sag)) / pace

    def truth(times: Floats) -> Longs:
        late = (np.asarray(times, dtype=np.longdouble) + fall) % (2 * fall + touching)
        inside = late - 2 * fall
        flying = speed * late - np.longdouble(g) / 2 * late**2
        pressed = -sag + sag * np.cos(pace * inside) - speed / pace * np.sin(pace * inside)
        return np.asarray(np.where(inside > 0, pressed, flying))[:, None]

    return Motion("contact", scene, span, ("x",), truth, 1e-14, (math.pi / float(pace), 10.0 / float(pace)))


# Masses


def relative_coordinates(random: Random) -> Motion:
    """Springs between light masses before a heavy one, each place told from the one before: M is nearly singular.

    The same motion in places x is harmless: x = Σ modes, by mpmath.
    """
    count, span = random.choice((2, 3)), random.choice((3.0, 10.0, 100.0, 1000.0))
    light = [log_uniform(random, 1e-9, 1e-4) for _ in range(count - 1)]
    return chain_of_springs(random, [*light, 1.0], span, "relative coordinates")


def chain_of_springs(random: Random, masses: Sequence[float], span: float, family: str) -> Motion:
    """Places x1 = s1, x2 = s1 + s2 …: springs between neighbours, and from each to the ground, as stiff as its mass."""
    names = [f"s{i}" for i in range(1, len(masses) + 1)]
    grounds = [m * random.uniform(1.0, 20.0) for m in masses]
    between = [0.0, *(min(pair) * random.uniform(1.0, 20.0) for pair in pairwise(masses))]
    start = [(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)) for _ in masses]
    places = list(accumulate(names, lambda a, b: f"{a} + {b}"))
    values = {
        f"{letter}{i}": v
        for letter, table in (("m", masses), ("k", grounds), ("c", between))
        for i, v in enumerate(table)
    }
    energy = " + ".join(f"k{i}/2*({x})^2 + c{i}/2*{s}^2" for i, (x, s) in enumerate(zip(places, names, strict=True)))
    scene = document(
        dict(zip(names, start, strict=True)),
        values,
        {f"mass{i}": (f"m{i}", [x, "0"]) for i, x in enumerate(places)},
        [{"kind": "potential", "name": "springs", "energy": energy}],
    )
    truth = partial(_modes, *_eigenmodes(masses, grounds, between), np.array(start, dtype=np.longdouble))
    return Motion(family, scene, span, tuple(names), truth, 1e-14)


def _eigenmodes(
    masses: Sequence[float], grounds: Sequence[float], between: Sequence[float]
) -> tuple[Longs, Longs, Longs]:
    """ω, and the modes in mass-weighted places with √m, to 40 digits."""
    with mpmath.workdps(40):
        n = len(masses)
        roots, matrix = [mpmath.sqrt(m) for m in masses], mpmath.zeros(n)
        for i in range(n):
            matrix[i, i] = mpmath.mpf(grounds[i]) + between[i] + (between[i + 1] if i + 1 < n else 0)
            if i:
                matrix[i, i - 1] = matrix[i - 1, i] = -mpmath.mpf(between[i])
        for i in range(n):
            for j in range(n):
                matrix[i, j] /= roots[i] * roots[j]
        squares, vectors = mpmath.eigsy(matrix)
        paces = _longs([mpmath.sqrt(square) for square in squares])
        return paces, _longs(list(vectors)).reshape(n, n), _longs(roots)


def _longs(numbers: Sequence[mpmath.mpf]) -> Longs:
    return np.array([np.longdouble(mpmath.nstr(number, 25)) for number in numbers])


def _modes(paces: Longs, vectors: Longs, roots: Longs, start: Longs, times: Floats) -> Longs:
    x0, u0 = np.cumsum(start, axis=0).T
    a, b = vectors.T @ (roots * x0), vectors.T @ (roots * u0) / paces
    angle = np.asarray(times, dtype=np.longdouble)[:, None] * paces
    places = (a * np.cos(angle) + b * np.sin(angle)) @ vectors.T / roots
    return np.asarray(np.diff(places, axis=1, prepend=0.0))


# Friction


def friction_stops_a_slide(random: Random) -> Motion:
    """x″ = p − μg sign(ẋ), |p| < μg: the mass slides, stops and stays."""
    grip, speed = random.uniform(0.5, 8.0), some_sign(random) * random.uniform(0.5, 4.0)
    push = random.choice((0.0, random.uniform(-0.6, 0.6))) * grip
    brake = grip * math.copysign(1.0, speed) - push
    end = speed / brake
    scene = on_line("P - R*sign(dot(x))", (0.0, speed), {"P": push, "R": grip})

    def truth(times: Floats) -> Longs:
        until = np.minimum(np.asarray(times, dtype=np.longdouble), np.longdouble(end))
        return np.asarray(np.longdouble(speed) * until - np.longdouble(brake) * until**2 / 2)[:, None]

    return Motion("friction, slide", scene, random.uniform(1.2, 5.0) * end, ("x",), truth, 1e-14)


def friction_stops_a_swing(random: Random) -> Motion:
    """x″ = −k x − R sign(ẋ) from rest: half swings about ±R/k, until one ends where the spring is too weak."""
    stiffness, begin = random.uniform(1.0, 30.0), random.uniform(0.5, 2.0)
    offset = begin * random.uniform(0.04, 0.6)
    grip = stiffness * offset
    half = math.pi / math.sqrt(stiffness)
    ends = [np.longdouble(begin)]
    while abs(ends[-1]) > grip / stiffness:
        ends.append(-ends[-1] + 2 * np.sign(ends[-1]) * np.longdouble(grip) / stiffness)
    scene = on_line("-k*x - R*sign(dot(x))", (begin, 0.0), {"k": stiffness, "R": grip})

    def truth(times: Floats) -> Longs:
        angle = np.asarray(times, dtype=np.longdouble) * np.sqrt(np.longdouble(stiffness))
        swing = np.minimum(angle // PI, len(ends) - 1).astype(int)
        first = np.array(ends)[swing]
        centre = np.sign(first) * np.longdouble(grip) / stiffness
        moving = centre + (first - centre) * np.cos(angle - swing * PI)
        return np.asarray(np.where(swing < len(ends) - 1, moving, first))[:, None]

    span = half * (len(ends) - 1) * random.uniform(0.9, 2.0)
    return Motion("friction, swing", scene, max(span, 0.5 * half), ("x",), truth, 1e-14)


# Long spans


def long_pendulum(random: Random) -> Motion:
    """sin(φ/2) = k cd(ω₀t, k) (Whittaker, §44), hundreds of swings long."""
    span, amplitude, ratio = random.choice((30.0, 100.0, 300.0)), random.uniform(0.1, 3.1), random.uniform(3.0, 12.0)
    bodies = {"bob": ("m", ["l*sin(phi)", "l*cos(phi)"])}
    scene = document({"phi": (amplitude, 0.0)}, {"m": 1.0, "l": 1.0, "g": ratio}, bodies, [WEIGHT])

    def truth(times: Floats) -> Longs:
        with mpmath.workdps(30):
            k, pace = mpmath.sin(mpmath.mpf(amplitude) / 2), mpmath.sqrt(ratio)
            angles = [2 * mpmath.asin(k * mpmath.ellipfun("cd", pace * float(t), m=k**2)) for t in times]
        return _longs(angles)[:, None]

    return Motion("long pendulum", scene, span, ("phi",), truth, 1e-17)


KINDS: tuple[Draw, ...] = (
    *IN_TIME,
    wall,
    contact,
    relative_coordinates,
    friction_stops_a_slide,
    friction_stops_a_swing,
    long_pendulum,
)
