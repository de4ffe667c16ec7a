"""Limits of what is read: the largest that is allowed is, one more is refused by the name of its limit."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.language.scene_names import read
from tests.language.test_messages import catalog

from deltaq.errors import ExpressionError
from deltaq.language.names import Names, Symbol

NAMES = Names(tuple(Symbol(name, "parameter") for name in ("x", "y", *(f"a{k}" for k in range(70)))))

CASES = [
    # 2000 characters
    pytest.param("x".ljust, 2000, "too-long", id="characters"),
    # 500 nodes: n names in one sum, n names in one product; a function and its argument
    pytest.param(lambda n: "+".join(["x"] * n), 499, "too-many-nodes", id="summands"),
    pytest.param(lambda n: "*".join(["1"] * n), 499, "too-many-nodes", id="factors"),
    # 60 levels: n functions and what stands in the innermost
    pytest.param(lambda n: "sin(" * n + "x" + ")" * n, 59, "too-deep", id="functions in functions"),
    # 120 levels of brackets, which leave no trace in the tree
    pytest.param(lambda n: "(" * n + "x" + ")" * n, 119, "too-deep", id="brackets in brackets"),
    pytest.param(lambda n: "|" + "abs(" * (n - 1) + "x" + ")" * (n - 1) + "|", 59, "too-deep", id="bars"),
    pytest.param(lambda n: "x" + "/x" * n, 59, "too-deep", id="quotients of quotients"),
    # exponents up to 64, in amount
    pytest.param(lambda n: f"x^{n}", 64, "exponent-too-large", id="exponent"),
    pytest.param(lambda n: f"x^-{n}", 64, "exponent-too-large", id="negative exponent"),
    pytest.param(lambda n: f"x^(1/{n})", 64, "exponent-too-large", id="root"),
    # degrees up to 64
    pytest.param(lambda n: f"sin(x)^{n}", 64, "exponent-too-large", id="a function is of the degree of its argument"),
    pytest.param(lambda n: f"((x+1)^{n})^8", 8, "degree-too-large", id="degree of a power of a power"),
    pytest.param(lambda n: f"(x*y)^{n}", 32, "degree-too-large", id="degree of a product"),
    pytest.param(lambda n: f"(x/y)^{n}", 32, "degree-too-large", id="degree of a quotient"),
    pytest.param(lambda n: f"(x + y^2)^{n}", 32, "degree-too-large", id="degree of a sum"),
    pytest.param(lambda n: f"(-x^2/3)^{n}", 32, "degree-too-large", id="degree with a sign and a number"),
    pytest.param(lambda n: f"sin(x^4)^{n}", 16, "degree-too-large", id="degree in a function"),
    pytest.param(lambda n: f"diff(x^2*y, x)^{n}", 21, "degree-too-large", id="degree of a derivative"),
    pytest.param(lambda n: f"atan2(x^2, y^4)^{n}", 16, "degree-too-large", id="degree of several arguments"),
    # 30 digits
    pytest.param(lambda n: "1" * n, 30, "too-many-digits", id="digits"),
    pytest.param(lambda n: "1." + "2" * (n - 1), 30, "too-many-digits", id="decimals"),
    # 10^±300 = exp(±690.8), and exponents that are no numbers up to 700
    pytest.param(lambda n: f"exp({n})", 690, "value-too-large", id="value"),
    pytest.param(lambda n: f"exp(-{n})", 690, "value-too-small", id="small value"),
    pytest.param(lambda n: f"exp({n} + x)", 700, "value-too-large", id="exponential"),
    # values up to 10^±300, however they come about
    pytest.param(lambda n: f"(10^10)^{n}", 30, "value-too-large", id="value of a power"),
    pytest.param(lambda n: f"(10^-10)^{n}", 30, "value-too-small", id="small value of a power"),
    pytest.param(lambda n: f"(10^-10)^-{n}", 30, "value-too-large", id="value of a negative power"),
    pytest.param(lambda n: f"(10^10)^-{n}", 30, "value-too-small", id="small value of a negative power"),
    pytest.param(lambda n: "*".join(["10^50"] * n), 6, "value-too-large", id="value of a product"),
    pytest.param(lambda n: "*".join(["(10^60)^(3/2)"] * n), 3, "value-too-large", id="value of roots"),
    pytest.param(lambda n: "1" + "/10^50" * n, 6, "value-too-small", id="value of a quotient"),
    pytest.param(lambda n: "+".join(["(10^10)^30/2"] * n), 2, "value-too-large", id="value of a sum"),
    # 64 different names
    pytest.param(lambda n: "+".join(f"a{k}" for k in range(n)), 64, "too-many-names", id="names"),
]


@pytest.mark.parametrize(("text", "most", "code"), CASES)
def test_limit(text: Callable[[int], str], most: int, code: str, root: Path) -> None:
    assert read(text(most), "plain", NAMES) is not None
    with pytest.raises(ExpressionError) as caught:
        read(text(most + 1), "plain", NAMES)
    (problem,) = caught.value.problems
    assert problem.code == code
    assert set(re.findall(r"{(\w+)}", catalog(root, "en")[code])) <= problem.parameters.keys()
