"""Operations carried out in normal form are those of the textbooks, and what is false by a term is not proved."""

from __future__ import annotations

import pytest
import sympy as sp

from deltaq.derivation.formula import (
    AtEquilibrium,
    AtTime,
    Boundary,
    Bounds,
    Called,
    Determinant,
    Directional,
    Dot,
    Each,
    Equation,
    Explicit,
    Formula,
    Gateaux,
    Inserted,
    Integral,
    Jacobian,
    LimitOfQuotient,
    MassIntegral,
    MatrixTimes,
    Named,
    Partial,
    Plus,
    Power,
    Quantity,
    Rate,
    Ratio,
    Rounded,
    Shifted,
    Stack,
    Substituted,
    Summed,
    Term,
    Times,
    minus,
)
from deltaq.derivation.normal_algebra import NormalAlgebra
from deltaq.derivation.step import Relation


def real(*names: str) -> tuple[sp.Symbol, ...]:
    return tuple(sp.Symbol(name, real=True) for name in names)


X, Y, XD, YD, XDD, X3, X4 = real("x", "y", "dot(x)", "dot(y)", "ddot(x)", "dddot(x)", "ddddot(x)")
DX, DY, DXD, DXDD = real("delta(x)", "delta(y)", "dot(delta(x))", "ddot(delta(x))")
TIME, S, H, T0, T1 = real("t", "s", "h", "t0", "t1")
M, L = sp.symbols("m l", positive=True)
NAME = Quantity("name")
ZERO, ONE = sp.Integer(0), sp.Integer(1)
OVER_TIME = (Bounds(TIME, T0, T1),)
OVER_ROD = (Bounds(S, ZERO, L),)
MATRIX = sp.ImmutableMatrix([[X, Y, 1], [2, XD, M], [L, 3, X]])
VECTOR = sp.ImmutableMatrix([X, Y, M])


def e(value: sp.Expr | sp.MatrixBase | int) -> Explicit:
    return Explicit(sp.sympify(value))


def integral(value: sp.Expr) -> Integral:
    return Integral(e(value), OVER_TIME)


def ends(value: sp.Expr) -> Boundary:
    return Boundary(e(value), T0, T1)


def added(*formulas: Formula) -> Plus:
    return Plus(tuple(map(Term, formulas)))


