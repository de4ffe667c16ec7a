"""Whether an expression can never become negative along a motion, as far as the way it is written tells."""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from dataclasses import dataclass

from ..language.tree import Call, Name, Node, Number, Power, Product, Quotient, Rate, Sum, walk

ALWAYS = frozenset({"abs", "sqrt", "exp", "cosh", "step", "heaviside"})  # where they have a value


@dataclass(frozen=True)
class LastingSigns:
    """Of expressions whose names in `moving`, rates and the time change, and those in `positive` do not."""

    moving: AbstractSet[str]
    positive: AbstractSet[str]

    def keeps(self, node: Node) -> bool:
        """Whether it stays as it begins, not negative or not positive: constants times what is never negative."""
        match node:
            case Product(factors=factors):
                return all(map(self.keeps, factors))
            case Quotient(numerator=above, denominator=below):
                return self.keeps(above) and self.keeps(below)
        return self._is_constant(node) or self.is_never_negative(node)

    def is_never_negative(self, node: Node) -> bool:
        """Whether it is so for all values of what moves, and of parameters as they may be."""
        match node:
            case Number(value=value):
                found = value >= 0
            case Name(name=name):
                found = name in self.positive
            case Call(function=function, arguments=arguments):
                found = self._is_call(function, arguments)
            case Power(base=base, exponent=exponent):
                found = _is_even(exponent) or self.is_never_negative(base)
            case Sum(terms=parts) | Product(factors=parts):
                found = all(map(self.is_never_negative, parts))
            case Quotient(numerator=above, denominator=below):
                found = self.is_never_negative(above) and self.is_never_negative(below)
            case _:
                found = False
        return found

    def _is_call(self, function: str, arguments: tuple[Node, ...]) -> bool:
        if function in ("max", "min"):
            return (any if function == "max" else all)(map(self.is_never_negative, arguments))
        return function in ALWAYS

    def _is_constant(self, node: Node) -> bool:
        return not any(isinstance(n, Rate) or (isinstance(n, Name) and n.name in self.moving) for n in walk(node))


def _is_even(exponent: Node) -> bool:
    return isinstance(exponent, Number) and exponent.value.denominator == 1 and exponent.value % 2 == 0
