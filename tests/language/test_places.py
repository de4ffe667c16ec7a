"""Every part of a tree knows where it stands: the text there, read alone, is that part again."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator

import pytest
from tests.language import test_latex_syntax, test_plain_syntax
from tests.language.scene_names import NAMES, problem_of

from deltaq.errors import ExpressionError, Problem
from deltaq.language.parser import Syntax, parse
from deltaq.language.tree import Node, PartialDerivative, Rate, Span, children

TEXTS: list[tuple[Syntax, str]] = [
    *(("plain", text) for text, _ in test_plain_syntax.ACCEPTED),
    *(("latex", text) for text, _ in test_latex_syntax.ACCEPTED),
]
# What belongs to a part is not one stretch of these texts: an index behind the power, a sign or a brace before it, or
# the number of derivatives after the variable.
SCATTERED = {"\\dot{q}^2_2", "(-dphi)/dt", "{m}{\\ell}", "diff(phi, t, 2)"}


def parts(node: Node, above: frozenset[Span] = frozenset()) -> Iterator[Node]:
    """The parts with a place of their own: a derivative carried out is where the whole is."""
    if node.span not in above:
        yield node
    for part in children(node):
        yield from parts(part, above | {node.span})


def alone(text: str, span: Span) -> str:
    """The text there, a raised number as a number, and what it leaves open closed."""
    found = text[span.offset : span.offset + span.length]
    found = unicodedata.normalize("NFKC", found) if found.isdigit() else found
    missing = (closing * (found.count(opening) - found.count(closing)) for opening, closing in ("()", "{}"))
    return found + "".join(missing)


def is_there(node: Node, text: str, syntax: Syntax) -> bool:
    """Whether the part is read from its place; a derivative written as a fraction stands in the upper half of it."""
    there = alone(text, node.span)
    if isinstance(node, Rate | PartialDerivative) and there.startswith("\\frac"):
        return there in text
    try:
        return parse(there, NAMES, syntax).tree == node
    except ExpressionError:
        return False


@pytest.mark.parametrize("syntax", ["plain", "latex"])
def test_each_part_is_read_where_it_stands(syntax: Syntax) -> None:
    texts = [text for of, text in TEXTS if of == syntax and text not in SCATTERED]
    nodes = [(text, node) for text in texts for node in parts(parse(text, NAMES, syntax).tree)]
    assert len(nodes) > 400
    assert [(text, alone(text, node.span)) for text, node in nodes if not is_there(node, text, syntax)] == []


# The part that is to blame stands between « and ».
BLAMED: list[tuple[Syntax, str, str]] = [
    ("plain", "x/«0»", "division-by-zero"),
    ("plain", "x/«(1 - 1)»", "division-by-zero"),
    ("plain", "x/«sin(0)»", "division-by-zero"),
    ("plain", "x/«|0|»", "division-by-zero"),
    ("plain", "x/«0^2»", "division-by-zero"),
    ("plain", "x/«√0»", "division-by-zero"),
    ("plain", "x/«sin^2(0)»", "division-by-zero"),
    ("plain", "y + x/«(0*2)»", "division-by-zero"),
    ("plain", "y + 1/«[x, y]»", "scalar-expected"),
    ("plain", "y + 1/«[x, y]'»", "scalar-expected"),
    ("plain", "y + sin(«[[x, y], [x, y]]»)", "scalar-expected"),
    ("plain", "m*«(-1)^(1/2)»", "not-real"),
    ("plain", "m*(x^«65» + 1)", "exponent-too-large"),
    ("plain", "m + «[x, y]·[x, y]·[x, y]»", "vector-product"),
    ("latex", "x/«\\frac{0}{2}»", "division-by-zero"),
    ("latex", "x/«\\sqrt[3]{0}»", "division-by-zero"),
    ("latex", "x/«\\left|0\\right|»", "division-by-zero"),
    ("latex", "x/«\\sin 0»", "division-by-zero"),
    ("latex", "\\frac{x}{«0»}", "division-by-zero"),
    ("latex", "y + 1/«\\begin{bmatrix}x\\\\y\\end{bmatrix}»", "scalar-expected"),
    ("latex", "y + 1/«\\begin{bmatrix}x & y\\\\y & x\\end{bmatrix}»", "scalar-expected"),
    ("latex", "y + 1/«\\begin{array}{cc}x & y\\\\y & x\\end{array}»", "scalar-expected"),
    ("latex", "y + 1/«[x \\quad y]^T»", "scalar-expected"),
    ("latex", "m\\,«\\sqrt[4]{-1}» + 1", "not-real"),
]


@pytest.mark.parametrize(("syntax", "marked", "code"), BLAMED, ids=[marked for _, marked, _ in BLAMED])
def test_what_is_to_blame_is_shown(syntax: Syntax, marked: str, code: str) -> None:
    before, blamed, after = (marked.replace("»", "«")).split("«")
    problem = problem_of(before + blamed + after, syntax)
    assert (problem.code, problem.offset, problem.length) == (code, len(before), len(blamed))


LONG = "zq" * 40
SHORTENED: list[tuple[Syntax, str, Problem]] = [
    ("latex", f"\\{LONG}", Problem("unknown-command", "", 0, 81, {"name": f"\\{LONG[:40]}"})),
    ("latex", f"0x{'1' * 80}", Problem("number-format", "", 0, 82, {"number": f"0x{'1' * 38}"})),
    ("plain", f"0x{'1' * 80}", Problem("number-format", "", 0, 82, {"number": f"0x{'1' * 38}"})),
    ("plain", f"1e{'9' * 80}", Problem("number-range", "", 0, 82, {"number": f"1e{'9' * 38}", "limit": 30})),
    ("latex", f"x_{{{'a+' * 40}}}", Problem("unexpected-symbol", "", 3, 80, {"symbol": "a+" * 20})),
    ("latex", f"\\text{{{'a b ' * 40}}}", Problem("unexpected-symbol", "", 6, 160, {"symbol": "a b " * 10})),
    ("latex", f"{{{LONG}}}_1", Problem("indexed-operator", "", 0, 82, {"name": LONG[:40]})),
    ("plain", f"diff(x, {'x + ' * 30}y)", Problem("derivative-variable", "", 8, 121, {"text": "x + " * 20})),
]  # fmt: skip


@pytest.mark.parametrize(("syntax", "text", "problem"), SHORTENED, ids=[text[:16] for _, text, _ in SHORTENED])
def test_a_message_repeats_no_long_text(syntax: Syntax, text: str, problem: Problem) -> None:
    found = problem_of(text, syntax)
    assert found == problem