EQUAL = [
    pytest.param(Partial(e(X**3 * sp.sin(X)), X), e(3 * X**2 * sp.sin(X) + X**3 * sp.cos(X)), id="product rule"),
    pytest.param(Partial(e(VECTOR), X), e(sp.ImmutableMatrix([1, 0, 0])), id="partial of a vector"),
    pytest.param(Rate(e(X**2 * TIME)), e(2 * X * XD * TIME + X**2), id="rate with the time itself"),
    pytest.param(Rate(e(X * Y)), e(XD * Y + X * YD), id="rate of two functions"),
    pytest.param(Rate(Rate(e(X))), e(XDD), id="second rate"),
    pytest.param(Rate(Rate(Rate(Rate(e(X))))), e(X4), id="fourth rate"),
    pytest.param(Rate(e(X * DX)), e(XD * DX + X * DXD), id="rate of a variation"),
    pytest.param(Gateaux(e(X**2 * Y * XD)), e((2 * X * DX * Y + X**2 * DY) * XD), id="variation leaves rates"),
    pytest.param(Gateaux(e(TIME * M)), e(0), id="variation leaves the time"),
    pytest.param(Times((e(X), e(Y), e(3))), e(3 * X * Y), id="product"),
    pytest.param(Times((e(X), e(VECTOR), e(M))), e(sp.ImmutableMatrix(M * X * VECTOR)), id="product with a vector"),
    pytest.param(Dot(e(VECTOR), e(VECTOR)), e(X**2 + Y**2 + M**2), id="scalar product"),
    pytest.param(Plus((Term(e(X)), minus(e(Y)))), e(X - Y), id="difference"),
    pytest.param(Equation(e(X), e(Y)), e(X - Y), id="equation"),
    pytest.param(Named(NAME, X + Y), e(Y + X), id="name"),
    pytest.param(Shifted((X + H * DX) ** 2 * (1 + H), H), e(2 * X * DX + X**2), id="neighbour"),
    pytest.param(Integral(e(M * S**2 * X / L), OVER_ROD), e(M * L**2 * X / 3), id="inertia of a rod"),
    pytest.param(Integral(e(X + S), (Bounds(S, X, 2 * X),)), e(X**2 + sp.Rational(3, 2) * X**2), id="bounds"),
    pytest.param(Integral(e(S * Y), (Bounds(S, ZERO, ONE), Bounds(Y, ZERO, S))), e(sp.Rational(1, 8)),
                 id="last one innermost"),
    pytest.param(integral(X * DXD), Plus((Term(ends(X * DX)), minus(integral(XD * DX)))), id="by parts"),
    pytest.param(integral(X * DXDD), added(Plus((Term(ends(X * DXD)), minus(ends(XD * DX)))), integral(XDD * DX)),
                 id="twice by parts"),
    pytest.param(integral(X), integral(X), id="integral of what is not known"),
    pytest.param(integral(X**2 * sp.cos(DX * 0) + sp.sin(X) ** 2), integral(X**2 + 1 - sp.cos(X) ** 2), id="integrand"),
    pytest.param(Substituted(e(X**2 * Y), {X: M + 1}), e((M + 1) ** 2 * Y), id="substituted"),
    pytest.param(Substituted(Rate(e(X**2)), {XD: M}), e(2 * X * M), id="a rate that no expression has named"),
    pytest.param(AtEquilibrium(e(X * XD + sp.cos(X)), {X: ZERO, XD: ZERO}), e(1), id="in an equilibrium"),
    pytest.param(Substituted(e(X / Y + Y), {X: ZERO}), e(Y), id="a zero above a line"),
    pytest.param(Inserted(e(M * X), {M: sp.Integer(3)}), e(3 * X), id="inserted"),
    pytest.param(Called(NAME, e(X)), e(X), id="called"),
    pytest.param(Directional(e(X**2 * XD), {X: DX, XD: DXD}, H), e(2 * X * DX * XD + X**2 * DXD), id="direction"),
    pytest.param(LimitOfQuotient(e(X**3), {X: Y}, H), e(3 * X**2 * Y), id="limit of quotients"),
    pytest.param(Directional(Called(NAME, e(X * Y)), {X: ONE}, H), e(Y), id="direction of a name"),
    pytest.param(Directional(integral(X * XD), {X: DX, XD: DXD}, H), integral(XD * DX + X * DXD), id="under ∫"),
    pytest.param(Directional(AtTime(e(X**2), T1), {X: DX}, H), AtTime(e(2 * X * DX), T1), id="at an instant"),
    pytest.param(AtTime(e(TIME * M), T1), e(T1 * M), id="time at an instant"),
    pytest.param(ends(TIME**2), e(T1**2 - T0**2), id="between two instants"),
    pytest.param(Ratio(e(X**2 - Y**2), e(X + Y)), e(X - Y), id="fraction"),
    pytest.param(Ratio(e(1), e(X)), e(1 / X), id="reciprocal"),
    pytest.param(Summed(e(0), (e(X), e(Y), e(Y))), e(X + 2 * Y), id="sum over an index"),
    pytest.param(Each(e(0), (e(X), e(Y))), e(sp.ImmutableMatrix([X, Y])), id="free index"),
    pytest.param(Stack((e(X), e(Y), e(M))), e(VECTOR), id="column"),
    pytest.param(MatrixTimes(e(MATRIX), e(VECTOR)), e(sp.ImmutableMatrix(MATRIX * VECTOR)), id="matrix times vector"),
    pytest.param(Jacobian(e(sp.ImmutableMatrix([X * Y, Y**3])), (X, Y), NAME),
                 e(sp.ImmutableMatrix([[Y, X], [0, 3 * Y**2]])), id="Jacobian matrix"),
    pytest.param(Determinant(e(MATRIX)), e(sp.expand(MATRIX.det())), id="determinant of three rows"),
    pytest.param(Determinant(e(sp.ImmutableMatrix([[X]]))), e(X), id="determinant of one row"),
    pytest.param(Power(e(X + 1), 3), e(X**3 + 3 * X**2 + 3 * X + 1), id="power"),
    pytest.param(Rounded(sp.Rational(1, 3)), e(sp.Rational(1, 3)), id="a number that is exact"),
]  # fmt: skip


@pytest.mark.parametrize(("formula", "value"), EQUAL)
def test_it_is_what_textbooks_say(formula: Formula, value: Formula) -> None:
    algebra = NormalAlgebra(("x", "y"))
    assert algebra.holds(Relation((formula, value)))
    assert algebra.holds(Relation((value, formula, value)))
    assert not algebra.holds(Relation((formula, value), "≠"))


