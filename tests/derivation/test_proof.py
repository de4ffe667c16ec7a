"""The general proof: both checks pass, and each catches a wrong line on its own."""

from __future__ import annotations

import pytest
import sympy as sp

from deltaq.derivation.abstract_motion import AbstractMotion, P, arbitrary, each, q, rate, sample, summed, total_rate
from deltaq.derivation.carrying_out import GeneralAlgebra
from deltaq.derivation.formula import Dot, Explicit, Formula, FunctionFormula, MassIntegral, Partial, Rate, Ratio, Times
from deltaq.derivation.general_lagrange import cancellation, exchange, product_rule
from deltaq.derivation.general_quantities import by_mass, for_each, half_square, lever, velocity
from deltaq.derivation.proof import CHAPTERS, prove
from deltaq.derivation.step import Relation, Step


def test_every_line_is_verified() -> None:
    steps = list(prove().steps())
    assert [step.id for step in steps if not step.verified] == []
    assert len(steps) == sum(map(len, CHAPTERS.values())) == 20


def without_time(motion: AbstractMotion) -> Step:
    """v = ∂r/∂q q̇: wrong where the position depends on time."""
    step = cancellation(motion)
    along = step.relations[0].members[2].terms[0].formula  # type: ignore[union-attr]
    return Step("wrong", "", (Relation((velocity(motion), along)),))


def other_index(motion: AbstractMotion) -> Step:
    """∂v/∂q̇₁ = ∂r/∂q₂"""
    return Step("wrong", "", (Relation((Partial(velocity(motion), rate("1")), lever(motion, "2"))),))


def forgotten_term(motion: AbstractMotion) -> Step:
    """The product rule without its second term."""
    (line,) = product_rule(motion).relations
    return Step("wrong", "", (for_each(lambda i: Rate(lever(motion, i)), lambda i: lever(motion, i)), line))


def wrong_exchange(motion: AbstractMotion) -> Step:
    """∂/∂q̇ ∫ v · v/2 dm = ∂/∂q ∫ v · v/2 dm"""
    energy = by_mass(motion, half_square(motion))
    return Step("wrong", "", (for_each(lambda i: Partial(energy, rate(i)), lambda i: Partial(energy, q(i))),))


@pytest.mark.parametrize("rule", [without_time, other_index, forgotten_term, wrong_exchange])
def test_a_wrong_rule_is_caught(rule: object) -> None:
    (step,) = prove({"wrong": (rule,)}).steps()  # type: ignore[dict-item]
    assert not step.verified


@pytest.mark.parametrize("rule", [without_time, other_index, forgotten_term, wrong_exchange])
def test_algebra_alone_catches_it(rule: object) -> None:
    algebra = GeneralAlgebra()
    assert not all(map(algebra.holds, rule(arbitrary()).relations))  # type: ignore[operator]


def test_numbers_alone_catch_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(GeneralAlgebra, "holds", lambda *_: True)
    (right, wrong) = prove({"both": (exchange, other_index)}).steps()
    assert (right.verified, wrong.verified) == (True, False)


def test_a_line_that_holds_for_the_sample_only_is_caught() -> None:
    """The proof is not one about the sample's functions."""
    special = sample().potential
    algebra = GeneralAlgebra()
    line = Relation((Explicit(arbitrary().potential), Explicit(special)))
    assert not algebra.holds(line)


def test_integrals_are_compared_term_by_term() -> None:
    motion, algebra = arbitrary(), GeneralAlgebra()
    twice = by_mass(motion, Explicit(2 * q("1")))
    once = by_mass(motion, Explicit(sp.Integer(1)))
    assert algebra.holds(Relation((twice, summed(lambda _: scaled(once)))))
    assert not algebra.holds(Relation((twice, once)))


def scaled(integral: MassIntegral) -> MassIntegral:
    """q₁ ∫ … with the factor inside"""
    return MassIntegral(Explicit(q("1")), integral.region, integral.element, integral.bounds, integral.weight)


def test_what_stands_before_an_integral_is_not_integrated() -> None:
    """P ∫ P dm is not ∫ P² dm."""
    motion, algebra = arbitrary(), GeneralAlgebra()
    before = Times((Explicit(P), by_mass(motion, Explicit(P))))
    assert not algebra.holds(Relation((before, by_mass(motion, Explicit(P**2)))))


MASS = by_mass(arbitrary(), Explicit(sp.Integer(1)))


@pytest.mark.parametrize(
    ("formula", "said"),
    [
        pytest.param(Times((MASS, MASS)), "a product of integrals", id="product"),
        pytest.param(Dot(MASS, MASS), "a product of integrals", id="scalar product"),
        pytest.param(Ratio(MASS, MASS), "a product of integrals", id="ratio"),
        pytest.param(by_mass(arbitrary(), MASS), "an integral of integrals", id="double integral"),
    ],
)
def test_integrals_are_carried_out_one_at_a_time(formula: Formula, said: str) -> None:
    with pytest.raises(TypeError, match=f"^{said} is no part of a general proof$"):
        GeneralAlgebra().carried_out(formula)


def test_rate_of_an_undefined_function_is_the_chain_rule() -> None:
    f = sp.Function("f")(q("1"))
    assert total_rate(f) == f.diff(q("1")) * rate("1")


def test_each_shows_the_index_and_holds_the_instances() -> None:
    formula = each(lambda i: Explicit(q(i)))
    assert formula.shown == Explicit(q("i"))
    assert formula.instances == (Explicit(q("1")), Explicit(q("2")))


def test_what_is_no_part_of_a_proof_is_our_bug() -> None:
    with pytest.raises(TypeError, match="FunctionFormula is no part of a general proof"):
        GeneralAlgebra().carried_out(FunctionFormula())
