"""Limits of what is read: the largest that is allowed is, one more is refused by the name of its limit."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from tests.language.scene_names import problem_of, read

from deltaq.errors import Problem
from deltaq.language.names import Names, Symbol

NAMES = Names(tuple(Symbol(name, "parameter") for name in ("x", "y", *(f"a{k}" for k in range(70)))))

CASES = [
    # 2000 characters
    pytest.param("x".ljust, 2000, "too-long", 2000, 1, {"length": 2001, "limit": 2000}, id="characters"),
    # 500 nodes: n names in one sum, n names in one product; a function and its argument
    pytest.param(lambda n: "+".join(["x"] * n), 499, "too-many-nodes", 0, 999, {"limit": 500}, id="summands"),
    pytest.param(lambda n: "*".join(["1"] * n), 499, "too-many-nodes", 998, 1, {"limit": 500}, id="factors"),
    # 60 levels: n functions and what stands in the innermost
    pytest.param(
        lambda n: "sin(" * n + "x" + ")" * n, 59, "too-deep", 0, 301, {"limit": 60}, id="functions in functions"
    ),
    # 120 levels of brackets, which leave no trace in the tree
    pytest.param(lambda n: "(" * n + "x" + ")" * n, 119, "too-deep", 120, 1, {"limit": 60}, id="brackets in brackets"),
    pytest.param(
        lambda n: "|" + "abs(" * (n - 1) + "x" + ")" * (n - 1) + "|", 59, "too-deep", 0, 298, {"limit": 60}, id="bars"
    ),
    pytest.param(lambda n: "x" + "/x" * n, 59, "too-deep", 0, 121, {"limit": 60}, id="quotients of quotients"),
    # exponents up to 64, in amount
    pytest.param(lambda n: f"x^{n}", 64, "exponent-too-large", 2, 2, {"limit": 64}, id="exponent"),
    pytest.param(lambda n: f"x^-{n}", 64, "exponent-too-large", 2, 3, {"limit": 64}, id="negative exponent"),
    pytest.param(lambda n: f"x^(1/{n})", 64, "exponent-too-large", 2, 6, {"limit": 64}, id="root"),
    # degrees up to 64
    pytest.param(
        lambda n: f"sin(x)^{n}",
        64,
        "exponent-too-large",
        7,
        2,
        {"limit": 64},
        id="a function is of the degree of its argument",
    ),
    pytest.param(
        lambda n: f"((x+1)^{n})^8",
        8,
        "degree-too-large",
        0,
        11,
        {"degree": 72, "limit": 64},
        id="degree of a power of a power",
    ),
    pytest.param(
        lambda n: f"(x*y)^{n}", 32, "degree-too-large", 0, 8, {"degree": 66, "limit": 64}, id="degree of a product"
    ),
    pytest.param(
        lambda n: f"(x/y)^{n}", 32, "degree-too-large", 0, 8, {"degree": 66, "limit": 64}, id="degree of a quotient"
    ),
    pytest.param(
        lambda n: f"(x + y^2)^{n}", 32, "degree-too-large", 0, 12, {"degree": 66, "limit": 64}, id="degree of a sum"
    ),
    pytest.param(
        lambda n: f"(-x^2/3)^{n}",
        32,
        "degree-too-large",
        0,
        11,
        {"degree": 66, "limit": 64},
        id="degree with a sign and a number",
    ),
    pytest.param(
        lambda n: f"sin(x^4)^{n}", 16, "degree-too-large", 0, 11, {"degree": 68, "limit": 64}, id="degree in a function"
    ),
    pytest.param(
        lambda n: f"diff(x^2*y, x)^{n}",
        21,
        "degree-too-large",
        0,
        17,
        {"degree": 66, "limit": 64},
        id="degree of a derivative",
    ),
    pytest.param(
        lambda n: f"atan2(x^2, y^4)^{n}",
        16,
        "degree-too-large",
        0,
        18,
        {"degree": 68, "limit": 64},
        id="degree of several arguments",
    ),
    # 30 digits
    pytest.param(lambda n: "1" * n, 30, "too-many-digits", 0, 31, {"limit": 30}, id="digits"),
    pytest.param(lambda n: "1." + "2" * (n - 1), 30, "too-many-digits", 0, 32, {"limit": 30}, id="decimals"),
    # 10^±300 = exp(±690.8), and exponents that are no numbers up to 700
    pytest.param(lambda n: f"exp({n})", 690, "value-too-large", 0, 8, {"limit": "1e300"}, id="value"),
    pytest.param(lambda n: f"exp(-{n})", 690, "value-too-small", 0, 9, {"limit": "1e-300"}, id="small value"),
    pytest.param(
        lambda n: f"exp({n} + x)", 700, "value-too-large", None, None, {"limit": "exp(700)"}, id="exponential"
    ),
    # values up to 10^±300, however they come about
    pytest.param(lambda n: f"(10^10)^{n}", 30, "value-too-large", 0, 10, {"limit": "1e±300"}, id="value of a power"),
    pytest.param(
        lambda n: f"(10^-10)^{n}", 30, "value-too-small", 0, 11, {"limit": "1e±300"}, id="small value of a power"
    ),
    pytest.param(
        lambda n: f"(10^-10)^-{n}", 30, "value-too-large", 0, 12, {"limit": "1e±300"}, id="value of a negative power"
    ),
    pytest.param(
        lambda n: f"(10^10)^-{n}",
        30,
        "value-too-small",
        0,
        11,
        {"limit": "1e±300"},
        id="small value of a negative power",
    ),
    pytest.param(
        lambda n: "*".join(["10^50"] * n), 6, "value-too-large", 0, 41, {"limit": "1e300"}, id="value of a product"
    ),
    pytest.param(
        lambda n: "*".join(["(10^60)^(3/2)"] * n), 3, "value-too-large", 0, 55, {"limit": "1e300"}, id="value of roots"
    ),
    pytest.param(
        lambda n: "1" + "/10^50" * n, 6, "value-too-small", 0, 43, {"limit": "1e-300"}, id="value of a quotient"
    ),
    pytest.param(
        lambda n: "+".join(["(10^10)^30/2"] * n), 2, "value-too-large", 0, 38, {"limit": "1e300"}, id="value of a sum"
    ),
    # 64 different names
    pytest.param(
        lambda n: "+".join(f"a{k}" for k in range(n)),
        64,
        "too-many-names",
        0,
        249,
        {"count": 65, "limit": 64},
        id="names",
    ),
]


@pytest.mark.parametrize(("text", "most", "code", "offset", "length", "parameters"), CASES)
def test_limit(
    text: Callable[[int], str], most: int, code: str, offset: int, length: int, parameters: dict[str, int | str]
) -> None:
    assert read(text(most), "plain", NAMES) is not None
    assert problem_of(text(most + 1), "plain", NAMES) == Problem(code, "", offset, length, parameters)
