"""Families of scenes that δq was not tuned on, with random values, and their motions in extended precision.

The equations are those of the textbooks, written down by hand; heyoka's Taylor series solve them in 80-bit numbers to
1e-19. Nothing here knows how δq derives or integrates. Sources: Landau, Lifshitz, Mechanics; Goldstein, Classical
Mechanics; Hénon, Heiles, Astron. J. 69 (1964) 73; Tufillaro, Abbott, Griffiths, Am. J. Phys. 52 (1984) 895.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from itertools import pairwise
from random import Random
from types import SimpleNamespace

import heyoka as hy
import numpy as np
from tests.simulation.adversaries import Draw, aligned_pace, log_uniform, on_line, some_sign
from tests.simulation.adversaries_of_state import chain_of_springs
from tests.simulation.judging import Floats, Longs, Motion
from tests.simulation.scenes import WEIGHT, document

DOUBT, FINEST = 1e-17, 1e-19  # of the truth: rounding of 80 bits over many steps; tolerance of the series
Equations = Callable[[SimpleNamespace], list[hy.expression]]
Values = Mapping[str, float]
Start = Mapping[str, tuple[float | np.longdouble, float | np.longdouble]]


@dataclass(frozen=True)
class Series:
    """Equations of motion q̈ = a(q, q̇, t, p), solved by Taylor series; compiled when first needed.

    `equations` gets a namespace with coordinates q, rates named q_t, parameters and t.
    """

    coordinates: tuple[str, ...]
    parameters: tuple[str, ...]
    equations: Equations

    def solve(self, start: Start, values: Values, times: Floats, longest: float = math.inf) -> Longs:
        """The coordinates at the times; no step is longer than `longest`."""
        solver, order = _compiled(self), np.unique(times, return_inverse=True)
        state = [np.longdouble(v) for part in (0, 1) for v in (start[name][part] for name in self.coordinates)]
        solver.time, solver.state[:] = np.longdouble(0), state
        solver.pars[:] = [np.longdouble(values[name]) for name in self.parameters]
        grid, bound = np.asarray(order[0], dtype=np.longdouble), np.longdouble(longest)
        outcome, *_, table = solver.propagate_grid(grid, max_delta_t=bound)
        if outcome != hy.taylor_outcome.time_limit:
            raise ArithmeticError(f"no truth for {start}, {values}: {outcome}")
        return np.asarray(table[order[1], : len(self.coordinates)])


@cache
def _compiled(series: Series) -> hy.taylor_adaptive_ldbl:
    names = (*series.coordinates, *(f"{name}_t" for name in series.coordinates))
    variables = dict(zip(names, hy.make_vars(*names), strict=True))
    known = {name: hy.par[i] for i, name in enumerate(series.parameters)}
    bends = series.equations(SimpleNamespace(**variables, **known, t=hy.time))
    rates = [variables[name] for name in names[len(bends) :]]
    system = list(zip((variables[name] for name in names), (*rates, *bends), strict=True))
    zero, pars = np.zeros(len(names), dtype=np.longdouble), np.zeros(max(len(known), 1), dtype=np.longdouble)
    return hy.taylor_adaptive(
        system, zero, fp_type=np.longdouble, tol=np.longdouble(FINEST), compact_mode=True, pars=pars
    )


def motion(
    family: str, series: Series, scene: dict[str, object], start: Start, values: Values, span: float, **more: object
) -> Motion:
    """The motion of a scene whose coordinates are those of the series."""
    truth = partial(series.solve, start, values)
    return Motion(family, scene, span, series.coordinates, truth, DOUBT, **more)  # type: ignore[arg-type]


def _uniform(random: Random, **ranges: tuple[float, float]) -> dict[str, float]:
    return {name: random.uniform(*ends) for name, ends in ranges.items()}


def _starts(random: Random, **ranges: tuple[float, float]) -> dict[str, tuple[float, float]]:
    """Values and rates, each between minus and plus so much."""
    return {n: (random.uniform(-value, value), random.uniform(-rate, rate)) for n, (value, rate) in ranges.items()}


def _span(random: Random, longest: float = 60.0) -> float:
    return log_uniform(random, 3.0, longest)


# Pendulums; y points down

BOB = {"bob": ("m", ["l*sin(phi)", "l*cos(phi)"])}


PENDULUM = Series(("phi",), ("l", "g"), lambda s: [-s.g / s.l * hy.sin(s.phi)])


def pendulum(random: Random) -> Motion:
    """φ̈ = −(g/l) sin φ; swings and turns over."""
    values = _uniform(random, m=(0.2, 3.0), l=(0.3, 2.0), g=(1.6, 12.0))
    start = _starts(random, phi=(3.1, 6.0))
    return motion("pendulum", PENDULUM, document(start, values, BOB, [WEIGHT]), start, values, _span(random))


DRIVEN_PENDULUM = Series(
    ("phi",),
    ("m", "l", "g", "c", "M0", "Omega"),
    lambda s: [-s.g / s.l * hy.sin(s.phi) + (s.M0 * hy.cos(s.Omega * s.t) - s.c * s.phi_t) / (s.m * s.l**2)],
)


def damped_driven_pendulum(random: Random) -> Motion:
    """m l² φ̈ = −m g l sin φ − c φ̇ + M₀ cos Ωt."""
    values = _uniform(
        random, m=(0.5, 2.0), l=(0.5, 1.5), g=(5.0, 12.0), c=(0.05, 1.0), M0=(0.5, 12.0), Omega=(0.5, 8.0)
    )
    return _driven_pendulum(random, "damped driven pendulum", values, _span(random))


def _driven_pendulum(random: Random, family: str, values: Values, span: float, traps: tuple[float, ...] = ()) -> Motion:
    start = _starts(random, phi=(2.0, 2.0))
    damping = {"kind": "dissipation", "name": "bearing", "function": "c*dot(phi)^2/2"}
    drive = {"kind": "moment", "name": "drive", "angle": "phi", "moment": "M0*cos(Omega*t)"}
    scene = document(start, values, BOB, [WEIGHT, damping, drive])
    return motion(family, DRIVEN_PENDULUM, scene, start, values, span, traps=traps)


def _two_links(s: SimpleNamespace) -> list[hy.expression]:
    """Both angles from the vertical."""
    apart, both = s.phi1 - s.phi2, s.m1 + s.m2
    below = 2 * s.m1 + s.m2 - s.m2 * hy.cos(2 * apart)
    upper, lower = s.phi1_t**2 * s.l1, s.phi2_t**2 * s.l2
    first = -s.g * (2 * s.m1 + s.m2) * hy.sin(s.phi1) - s.m2 * s.g * hy.sin(s.phi1 - 2 * s.phi2)
    first -= 2 * s.m2 * hy.sin(apart) * (lower + upper * hy.cos(apart))
    second = 2 * hy.sin(apart) * (upper * both + s.g * both * hy.cos(s.phi1) + lower * s.m2 * hy.cos(apart))
    return [first / (s.l1 * below), second / (s.l2 * below)]


DOUBLE_PENDULUM = Series(("phi1", "phi2"), ("m1", "m2", "l1", "l2", "g"), _two_links)


def _links(random: Random) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    values = _uniform(random, m1=(0.2, 3.0), m2=(0.2, 3.0), l1=(0.3, 1.5), l2=(0.3, 1.5)) | {"g": 9.81}
    wide = random.choice((0.3, 1.2, 3.0))
    return values, _starts(random, phi1=(wide, 1.0), phi2=(wide, 1.0))


def double_pendulum(random: Random) -> Motion:
    """Both angles from the vertical; regular or chaotic."""
    values, start = _links(random)
    upper = ["l1*sin(phi1)", "l1*cos(phi1)"]
    lower = ["l1*sin(phi1) + l2*sin(phi2)", "l1*cos(phi1) + l2*cos(phi2)"]
    scene = document(start, values, {"upper": ("m1", upper), "lower": ("m2", lower)}, [WEIGHT])
    return motion("double pendulum", DOUBLE_PENDULUM, scene, start, values, _span(random, 20.0))


def double_pendulum_in_relative_angles(random: Random) -> Motion:
    """The second angle from the first link: θ₂ = φ₂ − φ₁."""
    values, start = _links(random)
    (first, rate), (second, turn) = start["phi1"], start["phi2"]
    told = {"phi1": (first, rate), "theta2": (second - first, turn - rate)}
    # what the scene begins with, to the last digit
    apart, slower = (np.longdouble(number) for number in told["theta2"])
    exact: Start = {"phi1": (first, rate), "phi2": (first + apart, rate + slower)}
    upper = ["l1*sin(phi1)", "l1*cos(phi1)"]
    lower = ["l1*sin(phi1) + l2*sin(phi1 + theta2)", "l1*cos(phi1) + l2*cos(phi1 + theta2)"]
    scene = document(told, values, {"upper": ("m1", upper), "lower": ("m2", lower)}, [WEIGHT])

    def truth(times: Floats) -> Longs:
        angles = DOUBLE_PENDULUM.solve(exact, values, times)
        return np.column_stack([angles[:, 0], angles[:, 1] - angles[:, 0]])

    return Motion("double pendulum, relative", scene, _span(random, 20.0), ("phi1", "theta2"), truth, DOUBT)


SPHERICAL = Series(
    ("theta", "psi"),
    ("l", "g"),
    lambda s: [
        s.psi_t**2 * hy.sin(s.theta) * hy.cos(s.theta) - s.g / s.l * hy.sin(s.theta),
        -2 * s.theta_t * s.psi_t * hy.cos(s.theta) / hy.sin(s.theta),
    ],
)


def spherical_pendulum(random: Random) -> Motion:
    """θ̈ = ψ̇² sin θ cos θ − (g/l) sin θ, ψ̈ = −2 θ̇ψ̇ cot θ."""
    return _spherical(random, "spherical pendulum", random.uniform(0.5, 6.0))


def spherical_pendulum_near_the_pole(random: Random) -> Motion:
    """The pole θ = 0 is passed closely: there ψ turns by half a round at once."""
    return _spherical(random, "spherical, near the pole", log_uniform(random, 0.02, 0.3))


def _spherical(random: Random, family: str, turn: float) -> Motion:
    values = _uniform(random, m=(0.2, 3.0), l=(0.5, 2.0), g=(3.0, 12.0))
    start = {"theta": (random.uniform(0.4, 2.0), random.uniform(-0.5, 0.5)), "psi": (0.0, some_sign(random) * turn)}
    place = ["l*sin(theta)*cos(psi)", "l*sin(theta)*sin(psi)", "-l*cos(theta)"]
    scene = document(start, values, {"bob": ("m", place)}, [{"kind": "gravity", "acceleration": ["0", "0", "-g"]}])
    return motion(family, SPHERICAL, scene, start, values, _span(random, 30.0))


ELASTIC = Series(
    ("r", "phi"),
    ("m", "g", "k", "l"),
    lambda s: [
        s.r * s.phi_t**2 + s.g * hy.cos(s.phi) - s.k / s.m * (s.r - s.l),
        -(2 * s.r_t * s.phi_t + s.g * hy.sin(s.phi)) / s.r,
    ],
)


def elastic_pendulum(random: Random) -> Motion:
    """r̈ = rφ̇² + g cos φ − (k/m)(r − l), rφ̈ = −2ṙφ̇ − g sin φ."""
    values = _uniform(random, m=(0.3, 2.0), l=(0.5, 1.5), k=(30.0, 300.0)) | {"g": 9.81}
    rest = values["l"] + values["m"] * values["g"] / values["k"]
    start = {"r": (rest * random.uniform(0.9, 1.3), 0.0), **_starts(random, phi=(1.2, 1.0))}
    spring = {"kind": "potential", "name": "spring", "energy": "k/2*(r - l)^2"}
    scene = document(start, values, {"bob": ("m", ["r*sin(phi)", "r*cos(phi)"])}, [WEIGHT, spring])
    return motion("elastic pendulum", ELASTIC, scene, start, values, _span(random, 30.0))


CART = Series(
    ("x", "phi"),
    ("M", "m", "l", "g", "k"),
    lambda s: [_cart(s), -(_cart(s) * hy.cos(s.phi) + s.g * hy.sin(s.phi)) / s.l],
)


def _cart(s: SimpleNamespace) -> hy.expression:
    push = s.m * hy.sin(s.phi) * (s.l * s.phi_t**2 + s.g * hy.cos(s.phi)) - s.k * s.x
    return push / (s.M + s.m * hy.sin(s.phi) ** 2)


def cart_pendulum(random: Random) -> Motion:
    """(M + m sin²φ) ẍ = m sin φ (l φ̇² + g cos φ) − k x, l φ̈ = −ẍ cos φ − g sin φ."""
    values = _uniform(random, M=(0.1, 3.0), m=(0.3, 2.0), l=(0.4, 1.5), k=(0.0, 20.0)) | {"g": 9.81}
    start = _starts(random, x=(0.5, 1.0), phi=(2.0, 2.0))
    spring = {"kind": "potential", "name": "spring", "energy": "k/2*x^2"}
    bodies = {"cart": ("M", ["x", "0"]), "bob": ("m", ["x + l*sin(phi)", "l*cos(phi)"])}
    return motion(
        "cart pendulum", CART, document(start, values, bodies, [WEIGHT, spring]), start, values, _span(random, 20.0)
    )


ATWOOD = Series(
    ("r", "theta"),
    ("M", "m", "g"),
    lambda s: [
        (s.m * s.r * s.theta_t**2 + s.m * s.g * hy.cos(s.theta) - s.M * s.g) / (s.M + s.m),
        -(2 * s.r_t * s.theta_t + s.g * hy.sin(s.theta)) / s.r,
    ],
)


def swinging_atwood_machine(random: Random) -> Motion:
    """(M + m) r̈ = m r θ̇² + m g cos θ − M g, rθ̈ = −2ṙθ̇ − g sin θ."""
    values = {"m": 1.0, "M": random.uniform(1.3, 4.0), "g": 9.81}
    start = {"r": (random.uniform(0.8, 1.5), 0.0), "theta": (some_sign(random) * random.uniform(0.8, 2.2), 0.0)}
    bodies = {"bob": ("m", ["r*sin(theta)", "r*cos(theta)"]), "counterweight": ("M", ["1", "-r"])}
    return motion(
        "swinging Atwood", ATWOOD, document(start, values, bodies, [WEIGHT]), start, values, _span(random, 10.0)
    )


KAPITZA = Series(
    ("phi",),
    ("l", "g", "a", "Omega"),
    lambda s: [-(s.g + s.a * s.Omega**2 * hy.cos(s.Omega * s.t)) / s.l * hy.sin(s.phi)],
)


def kapitza_pendulum(random: Random) -> Motion:
    """The pivot shakes by y = a cos Ωt: l φ̈ = −(g + aΩ² cos Ωt) sin φ."""
    values = {"m": 1.0, "g": 9.81, **_uniform(random, l=(0.2, 1.0), a=(0.01, 0.06), Omega=(30.0, 200.0))}
    return _shaken(random, "Kapitza pendulum", values, _span(random, 10.0))


def _shaken(random: Random, family: str, values: Values, span: float, traps: tuple[float, ...] = ()) -> Motion:
    start = {"phi": (random.uniform(0.3, 3.1), 0.0)}
    bodies = {"bob": ("m", ["l*sin(phi)", "y + l*cos(phi)"])}
    scene = document({"y": (0.0, 0.0), **start}, values, bodies, [WEIGHT], {"y": "a*cos(Omega*t)"})
    return motion(family, KAPITZA, scene, start, values, span, traps=traps)


HOOP = Series(("theta",), ("R", "g", "Omega"), lambda s: [(s.Omega**2 * hy.cos(s.theta) - s.g / s.R) * hy.sin(s.theta)])


def bead_on_rotating_hoop(random: Random) -> Motion:
    """θ̈ = (Ω² cos θ − g/R) sin θ."""
    values = {"m": 1.0, **_uniform(random, R=(0.3, 1.5), g=(5.0, 12.0), Omega=(0.5, 10.0))}
    start = _starts(random, theta=(2.5, 3.0))
    place = ["R*sin(theta)*cos(Omega*t)", "R*sin(theta)*sin(Omega*t)", "-R*cos(theta)"]
    scene = document(start, values, {"bead": ("m", place)}, [{"kind": "gravity", "acceleration": ["0", "0", "-g"]}])
    return motion("bead on rotating hoop", HOOP, scene, start, values, _span(random, 30.0))


# Orbits

POLAR = Series(("r", "psi"), ("mu",), lambda s: [s.r * s.psi_t**2 - s.mu / s.r**2, -2 * s.r_t * s.psi_t / s.r])
CARTESIAN = Series(("x", "y"), ("mu",), lambda s: [-s.mu * c * (s.x**2 + s.y**2) ** -1.5 for c in (s.x, s.y)])


def _orbit(random: Random) -> tuple[float, float, float, float]:
    """μ, nearest distance, speed there, and a span of a few rounds."""
    e, mu = random.uniform(0.0, 0.9), random.uniform(0.5, 3.0)
    near = 1.0 - e
    return mu, near, math.sqrt(mu * (1.0 + e) / near), random.uniform(0.5, 6.0) * 2.0 * math.pi / math.sqrt(mu)


def kepler_in_polar_coordinates(random: Random) -> Motion:
    """r̈ = rψ̇² − μ/r², rψ̈ = −2ṙψ̇; eccentricity up to 0.9."""
    mu, near, speed, span = _orbit(random)
    values, start = {"m": 1.0, "mu": mu}, {"r": (near, 0.0), "psi": (0.0, speed / near)}
    gravity = {"kind": "potential", "name": "gravity", "energy": "-m*mu/r"}
    scene = document(start, values, {"planet": ("m", ["r*cos(psi)", "r*sin(psi)"])}, [gravity])
    return motion("Kepler, polar", POLAR, scene, start, values, span)


def kepler_in_cartesian_coordinates(random: Random) -> Motion:
    """r̈ = −μ r/r³; eccentricity up to 0.9."""
    mu, near, speed, span = _orbit(random)
    values, start = {"m": 1.0, "mu": mu}, {"x": (near, 0.0), "y": (0.0, speed)}
    gravity = {"kind": "potential", "name": "gravity", "energy": "-m*mu/sqrt(x^2 + y^2)"}
    scene = document(start, values, {"planet": ("m", ["x", "y"])}, [gravity])
    return motion("Kepler, Cartesian", CARTESIAN, scene, start, values, span)


HENON_HEILES = Series(("x", "y"), ("b",), lambda s: [-s.x - 2 * s.b * s.x * s.y, -s.y - s.b * (s.x**2 - s.y**2)])


def henon_heiles(random: Random) -> Motion:
    """V = (x² + y²)/2 + b (x²y − y³/3), below the energy at which it escapes."""
    values, start = {"m": 1.0, "b": 1.0}, _starts(random, x=(0.28, 0.28), y=(0.28, 0.28))
    hills = {"kind": "potential", "name": "hills", "energy": "(x^2 + y^2)/2 + b*(x^2*y - y^3/3)"}
    scene = document(start, values, {"star": ("m", ["x", "y"])}, [hills])
    return motion("Hénon-Heiles", HENON_HEILES, scene, start, values, _span(random, 100.0))


# Oscillators

DUFFING = Series(
    ("x",),
    ("c", "k", "b", "F", "Omega"),
    lambda s: [-s.c * s.x_t - s.k * s.x - s.b * s.x**3 + s.F * hy.cos(s.Omega * s.t)],
)


def driven_duffing_oscillator(random: Random) -> Motion:
    """ẍ = −c ẋ − k x − b x³ + F cos Ωt, with one well or two."""
    values = _uniform(random, c=(0.05, 0.5), k=(-1.0, 1.0), b=(0.5, 5.0), F=(0.1, 3.0), Omega=(0.5, 4.0))
    start = _starts(random, x=(1.5, 1.0))
    scene = on_line("-c*dot(x) - k*x - b*x^3 + F*cos(Omega*t)", start["x"], values)
    return motion("Duffing, driven", DUFFING, scene, start, values, _span(random))


VAN_DER_POL = Series(("x",), ("mu",), lambda s: [s.mu * (1 - s.x**2) * s.x_t - s.x])


def van_der_pol_oscillator(random: Random) -> Motion:
    """ẍ = μ (1 − x²) ẋ − x, up to stiff relaxation."""
    values, start = {"mu": log_uniform(random, 0.3, 30.0)}, _starts(random, x=(2.0, 2.0))
    scene = on_line("mu*(1 - x^2)*dot(x) - x", start["x"], values)
    return motion("van der Pol", VAN_DER_POL, scene, start, values, _span(random))


STIFF = Series(("x",), ("k", "c", "F", "Omega"), lambda s: [-s.k * s.x - s.c * s.x_t + s.F * hy.cos(s.Omega * s.t)])


def stiff_damped_spring(random: Random) -> Motion:
    """ẍ = −k x − c ẋ + F cos Ωt, from light damping to fifty times the critical one."""
    stiffness = log_uniform(random, 1e2, 1e6)
    damping = 2.0 * math.sqrt(stiffness) * log_uniform(random, 0.1, 50.0)
    size = stiffness * random.uniform(0.1, 1.0)
    values = {"k": stiffness, "c": min(damping, 3e4), "F": size, "Omega": random.uniform(0.5, 10.0)}
    start = _starts(random, x=(1.0, 1.0))
    scene = on_line("-k*x - c*dot(x) + F*cos(Omega*t)", start["x"], values)
    return motion("stiff damped spring", STIFF, scene, start, values, _span(random, 10.0))


def _neighbours(s: SimpleNamespace) -> list[hy.expression]:
    places = [0.0, s.x1, s.x2, s.x3, s.x4, 0.0]
    pulls = [s.k * (b - a) + s.b * (b - a) ** 3 for a, b in pairwise(places)]
    return [(after - before) / s.m for before, after in pairwise(pulls)]


CHAIN = Series(("x1", "x2", "x3", "x4"), ("m", "k", "b"), _neighbours)


def nonlinear_chain(random: Random) -> Motion:
    """Four masses between walls, springs of k u + b u³ (Fermi, Pasta, Ulam, Tsingou)."""
    values = _uniform(random, m=(0.5, 2.0), k=(0.5, 5.0), b=(0.0, 8.0))
    start = _starts(random, **dict.fromkeys(CHAIN.coordinates, (0.7, 0.7)))
    lengths = ["x1", "(x2 - x1)", "(x3 - x2)", "(x4 - x3)", "x4"]
    energy = " + ".join(f"k/2*{u}^2 + b/4*{u}^4" for u in lengths)
    bodies = {f"mass{n}": ("m", [f"x{n}", "0"]) for n in range(1, 5)}
    scene = document(start, values, bodies, [{"kind": "potential", "name": "springs", "energy": energy}])
    return motion("nonlinear chain", CHAIN, scene, start, values, _span(random))


def masses_of_unlike_size(random: Random) -> Motion:
    """A linear chain in relative coordinates, the condition of M up to 1e12 (exact: modes by mpmath)."""
    masses = [log_uniform(random, 4e-12, 1.0), 1.0]
    return chain_of_springs(random, masses, _span(random), "unlike masses, relative")


# The top


def _top(s: SimpleNamespace) -> list[hy.expression]:
    foot, spin = s.A + s.m * s.l**2, s.phi_t + s.psi_t * hy.cos(s.theta)
    sin, cos = hy.sin(s.theta), hy.cos(s.theta)
    turn = (s.C * spin - 2 * foot * s.psi_t * cos) * s.theta_t / (foot * sin)
    nod = (s.m * s.g * s.l - s.C * spin * s.psi_t + foot * s.psi_t**2 * cos) * sin / foot
    return [turn, nod, s.psi_t * s.theta_t * sin - turn * cos]


TOP = Series(("psi", "theta", "phi"), ("m", "l", "g", "A", "C"), _top)


def heavy_symmetric_top(random: Random) -> Motion:
    """Euler's angles, foot fixed: the spin n = φ̇ + ψ̇ cos θ is constant, the top nods and runs round."""
    values = {"m": 1.0, "g": 9.81, **_uniform(random, l=(0.1, 0.5), A=(0.01, 0.1), C=(0.01, 0.06))}
    start = {
        "psi": (0.0, random.uniform(-1.0, 1.0)),
        "theta": (random.uniform(0.3, 1.8), random.uniform(-0.5, 0.5)),
        "phi": (0.0, random.uniform(10.0, 80.0)),
    }
    body = {
        "name": "top",
        "kind": "rigid",
        "mass": "m",
        "inertia": ["A", "A", "C"],
        "position": ["l*sin(theta)*sin(psi)", "-l*sin(theta)*cos(psi)", "l*cos(theta)"],
        "angular_velocity": [
            "dot(psi)*sin(theta)*sin(phi) + dot(theta)*cos(phi)",
            "dot(psi)*sin(theta)*cos(phi) - dot(theta)*sin(phi)",
            "dot(psi)*cos(theta) + dot(phi)",
        ],
    }
    weight = {"kind": "gravity", "acceleration": ["0", "0", "-g"]}
    scene = document(start, values, {"top": ("m", ["0", "0", "0"])}, [weight]) | {"bodies": [body]}
    return motion("heavy symmetric top", TOP, scene, start, values, _span(random, 10.0))


