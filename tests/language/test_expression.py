"""What an expression says of itself."""

from __future__ import annotations

import pytest
from tests.language.scene_names import NAMES

from deltaq.errors import ExpressionError, Problem
from deltaq.language.expression import Expression
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse


def parsed(text: str) -> Expression:
    return parse(text, NAMES)


@pytest.mark.parametrize(
    ("text", "names", "rates", "functions", "scalar", "derivatives"),
    [
        pytest.param("m*l*sin(phi)", {"m", "l", "phi"}, set(), {"sin"}, True, False, id="product"),
        pytest.param("dot(phi)^2 + x", {"phi", "x"}, {"phi"}, set(), True, False, id="rate"),
        pytest.param("delta(phi)", {"phi"}, set(), set(), False, False, id="variation"),
        pytest.param("d(phi)", {"phi"}, set(), set(), False, False, id="differential"),
        pytest.param("[x, y]", {"x", "y"}, set(), set(), False, False, id="vector"),
        pytest.param("x = y", {"x", "y"}, set(), set(), False, False, id="equation"),
        pytest.param("dot(x^2)", {"x"}, set(), set(), True, True, id="derivative by the time"),
        pytest.param("diff(abs(x), x)", {"x"}, set(), {"abs"}, True, True, id="partial derivative"),
    ],
)
def test_what_it_depends_on(
    text: str, names: set[str], rates: set[str], functions: set[str], *, scalar: bool, derivatives: bool
) -> None:
    found = parsed(text)
    assert (found.names, found.rates, found.functions) == (names, rates, functions)
    assert (found.is_scalar, found.has_derivatives) == (scalar, derivatives)


def test_equal_trees_are_equal_expressions() -> None:
    assert parsed("m l") == parsed("m*l")
    assert hash(parsed("m l")) == hash(parsed("m*l"))
    assert parsed("m*l") != parsed("l*m")
    assert parsed("m") != "m"


def test_too_many_names() -> None:
    symbols = tuple(Symbol(f"p{n}", "parameter") for n in range(65))
    text = "+".join(symbol.name for symbol in symbols)
    with pytest.raises(ExpressionError) as caught:
        parse(text, Names(symbols))
    assert caught.value.problems == (Problem("too-many-names", "", 0, len(text), {"count": 65, "limit": 64}),)
    assert len(parse(text.removesuffix("+p64"), Names(symbols)).names) == 64
