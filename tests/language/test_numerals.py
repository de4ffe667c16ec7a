"""How numbers are written: decimals to the last digit, as Python's own decimal arithmetic has them."""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import product

import pytest
import sympy

from deltaq.language.numerals import decimal, decimals_of, ends, exact, is_decimal, is_long

DENOMINATORS = (1, 2, 4, 5, 8, 10, 16, 20, 25, 40, 64, 125, 1000, 4096, 10**12)


@pytest.mark.parametrize("denominator", DENOMINATORS)
def test_a_decimal_has_all_its_digits(denominator: int) -> None:
    for numerator in (1, 3, -3, 7, 99, -101, 12345, 10**15 + 1):
        value = Fraction(numerator, denominator)
        written = decimal(value)
        assert Fraction(written) == value
        with localcontext(prec=60):
            assert Decimal(written) == Decimal(numerator) / Decimal(denominator)
        whole, _, part = written.partition(".")
        assert len(part) == 1 or part[-1] != "0"
        assert whole.lstrip("-").isdigit()
        assert written.startswith("-") is (value < 0)


@pytest.mark.parametrize(
    ("value", "usual", "wanted", "long"),
    [
        ("981/100", True, True, True),
        ("1/2", False, True, False),
        ("1/4", False, True, False),
        ("1/5", False, True, False),
        ("3/10", True, True, False),
        ("1/16", False, True, False),
        ("1/3", False, False, False),
        ("7/30", False, False, False),
        ("1/128", False, True, True),
        ("3/99", False, False, False),
        ("1/100", True, True, True),
        ("4", False, True, False),
    ],
)
def test_which_numbers_are_written_as_decimals(value: str, usual: bool, wanted: bool, long: bool) -> None:
    number = Fraction(value)
    assert (is_decimal(number), ends(number), is_long(number)) == (usual, wanted, long)


X = sympy.Symbol("x", real=True)


@pytest.mark.parametrize(
    ("numbers", "as_decimals"),
    [
        pytest.param(("7/10", "7/5"), True, id="all end"),
        pytest.param(("7/10", "1/3"), False, id="one does not"),
        pytest.param(("1/2", "3"), False, id="a half alone may stay"),
        pytest.param(("1/2", "7/5"), True, id="a half beside others may not"),
    ],
)
def test_decimals_and_fractions_do_not_stand_side_by_side(numbers: tuple[str, str], as_decimals: bool) -> None:
    expr = sympy.Add(*(sympy.Rational(each) * X**n for n, each in enumerate(numbers, 1)))
    found = decimals_of(expr, wanted=True)
    assert found(Fraction(7, 5)) is as_decimals
    assert not decimals_of(expr, wanted=False)(Fraction(7, 5))
    assert [decimals_of(expr, wanted=None)(Fraction(n, d)) for n, d in product((7,), (5, 10))] == [False, True]


@pytest.mark.parametrize(("number", "value"), [("0.1", "1/10"), ("1e-7", "1/10000000"), ("2/3", "2/3"), ("12", "12")])
def test_a_number_means_what_is_written(number: str, value: str) -> None:
    """0.1 is a tenth, and not the double beside it."""
    written = sympy.Float(number) if "." in number or "e" in number else sympy.Rational(number)
    assert exact(written) == Fraction(value)
