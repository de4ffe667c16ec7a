"""The verification: right lines pass, and every kind of wrong line is caught."""

from __future__ import annotations

import pytest
import sympy as sp

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
from deltaq.derivation.step import Relation, Step
from deltaq.derivation.system import System
from deltaq.derivation.verification import holds, random_points, verified_step
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


@pytest.mark.parametrize("identifier", scene_ids())
def test_every_step_of_every_scene_is_verified(identifier: str) -> None:
    _, derivation = derive(load_scene(identifier))
    steps = list(derivation.steps())
    assert [step.id for step in steps if not step.verified] == []
    assert len({step.id for step in steps}) == len(steps) >= 15
