"""Kinds of motions with constraints, from pendulums in x and y to skates: each as a scene, and once more in symbols."""

from __future__ import annotations

import math
from random import Random

import numpy as np
from tests.simulation.bound_motions import Kind
from tests.simulation.constrained import equation, particle, rod

Drawn = tuple[dict[str, float], list[float], list[float]]
WEIGHT = {"name": "weight", "kind": "gravity", "acceleration": ["0", "-g"]}
WEIGHT_IN_SPACE = {"name": "weight", "kind": "gravity", "acceleration": ["0", "0", "-g"]}


def _constants(random: Random, *names: str) -> dict[str, float]:
    """Numbers over a decade; masses, now and then, over four."""
    wide = random.random() < 0.25
    return {
        name: round(10.0 ** random.uniform(*((-2.0, 2.0) if wide and name[0] == "m" else (-0.4, 0.4))), 4)
        for name in names
    }


def _chain(random: Random, lengths: list[float], drive: float = 0.0) -> tuple[list[float], list[float]]:
    """Places and rates of particles on rods, angles from the downward vertical; some begin at rest, some whip round."""
    at, speed, q, v = np.zeros(2), np.array([0.0, drive]), [], []
    fast = random.choice((0.0, 0.3, 3.0))
    for length in lengths:
        angle, rate = random.uniform(-2.5, 2.5), fast * random.uniform(-1.0, 1.0)
        at = at + length * np.array([math.sin(angle), -math.cos(angle)])
        speed = speed + length * rate * np.array([math.cos(angle), math.sin(angle)])
        q, v = [*q, *at.tolist()], [*v, *speed.tolist()]
    return q, v


def _pendulum(random: Random) -> Drawn:
    values = _constants(random, "m", "l") | {"g": 9.81, "c": random.choice((0.0, 0.3))}
    return values, *_chain(random, [values["l"]])


PENDULUM = Kind(
    "pendulum",
    ("x", "y"),
    (particle("bob", "x", "y"),),
    (rod("S", "pivot", "bob"),),
    (("m", ("x", "y")),),
    ("l - sqrt(x**2 + y**2)",),
    _pendulum,
    ("S",),
    "m*g*y",
    ("-c*rate_x", "-c*rate_y"),
    {"pivot": ["0", "0"]},
    (WEIGHT, {"name": "air", "kind": "dissipation", "function": "c*(dot(x)^2 + dot(y)^2)/2"}),
)


def _driven(random: Random) -> Drawn:
    values = _constants(random, "m", "l", "w") | {"g": 9.81, "a": round(random.uniform(0.02, 0.3), 3)}
    return values, *_chain(random, [values["l"]], values["a"] * values["w"])


DRIVEN = Kind(
    "pendulum on a moving pivot",
    ("x", "y"),
    (particle("bob", "x", "y"),),
    (rod("S", "pivot", "bob"),),
    (("m", ("x", "y")),),
    ("l - sqrt(x**2 + (y - a*sin(w*t))**2)",),
    _driven,
    ("S",),
    "m*g*y",
    points={"pivot": ["0", "a*sin(w*t)"]},
    loads=(WEIGHT,),
)


def _double(random: Random) -> Drawn:
    values = _constants(random, "m1", "m2", "l1", "l2") | {"g": 9.81}
    return values, *_chain(random, [values["l1"], values["l2"]])


DOUBLE = Kind(
    "double pendulum",
    ("x1", "y1", "x2", "y2"),
    (particle("upper", "x1", "y1", mass="m1"), particle("lower", "x2", "y2", mass="m2")),
    (rod("S1", "pivot", "upper", "l1"), rod("S2", "upper", "lower", "l2")),
    (("m1", ("x1", "y1")), ("m2", ("x2", "y2"))),
    ("l1 - sqrt(x1**2 + y1**2)", "l2 - sqrt((x2 - x1)**2 + (y2 - y1)**2)"),
    _double,
    ("S1", "S2"),
    "g*(m1*y1 + m2*y2)",
    points={"pivot": ["0", "0"]},
    loads=(WEIGHT,),
    t_end=3.0,
)