@pytest.mark.parametrize(("formula", "value"), EQUAL)
def test_one_term_more_is_false(formula: Formula, value: Formula) -> None:
    algebra = NormalAlgebra(("x", "y"))
    (*others, last) = algebra.carried_out(value)
    components = tuple(algebra.reader.expression(form) for form in (*others, algebra.add((last, algebra.value(X)[0]))))
    false = Explicit(components[0] if len(components) == 1 else sp.ImmutableMatrix(components))
    assert not algebra.holds(Relation((formula, false)))
    assert not algebra.holds(Relation((formula, value, false)))
    assert algebra.holds(Relation((formula, false), "≠"))


@pytest.mark.parametrize(
    "formula",
    [
        pytest.param(MassIntegral(e(X), "B", "dm", OVER_ROD[0], M), id="region of no form"),
        pytest.param(integral(DXD**2), id="square of the rate of a variation"),
        pytest.param(Integral(e(sp.sin(S)), OVER_ROD), id="wave along a body"),
        pytest.param(Integral(e(1 / S), OVER_ROD), id="reciprocal along a body"),
        pytest.param(Integral(e(sp.sqrt(1 + S**2)), OVER_ROD), id="root along a body"),
        pytest.param(Integral(e(sp.sqrt(S)), OVER_ROD), id="root of the coordinate along a body"),
        pytest.param(Integral(e(sp.sqrt(L)), (Bounds(L, ZERO, M),)), id="and where it is positive"),
        pytest.param(Ratio(e(X), e(0)), id="division by zero"),
        pytest.param(Rounded(sp.Rational(1, 2**201)), id="rounded"),
        pytest.param(Substituted(e(X), {X: sp.Rational(1, 3**200)}), id="rounded put in"),
        pytest.param(Substituted(e(X * Y), {X: sp.Rational(1, 3**200), Y: ONE}), id="rounded put in beside others"),
    ],
)
def test_what_has_no_normal_form_is_not_proved(formula: Formula) -> None:
    algebra = NormalAlgebra(("x", "y"))
    assert not algebra.holds(Relation((formula, formula)))
    assert not algebra.holds(Relation((formula, e(X)), "≠"))
    assert algebra.products(formula) is None


def test_vectors_are_not_compared_with_scalars() -> None:
    algebra = NormalAlgebra(("x",))
    assert not algebra.holds(Relation((e(VECTOR), e(X))))
    assert not algebra.holds(Relation((e(VECTOR), e(X)), "≠"))


def test_variations_vanish_where_they_are_held() -> None:
    free, fixed = NormalAlgebra(("x",)), NormalAlgebra(("x",), frozenset({("delta(x)", T0), ("delta(x)", T1)}))
    without_ends = Relation((integral(X * DXD), integral(-XD * DX)))
    assert fixed.holds(without_ends)
    assert not free.holds(without_ends)


@pytest.mark.parametrize(
    ("sign", "numbers", "holds"),
    [
        ("<", (1, 2, 3), True),
        ("<", (0, sp.Rational(1, 2)), True),
        ("<", (1, 2, 2), False),
        ("<", (1, 3, 2), False),
        ("≤", (1, 2, 2), True),
        ("≤", (-1, 0, 0), True),
        ("≤", (2, 1), False),
        ("<", (1, X), False),
        ("≤", (X, X), False),
    ],
)
def test_numbers_rise(sign: str, numbers: tuple[sp.Expr, ...], holds: bool) -> None:
    assert NormalAlgebra(("x",)).holds(Relation(tuple(map(e, numbers)), sign)) is holds


def test_products_are_told_by_component() -> None:
    algebra = NormalAlgebra(("x", "y"))
    found = algebra.products(e(sp.ImmutableMatrix([3 * X - Y, 0, X])))
    assert found is not None
    assert sorted((place, int(number.p)) for (place, _), number in found.items()) == [(0, -1), (0, 3), (2, 1)]  # type: ignore[attr-defined]
    assert algebra.products(e(0)) == {}


@pytest.mark.parametrize("moving", [X, XD, XDD, X3, X4, DX, DXD, DXDD], ids=str)
def test_what_moves_is_another_thing_at_an_instant(moving: sp.Symbol) -> None:
    algebra = NormalAlgebra(("x",))
    assert not algebra.holds(Relation((AtTime(e(moving), T1), e(moving))))
    assert not algebra.holds(Relation((AtTime(e(moving), T1), AtTime(e(moving), T0))))
    assert algebra.holds(Relation((AtTime(e(M * L), T1), e(M * L))))
