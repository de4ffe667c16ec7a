"""The verification: right lines pass, and every kind of wrong line is caught."""

from __future__ import annotations

import pytest
import sympy as sp
from flint import arb
from tests.derived import derived

from deltaq.derivation.engine import derive
from deltaq.derivation.formula import (
    Dot,
    Equation,
    Explicit,
    Formula,
    Gateaux,
    Named,
    Partial,
    Plus,
    Quantity,
    Rate,
    Shifted,
    Substituted,
    Term,
    Times,
)
from deltaq.derivation.points import along_motion
from deltaq.derivation.step import Chapter, Derivation, Relation, Step
from deltaq.derivation.system import System
from deltaq.derivation.verification import holds, random_points, verified, verified_step
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids

SYSTEM = System(load_scene("elastic-pendulum"))
POINTS = tuple(random_points(SYSTEM))
L, M, T = (SYSTEM.symbols.name(name) for name in ("l", "m", "t"))
Y, PHI = SYSTEM.q("y"), SYSTEM.q("phi")
DY, DPHI = SYSTEM.variation("y"), SYSTEM.variation("phi")
YD, PHID = SYSTEM.rate("y"), SYSTEM.rate("phi")
PHIDD = SYSTEM.acceleration("phi")
R = Named(Quantity("position", "bob"), SYSTEM.position("bob"), (Y, PHI))


def column(*components: sp.Expr) -> Explicit:
    return Explicit(sp.ImmutableMatrix(components))


IDENTITIES = [
    pytest.param(Partial(R, PHI), column(L * sp.cos(PHI), -L * sp.sin(PHI)), id="partial derivative"),
    pytest.param(Gateaux(R), column(L * sp.cos(PHI) * DPHI, DY - L * sp.sin(PHI) * DPHI), id="first variation"),
    pytest.param(Rate(R), column(L * sp.cos(PHI) * PHID, YD - L * sp.sin(PHI) * PHID), id="rate"),
    pytest.param(
        Rate(Rate(Explicit(sp.sin(PHI)))), Explicit(sp.cos(PHI) * PHIDD - sp.sin(PHI) * PHID**2), id="nested rates"
    ),
    pytest.param(Rate(Partial(Explicit(M * PHID**2 / 2), PHID)), Explicit(M * PHIDD), id="rate of a momentum"),
    pytest.param(Rate(Explicit(sp.sin(T))), Explicit(sp.cos(T)), id="explicit time"),
    pytest.param(Gateaux(Explicit(sp.sin(T) * Y)), Explicit(sp.sin(T) * DY), id="time is not varied"),
    pytest.param(Gateaux(Explicit(M * L)), Explicit(sp.Integer(0)), id="parameters are not varied"),
    pytest.param(
        Shifted(sp.cos(PHI + SYSTEM.h * DPHI), SYSTEM.h), Explicit(-sp.sin(PHI) * DPHI), id="derivative at h = 0"
    ),
    pytest.param(Dot(R, R), Explicit(L**2 + 2 * L * Y * sp.cos(PHI) + Y**2), id="scalar product"),
    pytest.param(
        Times((Explicit(M), R)), column(M * L * sp.sin(PHI), M * (Y + L * sp.cos(PHI))), id="scalar times vector"
    ),
    pytest.param(Plus((Term(Explicit(Y)), Term(Explicit(PHI), sign=-1))), Explicit(Y - PHI), id="sum with a minus"),
    pytest.param(Substituted(Explicit(Y**2), {Y: sp.sin(T)}), Explicit(sp.sin(T) ** 2), id="substitution"),
    pytest.param(Equation(Explicit(Y), Explicit(PHI)), Explicit(Y - PHI), id="equation as left minus right"),
    pytest.param(Explicit(sp.Abs(-Y) + sp.sqrt(Y**2)), Explicit(2 * Y), id="functions"),
]