FAMILIES: tuple[Draw, ...] = (
    pendulum,
    damped_driven_pendulum,
    double_pendulum,
    double_pendulum_in_relative_angles,
    spherical_pendulum,
    spherical_pendulum_near_the_pole,
    elastic_pendulum,
    cart_pendulum,
    swinging_atwood_machine,
    kapitza_pendulum,
    bead_on_rotating_hoop,
    kepler_in_polar_coordinates,
    kepler_in_cartesian_coordinates,
    henon_heiles,
    driven_duffing_oscillator,
    van_der_pol_oscillator,
    stiff_damped_spring,
    nonlinear_chain,
    masses_of_unlike_size,
    heavy_symmetric_top,
)


# Adversaries whose truth needs series: see tests.simulation.adversaries


def fast_driven_pendulum(random: Random) -> Motion:
    """A pendulum under a fast moment, its period a part of the first steps."""
    span = random.choice((1.0, 3.0, 10.0))
    pace = aligned_pace(random, span)
    values = {"m": 1.0, "l": 1.0, "g": 9.81, "c": 0.0, "M0": random.choice((0.1, 1.0)) * pace, "Omega": pace}
    traps = tuple(math.pi / pace * halves for halves in (1, 2, 4, 8, 16))
    return _driven_pendulum(random, "fast driven pendulum", values, span, traps)


