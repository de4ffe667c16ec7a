"""Which LaTeX commands mean what."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

NUMBER = re.compile(r"(?:\d+(?:(?:\.|\{,\})\d*)?|\.\d+)(?:[eE][+-]?\d+)?(?P<again>\.\d*)?", re.ASCII)
PREFIX = re.compile(r"0[xXbBoO][0-9A-Fa-f]+")
LETTER = re.compile(r"[A-Za-z]")
TRANSPOSE = re.compile(r"\s*(?:T|\\top|\\intercal|\\(?:mathrm|mathsf|text)\s*(?:\{\s*T\s*\}|T))\s*\Z")
PRIMED = re.compile(r"\s*(?:(?:\\prime(?![A-Za-z])|')\s*)+(?:\^(?=.))?\s*")  # x^{\prime2} is the square of x′
LETTERS = re.compile(r"[A-Za-z]+")
SINGLE = re.compile(r"\s*(?:\\([A-Za-z]+)|([A-Za-z])|([^\x00-\x7f]))\s*\Z")
MARKS = re.compile(r"[\u0307\u0308]+")
INDEX = re.compile(r"(?:[A-Za-z0-9,\s]|\\(?:mathrm|text|mathit)\b|\\[A-Za-z]+|[{}])*\Z")

OPERATORS: Mapping[str, str] = MappingProxyType(
    {
        "cdot": "*",
        "ast": "*",
        "times": "×",
        "div": "/",
        "lbrack": "[",
        "rbrack": "]",
        "lparen": "(",
        "rparen": ")",
        "prime": "'",
        "{": "(",
        "}": ")",
        "lbrace": "(",
        "rbrace": ")",
        "\\": ";",
        "lvert": "|",
        "rvert": "|",
        "vert": "|",
        "mid": "|",
        "minus": "-",
        "partial": "∂",
        "delta": "δ",
        "variation": "δ",
    }
)
SIZES = frozenset(
    [
        "left",
        "right",
        "mleft",
        "mright",
        "big",
        "Big",
        "bigg",
        "Bigg",
        "bigl",
        "bigr",
        "Bigl",
        "Bigr",
        "biggl",
        "biggr",
        "Biggl",
        "Biggr",
    ]
)
UPRIGHT = frozenset(
    [
        "mathrm",
        "text",
        "textrm",
        "operatorname",
        "operatorname*",
        "mathit",
        "mathsf",
        "mathbf",
        "mathnormal",
        "boldsymbol",
        "vec",
    ]
)
# Commands of the packages that typeset quantities with units.
QUANTITIES = frozenset({"SI", "si", "qty", "unit", "pu"})
DIFFERENTIAL = frozenset({"differentialD", "dd"})
MATRICES = frozenset({"matrix", "pmatrix", "bmatrix", "Bmatrix", "smallmatrix", "array"})
SYSTEMS = frozenset(
    {"aligned", "align", "align*", "gathered", "gather", "gather*", "cases", "equation", "equation*", "split"}
)