@pytest.mark.parametrize(("formula", "equal"), IDENTITIES)
def test_right_lines_hold(formula: Formula, equal: Explicit) -> None:
    assert holds(Relation((formula, equal)), POINTS)


@pytest.mark.parametrize(("formula", "equal"), IDENTITIES)
def test_wrong_lines_do_not(formula: Formula, equal: Explicit) -> None:
    tiny = sp.Rational(1, 10**15)
    is_vector = isinstance(equal.value, sp.MatrixBase)
    wrong = Explicit(equal.value.applyfunc(lambda c: c + tiny) if is_vector else equal.value + tiny)
    assert not holds(Relation((formula, wrong)), POINTS)
    assert holds(Relation((formula, wrong), "≠"), POINTS)


def test_what_is_nowhere_defined_is_not_verified() -> None:
    nowhere = Explicit(sp.log(-L))
    assert not holds(Relation((nowhere, nowhere)), POINTS)


def first_values(symbol: sp.Symbol, count: int) -> list[sp.Rational]:
    """What a symbol is at the first points, exactly."""
    mantissas = [point[symbol.name].man_exp() for point in POINTS[:count]]
    return [sp.Rational(int(mantissa)) * sp.Integer(2) ** int(exponent) for mantissa, exponent in mantissas]


@pytest.mark.parametrize(("points", "enough"), [(1, False), (2, True)])
def test_lines_that_can_be_compared_at_one_point_alone_are_not_verified(points: int, enough: bool) -> None:
    """√(−(y − y₁)²…) is real where y is one of so many of the points, and nowhere else."""
    here = Explicit(sp.sqrt(-sp.prod((Y - value) ** 2 for value in first_values(Y, points)), evaluate=False))
    assert holds(Relation((here, Explicit(sp.Integer(0)))), POINTS) is enough


def test_lines_that_agree_at_one_point_by_chance_are_not_verified() -> None:
    (value,) = first_values(Y, 1)
    lucky, right = Explicit(PHI + Y - value), Explicit(PHI)
    assert not holds(Relation((lucky, right)), POINTS)
    assert holds(Relation((lucky, right), "≠"), POINTS)


def test_every_member_counts_and_every_component() -> None:
    a, b = column(Y, PHI), column(Y, PHI + Y)
    for members in ((a, b), (b, a), (a, a, b), (a, b, a)):
        assert not holds(Relation(members), POINTS)
        assert holds(Relation(members, "≠"), POINTS)
    assert holds(Relation((a, a, a)), POINTS)
    assert not holds(Relation((a, a), "≠"), POINTS)
    opposite = column(Y + 1, PHI - 1)
    assert not holds(Relation((a, opposite)), POINTS)


@pytest.mark.parametrize(
    ("size", "off", "same"),
    [
        (1, 1.5 * 2**-79, False),  # relative to 1 + 1, hence three halves of what is allowed
        (1, 2**-79, False),
        (1, 1.5 * 2**-80, True),
        (0, 1.5 * 2**-80, False),
        (0, 1.5 * 2**-81, True),
        (10**30, 1, True),
        (10**30, 10**8, False),
        (-(10**30), 1, True),
    ],
)
def test_a_difference_counts_by_the_size_of_what_is_compared(size: int, off: float, same: bool) -> None:
    left, right = Explicit(sp.Integer(size)), Explicit(sp.Integer(size) + sp.Rational(off))
    assert holds(Relation((left, right)), POINTS) is same


def test_variations_vanish_at_both_ends_and_are_in_motion_between() -> None:
    """δq is a parabola that has its value at the time of the point: no rate of it is zero there."""
    start, end = (symbol.name for symbol in SYSTEM.ends)
    for point in POINTS:
        for name in ("y", "phi"):
            value, rate, second = (point[f"{dot}delta({name}){')' * bool(dot)}"] for dot in ("", "dot(", "ddot("))
            for time in (start, end):
                away = point[time] - point["t"]
                assert abs(value + rate * away + second * away**2 / 2) < 1e-9
            assert abs(rate * (point[end] - point[start])) > abs(value) / 10
            assert abs(second) > 0