def fast_shaken_pendulum(random: Random) -> Motion:
    """Kapitza's pendulum with a shake that first steps may miss, strong enough to turn the pendulum over."""
    span = random.choice((1.0, 3.0, 10.0))
    pace = aligned_pace(random, span)
    values = {"m": 1.0, "l": 1.0, "g": 9.81, "a": random.uniform(2.0, 10.0) / pace, "Omega": pace}
    return _shaken(random, "fast shaken pendulum", values, span, (math.pi / pace, 2.0 * math.pi / pace))


TRAP = Series(
    ("x",),
    ("k", "V0", "x0", "w"),
    lambda s: [-s.k * s.x + 2 * s.V0 * (s.x - s.x0) / s.w**2 * hy.exp(-(((s.x - s.x0) / s.w) ** 2))],
)


def hill_in_a_trap(random: Random) -> Motion:
    """An oscillator that passes a narrow hill or well again and again."""
    size, stiffness = random.uniform(0.5, 1.5), random.uniform(1.0, 20.0)
    place, width = size * random.uniform(-0.7, 0.7), log_uniform(random, 1e-3, 1e-1)
    energy = stiffness * (size**2 - place**2) / 2.0
    height = energy * random.choice((-3.0, -0.5, 0.2, 0.6))
    values, start = {"k": stiffness, "V0": height, "x0": place, "w": width}, {"x": (size, 0.0)}
    scene = on_line("-k*x + 2*V0*(x - x0)/w^2*exp(-((x - x0)/w)^2)", start["x"], values)
    fast = math.sqrt(2.0 * (energy + max(-height, 0.0)) + stiffness * place**2)
    truth = partial(TRAP.solve, start, values, longest=0.5 * width / fast)
    span = random.choice((1.0, 3.0, 10.0))
    return Motion("hill in a trap", scene, span, ("x",), truth, DOUBT, (width / fast, 10.0 * width / fast))


ADVERSARIES: tuple[Draw, ...] = (fast_driven_pendulum, fast_shaken_pendulum, hill_in_a_trap)
