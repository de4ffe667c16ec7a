"""Rest at kinks and in ranges, of one degree of freedom: closed forms, minima on a grid, and what motions do."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import sympy as sp
from tests.derivation.kinked_scenes import document, friction, line, potential, swinging, wall
from tests.derivation.model_scenes import model_steps

from deltaq.derivation.linearization import linearizations
from deltaq.derivation.rest_sets import RestRange, rest_search
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.narration.derive import derive_request
from deltaq.simulation.service import run

SPRING = potential("k*x^2/2")
HOLDING = friction("mu*m*g")

Kink = tuple[str, str, str, str]
KINKS = [
    pytest.param(line(potential("k*abs(x)"), k=2.0), [("0", "k", "-k", "stable")], id="|x|"),
    pytest.param(line(potential("-k*abs(x)"), k=2.0), [("0", "-k", "k", "unstable")], id="−|x|: the top of a roof"),
    pytest.param(
        line(potential("k*abs(x - a) + m*g*x"), k=20.0, a=0.5),
        [("a", "-g*m + k", "-g*m - k", "stable")],
        id="a valley with a weight",
    ),
    pytest.param(line(potential("k*abs(x - a) + m*g*x"), k=2.0, a=0.5), [], id="a weight that is too much for it"),
    pytest.param(
        line(potential("max(k*x, -c*x)"), k=2.0, c=1.0), [("0", "c", "-k", "stable")], id="the larger of two slopes"
    ),
    pytest.param(line(potential("max(k*x, c*x)"), k=2.0, c=1.0), [], id="a slope that becomes steeper"),
    pytest.param(
        line(potential("min(k*x, -c*x)"), k=2.0, c=1.0), [("0", "-k", "c", "unstable")], id="the smaller of two slopes"
    ),
    pytest.param(
        line(potential("k*abs(x - a) + c/(x - a)^2"), k=2.0, c=1.0, a=0.5), [], id="a pole at the kink"
    ),
    pytest.param(
        line(potential("k*abs(x^2 - a^2)"), k=2.0, a=0.5),
        [
            ("-Abs(a)", "2*k*Abs(a)", "-2*k*Abs(a)", "stable"),
            ("Abs(a)", "2*k*Abs(a)", "-2*k*Abs(a)", "stable"),
        ],
        id="two wells with a kink in each",
    ),
    pytest.param(
        line(potential("k*abs(abs(x) - a)"), k=2.0, a=0.5),
        [("-a", "k", "-k", "stable"), ("a", "k", "-k", "stable"), ("0", "-k", "k", "unstable")],
        id="a modulus of a modulus",
    ),
    pytest.param(
        line({"kind": "force", "at": "bob", "force": ["-k*sign(x - a) - c", "0"]}, k=2.0, a=0.5, c=0.1),
        [("a", "-c + k", "-c - k", "stable")],
        id="a force with a sign",
    ),
    pytest.param(
        line(potential("k*abs(x) + c*x^2/2"), friction("mu*m*g"), k=5.0, c=1.0, mu=0.1),
        [("0", "g*m*mu + k", "-g*m*mu - k", "stable")],
        id="friction beside a kink that is steeper",
    ),
    pytest.param(
        line(potential("k*abs(x)"), events=[wall("x - 1")], k=2.0), [], id="a kink behind a wall"
    ),
    pytest.param(
        line(potential("k*abs(x)"), {"kind": "dissipation", "function": "c*dot(x)^2/2"}, k=2.0, c=0.3),
        [("0", "k", "-k", "stable")],
        id="with a damper",
    ),
    pytest.param(
        line(potential("k*abs(x)"), {"kind": "dissipation", "function": "c*dot(x)^2/2"}, k=2.0, c=-0.3),
        [("0", "k", "-k", "undecided")],
        id="with what feeds energy in",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("scene", "expected"), KINKS)
def test_rest_at_kinks(scene: Scene, expected: list[Kink]) -> None:
    system = System(scene)
    found = rest_search(system)
    assert found is not None
    told = [
        (str(each.equilibrium.values[system.q("x")]), *map(str, each.sides or ()), each.stability)
        for each in found.kinks
    ]
    assert told == expected
    assert found.complete
    assert all(step.verified for step in model_steps(scene).values())


Ends = tuple[str | None, str | None]
RANGES = [
    pytest.param(line(SPRING, HOLDING, k=3.0, mu=0.2), [("-g*m*mu/k", "g*m*mu/k")], id="a spring: |x| ≤ μ m g/k"),
    pytest.param(
        line(SPRING, friction("mu*m*g", static="2*mu*m*g"), k=3.0, mu=0.2),
        [("-2*g*m*mu/k", "2*g*m*mu/k")],
        id="it holds with more than it resists slipping with",
    ),
    pytest.param(
        line(SPRING, friction("mu*m*g", surface_rate="v"), k=3.0, mu=0.2, v=0.5), [], id="a belt holds nothing"
    ),
    pytest.param(
        line(SPRING, friction("mu*m*g", surface_rate="v"), k=3.0, mu=0.2, v=0.0),
        [("-g*m*mu/k", "g*m*mu/k")],
        id="a belt that stands still",
    ),
    pytest.param(
        line(potential("-m*g*sin(al)*x"), friction("mu*m*g*cos(al)"), al=0.3, mu=0.5),
        [(None, None)],
        id="a block on an incline with tan α < μ",
    ),
    pytest.param(line(potential("-m*g*sin(al)*x"), friction("mu*m*g*cos(al)"), al=0.3, mu=0.2), [], id="a steeper one"),
    pytest.param(
        line(potential("-k*(x + x^3/3)"), HOLDING, k=1.0, mu=0.2),
        [("-sqrt(g*m*mu/k - 1)", "sqrt(g*m*mu/k - 1)")],
        id="a force that vanishes nowhere, and is small for a while",
    ),
    pytest.param(
        line(potential("k*(x - 1)^2/2"), HOLDING, events=[wall("x")], k=1.0, mu=0.2),
        [("0", "g*m*mu/k + 1")],
        id="a wall in the range",
    ),
    pytest.param(
        line(potential("k*(x - 1)^2/2"), HOLDING, events=[wall("x - 4")], k=1.0, mu=0.2), [], id="a wall beyond it"
    ),
    pytest.param(
        line(potential("k*abs(x) + c*x^2/2"), HOLDING, k=1.0, c=1.0, mu=0.2),
        [("(-g*m*mu + k)/c", "(g*m*mu - k)/c")],
        id="a kink within",
    ),
    pytest.param(line(potential("k*max(x, 0)"), k=2.0), [(None, "0")], id="flat on one side"),
    pytest.param(
        line(potential("k*max(abs(x) - a, 0)^2/2"), k=2.0, a=0.5), [("-a", "a")], id="play between two springs"
    ),
    pytest.param(
        line(potential("k*(x^2 - 1)^2/4"), HOLDING, k=100.0, mu=0.2),
        3,
        id="three ranges, about two wells and the hill between them",
    ),
    pytest.param(
        swinging(friction("mu*m*g"), mu=0.2),
        [("-asin(mu/l)", "asin(mu/l)"), ("pi - asin(mu/l)", "pi + asin(mu/l)")],
        id="a pendulum with friction: hanging, and standing over π",
    ),
    pytest.param(swinging(friction("mu*m*g"), mu=2.0), [(None, None)], id="one that is held everywhere"),
]


@pytest.mark.parametrize(("scene", "expected"), RANGES)
def test_ranges_of_rest(scene: Scene, expected: list[Ends] | int) -> None:
    system = System(scene)
    found = rest_search(system)
    assert found is not None
    if isinstance(expected, int):
        assert len(found.found) == expected
    else:
        assert sorted(map(_ends, found.found), key=str) == sorted(
            (tuple(None if end is None else sp.sympify(end, SYMBOLS) for end in pair) for pair in expected), key=str
        )
    assert found.complete
    assert all(step.verified for step in model_steps(scene).values())


SYMBOLS = {name: sp.Symbol(name, real=True) for name in ("g", "m", "mu", "k", "c", "a", "l")}


def _ends(found: RestRange) -> tuple[sp.Expr | None, sp.Expr | None]:
    known = {each: SYMBOLS[each.name] for end in (found.low, found.high) if end for each in end.value.free_symbols}
    low, high = (None if end is None else end.value.xreplace(known) for end in (found.low, found.high))
    return low, high


@pytest.mark.one_in(4)
@pytest.mark.parametrize("seed", range(16))
def test_stable_rest_is_where_a_random_potential_with_kinks_is_least(seed: int) -> None:
    """Against the minima of the potential on a fine grid: all of them, and no others."""
    source = Random(f"kinks {seed}")
    a, b, c, p, q, r = (round(source.uniform(-1.5, 1.5), 2) for _ in range(6))
    energy = f"{a}*abs(x - ({p})) + {b}*abs(x - ({q})) + (x - ({r}))^2/2 + {c}*max(x, {r}*x^2)"
    x = np.linspace(-9.0, 9.0, 720_001)
    v = a * np.abs(x - p) + b * np.abs(x - q) + (x - r) ** 2 / 2 + c * np.maximum(x, r * x**2)
    least = x[1:-1][(v[1:-1] < v[:-2]) & (v[1:-1] < v[2:])]
    system = System(line(potential(energy)))
    known = rest_search(system)
    assert known is not None
    told = [(each.equilibrium, each.stability) for each in known.kinks]
    told += [(each.equilibrium, each.stability) for each in linearizations(system)]
    found = np.array([float(each.values[system.q("x")]) for each, stability in told if stability == "stable"])
    np.testing.assert_allclose(np.sort(found[np.abs(found) < 8.9]), least, atol=5e-5)


@pytest.mark.one_in(4)
@pytest.mark.parametrize("seed", range(16))
def test_ranges_are_where_a_force_is_not_larger_than_friction(seed: int) -> None:
    """F(x) = a sin px + b x + c against R on a fine grid."""
    source = Random(f"ranges {seed}")
    limits = ((0.5, 3.0), (-1.0, 1.0), (-2.0, 2.0), (0.5, 2.0), (0.2, 1.5))
    a, b, c, p, r = (round(source.uniform(low, high), 2) for low, high in limits)
    force = {"kind": "force", "at": "bob", "force": [f"{a}*sin({p}*x) + {b}*x + {c}", "0"]}
    found = rest_search(System(line(force, friction(str(r)))))
    assert found is not None
    x = np.linspace(-20.0, 20.0, 4001)
    held = np.abs(a * np.sin(p * x) + b * x + c) <= r
    told = np.zeros_like(held)
    for each in found.found:
        low, high = (math.nan if end is None else float(end.value) for end in (each.low, each.high))
        told |= ~(x < low) & ~(x > high)
    assert np.count_nonzero(told != held) <= 1


@pytest.mark.parametrize(
    ("loads", "values", "inside", "outside"),
    [
        pytest.param([SPRING, HOLDING], {"k": 3.0, "mu": 0.2}, 0.6539, 0.6541, id="a spring"),
        pytest.param([potential("-k*(x + x^3/3)"), HOLDING], {"k": 1.0, "mu": 0.2}, 0.9807, 0.9809, id="no zero"),
        pytest.param([SPRING, friction("mu*m*g", static="2*mu*m*g")], {"k": 3.0, "mu": 0.2}, 1.3078, 1.3082, id="F₀"),
    ],
)
def test_motions_from_the_ends_of_a_range_stay_within_and_leave_without(
    loads: list[dict[str, object]], values: dict[str, float], inside: float, outside: float
) -> None:
    for start, moves in ((inside, False), (outside, True)):
        asked = {"scene": document(loads, values), "initial": {"x": {"value": start, "rate": 0.0}}, "t_end": 2.0}
        x = run(asked)["coordinates"]["x"]  # type: ignore[index]
        assert (max(x) - min(x) > 0.0) is moves


def test_answers_tell_kinks_and_ranges() -> None:
    answer = derive_request({"scene": document([potential("k*abs(x)"), HOLDING], {"k": 1.0, "mu": 0.2})})["result"]
    (told,) = answer["rest_ranges"]  # type: ignore[index]
    assert (told["low"], told["high"], told["friction"]) == (None, None, True)
    answer = derive_request({"scene": document([potential("k*abs(x)")], {"k": 1.0})})["result"]
    (kink,) = answer["kink_equilibria"]  # type: ignore[index]
    assert {key: value["number"] for key, value in kink["forces"].items()} == {"below": 1.0, "above": -1.0}
    assert ([each["plain"] for each in kink["switches"]], kink["stability"]) == (["x"], "stable")


def test_a_search_in_several_coordinates_with_friction_does_not_claim_to_be_complete() -> None:
    scene = document([potential("k*(x^2 + y^2)/2"), HOLDING], {"k": 2.0, "mu": 0.3}, (), ("x", "y"), ("x", "y"))
    told = derive_request({"scene": scene})["result"]["equilibrium_search"]  # type: ignore[index]
    assert (told["complete"], told["left_out"]) == (False, "friction")
    assert rest_search(System(read_scene(scene))) is None