def _four_bar(random: Random) -> Drawn:
    """Crank r, coupler k, rocker s: drawn as angles, the ground then joins them."""
    values = _constants(random, "m") | {"r": 0.5, "k": round(random.uniform(1.3, 2.0), 3), "s": 1.2, "g": 9.81}
    a, c = random.uniform(0.3, 2.5), random.uniform(1.2, 2.0)
    height = (values["s"] * math.sin(c) - 0.5 * math.sin(a)) / values["k"]
    b, w = math.asin(height), random.choice((0.5, 3.0, 6.0))
    values["d"] = 0.5 * math.cos(a) + values["k"] * math.cos(b) - values["s"] * math.cos(c)
    matrix = [
        [-values["k"] * math.sin(b), values["s"] * math.sin(c)],
        [values["k"] * math.cos(b), -values["s"] * math.cos(c)],
    ]
    rates = np.linalg.solve(matrix, [0.5 * w * math.sin(a), -0.5 * w * math.cos(a)])
    return values, [a, b, c], [w, *rates.tolist()]


MIDDLE = ("r*cos(a) + k/2*cos(b)", "r*sin(a) + k/2*sin(b)")
FOUR_BAR = Kind(
    "four-bar",
    ("a", "b", "c"),
    (
        particle("crank", "r*cos(a)", "r*sin(a)"),
        particle("middle", *MIDDLE),
        particle("rocker", "d + s*cos(c)", "s*sin(c)"),
    ),
    (equation("X", "r*cos(a) + k*cos(b) - d - s*cos(c) = 0"), equation("Y", "r*sin(a) + k*sin(b) - s*sin(c) = 0")),
    (("m", ("r*cos(a)", "r*sin(a)")), ("m", MIDDLE), ("m", ("d + s*cos(c)", "s*sin(c)"))),
    ("r*cos(a) + k*cos(b) - d - s*cos(c)", "r*sin(a) + k*sin(b) - s*sin(c)"),
    _four_bar,
    ("X", "Y"),
    "m*g*(r*sin(a) + r*sin(a) + k/2*sin(b) + s*sin(c))",
    loads=(WEIGHT,),
    t_end=2.0,
)


def _wire(random: Random) -> Drawn:
    values = _constants(random, "m", "b", "k", "p") | {"g": 9.81}
    x, u = random.uniform(-1.0, 1.0), random.choice((0.0, 1.0)) * random.uniform(-2.0, 2.0)
    return values, [x, values["b"] * x**2], [u, 2 * values["b"] * x * u]


WIRE = Kind(
    "bead on a wire",
    ("x", "y"),
    (particle("bead", "x", "y"),),
    (equation("N", "y = b*x^2"),),
    (("m", ("x", "y")),),
    ("y - b*x**2",),
    _wire,
    ("N",),
    "m*g*y + k*(x - p)**2/2",
    loads=(WEIGHT, {"name": "pull", "kind": "potential", "energy": "k*(x - p)^2/2"}),
)


def _turned(random: Random) -> Drawn:
    values = _constants(random, "m", "k", "w")
    s, u = random.uniform(0.3, 1.5), random.uniform(-1.0, 1.0)
    return values, [s, 0.0], [u, values["w"] * s]


TURNED = Kind(
    "bead on a rod that turns",
    ("x", "y"),
    (particle("bead", "x", "y"),),
    (equation("N", "y*cos(w*t) - x*sin(w*t) = 0"),),
    (("m", ("x", "y")),),
    ("y*cos(w*t) - x*sin(w*t)",),
    _turned,
    ("N",),
    "k*(x**2 + y**2)/2",
    loads=({"name": "pull", "kind": "potential", "energy": "k*(x^2 + y^2)/2"},),
    t_end=3.0,
)


def _skate(random: Random) -> Drawn:
    values = _constants(random, "m", "J", "a") | {"g": random.choice((0.0, 2.0))}
    light = random.choice((1.0, 1e-6))  # so small are then forces, too
    values |= {name: light * values[name] for name in ("m", "J")}
    angle, u, w = random.uniform(-3.0, 3.0), random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)
    return values, [0.0, 0.0, angle], [u * math.cos(angle), u * math.sin(angle), w]


