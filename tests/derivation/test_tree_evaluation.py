"""Trees in ball arithmetic: the value of plain numbers lies in the ball; derivatives are those along the motion."""

from __future__ import annotations

import pytest
from flint import arb, ctx
from tests.language.scene_names import NAMES
from tests.language.test_floats import POINT, ROWS

from deltaq.derivation.tree_evaluation import power, tree_value
from deltaq.derivation.verification import BITS
from deltaq.language.parser import parse

BALLS = {name: arb(value) for name, value in POINT.items()}


@pytest.mark.parametrize("text", [text for text, _ in ROWS])
def test_agrees_with_plain_numbers(text: str) -> None:
    expected = dict(ROWS)[text]
    assert float(tree_value(parse(text, NAMES).tree, BALLS)) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("dot(sin(phi))", "cos(phi)*dot(phi)", id="chain rule"),
        pytest.param("dot(l*phi^2)", "2*l*phi*dot(phi)", id="parameters are constant"),
        pytest.param("dot(dot(phi)*t)", "ddot(phi)*t + dot(phi)", id="product rule with the time"),
    ],
)
def test_derivative_by_the_time(text: str, expected: str) -> None:
    with ctx.workprec(BITS):
        found, known = (tree_value(parse(one, NAMES).tree, BALLS) for one in (text, expected))
        assert abs(float(found - known)) < 1e-60


@pytest.mark.parametrize("middle", [0, 1, -1])
@pytest.mark.parametrize("exponent", range(5))
def test_a_power_holds_all_powers_of_a_ball(middle: int, exponent: int) -> None:
    """Also around zero, as the rate of a length that does not change is: there a logarithm is not finite."""
    base = arb(middle, 0.25)
    found = power(base, arb(exponent))
    assert all(found.contains(arb(middle + part) ** exponent) for part in (-0.25, -0.125, 0, 0.125, 0.25))
    assert found.is_finite()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        pytest.param("diff(x^2, x)", "a number has no derivative", id="partial derivative"),
        pytest.param("[x, y]", "a vector is evaluated component by component", id="vector"),
        pytest.param("x = y", "an equation has no value", id="equation"),
    ],
)
def test_what_has_no_value(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=r"^an? ") as caught:
        tree_value(parse(text, NAMES).tree, BALLS)
    assert str(caught.value) == message
