"""Systems whose equilibria, stability and eigenfrequencies textbooks give, each with its source."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import acos, asin, cos, pi, sqrt
from types import SimpleNamespace
from typing import Any

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene


@dataclass(frozen=True)
class Rest:
    """A published equilibrium: where, its verdict, and the squares of its eigenfrequencies where the book has them."""

    at: Mapping[str, float]
    stability: str
    squares: Sequence[float] | None = None
    kind: str = ""


@dataclass(frozen=True)
class Published:
    """A scene and what a book says of it; `whole`: it lists all equilibria."""

    name: str
    source: str
    scene: Scene
    rests: tuple[Rest, ...]
    whole: bool = True


Load = Mapping[str, object]


def scene(
    coordinates: Sequence[str], parameters: Mapping[str, float], bodies: Sequence[Mapping[str, object]], *loads: Load
) -> Scene:
    return read_scene(
        {
            "id": "textbook",
            "dimension": len(bodies[0]["position"]),  # type: ignore[arg-type]
            "coordinates": [{"name": q, "value": 0.3 + 0.1 * i} for i, q in enumerate(coordinates)],
            "parameters": [{"name": name, "value": value} for name, value in parameters.items()],
            "bodies": list(bodies),
            "loads": list(loads),
        }
    )


def particle(*position: str, mass: str = "m", name: str = "bob") -> dict[str, Any]:
    return {"name": name, "kind": "particle", "mass": mass, "position": list(position)}


def rigid(inertia: str, angle: str, *position: str, mass: str = "m") -> dict[str, Any]:
    body = {"name": "body", "kind": "rigid", "mass": mass, "position": list(position)}
    return body | {"inertia": inertia, "angle": angle}


def potential(energy: str) -> Load:
    return {"kind": "potential", "energy": energy}


def force(*components: str, at: str = "bob") -> Load:
    return {"kind": "force", "at": at, "force": list(components)}


def down(dimension: int = 2) -> Load:
    return {"kind": "gravity", "acceleration": ["0"] * (dimension - 1) + ["-g"]}


def between(function: Callable[[float], float], low: float, high: float) -> float:
    """The zero in an interval, by bisection."""
    sign = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) > 0) == sign else (low, middle)
    return (low + high) / 2


SYSTEMS: list[Published] = []


def published(
    name: str,
    source: str,
    coordinates: str,
    parameters: Mapping[str, float],
    bodies: Sequence[Mapping[str, object]],
    loads: Sequence[Load],
    rests: Callable[[Any], Sequence[Rest]],
    *,
    whole: bool = True,
) -> None:
    made = scene(coordinates.split(), parameters, bodies, *loads)
    SYSTEMS.append(Published(name, source, made, tuple(rests(SimpleNamespace(**parameters))), whole))


BOB = particle("l*sin(phi)", "-l*cos(phi)")
G = 9.81

published(
    "plane pendulum", "Landau, Lifshitz, Mechanics, §21, problem 1", "phi", {"m": 1, "l": 0.7, "g": G}, [BOB], [down()],
    lambda p: [Rest({"phi": 0}, "stable", [p.g / p.l]), Rest({"phi": pi}, "unstable", [-p.g / p.l])],
)  # fmt: skip
published(
    "physical pendulum", "Gross, Hauger, Schröder, Wall, Technische Mechanik 3, §5.2.2", "phi",
    {"m": 2, "a": 0.3, "J": 0.4, "g": G}, [rigid("J", "phi", "a*sin(phi)", "-a*cos(phi)")], [down()],
    lambda p: [
        Rest({"phi": 0}, "stable", [p.m * p.g * p.a / (p.J + p.m * p.a**2)]),
        Rest({"phi": pi}, "unstable", [-p.m * p.g * p.a / (p.J + p.m * p.a**2)]),
    ],
)  # fmt: skip
published(
    "inverted pendulum, strong torsion spring", "Gross, Hauger, Technische Mechanik 1, §8.5", "phi",
    {"m": 1, "l": 1, "g": G, "c": 20}, [particle("l*sin(phi)", "l*cos(phi)")], [down(), potential("c*phi^2/2")],
    lambda p: [Rest({"phi": 0}, "stable", [(p.c - p.m * p.g * p.l) / (p.m * p.l**2)])],
)  # fmt: skip
published(
    "inverted pendulum, weak torsion spring", "Gross, Hauger, Technische Mechanik 1, §8.5", "phi",
    {"m": 1, "l": 1, "g": G, "c": 8}, [particle("l*sin(phi)", "l*cos(phi)")], [down(), potential("c*phi^2/2")],
    lambda p: [
        Rest({"phi": 0}, "unstable", [(p.c - p.g) / 1]),
        *(Rest({"phi": s * between(lambda x: p.c * x - p.g * math.sin(x), 0.5, 2)}, "stable") for s in (1, -1)),
    ],
)  # fmt: skip
for slow in (True, False):
    published(
        f"bead on a hoop that turns {'slowly' if slow else 'fast'}",
        "Goldstein, Classical Mechanics, 3rd ed., ch. 2, 18",
        "phi", {"m": 1, "r": 0.5, "g": 10, "Omega": 4 if slow else 5},
        [particle("r*sin(phi)*cos(Omega*t)", "r*sin(phi)*sin(Omega*t)", "-r*cos(phi)")], [down(3)],
        lambda p: [
            Rest({"phi": 0}, "stable" if p.Omega**2 < p.g / p.r else "unstable", [p.g / p.r - p.Omega**2]),
            Rest({"phi": pi}, "unstable", [-p.g / p.r - p.Omega**2]),
            *(
                Rest({"phi": s * acos(p.g / p.r / p.Omega**2)}, "stable", [p.Omega**2 - (p.g / p.r / p.Omega) ** 2])
                for s in ((1, -1) if p.Omega**2 > p.g / p.r else ())
            ),
        ],
    )  # fmt: skip
    published(
        f"bead on a parabola that turns {'slowly' if slow else 'fast'}", "Kuypers, Klassische Mechanik, §3.5", "x",
        {"m": 1, "a": 2, "g": 10, "Omega": 6 if slow else 7},
        [particle("x*cos(Omega*t)", "x*sin(Omega*t)", "a*x^2")], [down(3)],
        lambda p: [
            Rest({"x": 0}, "stable" if p.Omega**2 < 2 * p.g * p.a else "unstable", [2 * p.g * p.a - p.Omega**2])
        ],
    )  # fmt: skip
published(
    "spherical pendulum", "Landau, Lifshitz, Mechanics, §14, problem 1", "theta psi", {"m": 1, "l": 1, "g": G},
    [particle("l*sin(theta)*cos(psi)", "l*sin(theta)*sin(psi)", "-l*cos(theta)")], [down(3)],
    lambda p: [Rest({"theta": 0}, "stable"), Rest({"theta": pi}, "unstable")],
)  # fmt: skip


def links(n: int) -> list[dict[str, Any]]:
    def sum_of(wave: str, k: int) -> str:
        return "+".join(f"l*{wave}(q{i})" for i in range(1, k + 1))

    return [particle(sum_of("sin", k), f"-({sum_of('cos', k)})", name=f"bob{k}") for k in range(1, n + 1)]


def hanging(n: int, squares: Sequence[float]) -> list[Rest]:
    corners = [[(k >> i) & 1 for i in range(n)] for k in range(2**n)]
    return [
        Rest({f"q{i + 1}": pi * up for i, up in enumerate(c)}, "unstable" if any(c) else "stable",
        None if any(c) else squares)
        for c in corners
    ]  # fmt: skip


published(
    "double pendulum", "Landau, Lifshitz, Mechanics, §23, problem 2", "q1 q2", {"m": 1, "l": 0.8, "g": G}, links(2),
    [down()],
    lambda p: hanging(2, [p.g / p.l * (2 - sqrt(2)), p.g / p.l * (2 + sqrt(2))]),
)  # fmt: skip
published(
    "triple pendulum", "Meirovitch, Methods of Analytical Dynamics, §6.4", "q1 q2 q3", {"m": 1, "l": 1, "g": G},
    links(3),
    [down()], lambda p: hanging(3, [p.g * x for x in (0.4157745567834791, 2.294280360279042, 6.289945082937479)]),
)  # fmt: skip
published(
    "chain of four", "Meirovitch, Methods of Analytical Dynamics, §6.4", "q1 q2 q3 q4", {"m": 1, "l": 1, "g": G},
    links(4),
    [down()],
    lambda p: hanging(
        4, [p.g * x for x in (0.3225476896193923, 1.7457611011583466, 4.536620296921128, 9.395070912301133)]
    ),
)  # fmt: skip


def beads(n: int) -> list[dict[str, Any]]:
    return [particle(f"q{k}", "0", name=f"bob{k}") for k in range(1, n + 1)]


def springs(*parts: str) -> list[Load]:
    return [potential(" + ".join(f"k*({part})^2/2" for part in parts))]


published(
    "two masses, three springs", "Goldstein, Classical Mechanics, 3rd ed., ch. 6", "q1 q2", {"m": 2, "k": 5}, beads(2),
    springs("q1", "q2-q1", "q2"), lambda p: [Rest({"q1": 0, "q2": 0}, "stable", [p.k / p.m, 3 * p.k / p.m])],
)  # fmt: skip
published(
    "three masses, four springs", "Meirovitch, Methods of Analytical Dynamics, §6.4", "q1 q2 q3", {"m": 2, "k": 5},
    beads(3),
    springs("q1", "q2-q1", "q3-q2", "q3"),
    lambda p: [
        Rest({"q1": 0, "q2": 0, "q3": 0}, "stable", [p.k / p.m * x for x in (2 - sqrt(2), 2, 2 + sqrt(2))])
    ],
)  # fmt: skip
published(
    "linear triatomic molecule", "Goldstein, Classical Mechanics, 3rd ed., §6.4", "x y z",
    {"m": 1, "M": 3, "k": 7, "b": 0.5},
    [particle("x", "0", name="a"), particle("y", "0", mass="M", name="b1"), particle("z", "0", name="c")],
    springs("y-x-b", "z-y-b"),
    lambda p: [Rest({"y": 0.8, "z": 1.3}, "stable", [0, p.k / p.m, p.k / p.m * (1 + 2 * p.m / p.M)], "family")],
)  # fmt: skip
published(
    "two masses and a spring on a line", "Landau, Lifshitz, Mechanics, §13 and §21", "x y", {"m": 1, "M": 3, "k": 7,
    "b": 0.5},
    [particle("x", "0", name="a"), particle("y", "0", mass="M", name="c")], springs("y-x-b"),
    lambda p: [Rest({"y": 0.8}, "stable", [0, p.k * (1 / p.m + 1 / p.M)], "family")],
)  # fmt: skip
published(
    "coupled pendulums", "Goldstein, Classical Mechanics, 3rd ed., ch. 6; Kuypers, §7.3", "u v", {"m": 1, "l": 1,
    "g": G, "k": 2},
    [particle("l*sin(u)", "-l*cos(u)", name="a"), particle("l*sin(v)", "-l*cos(v)", name="c")],
    [down(), potential("k*l^2*(sin(u)-sin(v))^2/2")],
    lambda p: [Rest({"u": 0, "v": 0}, "stable", [p.g / p.l, p.g / p.l + 2 * p.k / p.m]), Rest({"u": pi, "v": pi},
    "unstable")],
    whole=False,
)  # fmt: skip
published(
    "pendulum on a cart", "Landau, Lifshitz, Mechanics, §5, problem 2", "x phi", {"m": 1, "M": 3, "l": 0.8, "g": G},
    [particle("x", "0", mass="M", name="cart"), particle("x+l*sin(phi)", "-l*cos(phi)")], [down()],
    lambda p: [
        Rest({"phi": 0}, "stable", [0, p.g / p.l * (1 + p.m / p.M)]),
        Rest({"phi": pi}, "unstable", [-p.g / p.l * (1 + p.m / p.M), 0]),
    ],
)  # fmt: skip
published(
    "elastic pendulum", "Kuypers, Klassische Mechanik, §7; Vitt, Gorelik (1933)", "r phi",
    {"m": 1, "g": G, "k": 60, "b": 0.9}, [particle("r*sin(phi)", "-r*cos(phi)")], [down(), *springs("r-b")],
    lambda p: [
        Rest({"r": p.b + p.m * p.g / p.k, "phi": 0}, "stable", [p.g / (p.b + p.m * p.g / p.k), p.k / p.m]),
        Rest({"r": p.b - p.m * p.g / p.k, "phi": pi}, "unstable"),
    ],
)  # fmt: skip
published(
    "Atwood's machine", "Goldstein, Classical Mechanics, 3rd ed., §1.6", "x", {"m": 1, "M": 3, "L": 2, "g": G},
    [particle("0", "-x", name="a"), particle("1", "x-L", mass="M", name="c")], [down()], lambda _: [],
)  # fmt: skip
published(
    "balanced Atwood machine", "Goldstein, Classical Mechanics, 3rd ed., §1.6", "x", {"m": 1, "L": 2, "g": G},
    [particle("0", "-x", name="a"), particle("1", "x-L", name="c")], [down()], lambda _: [Rest({}, "undecided")],
)  # fmt: skip

X = particle("x", "0")


def well(
    name: str, source: str, energy: str, parameters: Mapping[str, float], rests: Callable[[Any], Sequence[Rest]]
) -> None:
    published(name, source, "x", {"m": 2, **parameters}, [X], [potential(energy)], rests)


well(
    "radial motion in Kepler's field", "Goldstein, Classical Mechanics, 3rd ed., §3.3", "L^2/(2*m*x^2)-k/x",
    {"L": 1.5, "k": 3},
    lambda p: [Rest({"x": p.L**2 / p.m / p.k}, "stable", [p.k / p.m / (p.L**2 / p.m / p.k) ** 3])],
)  # fmt: skip
well(
    "radial motion on a spring", "Landau, Lifshitz, Mechanics, §14", "L^2/(2*m*x^2)+k*x^2/2", {"L": 1.5, "k": 3},
    lambda p: [Rest({"x": s * (p.L**2 / p.m / p.k) ** 0.25}, "stable", [4 * p.k / p.m]) for s in (1, -1)],
)  # fmt: skip
well(
    "Lennard-Jones", "Taylor, Classical Mechanics, ch. 4", "4*e*((s/x)^12-(s/x)^6)", {"e": 1, "s": 1.3},
    lambda p: [
        Rest({"x": z * 2 ** (1 / 6) * p.s}, "stable", [72 * p.e / (2 ** (1 / 3) * p.s**2 * p.m)]) for z in (1, -1)
    ],
)  # fmt: skip
well(
    "Morse", "Taylor, Classical Mechanics, ch. 5", "D*(1-exp(-(x-b)/s))^2", {"D": 2, "s": 0.5, "b": 1.2},
    lambda p: [Rest({"x": p.b}, "stable", [2 * p.D / p.s**2 / p.m])],
)  # fmt: skip
well(
    "two wells (Duffing)", "Guckenheimer, Holmes, Nonlinear Oscillations, §2.2", "-a*x^2/2+b*x^4/4", {"a": 2, "b": 3},
    lambda p: [
        Rest({"x": 0}, "unstable", [-p.a / p.m]),
        *(Rest({"x": s * sqrt(p.a / p.b)}, "stable", [2 * p.a / p.m]) for s in (1, -1)),
    ],
)  # fmt: skip
well(
    "cubic well", "Landau, Lifshitz, Mechanics, §28", "k*x^2/2-c*x^3/3", {"k": 3, "c": 2},
    lambda p: [Rest({"x": 0}, "stable", [p.k / p.m]), Rest({"x": p.k / p.c}, "unstable", [-p.k / p.m])],
)  # fmt: skip
well(
    "quartic well",
    "Merkin, Introduction to the Theory of Stability, §3.2",
    "c*x^4",
    {"c": 1},
    lambda _: [Rest({"x": 0}, "stable")],
)
well(
    "quartic hill",
    "Merkin, Introduction to the Theory of Stability, §3.4",
    "-c*x^4",
    {"c": 1},
    lambda _: [Rest({"x": 0}, "unstable")],
)
well(
    "cubic",
    "Merkin, Introduction to the Theory of Stability, §3.4",
    "c*x^3",
    {"c": 1},
    lambda _: [Rest({"x": 0}, "unstable")],
)
well(
    "plate before an electrode", "Younis, MEMS Linear and Nonlinear Statics and Dynamics, §3.2", "k*x^2/2-A/(d-x)",
    {"k": 4, "A": 0.3, "d": 1},
    lambda p: [
        Rest({"x": between(lambda x: x * (p.d - x) ** 2 - p.A / p.k, *ends)}, verdict)
        for *ends, verdict in ((0, 1 / 3, "stable"), (1 / 3, 1, "unstable"), (1, 3, "stable"))
    ],
)  # fmt: skip
published(
    "pendulum under a moment", "Gross, Hauger, Technische Mechanik 3, §5", "phi", {"m": 1, "l": 1, "g": G, "M": 4},
    [BOB],
    [down(), potential("-M*phi")],
    lambda p: [
        Rest({"phi": asin(p.M / p.g)}, "stable", [p.g * cos(asin(p.M / p.g))]),
        Rest({"phi": pi - asin(p.M / p.g)}, "unstable", [-p.g * cos(asin(p.M / p.g))]),
    ],
)  # fmt: skip
published(
    "damped oscillator", "Landau, Lifshitz, Mechanics, §25", "x", {"m": 2, "k": 3, "c": 0.4}, [X],
    [force("-k*x-c*dot(x)", "0")], lambda _: [Rest({"x": 0}, "stable")],
)  # fmt: skip
published(
    "oscillator with a drag of the square", "Magnus, Popp, Sextro, Schwingungen, §3.1", "x", {"m": 2, "k": 3,
    "c": 0.4}, [X],
    [*springs("x"), force("-c*abs(dot(x))*dot(x)", "0")], lambda _: [Rest({"x": 0}, "stable")],
)  # fmt: skip
published(
    "van der Pol", "Guckenheimer, Holmes, Nonlinear Oscillations, §2.1", "x", {"m": 2, "k": 3, "c": 0.4, "s": 1}, [X],
    [force("-k*x+c*(1-x^2/s^2)*dot(x)", "0")], lambda _: [Rest({"x": 0}, "unstable")],
)  # fmt: skip
published(
    "oscillator with dry friction", "Magnus, Popp, Sextro, Schwingungen, §3.1.3", "x", {"m": 2, "k": 3, "R": 0.6}, [X],
    [*springs("x"), force("-R*sign(dot(x))", "0")], lambda _: [Rest({"x": 0}, "stable", None, "band")],
)  # fmt: skip
XY = particle("x", "y")
O = {"x": 0.0, "y": 0.0}
published(
    "circulatory force", "Merkin, Introduction to the Theory of Stability, §6.6", "x y", {"m": 1, "k": 3}, [XY],
    [force("-k*y", "k*x")], lambda _: [Rest(O, "unstable")],
)  # fmt: skip
for name, field, verdict, kind in (("strong", 5, "undecided", "gyroscopic"), ("weak", 3, "unstable", "")):
    published(
        f"hill in a {name} magnetic field", "Merkin, Introduction to the Theory of Stability, §6.3", "x y",
        {"m": 1, "k": 4, "B": field}, [XY], [potential("-k*(x^2+y^2)/2"), force("B*dot(y)", "-B*dot(x)")],
        lambda _, v=verdict, k=kind: [Rest(O, v, None, k)],
    )  # fmt: skip
published(
    "hill in a magnetic field, damped", "Thomson, Tait, Treatise on Natural Philosophy, §345; Merkin, §6.4", "x y",
    {"m": 1, "k": 4, "B": 5, "c": 0.1}, [XY],
    [potential("-k*(x^2+y^2)/2"), force("B*dot(y)-c*dot(x)", "-B*dot(x)-c*dot(y)")], lambda _: [Rest(O, "unstable")],
)  # fmt: skip
published(
    "well in a magnetic field", "Landau, Lifshitz, The Classical Theory of Fields, §21 (Zeeman)", "x y",
    {"m": 1, "k": 4, "B": 5}, [XY], [potential("k*(x^2+y^2)/2"), force("B*dot(y)", "-B*dot(x)")],
    lambda _: [Rest(O, "stable")],
)  # fmt: skip
published(
    "oscillator in the plane", "Landau, Lifshitz, Mechanics, §23", "x y", {"m": 2, "k": 3, "c": 5}, [XY],
    [potential("(k*x^2+c*y^2)/2")], lambda p: [Rest(O, "stable", [p.k / p.m, p.c / p.m])],
)  # fmt: skip
published(
    "Hénon–Heiles", "Hénon, Heiles, Astron. J. 69 (1964), 73; Goldstein, §11.6", "x y", {"m": 1, "k": 1, "s": 1}, [XY],
    [potential("k*((x^2+y^2)/2+(x^2*y-y^3/3)/s)")],
    lambda _: [
        Rest(O, "stable", [1, 1]), Rest({"x": 0, "y": 1}, "unstable"),
        *(Rest({"x": z * sqrt(3) / 2, "y": -0.5}, "unstable") for z in (1, -1)),
    ],
)  # fmt: skip
for mu, verdict, kind, points in (
    (0.01215, "undecided", "gyroscopic", (0.836918007, 1.155679913, -1.005062402)),
    (0.1, "unstable", "", None),
):
    published(
        f"restricted problem of three bodies, μ = {mu}",
        "Goldstein, Classical Mechanics, 3rd ed., §3.12; Szebehely, §5.3",
        "x y", {"m": 1, "mu": mu, "Omega": 1},
        [particle("x*cos(Omega*t)-y*sin(Omega*t)", "x*sin(Omega*t)+y*cos(Omega*t)")],
        [potential("-m*(1-mu)/sqrt((x+mu)^2+y^2)-m*mu/sqrt((x-1+mu)^2+y^2)")],
        lambda p, v=verdict, k=kind, xs=points: [
            *(Rest({"x": 0.5 - p.mu, "y": z * sqrt(3) / 2}, v, None, k) for z in (1, -1)),
            *(Rest({"x": x, "y": 0}, "unstable") for x in xs or ()),
        ],
        whole=points is not None,
    )  # fmt: skip
Y = particle("0", "y")
TRUSS = "k*(sqrt(a^2+y^2)-l)^2"
published(
    "flat truss, pressed", "Gross, Hauger, Technische Mechanik 4, §6 (von Mises truss)", "y", {"m": 1, "k": 50,
    "a": 1, "l": 1.2},
    [Y], [potential(TRUSS)],
    lambda p: [
        Rest({"y": 0}, "unstable", [2 * p.k / p.m * (1 - p.l / p.a)]),
        *(Rest({"y": s * sqrt(p.l**2 - p.a**2)}, "stable", [2 * p.k / p.m * (1 - (p.a / p.l) ** 2)]) for s in (1, -1)),
    ],
)  # fmt: skip
published(
    "flat truss, stretched", "Gross, Hauger, Technische Mechanik 4, §6", "y", {"m": 1, "k": 50, "a": 1, "l": 0.8}, [Y],
    [potential(TRUSS)], lambda p: [Rest({"y": 0}, "stable", [2 * p.k / p.m * (1 - p.l / p.a)])],
)  # fmt: skip
published(
    "flat truss without tension", "Landau, Lifshitz, Mechanics, §21, problem 3", "y", {"m": 1, "k": 50, "a": 1}, [Y],
    [potential("k*(sqrt(a^2+y^2)-a)^2")], lambda _: [Rest({"y": 0}, "stable")],
)  # fmt: skip
published(
    "half disc that rolls", "Gross, Hauger, Technische Mechanik 3, §5 (Halbkreisscheibe)", "phi",
    {"m": 1, "r": 0.6, "s": 4 * 0.6 / (3 * pi), "J": 0.6**2 / 2 - (4 * 0.6 / (3 * pi)) ** 2, "g": G},
    [rigid("J", "phi", "r*phi-s*sin(phi)", "-s*cos(phi)")], [down()],
    lambda p: [Rest({"phi": 0}, "stable", [8 * p.g / ((9 * pi - 16) * p.r)]), Rest({"phi": pi}, "unstable")],
)  # fmt: skip
for shape, factor in (("cylinder", 0.5), ("ball", 0.4)):
    published(
        f"{shape} that rolls in a hollow", "Landau, Lifshitz, Mechanics, §32; Hauger, Technische Mechanik 3, §5", "phi",
        {"m": 1, "R": 1, "r": 0.2, "J": factor * 0.04, "g": G},
        [rigid("J", "(R-r)/r*phi", "(R-r)*sin(phi)", "-(R-r)*cos(phi)")], [down()],
        lambda p, f=factor: [
            Rest({"phi": 0}, "stable", [p.g / (1 + f) / (p.R - p.r)]),
            Rest({"phi": pi}, "unstable", [-p.g / (1 + f) / (p.R - p.r)]),
        ],
    )  # fmt: skip
published(
    "cycloidal pendulum", "Landau, Lifshitz, Mechanics, §21; Kuypers, §3", "phi", {"m": 1, "a": 0.5, "g": G},
    [particle("a*(phi-sin(phi))", "a*cos(phi)")], [down()],
    lambda p: [Rest({"phi": pi}, "stable", [p.g / (4 * p.a)])],
)  # fmt: skip
published(
    "inverted pendulum between springs", "Gross, Hauger, Technische Mechanik 3, §5", "phi",
    {"m": 1, "l": 1, "a": 0.8, "k": 25, "g": G}, [particle("l*sin(phi)", "l*cos(phi)")],
    [down(), potential("k*(a*sin(phi))^2/2")],
    lambda p: [
        Rest({"phi": 0}, "stable", [(p.k * p.a**2 - p.m * p.g * p.l) / (p.m * p.l**2)]),
        Rest({"phi": pi}, "stable", [(p.k * p.a**2 + p.m * p.g * p.l) / (p.m * p.l**2)]),
        *(Rest({"phi": s * acos(p.m * p.g * p.l / (p.k * p.a**2))}, "unstable") for s in (1, -1)),
    ],
)  # fmt: skip
published(
    "Kapitza's pendulum on average", "Landau, Lifshitz, Mechanics, §30", "phi", {"m": 1, "l": 1, "g": G, "U": 12},
    [BOB],
    [down(), potential("U*sin(phi)^2")],
    lambda p: [
        Rest({"phi": 0}, "stable", [p.g + 2 * p.U]), Rest({"phi": pi}, "stable", [2 * p.U - p.g]),
        *(Rest({"phi": s * acos(-p.g / (2 * p.U))}, "unstable") for s in (1, -1)),
    ],
)  # fmt: skip
published(
    "bead with a spring on a turning rod", "Kuypers, Klassische Mechanik, §3.5", "r",
    {"m": 1, "k": 30, "b": 0.5, "Omega": 3}, [particle("r*cos(Omega*t)", "r*sin(Omega*t)")], springs("r-b"),
    lambda p: [Rest({"r": p.k * p.b / (p.k - p.m * p.Omega**2)}, "stable", [p.k / p.m - p.Omega**2])],
)  # fmt: skip
published(
    "disc that rolls on a spring", "Gross, Hauger, Technische Mechanik 3, §5.2", "x", {"m": 2, "r": 0.3, "J": 0.09,
    "k": 12},
    [rigid("J", "x/r", "x", "0")], springs("x"), lambda p: [Rest({"x": 0}, "stable", [2 * p.k / (3 * p.m)])],
)  # fmt: skip
published(
    "block with a spring on a movable wedge", "Kuypers, Klassische Mechanik, §3", "x s",
    {"m": 1, "M": 3, "k": 20, "g": G, "alpha": 0.5},
    [particle("x", "0", mass="M", name="wedge"), particle("x+s*cos(alpha)", "-s*sin(alpha)")], [down(), *springs("s")],
    lambda p: [
        Rest({"s": p.m * p.g * math.sin(p.alpha) / p.k}, "stable",
             [0, p.k * (p.M + p.m) / (p.m * (p.M + p.m * math.sin(p.alpha) ** 2))])
    ],
)  # fmt: skip
published(
    "rod that leans on a wall", "Gross, Hauger, Technische Mechanik 3, §4", "theta", {"m": 1, "l": 1, "J": 1 / 12,
    "g": G},
    [rigid("J", "theta", "l/2*sin(theta)", "l/2*cos(theta)")], [down()],
    lambda p: [Rest({"theta": 0}, "unstable", [-1.5 * p.g / p.l]), Rest({"theta": pi}, "stable", [1.5 * p.g / p.l])],
)  # fmt: skip
published(
    "two bodies that attract each other", "Landau, Lifshitz, Mechanics, §13", "x y u v", {"m": 1, "M": 3, "G": 1},
    [particle("x", "y", name="a"), particle("u", "v", mass="M", name="c")],
    [potential("-G*m*M/sqrt((u-x)^2+(v-y)^2)")], lambda _: [],
)  # fmt: skip
published(
    "free particle", "Landau, Lifshitz, Mechanics, §3", "x", {"m": 1}, [X], [], lambda _: [Rest({}, "undecided")],
)  # fmt: skip
published(
    "double well and a spring", "Guckenheimer, Holmes, Nonlinear Oscillations, §2.2", "x y",
    {"m": 1, "a": 1, "b": 1, "k": 3}, [XY], [potential("-a*x^2/2+b*x^4/4+k*(y-x)^2/2")],
    lambda _: [
        Rest(O, "unstable"), Rest({"x": 1, "y": 1}, "stable"), Rest({"x": -1, "y": -1}, "stable"),
    ],
)  # fmt: skip


def ziegler(load: float) -> tuple[list[dict[str, Any]], list[Load], dict[str, float]]:
    """Two rods of length l with masses 2m and m, torsion springs in the joints, a force along the second one."""
    bodies = [
        particle("l*sin(u)", "l*cos(u)", mass="2*m", name="a"),
        particle("l*sin(u)+l*sin(v)", "l*cos(u)+l*cos(v)", name="tip"),
    ]
    follower = force("-P*sin(v)", "-P*cos(v)", at="tip")
    return bodies, [potential("c*u^2/2+c*(v-u)^2/2"), follower], {"m": 1, "l": 1, "c": 1, "P": load}


for load, verdict in ((2.0, "undecided"), (2.2, "unstable")):
    bodies, loads, parameters = ziegler(load)
    published(
        f"Ziegler's pendulum, P = {load} c/l", "Ziegler, Ing.-Arch. 20 (1952), 49: (7/2 − √2) c/l ≈ 2.086", "u v",
        parameters, bodies, loads, lambda _, v=verdict: [Rest({"u": 0, "v": 0}, v)], whole=False,
    )  # fmt: skip