TINY = sp.Rational(1, 10**20)


@pytest.mark.parametrize(
    ("members", "strictly", "at_most"),
    [
        ((0, 1), True, True),
        ((1, 0), False, False),
        ((1, 1), False, True),
        ((0, 1, 1), False, True),
        ((0, 2, 1), False, False),
        ((2, 0, 1), False, False),
        ((0, 1, 2), True, True),
        ((1, 1 + TINY), True, True),
        ((1, 1 - TINY), False, False),
        ((-Y, Y), True, True),
        ((sp.log(-L), 1), False, False),  # nowhere defined
    ],
)
def test_numbers_rise_from_member_to_member(members: tuple[sp.Expr, ...], strictly: bool, at_most: bool) -> None:
    line = tuple(Explicit(sp.sympify(member)) for member in members)
    assert [holds(Relation(line, sign), POINTS) for sign in ("<", "≤")] == [strictly, at_most]


def test_points_are_the_same_for_every_call_and_apart_from_each_other() -> None:
    again = tuple(random_points(SYSTEM))
    assert [dict(point) for point in again] == [dict(point) for point in POINTS]
    names = [name for name in POINTS[0] if name not in {parameter.name for parameter in SYSTEM.scene.parameters}]
    for name in names:
        values = [float(point[name]) for point in POINTS]
        assert len(set(values)) == len(values) == 10, name
    for name in ("y", "dot(phi)", "ddot(y)", "delta(phi)", "d(y)", "d(t)", "t"):
        assert all(0.25 <= float(point[name]) <= 1.75 for point in POINTS), name
    assert [float(point["omega"]) for point in random_points(SYSTEM, seed=2)] != [float(p["omega"]) for p in POINTS]


def test_the_last_two_points_have_the_values_of_the_scene() -> None:
    own = {parameter.name: parameter.value for parameter in SYSTEM.scene.parameters}
    assert [{name: float(point[name]) for name in own} == own for point in POINTS] == [False] * 8 + [True] * 2


def test_a_variation_vanishes_at_both_ends() -> None:
    """δq + δq̇ s + δq̈ s²/2 is the parabola through its value now; s leads from now to the start, or to the end."""
    start, end = (symbol.name for symbol in SYSTEM.ends)
    for point in POINTS:
        for name in SYSTEM.coordinates:
            value, slope, bend = (point[f"{dots}delta({name}){')' * bool(dots)}"] for dots in ("", "dot(", "ddot("))
            for moment in (start, end):
                s = point[moment] - point["t"]
                assert abs(float(value + slope * s + bend * s * s / 2)) < 1e-12 * float(value)
        assert float(point[start]) < float(point["t"]) < float(point[end])
        assert float(point[end] - point[start]) < 1e-5


@pytest.mark.parametrize("later", [sp.Rational(1, 2), sp.Integer(-3)])
def test_the_motion_goes_on_by_taylor_s_series(later: sp.Rational) -> None:
    """The last rate that is known stays: q = 2 + 3t + 4t²/2 + 5t³/6 and its derivatives."""
    h = arb(later.p) / later.q
    known = {"t": arb(7), "k": arb(9), "q": arb(2), "dot(q)": arb(3), "ddot(q)": arb(4), "dddot(q)": arb(5)}
    there = along_motion(known, h)
    time = sp.Symbol("time")
    path = 2 + 3 * time + 2 * time**2 + sp.Rational(5, 6) * time**3
    for order, name in enumerate(("q", "dot(q)", "ddot(q)", "dddot(q)")):
        assert float(there[name]) == pytest.approx(float(path.diff(time, order).subs(time, later)), rel=1e-15)
    assert (float(there["t"]), float(there["k"])) == (7 + float(later), 9.0)


