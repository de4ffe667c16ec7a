"""Which LaTeX commands mean what."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from itertools import accumulate
from types import MappingProxyType

from .tokens import Kind

NUMBER = re.compile(r"(?:\d+(?:(?:\.|\{,\})\d*)?|\.\d+)(?:[eE][+-]?\d+)?(?P<again>\.\d*)?", re.ASCII)
PREFIX = re.compile(r"0[xXbBoO][0-9A-Fa-f]+")
LETTER = re.compile(r"[A-Za-z]")
TRANSPOSE = re.compile(r"\s*(?:T|\\top|\\intercal|\\(?:mathrm|mathsf|text)\s*(?:\{\s*T\s*\}|T))\s*\Z")
PRIMED = re.compile(r"\s*(?:(?:\\prime(?![A-Za-z])|')\s*)+(?:\^(?=.))?\s*")  # x^{\prime2} is the square of x′
LETTERS = re.compile(r"[A-Za-z]+")
SINGLE = re.compile(r"\s*(?:\\([A-Za-z]+)|([A-Za-z])|([^\x00-\x7f]))\s*\Z")
MARKS = re.compile(r"[\u0307\u0308]+")
BAR = re.compile(r"\||\\[lr]?vert(?![A-Za-z])")
# A bar with what enlarges it, as \left| and \bigl\vert; either may tell the side.
_SIZED_BAR = re.compile(
    r"(?:\\(?P<size>m?left|m?right|[bB]igg?[lr]?)(?:\s|\\[,;:! ])*)?(?:\||\\(?P<own>[lr]?)vert(?![A-Za-z]))"
)
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


def sides_of_bars(text: str) -> Mapping[int, Kind]:
    """By their places, the bars that open and those that close, as far as that is told.

    \\left and \\right are always meant; \\lvert, \\bigl and the like only where no bar is without a side, and all go by
    pairs: else they are bars like others.
    """
    always: dict[int, Kind] = {}
    told: dict[int, str] = {}
    for bar in _SIZED_BAR.finditer(text):
        size = bar["size"] or ""
        if size.endswith(("left", "right")):
            always[bar.start()] = "open" if size.endswith("left") else "close"
        else:
            told[bar.start()] = size[-1] if size.endswith(("l", "r")) else bar["own"] or ""
    depths = list(accumulate({"l": 1, "r": -1}.get(side, math.inf) for side in told.values()))
    if depths and min(depths) >= 0 and depths[-1] == 0:
        always |= {start: "open" if side == "l" else "close" for start, side in told.items()}
    return always
