"""Dimensional homogeneity: every term of a sum has the same dimension, and the argument of a sine has none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from ..errors import Problem
from ..language.expression import Expression
from ..language.tree import (
    Call,
    Differential,
    Name,
    Negation,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Rate,
    Sum,
    TimeDerivative,
    Variation,
)
from .units import ONE, Dimension

SECOND = Dimension(time=Fraction(1))
SAME_AS_ARGUMENTS = ("abs", "max", "min")
# A bare number takes the dimension of its surroundings where it stands alone; so does cosh(x) of an x without a unit.
NUMBER = "number"

Found = Dimension | str | None  # NUMBER, or None where a unit is missing


@dataclass(frozen=True)
class DimensionCheck:
    """Collects the problems of one expression in `problems`, at their place in its text."""

    units: Mapping[str, Dimension | None]
    text: str
    problems: list[Problem]

    def of(self, node: Node) -> Found:
        """The dimension of a node, as far as the units tell."""
        match node:
            case Number() | Name(name="pi"):
                return NUMBER
            case Name() | Differential() | Rate() | Variation():
                return self._quantity(node)
            case TimeDerivative(operand=operand):
                return self._product([self.of(operand), SECOND.to(Fraction(-1))])
            case Negation(operand=operand):
                return self.of(operand)
            case Sum(terms=terms):
                return self._same(terms)
            case Product(factors=factors):
                return self._product([self.of(factor) for factor in factors])
            case Quotient(numerator=numerator, denominator=denominator):
                return self._product([self.of(numerator), self._raised(self.of(denominator), Fraction(-1))])
            case Power(base=base, exponent=exponent):
                return self._power(base, exponent)
            case Call(function=function, arguments=arguments):
                return self._call(function, arguments)
            case _:
                return None

    def _quantity(self, node: Name | Differential | Rate | Variation) -> Dimension | None:
        unit = self.units.get(node.name)
        order = node.order if isinstance(node, Rate | Variation) else 0
        return None if unit is None else unit.times(SECOND.to(Fraction(-order)))

    def expect(self, node: Node, wanted: Dimension) -> None:
        """Complains about the node, or about its terms, if the dimension is another than its field wants."""
        if isinstance(node, Sum):
            for term in node.terms:
                self.expect(term, wanted)
            return
        found = self.of(node)
        if isinstance(found, Dimension) and not found.fits(wanted):
            self._complain(node, found, wanted)

    def _same(self, terms: tuple[Node, ...]) -> Found:
        """The common dimension of summands; each that differs from the first known one is named."""
        found = [(term, self.of(term)) for term in terms]
        known = [(term, dimension) for term, dimension in found if isinstance(dimension, Dimension)]
        if not known:
            return NUMBER if all(dimension == NUMBER for _, dimension in found) else None
        first = known[0][1]
        for term, dimension in known[1:]:
            if not dimension.fits(first):
                self._complain(term, dimension, first)
        return first

    def _product(self, factors: list[Found]) -> Found:
        if None in factors:
            return None
        known = [factor for factor in factors if isinstance(factor, Dimension)]
        product = ONE
        for factor in known:
            product = product.times(factor)
        return product if known else NUMBER

    def _raised(self, found: Found, exponent: Fraction) -> Found:
        return found.to(exponent) if isinstance(found, Dimension) else found

    def _power(self, base: Node, exponent: Node) -> Found:
        value = _constant(exponent)
        return None if value is None else self._raised(self.of(base), value)

    def _call(self, function: str, arguments: tuple[Node, ...]) -> Found:
        if function == "sqrt":
            return self._raised(self.of(arguments[0]), Fraction(1, 2))
        if function in SAME_AS_ARGUMENTS:
            return self._same(arguments)
        if function == "atan2":
            self._same(arguments)
        elif function not in ("sign", "step"):
            self.expect(arguments[0], ONE)
        silent = DimensionCheck(self.units, self.text, [])
        return ONE if isinstance(silent.of(arguments[0]), Dimension) else NUMBER

    def _complain(self, node: Node, found: Dimension, wanted: Dimension) -> None:
        offset, length = node.span.offset, node.span.length
        term = self.text[offset : offset + length]
        parameters = {"term": term, "found": str(found), "expected": str(wanted)}
        self.problems.append(Problem("inconsistent-units", "", offset, length, parameters))


def _constant(node: Node) -> Fraction | None:
    """The value of an exponent that is a plain number."""
    match node:
        case Number(value=value):
            return value
        case Negation(operand=operand):
            inner = _constant(operand)
            return None if inner is None else -inner
        case Quotient(numerator=Number(value=a), denominator=Number(value=b)) if b:
            return a / b
        case _:
            return None


def dimension_problems(
    expression: Expression, wanted: Dimension | None, units: Mapping[str, Dimension | None]
) -> tuple[Problem, ...]:
    """What is wrong with the dimensions of one expression; `wanted` is what its field should have."""
    check = DimensionCheck(units, expression.text, [])
    if wanted is None:
        check.of(expression.tree)
    else:
        check.expect(expression.tree, wanted)
    return tuple(check.problems)