AHEAD = ("x + a*cos(th)", "y + a*sin(th)")
SKATE = Kind(
    "skate on a slope",
    ("x", "y", "th"),
    ({"name": "sleigh", "kind": "rigid", "mass": "m", "inertia": "J", "angle": "th", "position": list(AHEAD)},),
    (equation("N", "dot(y)*cos(th) - dot(x)*sin(th) = 0"),),
    (("m", AHEAD), ("J", ("th", "0"))),
    ("rate_y*cos(th) - rate_x*sin(th)",),
    _skate,
    ("N",),
    "m*g*(y + a*sin(th))",
    loads=(WEIGHT,),
)


def _sphere(random: Random) -> Drawn:
    values = _constants(random, "m", "l") | {"g": 9.81}
    theta, psi = random.uniform(0.4, 2.2), random.uniform(-3.0, 3.0)
    u, w = random.uniform(-1.0, 1.0), random.choice((0.3, 2.0))
    s, c, l = math.sin(theta), math.cos(theta), values["l"]
    q = [l * s * math.cos(psi), l * s * math.sin(psi), -l * c]
    v = [
        l * (u * c * math.cos(psi) - w * s * math.sin(psi)),
        l * (u * c * math.sin(psi) + w * s * math.cos(psi)),
        l * u * s,
    ]
    return values, q, v


SPHERE = Kind(
    "pendulum in space",
    ("x", "y", "z"),
    (particle("bob", "x", "y", "z"),),
    (rod("S", "pivot", "bob"),),
    (("m", ("x", "y", "z")),),
    ("l - sqrt(x**2 + y**2 + z**2)",),
    _sphere,
    ("S",),
    "m*g*z",
    points={"pivot": ["0", "0", "0"]},
    loads=(WEIGHT_IN_SPACE,),
)


def _carts(random: Random) -> Drawn:
    values = _constants(random, "m1", "m2", "l") | {"g": 9.81, "k": random.choice((5.0, 300.0, 3000.0))}
    angle, u, w = random.uniform(-1.5, 1.5), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)
    l, s, c = values["l"], math.sin(angle), math.cos(angle)
    return values, [0.01, 0.01 + l * s, -l * c], [u, u + l * w * c, l * w * s]


CARTS = Kind(
    "pendulum on a cart with a spring, soft or stiff",
    ("s", "x", "y"),
    (particle("cart", "s", "0", mass="m1"), particle("bob", "x", "y", mass="m2")),
    (rod("S", "cart", "bob"),),
    (("m1", ("s", "0")), ("m2", ("x", "y"))),
    ("l - sqrt((x - s)**2 + y**2)",),
    _carts,
    ("S",),
    "m2*g*y + k*s**2/2",
    loads=(WEIGHT, {"name": "spring", "kind": "potential", "energy": "k*s^2/2"}),
    t_end=2.0,
)


def _rail(random: Random) -> Drawn:
    """At rest, or nearly: the multiplier is a constant, or swings by little about it."""
    values = _constants(random, "m", "l", "k") | {"g": 9.81}
    small = random.choice((0.0, 1e-6, 1e-3))
    angle = small * random.uniform(-1.0, 1.0)
    l = values["l"]
    return values, [l * math.sin(angle), -l * math.cos(angle)], [0.0, 0.0]


REST = Kind(
    "pendulum that hangs, nearly at rest",
    ("x", "y"),
    (particle("bob", "x", "y"),),
    (rod("S", "pivot", "bob"),),
    (("m", ("x", "y")),),
    ("l - sqrt(x**2 + y**2)",),
    _rail,
    ("S",),
    "m*g*y + k*x**2/2",
    points={"pivot": ["0", "0"]},
    loads=(WEIGHT, {"name": "pull", "kind": "potential", "energy": "k*x^2/2"}),
)

KINDS = (PENDULUM, DRIVEN, DOUBLE, FOUR_BAR, WIRE, TURNED, SKATE, SPHERE, CARTS, REST)
