"""How large a part of a text would become: degree, value and shape, by hand."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from deltaq.errors import ExpressionError
from deltaq.language.measure import Real, measure
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse

NAMES = Names((Symbol("x", "parameter"), Symbol("y", "parameter"), Symbol("q", "coordinate")))

MEASURES: list[tuple[str, int, Real | None, tuple[int, ...]]] = [
    ("3", 0, Fraction(3), ()),
    ("pi", 0, math.pi, ()),
    ("2 + 3", 0, Fraction(5), ()),
    ("-2", 0, Fraction(-2), ()),
    ("2*3", 0, Fraction(6), ()),
    ("2/4", 0, Fraction(1, 2), ()),
    ("2^3", 0, Fraction(8), ()),
    ("2^-3", 0, Fraction(1, 8), ()),
    ("(-2)^3", 0, Fraction(-8), ()),
    ("4^(3/2)", 0, 8.0, ()),
    ("0^(1/2)", 0, 0.0, ()),
    ("0^2", 0, Fraction(0), ()),
    ("sin(2)", 0, math.sin(2), ()),
    ("atan2(1, 2)", 0, math.atan2(1, 2), ()),
    ("x", 1, None, ()),
    ("dot(q)", 1, None, ()),
    ("2*x", 1, None, ()),
    ("x + 1", 1, None, ()),
    ("x + y^3 + 1", 3, None, ()),
    ("-x^2", 2, None, ()),
    ("x*y^2", 3, None, ()),
    ("x/y^2", 3, None, ()),
    ("x^2/3", 2, None, ()),
    ("x^-2", 2, None, ()),
    ("x^(1/2)", 1, None, ()),
    ("x^(5/2)", 3, None, ()),
    ("(pi*x)^4", 4, None, ()),
    ("sin(x^2)", 2, None, ()),
    ("atan2(x^2, 3)", 2, None, ()),
    ("exp(2 + x)", 1, None, ()),
    ("d/dt (q^2)", 3, None, ()),
    ("diff(x^2*y, x)", 3, None, ()),
    ("[x, y^2, 3]", 2, None, (3,)),
    ("-[x, y]", 1, None, (2,)),
    ("[x, y] + [1, 2]", 1, None, (2,)),
    ("3*[x, y]*x", 2, None, (2,)),
    ("[x, y]/x", 2, None, (2,)),
    ("[x, y]*[x, y]", 2, None, ()),
    ("[[x, y], [1, 2], [3, x]]", 1, None, (3, 2)),
    ("[[x, y], [1, 2], [3, x]]*[x^2, y]", 3, None, (3,)),
    ("d/dt [q, 1]", 2, None, (2,)),
    ("diff([x, y], x)", 1, None, (2,)),
    ("[x, y] = [1, y^2]", 2, None, (2,)),
    ("[x, y] = 0", 1, None, (2,)),
    ("x = y^2", 2, None, ()),
]


@pytest.mark.parametrize(("text", "degree", "value", "shape"), MEASURES, ids=[text for text, *_ in MEASURES])
def test_measure(text: str, degree: int, value: Real | None, shape: tuple[int, ...]) -> None:
    found = measure(parse(text, NAMES).tree)
    assert (found.degree, found.shape) == (degree, shape)
    assert found.value == value
    assert type(found.value) is type(value)


@pytest.mark.parametrize(("power", "kind"), [(20, Fraction), (21, float), (-20, Fraction), (-21, float)])
def test_values_of_very_many_digits_are_rounded(power: int, kind: type[Real]) -> None:
    """Above and below the line together 4000 binary digits are kept."""
    found = measure(parse(f"1.23456789012345678901234567891^({power})", NAMES).tree).value
    assert type(found) is kind
    assert found == pytest.approx(1.23456789012345678901234567891**power, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "code", "parameters"),
    [
        ("0^0", "zero-to-the-zero", {}),
        ("0^-1", "division-by-zero", {}),
        ("1/(2 - 2)", "division-by-zero", {}),
        ("(-8)^(1/3)", "not-real", {}),
        ("(10^30)^(63/2)", "value-too-large", {"limit": "1e±300"}),
        ("(10^30)^(-63/2)", "value-too-small", {"limit": "1e±300"}),
        ("(10^-30)^(63/2)", "value-too-small", {"limit": "1e±300"}),
        ("(10^-30)^(-63/2)", "value-too-large", {"limit": "1e±300"}),
        ("(10^43)^7", "value-too-large", {"limit": "1e±300"}),
        ("(10^-43)^7", "value-too-small", {"limit": "1e±300"}),
        ("exp(691)", "value-too-large", {"limit": "1e300"}),
        ("exp(700)", "value-too-large", {"limit": "1e300"}),
        ("exp(701)", "value-too-large", {"limit": "exp(±700)"}),
        ("exp(-700)", "value-too-small", {"limit": "1e-300"}),
        ("exp(-800)", "value-too-small", {"limit": "exp(±700)"}),
        ("cosh(1000)", "value-too-large", {"limit": "1e300"}),
        ("log(-1)", "outside-domain", {"function": "log"}),
        ("[[x, y], [1]]", "ragged-matrix", {}),
        ("[[[x, y], [1, 2]], [[x, y], [1, 2]]]", "too-many-dimensions", {}),
        ("[x, y]*[x, y]*[x, y]", "vector-product", {"first": "2", "second": "2"}),
        ("[x, y]*[x, y, 1]", "vector-product", {"first": "2", "second": "3"}),
        ("[x, y]*[[x, y], [1, 2]]", "vector-product", {"first": "2", "second": "2×2"}),
        ("[[x, y], [1, 2]]*[[x, y], [1, 2]]", "vector-product", {"first": "2×2", "second": "2×2"}),
        ("[x, y] = 1", "shapes-differ", {"first": "2", "second": "1"}),
    ],
)
def test_what_is_not_defined_or_too_large(text: str, code: str, parameters: dict[str, str]) -> None:
    with pytest.raises(ExpressionError) as caught:
        parse(text, NAMES)
    (problem,) = caught.value.problems
    assert (problem.code, dict(problem.parameters)) == (code, parameters)
