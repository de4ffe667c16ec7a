"""Equalities that are seen at states: where constraints are kept, and of integrals that symmetries have.

The states themselves are held against the laws of their scenes by hand, the decisions against what the books say.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import pytest
import sympy as sp
from tests.derivation.scenes import constrained
from tests.derivation.textbook_systems import particle, potential, scene
from tests.simulation import constrained as known

from deltaq.homework.equality import Match, Parts, kept_by_constraints, symmetry
from deltaq.homework.reading import read
from deltaq.homework.solution import Solution
from deltaq.homework.workbook import Workbook

YES, NO, UNDECIDED = Match(equal=True), Match(equal=False), Match(equal=None)
State = dict[str, float]

# y = √x near its vertex: not every start beside it is one that can be moved onto it.
ROOT = known.scene(
    {"x": (0.05, 0.0), "y": (0.2, 0.0)},
    {"m": 1.0, "g": 9.81},
    [known.particle("bob", "x", "y")],
    [known.equation("N", "y = sqrt(x)")],
)
# In Cartesian coordinates: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §3.2.
KEPLER = scene(["x", "y"], {"m": 1.3, "k": 2}, [particle("x", "y")], potential("-k/sqrt(x^2 + y^2)"))
SCENES = {each.id: each for each in constrained()} | {"root": ROOT, "kepler": KEPLER}


@cache
def book(name: str) -> Workbook:
    return Workbook(SCENES[name])


def given(name: str, text: str, task: str = "kinetic-energy") -> Parts:
    return read(book(name).task(task), book(name).solution, text, "plain").parts


def states(name: str) -> list[State]:
    return list(kept_by_constraints.states_of(book(name).solution))


def on_circle(s: State) -> list[float]:
    x, y, u, v, a, b = (s[name] for name in ("x", "y", "dot(x)", "dot(y)", "ddot(x)", "ddot(y)"))
    return [x * x + y * y - s["l"] ** 2, x * u + y * v, x * a + y * b + u * u + v * v, x * (b - s["g"]) - y * a]


def on_turning_line(s: State) -> list[float]:
    """r is along e = (cos ωt, sin ωt): ṙ·n = ω r·e across it, and along it the weight alone acts."""
    w, c, n = s["omega"], math.cos(s["omega"] * s["t"]), math.sin(s["omega"] * s["t"])
    x, y, u, v, a, b = (s[name] for name in ("x", "y", "dot(x)", "dot(y)", "ddot(x)", "ddot(y)"))
    across = b * c - a * n - 2 * w * (u * c + v * n) + w * w * (x * n - y * c)
    return [y * c - x * n, v * c - u * n - w * (x * c + y * n), a * c + (b - s["g"]) * n, across]


def on_blade(s: State) -> list[float]:
    c, n, u, v, w = math.cos(s["phi"]), math.sin(s["phi"]), s["dot(x)"], s["dot(y)"], s["dot(phi)"]
    turning = s["ddot(y)"] * c - s["ddot(x)"] * n - w * (u * c + v * n)
    # The angular momentum about the blade (x, y) changes by what moves the centre along: J ω̇ + m a (a ω̇ + v ω) = 0.
    speed = u * c + v * n
    return [v * c - u * n, turning, (s["J"] + s["m"] * s["a"] ** 2) * s["ddot(phi)"] + s["m"] * s["a"] * speed * w]


def on_root(s: State) -> list[float]:
    x, y, u, v = (s[name] for name in ("x", "y", "dot(x)", "dot(y)"))
    return [y - math.sqrt(x), v - u / (2 * math.sqrt(x))]


def on_two_rods(s: State) -> list[float]:
    one = [(s["x1"], s["dot(x1)"]), (s["y1"], s["dot(y1)"])]
    two = [(s[f"{q}2"] - s[f"{q}1"], s[f"dot({q}2)"] - s[f"dot({q}1)"]) for q in "xy"]
    lengths = [math.hypot(*(q for q, _ in rod)) - s[length] for rod, length in ((one, "l1"), (two, "l2"))]
    return [*lengths, *(sum(q * v for q, v in rod) for rod in (one, two))]


@pytest.mark.parametrize(
    ("name", "laws"),
    [
        pytest.param("particle-on-a-circle", on_circle, id="an equation"),
        pytest.param("particle-on-a-rod", on_circle, id="a rod"),
        pytest.param("particle-on-a-turning-line", on_turning_line, id="in time"),
        pytest.param("sleigh", on_blade, id="of rates"),
        pytest.param("two-rods", on_two_rods, id="two"),
        pytest.param("root", on_root, id="where not every start can be moved there"),
    ],
)
def test_states_keep_the_constraints_and_move_by_the_laws(name: str, laws: Callable[[State], list[float]]) -> None:
    """Five, no two of them alike, with the parameters near those of the scene, and a time of their own."""
    found, wanted = states(name), {p.name: p.value for p in SCENES[name].parameters}
    assert len({tuple(state.values()) for state in found}) == 5
    for state in found:
        assert laws(state) == pytest.approx([0.0] * len(laws(state)), abs=1e-10)
        assert {p: state[p] for p in wanted} == pytest.approx(wanted, rel=0.0501)
        assert 0.0 <= state["t"] <= 1.0
    moving = [each.name for each in SCENES[name].free]
    for what in (*wanted, "t", *moving, *map("dot({})".format, moving)):
        assert len({state[what] for state in found}) == 5, what


CIRCLE = "particle-on-a-circle"


@pytest.mark.parametrize(
    ("own", "true", "decided"),
    [
        pytest.param(["sqrt(x^2 + y^2)"], ["l"], YES, id="on the circle"),
        pytest.param(["x*dot(x)", "l"], ["-y*dot(y)", "l"], YES, id="along it, two parts"),
        pytest.param(["x^2 + y^2"], ["l"], NO, id="another"),
        pytest.param(["l", "x"], ["l", "y"], NO, id="another second part"),
        pytest.param(["l*(1 + 10^(-5))"], ["l"], UNDECIDED, id="nearer than can be told"),
        pytest.param(["l*(1 + 10^(-3))"], ["l"], NO, id="nearly"),
        pytest.param(["log(x^2 - 9*l^2)"], ["l"], NO, id="without a value"),
        pytest.param(["l"], ["log(x^2 - 9*l^2)"], UNDECIDED, id="where the right one has none"),
        pytest.param(["log(x^2 - 9*l^2)"], ["log(x^2 - 9*l^2)"], UNDECIDED, id="where both have none"),
        pytest.param(["l", "l"], ["l"], UNDECIDED, id="another number of parts"),
        pytest.param([], [], UNDECIDED, id="nothing"),
    ],
)
def test_what_is_equal_where_the_constraint_is_kept(own: list[str], true: list[str], decided: Match) -> None:
    parts, right = (tuple(given(CIRCLE, text)[0] for text in each) for each in (own, true))
    assert kept_by_constraints.same(parts, right, book(CIRCLE).solution) == decided


def symbol_of_no_state(solution: Solution) -> sp.Expr:
    return solution.symbols.rate("x", 3)


EQUATION = "m*ddot(x) - 2*lambda*x = 0"


@pytest.mark.parametrize(
    ("own", "proportional"),
    [
        pytest.param(EQUATION, True, id="itself"),
        pytest.param("3*l*(m*ddot(x) - 2*lambda*x) = 0", True, id="a multiple"),
        pytest.param("sqrt(x^2 + y^2)*m*ddot(x) = 2*lambda*x*l", True, id="where the constraint is kept"),
        pytest.param("(2 + x)*(m*ddot(x) - 2*lambda*x) = 0", True, id="another factor in each state"),
        pytest.param("m*ddot(x) + 2*lambda*x = 0", False, id="a sign"),
        pytest.param("m*ddot(x) - 2*lambda*x = m*g/10^3", False, id="a small rest"),
        pytest.param("m*ddot(y) - 2*lambda*x = 0", False, id="another acceleration"),
        pytest.param("0*m = 0", False, id="nothing"),
        pytest.param("ddot(x)*(m*ddot(x) - 2*lambda*x) = 0", False, id="not linear"),
        pytest.param("lambda*(m*ddot(x) - 2*lambda*x) = 0", False, id="nor in the multiplier"),
        pytest.param("m*ddot(x) - 2*lambda*x + log(x^2 - 9*l^2) = 0", False, id="without a value"),
    ],
)
def test_equations_are_multiples_where_the_constraint_is_kept(own: str, proportional: bool) -> None:
    parts, right = (given(CIRCLE, text, "equation:x") for text in (own, EQUATION))
    solution = book(CIRCLE).solution
    assert bool(kept_by_constraints.proportional(parts, right, solution)) is proportional
    assert not kept_by_constraints.proportional((*parts, *parts), right, solution)
    # What holds a symbol that no state has a value for is a multiple of nothing, whatever else stands in it.
    assert not kept_by_constraints.proportional((parts[0] + symbol_of_no_state(solution),), right, solution)


def test_without_a_constraint_of_positions_nothing_is_compared_where_it_is_kept() -> None:
    right = given("sleigh", "m*ddot(x) + lambda*sin(phi) = 0", "equation:x")
    assert not kept_by_constraints.proportional(right, right, book("sleigh").solution)


SPIN, ENERGY = "(x*dot(y) - y*dot(x))", "(m*(dot(x)^2 + dot(y)^2)/2 - k/sqrt(x^2 + y^2))"
MULTIPLE, OTHERS, OTHER, NEVER = (
    Match(equal, remark)
    for equal, remark in (
        (True, "multiple"),
        (True, "with-others"),
        (False, "other-integral"),
        (False, "not-conserved"),
    )
)


@pytest.mark.parametrize(
    ("own", "decided"),
    [
        (f"m*{SPIN}", YES),
        (f"-2*{SPIN} + 3", MULTIPLE),
        (f"m*{SPIN} + {ENERGY}", OTHERS),
        (f"10^12*{SPIN} + {ENERGY}", OTHERS),
        (f"{SPIN}/10^12 + 10^(-12)*{ENERGY} + 10^(-12)", OTHERS),
        (f"m*{SPIN} - 10^6*{ENERGY}", OTHERS),
        (ENERGY, OTHER),
        (f"10^12*{ENERGY}", OTHER),
        (f"{SPIN}^2", OTHER),
        (f"{SPIN}*{ENERGY}", OTHER),
        (f"{SPIN} + {ENERGY}^2", OTHER),
        ("x*dot(y)", NEVER),
        (f"t*{SPIN}", NEVER),
        ("x^2 + y^2", NEVER),
        ("m*k", NEVER),
    ],
)
def test_an_integral_of_a_symmetry_among_others(own: str, decided: Match) -> None:
    """The angular momentum is the one that is asked for; the energy may be added, and not stand in its place."""
    workbook = book("kepler")
    right = workbook.right(workbook.task("symmetry:1"))
    (found,) = given("kepler", own, "lagrangian")
    assert symmetry.same((found,), right, workbook.solution) == decided


@pytest.mark.parametrize(("own", "nothing"), [("m*k", True), ("10^6*k*(x/x)", True), (SPIN, False), ("x", False)])
def test_only_a_constant_says_nothing_as_an_integral(own: str, nothing: bool) -> None:
    workbook = book("kepler")
    found = symmetry.fingerprint(given("kepler", own, "lagrangian"), workbook.sampler)
    assert (found == ()) is nothing
    assert found is None or nothing
