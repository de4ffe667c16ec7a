"""Arithmetic of Fourier forms: products of waves as in a table of formulas, quotients where there are any."""

from __future__ import annotations

from typing import Any

import pytest
from flint import fmpq
from tests.language.scene_names import SYMBOLS, read

from deltaq.language import fourier
from deltaq.language.canonical import is_zero
from deltaq.language.fourier import Form, Phase
from deltaq.language.kernel_reader import divided
from deltaq.language.normal_form import Reader

A: Phase = (((("a", 1),), 1),)
B: Phase = (((("b", 1),), 1),)
TWICE: Phase = (((("a", 1),), 2),)
SUM: Phase = (((("a", 1),), 1), ((("b", 1),), 1))
DIFFERENCE: Phase = (((("a", 1),), 1), ((("b", 1),), -1))


def cos(phase: Phase, number: Any = 1) -> Form:
    return fourier.scale(fourier.wave(phase, sine=False), fmpq(number))


def sin(phase: Phase, number: Any = 1) -> Form:
    return fourier.scale(fourier.wave(phase, sine=True), fmpq(number))


HALF = fmpq(1, 2)


@pytest.mark.parametrize(
    ("left", "right", "product"),
    [
        (cos(A), cos(B), (cos(DIFFERENCE, HALF), cos(SUM, HALF))),
        (sin(A), sin(B), (cos(DIFFERENCE, HALF), cos(SUM, -HALF))),
        (sin(A), cos(B), (sin(DIFFERENCE, HALF), sin(SUM, HALF))),
        (cos(A), sin(B), (sin(DIFFERENCE, -HALF), sin(SUM, HALF))),
        (sin(A), sin(A), (fourier.constant(HALF), cos(TWICE, -HALF))),
        (cos(A), cos(A), (fourier.constant(HALF), cos(TWICE, HALF))),
        (sin(A), cos(A), (sin(TWICE, HALF),)),
        (fourier.constant(3), sin(A), (sin(A, 3),)),
        (sin(A), fourier.monomial("x", 2), ({((("x", 2),), A, True): fmpq(1)},)),
        (fourier.monomial("x", 2), fourier.monomial("x", -2), (fourier.constant(1),)),
        (fourier.monomial("x", HALF), fourier.monomial("x", HALF), (fourier.monomial("x"),)),
    ],
)
def test_products(left: Form, right: Form, product: tuple[Form, ...]) -> None:
    assert fourier.multiply(left, right) == fourier.add(product)


def test_waves_of_turned_phases() -> None:
    turned: Phase = (((("a", 1),), -1),)
    assert (cos(turned), sin(turned)) == (cos(A), sin(A, -1))
    assert (cos(()), sin(())) == (fourier.constant(1), {})
    assert fourier.add((sin(A), sin(turned))) == {}


def test_powers_and_numbers() -> None:
    assert [fourier.power(sin(A), n) for n in (0, 1, 2)] == [
        fourier.constant(1), sin(A), fourier.multiply(sin(A), sin(A)),
    ]  # fmt: skip
    assert fourier.raised((("x", 2), ("y", -1)), HALF) == (("x", 1), ("y", -HALF))
    assert fourier.raised((("x", 2),), 0) == ()
    assert [type(fourier.whole(number)) for number in (fmpq(4, 2), fmpq(1, 2), 3)] == [int, fmpq, int]
    assert [fourier.size(number) for number in (3, fmpq(-3, 4))] == [3.0, -0.75]
    assert fourier.scale(sin(A), 0) == fourier.constant(0) == {}
    assert fourier.monomial("x", 0) == fourier.constant(1)


def test_the_leading_term_is_the_same_however_a_form_was_made() -> None:
    parts = (fourier.monomial("x"), fourier.monomial("y", 3), fourier.monomial("x", 2), sin(A), cos(A))
    leading = {fourier.leading(fourier.add(order)) for order in (parts, parts[::-1], (*parts[2:], *parts[:2]))}
    assert len(leading) == 1


@pytest.mark.parametrize(
    ("form", "by", "quotient"),
    [
        ("x^2 - y^2", "x - y", "x + y"),
        ("m*x^2 - m*y^2", "x - y", "m*x + m*y"),
        ("x^2 - y", "x - y", None),
        ("x^2 - y^2", "2*x + 2*y", "x/2 - y/2"),
        ("x/2 - y/2", "x - y", "1/2"),
        ("x - y", "x*y", None),
        ("x^2/y - y", "x - y", None),
        ("m^(1/2)*x - m^(1/2)*y", "x - y", None),
        ("x*sin(phi) - y*sin(phi)", "x - y", None),
        ("x - y", "x*sin(phi)", None),
        ("0", "x - y", None),
        ("x^2 - y^2", "x/m - y/m", None),
    ],
)
def test_quotients_of_polynomials(form: str, by: str, quotient: str | None) -> None:
    reader = Reader()

    def plain(text: str) -> Form:
        return fourier.add(reader.form(term) for term in _terms(text))

    found = divided(plain(form), plain(by))
    assert found == (None if quotient is None else plain(quotient))


def _terms(text: str) -> list[Any]:
    value = read(text)
    return list(value.args) if value.is_Add else [value]


@pytest.mark.parametrize(
    ("text", "zero"),
    [
        ("max(x, y) + min(x, y) - x - y", True),
        ("max(x, y) - min(x, y) - abs(x - y)", True),
        ("2*max(x, y) - x - y - abs(x - y)", True),
        ("max(x, y, phi) - max(max(phi, y), x)", True),
        ("min(x, y) + max(-x, -y)", True),
        ("max(x, y) - x", False),
        ("min(x, y) - max(x, y)", False),
        ("step(x) + step(-x) - 1", True),
        ("2*step(x) - 1 - sign(x)", True),
        ("step(3*x) - step(x)", True),
        ("step(x) - step(y)", False),
        ("abs(sin(x)^2 + cos(x)^2 - 1)", True),
        ("y*sign(sin(x)^2 + cos(x)^2 - 1)", True),
        ("step(sin(x)^2 + cos(x)^2 - 1) - 1/2", True),
    ],
)
def test_the_larger_the_smaller_and_the_step_are_known_by_absolute_values_and_signs(text: str, *, zero: bool) -> None:
    assert is_zero(read(text), SYMBOLS) is zero
