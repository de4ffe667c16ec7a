"""A tree → LaTeX in the order in which it was written, with some of its parts marked.

The other printers arrange what they print. Here a student is to know their own formula again, so nothing is moved,
combined or simplified.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from .functions import FUNCTIONS
from .numerals import ATOM, POWER, PRODUCT, SUM, decimal, ends
from .spelling import spell_rate
from .tree import (
    Call,
    Differential,
    Equation,
    Name,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Power,
    Product,
    Quotient,
    Rate,
    Span,
    Sum,
    TimeDerivative,
    Variation,
    Vector,
)
from .typography import Typography

Printed = tuple[str, int]  # LaTeX, and how strongly it binds
EQUATION = -1


def written_latex(tree: Node, typography: Typography, marks: Iterable[Span] = (), css: str = "") -> str:
    """LaTeX of a tree; what stands at one of the `marks` of its text is put in \\htmlClass{css}."""
    return _Writer(typography, set(marks), css).text(tree, EQUATION)


class _Writer:
    def __init__(self, typography: Typography, marks: set[Span], css: str) -> None:
        self._typography = typography
        self._marks = marks
        self._css = css

    def text(self, node: Node, binding: int = SUM) -> str:
        """The LaTeX of a node, in brackets where it binds less than asked; marked if it is to be."""
        marked = node.span in self._marks
        self._marks.discard(node.span)  # the parts of a node may stand at the same place
        printed, own = self._printed(node)
        whole = _bracketed(printed) if own < binding else printed
        return rf"\htmlClass{{{self._css}}}{{{whole}}}" if marked else whole

    def _printed(self, node: Node) -> Printed:  # noqa: C901, PLR0911 - one case for each kind
        match node:
            case Number(value):
                return _number(value)
            case Name("pi"):
                return r"\pi", ATOM
            case Name() | Rate() | Variation() | Differential():
                return self._typography.symbol(_spelt(node)), ATOM
            case Sum(terms):
                return self._sum(terms), SUM
            case Product((Negation(), *_)):
                return self._product(node.factors), SUM
            case Product(factors):
                return self._product(factors), PRODUCT
            case Quotient(numerator, denominator):
                return rf"\frac{{{self.text(numerator)}}}{{{self.text(denominator)}}}", PRODUCT
            case Negation(operand):
                return f"-{self.text(operand, PRODUCT)}", SUM
            case Power():
                return self._power(node), POWER
            case Call(function, arguments):
                return self._call(function, arguments), PRODUCT
            case _:
                return self._other(node)

    def _other(self, node: Node) -> Printed:
        match node:
            case TimeDerivative(operand):
                return rf"\frac{{\mathrm{{d}}}}{{\mathrm{{d}}t}}{_bracketed(self.text(operand))}", PRODUCT
            case PartialDerivative(operand, variable):
                below = self.text(variable)
                return rf"\frac{{\partial}}{{\partial {below}}}{_bracketed(self.text(operand))}", PRODUCT
            case Vector(components):
                rows = r" \\ ".join(self._row(component) for component in components)
                return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}", ATOM
            case Equation(left, right):
                return f"{self.text(left)} = {self.text(right)}", EQUATION
            case _:
                return "", ATOM

    def _row(self, component: Node) -> str:
        """A component; a row of a matrix, or an equation of a system, is one, too."""
        if isinstance(component, Vector):
            return " & ".join(self.text(part, EQUATION) for part in component.components)
        return self.text(component, EQUATION)

    def _sum(self, terms: Iterable[Node]) -> str:
        text = ""
        for term in terms:
            printed = self.text(term, SUM if isinstance(term, Negation) else PRODUCT)
            bare = printed.removeprefix(rf"\htmlClass{{{self._css}}}{{") if self._css else printed
            text += printed if not text else f" {printed}" if bare.startswith("-") else f" + {printed}"
        return text

    def _product(self, factors: Sequence[Node]) -> str:
        text = ""
        for factor in factors:
            # A sign before the first factor is the sign of the term.
            printed = self.text(factor, PRODUCT if text or not isinstance(factor, Negation) else SUM)
            between = r" \cdot " if printed[0].isdigit() and text else r" \, " if text else ""
            text += f"{between}{printed}"
        return text

    def _power(self, node: Power) -> str:
        exponent = self.text(node.exponent)
        match node.base:
            case Call(function, arguments) if FUNCTIONS[function].power_after_name:
                return self._call(function, arguments, f"^{{{exponent}}}", node.base.span)
            case Name(name) if name != "pi":
                return self._marked(node.base.span, self._typography.power(name, exponent))
            case _:
                return f"{self.text(node.base, ATOM)}^{{{exponent}}}"

    def _call(self, function: str, arguments: Iterable[Node], raised: str = "", at: Span | None = None) -> str:
        inner = ", ".join(self.text(argument) for argument in arguments)
        if function == "sqrt":
            return rf"\sqrt{{{inner}}}"
        if function == "abs":
            return rf"\left|{inner}\right|{raised}"
        return self._marked(at, f"{FUNCTIONS[function].latex}{raised}{_bracketed(inner)}")

    def _marked(self, place: Span | None, printed: str) -> str:
        """What was printed together with what stands around it."""
        if place is None or place not in self._marks:
            return printed
        self._marks.discard(place)
        return rf"\htmlClass{{{self._css}}}{{{printed}}}"


def _spelt(node: Name | Rate | Variation | Differential) -> str:
    match node:
        case Rate(name, order):
            return spell_rate(name, order)
        case Variation(name, order):
            return spell_rate(f"delta({name})", order)
        case Differential(name):
            return f"d({name})"
        case Name(name):
            return name


def _number(value: Fraction) -> Printed:
    if value.denominator == 1:
        return str(value), ATOM if value >= 0 else SUM
    if ends(value):
        return decimal(value), ATOM
    return rf"\frac{{{value.numerator}}}{{{value.denominator}}}", PRODUCT


def _bracketed(text: str) -> str:
    tall = any(command in text for command in (r"\frac", r"\left", r"\sqrt"))
    return rf"\left({text}\right)" if tall else f"({text})"