def test_steps_are_found_with_all_below_them_in_reading_order() -> None:
    leaf = Step("leaf", "", ())
    branch = Step("branch", "bob", (), about={"load": "weight"}).with_substeps(leaf, Step("leaf", "two", ()))
    derivation = Derivation("hamilton", (Chapter("one", (branch, leaf)), Chapter("two", (Step("last", "x", ()),))))
    assert [step.id for step in derivation.steps()] == ["branch:bob", "leaf", "leaf:two", "leaf", "last:x"]
    relation = Relation((Explicit(Y), Explicit(PHI), Explicit(L)))
    assert (relation.before, relation.after) == (Explicit(Y), Explicit(L))
    assert not branch.verified
    with pytest.raises(TypeError):
        branch.about["load"] = "another"  # type: ignore[index]


@pytest.mark.parametrize("place", ["step", "substep", "second relation", "second step"])
def test_only_what_is_wrong_and_what_holds_it_is_marked(place: str) -> None:
    right, wrong = Relation((Explicit(Y), Explicit(Y))), Relation((Explicit(Y), Explicit(PHI)))

    def line(*places: str) -> tuple[Relation, ...]:
        return (right, wrong if place in places else right)

    first = Step("first", "", line("step", "second relation")).with_substeps(Step("below", "", line("substep")))
    derivation = Derivation("hamilton", (Chapter("only", (first, Step("second", "", line("second step")))),))
    found = {step.id: step.verified for step in verified(derivation, SYSTEM).steps()}
    spoilt = {"substep": {"first", "below"}, "second step": {"second"}}.get(place, {"first"})
    assert found == {name: name not in spoilt for name in ("first", "below", "second")}


def test_a_wrong_substep_spoils_its_step() -> None:
    right = Relation((Explicit(Y), Explicit(Y)))
    wrong = Step("wrong", "", (Relation((Explicit(Y), Explicit(PHI))),))
    step = verified_step(Step("right", "", (right,)).with_substeps(wrong), POINTS)
    assert (step.verified, step.substeps[0].verified) == (False, False)


def test_a_wrong_rule_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """A velocity that forgets the explicit time dependence of a guide."""
    right = System.velocity

    def forgetful(self: System, place: str) -> sp.ImmutableMatrix:
        return right(self, place).xreplace({self.symbols.name("omega"): sp.Integer(0)})

    monkeypatch.setattr(System, "velocity", forgetful)
    _, derivation = derive(load_scene("guided-pendulum"))
    wrong = {step.id for step in derivation.steps() if not step.verified}
    assert "velocity:bob" in wrong
    assert "virtual-displacement:bob" not in wrong


@pytest.mark.always
@pytest.mark.parametrize("identifier", scene_ids())
def test_every_step_of_every_scene_is_verified(identifier: str) -> None:
    _, derivation = derived(identifier)
    steps = list(derivation.steps())
    assert [step.id for step in steps if not step.verified] == []
    assert len({step.id for step in steps}) == len(steps) >= 15


def test_an_equilibrium_where_the_ends_of_a_damper_meet_is_verified() -> None:
    scene = read_scene(
        {
            "id": "damped",
            "dimension": 2,
            "coordinates": [{"name": "x", "value": 0.3}],
            "parameters": [{"name": name, "value": 1.5} for name in ("m", "a", "c", "k")],
            "points": [{"name": "anchor", "position": ["0", "0"]}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "a*sin(x/a)"]}],
            "loads": [
                {"kind": "damper", "name": "damper", "from": "anchor", "to": "bob", "coefficient": "c"},
                {"kind": "potential", "name": "spring", "energy": "k*x^2"},
            ],
        }
    )
    _, derivation = derive(scene)
    assert [step.id for step in derivation.steps() if not step.verified] == []
    assert any(step.rule == "equilibrium" for step in derivation.steps())
