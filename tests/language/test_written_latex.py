"""LaTeX of formulas in the order in which they were written, with marks."""

from __future__ import annotations

import pytest

from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.tree import Node, walk
from deltaq.language.typography import Typography
from deltaq.language.written_latex import written_latex

NAMES = Names(
    (
        *(Symbol(name, "parameter") for name in ("m", "l", "k", "F0")),
        Symbol("phi", "coordinate"),
        Symbol("x", "coordinate"),
    )
)
TYPOGRAPHY = Typography(NAMES)

ROWS = [
    ("3", "3"),
    ("0.5*m", r"0.5 \, m"),
    ("m*2*l", r"m \cdot 2 \, l"),
    ("1/3", r"\frac{1}{3}"),
    ("pi*m", r"\pi \, m"),
    ("pi^2", r"\pi^{2}"),
    ("x*l*m", r"x \, l \, m"),
    ("F0*x", r"F_{0} \, x"),
    ("m + x - l", "m + x -l"),
    ("-m + x", "-m + x"),
    ("m + (x + l)", "m + (x + l)"),
    ("m - (x + l)", "m -(x + l)"),
    ("m - (-l)", "m -(-l)"),
    ("m + (-l)*x", r"m + (-l \, x)"),
    ("-(x + l)", "-(x + l)"),
    ("m*(x + l)", r"m \, (x + l)"),
    ("(-m)*x", r"-m \, x"),
    ("m*(-x)", r"m \, (-x)"),
    ("x/(l + m)", r"\frac{x}{l + m}"),
    ("m*(x/l)", r"m \, \frac{x}{l}"),
    ("(x/l)^2", r"\left(\frac{x}{l}\right)^{2}"),
    ("(x*l)^2", r"(x \, l)^{2}"),
    ("(x^2)^3", r"(x^{2})^{3}"),
    ("x^2", "x^{2}"),
    ("x^(1/2)", r"x^{\frac{1}{2}}"),
    ("2^3", "2^{3}"),
    ("(-2)^3", "(-2)^{3}"),
    ("dot(x)^2", r"\dot{x}^{2}"),
    ("sin(phi)^2", r"\sin^{2}(\varphi)"),
    ("sin(x/l)", r"\sin\left(\frac{x}{l}\right)"),
    ("sin(sqrt(x))", r"\sin\left(\sqrt{x}\right)"),
    ("cos(abs(x))", r"\cos\left(\left|x\right|\right)"),
    ("sqrt(x + l)", r"\sqrt{x + l}"),
    ("sqrt(x)^2", r"\left(\sqrt{x}\right)^{2}"),
    ("abs(x)^2", r"\left(\left|x\right|\right)^{2}"),
    ("atan2(x, l)", r"\operatorname{atan2}(x, l)"),
    ("exp(-x)", r"\exp(-x)"),
    ("ddot(phi)", r"\ddot{\varphi}"),
    ("delta(x)", r"\delta x"),
    ("dot(delta(x))", r"\delta \dot{x}"),
    ("d(x)", r"\mathrm{d}x"),
    ("d/dt (m*x)", r"\frac{\mathrm{d}}{\mathrm{d}t}(m \, x)"),
    ("diff(m*x, x)", r"\frac{\partial}{\partial x}(m \, x)"),
    ("[x, -l]", r"\begin{bmatrix} x \\ -l \end{bmatrix}"),
    ("[[x, l], [m, k]]", r"\begin{bmatrix} x & l \\ m & k \end{bmatrix}"),
    ("m = x + l", "m = x + l"),
    ("m = x; l = k", r"\begin{bmatrix} m = x \\ l = k \end{bmatrix}"),
]


@pytest.mark.parametrize(("text", "written"), ROWS, ids=[text for text, _ in ROWS])
def test_written_as(text: str, written: str) -> None:
    assert written_latex(parse(text, NAMES, "plain").tree, TYPOGRAPHY) == written


@pytest.mark.parametrize(
    ("text", "marked", "written"),
    [
        ("m*x + l", "l", r"m \, x + <l>"),
        ("m*x + l", "m*x", r"<m \, x> + l"),
        ("m - l", "- l", "m <-l>"),
        ("m*(x + l)", "(x + l)", r"m \, <(x + l)>"),
        ("x^2*m", "x", r"<x^{2}> \, m"),
        ("sin(phi)^2", "sin(phi)", r"<\sin^{2}(\varphi)>"),
        ("sin(phi)^2", "phi", r"\sin^{2}(<\varphi>)"),
        ("m = x + l", "m", "<m> = x + l"),
        ("[x, l]", "l", r"\begin{bmatrix} x \\ <l> \end{bmatrix}"),
    ],
)
def test_marked(text: str, marked: str, written: str) -> None:
    tree = parse(text, NAMES, "plain").tree
    (span,) = {part.span for part in walk(tree) if text[slice(*_ends(part))].strip() == marked}
    found = written_latex(tree, TYPOGRAPHY, [span], "c")
    assert found.replace(r"\htmlClass{c}{", "<", 1) == written.replace(">", "}", 1)


def _ends(node: Node) -> tuple[int, int]:
    return node.span.offset, node.span.offset + node.span.length
