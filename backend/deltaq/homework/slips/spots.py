"""The places of an answer: every node of its tree, with its values and those it should have for the answer to be right.

A place that is reached through sums, products, quotients and powers has exactly one such value at every point: what is
wanted of the whole is carried down to it. So no change has to be tried to be seen as fitting or not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from types import MappingProxyType
from typing import Any

from ...language.floats import evaluate
from ...language.sympy_algebra import to_sympy
from ...language.tree import (
    Call,
    Equation,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Power,
    Product,
    Quotient,
    Sum,
    TimeDerivative,
    Vector,
    children,
    walk,
)
from ..sampling import Sampler, Values

Path = tuple[int, ...]
Evaluate = Callable[[Node], Values]
MOST_SPOTS = 160


@dataclass(frozen=True)
class Spot:
    """A node at its path, its values, those wanted of it, and whether it is a term: of a sum, or the whole of an answer
    or of what stands under a root.
    """

    node: Node
    path: Path
    values: Values
    wanted: Values
    is_term: bool
    is_addend: bool = False
    is_whole: bool = False

    @property
    def ratio(self) -> Values:
        """How many times larger it should be; NaN where it is zero."""
        return tuple(w / v if v else math.nan for w, v in zip(self.wanted, self.values, strict=True))

    @property
    def difference(self) -> Values:
        """How much larger it should be."""
        return tuple(w - v for w, v in zip(self.wanted, self.values, strict=True))


def spots(tree: Node, wanted: Values, values: Evaluate) -> Iterator[Spot]:
    """Every place below the tree whose wanted values can be told, the whole first."""
    left = [Spot(tree, (), values(tree), wanted, is_term=True)]
    for _ in range(MOST_SPOTS):
        if not left:
            return
        spot = left.pop(0)
        yield spot
        left += _below(spot, values)


def _below(spot: Spot, values: Evaluate) -> Iterator[Spot]:
    match spot.node:
        case Sum(terms):
            yield from _terms(spot, terms, values)
        case Product(factors):
            yield from _factors(spot, factors, values)
        case Quotient(numerator, denominator):
            upper, lower = values(numerator), values(denominator)
            yield _spot(spot, 0, numerator, upper, _each(_times, spot.wanted, lower))
            yield _spot(spot, 1, denominator, lower, _each(_over, upper, spot.wanted))
        case Negation(operand):
            yield _spot(spot, 0, operand, values(operand), tuple(-w for w in spot.wanted))
        case Power(base, Number() as exponent):
            own = values(base)
            yield _spot(spot, 0, base, own, _roots(spot.wanted, own, float(exponent.value)))
        case Call("sqrt", (operand,)):
            whole = _spot(spot, 0, operand, values(operand), tuple(w * w for w in spot.wanted))
            yield replace(whole, is_term=True, is_whole=True)
        case _:
            return


def _terms(spot: Spot, terms: Sequence[Node], values: Evaluate) -> Iterator[Spot]:
    each = [values(term) for term in terms]
    for index, (term, own) in enumerate(zip(terms, each, strict=True)):
        wanted = tuple(w - v + o for w, v, o in zip(spot.wanted, spot.values, own, strict=True))
        yield replace(_spot(spot, index, term, own, wanted), is_term=True, is_addend=True)


def _factors(spot: Spot, factors: Sequence[Node], values: Evaluate) -> Iterator[Spot]:
    each = [values(factor) for factor in factors]
    for index, (factor, own) in enumerate(zip(factors, each, strict=True)):
        others = each[:index] + each[index + 1 :]
        rest = tuple(math.prod(other[k] for other in others) for k in range(len(own)))
        yield _spot(spot, index, factor, own, _each(_over, spot.wanted, rest))


def _spot(above: Spot, index: int, node: Node, values: Values, wanted: Values) -> Spot:
    return Spot(node, (*above.path, index), values, wanted, is_term=False)


def _each(operation: Callable[[float, float], float], left: Values, right: Values) -> Values:
    return tuple(map(operation, left, right))


def _times(a: float, b: float) -> float:
    return a * b


def _over(a: float, b: float) -> float:
    return a / b if b else math.nan


def _roots(wanted: Values, own: Values, exponent: float) -> Values:
    """The bases of the powers wanted, with the signs that the bases have now."""
    return tuple(
        math.copysign(abs(w) ** (1 / exponent), o) if exponent and w and (w > 0 or exponent % 2 == 1) else math.nan
        for w, o in zip(wanted, own, strict=True)
    )


# --- trees -----------------------------------------------------------------------------------------------------------


FIELDS: Mapping[type, tuple[str, ...]] = MappingProxyType(
    {
        Quotient: ("numerator", "denominator"),
        Power: ("base", "exponent"),
        Equation: ("left", "right"),
        PartialDerivative: ("operand", "variable"),
        Negation: ("operand",),
        TimeDerivative: ("operand",),
    }
)
LISTS: Mapping[type, str] = MappingProxyType(
    {Sum: "terms", Product: "factors", Vector: "components", Call: "arguments"}
)


def with_children(node: Node, parts: Sequence[Node]) -> Node:
    """The node with other parts, at the same place of the text."""
    field = LISTS.get(type(node))
    fields = FIELDS.get(type(node), ())
    changes: dict[str, Any] = {field: tuple(parts)} if field else dict(zip(fields, parts, strict=True))
    return replace(node, **changes)


def put(tree: Node, path: Path, node: Node) -> Node:
    """The tree with another node at a path."""
    if not path:
        return node
    parts = list(children(tree))
    parts[path[0]] = put(parts[path[0]], path[1:], node)
    return with_children(tree, parts)


def at(tree: Node, path: Path) -> Node:
    """The node at a path."""
    for index in path:
        tree = children(tree)[index]
    return tree


class Valued:
    """The values of nodes at the sampling points; NaN where they are not defined."""

    def __init__(self, sampler: Sampler) -> None:
        self._sampler = sampler
        names = [symbol.name for symbol in sampler.slots]
        self._points = [dict(zip(names, point, strict=True)) for point in sampler.points]
        self._known: dict[int, tuple[Node, Values]] = {}  # the node is kept so that its id is not given away

    def __call__(self, node: Node) -> Values:
        if id(node) not in self._known:
            self._known[id(node)] = node, self._values(node)
        return self._known[id(node)][1]

    def _values(self, node: Node) -> Values:
        if any(isinstance(part, TimeDerivative | PartialDerivative) for part in walk(node)):
            return self._sampler.values(to_sympy(node, self._sampler.solution.symbols))
        try:
            return tuple(evaluate(node, point) for point in self._points)
        except (KeyError, TypeError):
            return (math.nan,) * len(self._points)


def exact(value: int) -> Number:
    """A whole number as a node."""
    return Number(Fraction(value))
