"""Trees to SymEngine."""

from __future__ import annotations

import pytest
import symengine as se
from tests.simulation.scenes import get_scene

from deltaq.language.parser import parse
from deltaq.language.tree import Vector
from deltaq.model.symbols import Symbols
from deltaq.model.symengine_algebra import to_symengine

SCENE = get_scene("guided-pendulum")
SYMBOLS = Symbols.of(SCENE)
PHI, RATE, ACCELERATION = se.symbols("q0 u0 a0")
Y, T = se.symbols("q1 t")
M, L, G, Y0, OMEGA = se.symbols("p0 p1 p2 p3 p4")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("9.81", se.Integer(981) / 100, id="decimals are exact"),
        pytest.param("m*l^2*dot(phi)^2/2", M * L**2 * RATE**2 / 2, id="kinetic energy"),
        pytest.param("y - y0*sin(omega*t)", Y - Y0 * se.sin(OMEGA * T), id="guided coordinate and time"),
        pytest.param("-pi*phi", -se.pi * PHI, id="pi"),
        pytest.param("ddot(phi)", ACCELERATION, id="acceleration"),
    ],
)
def test_expressions(text: str, expected: object) -> None:
    assert se.expand(to_symengine(parse(text, SCENE.names).tree, SYMBOLS) - expected) == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        pytest.param("delta(phi)", "a model has no virtual displacement of phi", id="variation"),
        pytest.param("d(phi)", "a model has no differential of phi", id="differential"),
        pytest.param("phi = 1", "a model is built from expressions, not from equations (q0 = 1)", id="equation"),
    ],
)
def test_what_a_model_has_no_place_for(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=r"^a model") as caught:
        to_symengine(parse(text, SCENE.names).tree, SYMBOLS)
    assert str(caught.value) == message


def test_vectors_are_taken_by_component() -> None:
    with pytest.raises(ValueError, match="not from vectors of 2"):
        to_symengine(Vector((parse("1", SCENE.names).tree,) * 2), SYMBOLS)
