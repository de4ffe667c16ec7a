"""An answer as one tree for each of its parts, with the places in the text that the trees were read from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ...language.parser import parse
from ...language.plain_printer import plain
from ...language.tree import (
    NOWHERE,
    Call,
    Equation,
    Negation,
    Node,
    Power,
    Product,
    Quotient,
    Span,
    Sum,
    TimeDerivative,
    Vector,
    children,
)
from ..reading import Reading
from ..sampling import Sampler, Values, close, defined
from ..task import Task
from .spots import Valued, with_children


@dataclass(frozen=True)
class WrittenPart:
    """A part of an answer as it was written, the residual of an equation as one sum; where its text begins in the
    answer, None if the tree was not read from it.
    """

    tree: Node
    offset: int | None = None

    def place(self, node: Node) -> Span | None:
        """Where a node stands in the text of the answer."""
        if self.offset is None or node.span == NOWHERE or not node.span.length:
            return None
        return Span(node.span.offset + self.offset, node.span.length)


def written_parts(task: Task, reading: Reading, text: str, sampler: Sampler) -> tuple[WrittenPart, ...]:
    """The parts as they were written; printed anew where the trees do not say what was understood."""
    found = list(_written(task, reading, text))
    values = Valued(sampler)
    pairs = zip(found, reading.parts, strict=False)
    if len(found) == len(reading.parts) and all(_agrees(values(a.tree), sampler.values(b)) for a, b in pairs):
        return tuple(found)
    names = sampler.solution.scene.names
    return tuple(WrittenPart(flat(parse(plain(part), names, "plain").tree)) for part in reading.parts)


def _agrees(own: Values, understood: Values) -> bool:
    return not defined(own) or close(own, understood)


def _written(task: Task, reading: Reading, text: str) -> Iterator[WrittenPart]:
    after = 0
    for source, tree in reading.trees:
        start = text.find(source, after)
        after = max(start, after)
        for part in _scalars(task, tree):
            yield WrittenPart(flat(part), None if start < 0 else start)


def _scalars(task: Task, tree: Node) -> Iterator[Node]:
    match tree:
        case Vector() if task.quantity.form != "vector":
            for component in tree.components:
                yield from _scalars(task, component)
        case Equation(left, right) if task.quantity.form == "set":
            squared = isinstance(left, Power)
            yield Call("sqrt", (right,), span=right.span) if squared else right
        case Equation(left, right):
            yield Sum((*_addends(left), *(Negation(term, span=term.span) for term in _addends(right))), span=tree.span)
        case _:
            yield from _components(tree) or (tree,)


def _components(tree: Node) -> tuple[Node, ...]:  # noqa: PLR0911 - one case for each kind
    """The components of what is a vector: factors and signs before a column stand before each of them."""
    match tree:
        case Vector(parts):
            return parts
        case Negation(operand):
            return tuple(Negation(part, span=part.span) for part in _components(operand))
        case Quotient(numerator, denominator):
            return tuple(Quotient(part, denominator, span=part.span) for part in _components(numerator))
        case Product(factors):
            columns = [(k, _components(factor)) for k, factor in enumerate(factors)]
            found = [(k, parts) for k, parts in columns if parts]
            if len(found) != 1:
                return ()
            ((k, parts),) = found
            return tuple(Product((*factors[:k], part, *factors[k + 1 :]), span=part.span) for part in parts)
        case Sum(terms):
            columns_of = [_components(term) for term in terms]
            if not all(columns_of) or len({len(each) for each in columns_of}) != 1:
                return ()
            return tuple(Sum(rows) for rows in zip(*columns_of, strict=True))
        case _:
            return ()


def flat(tree: Node) -> Node:
    """Sums within sums as one sum, signs and d/dt drawn to each term: a term is then what a reader takes for one."""
    match tree:
        case Sum(terms):
            return replace(tree, terms=tuple(each for term in terms for each in _addends(flat(term))))
        case TimeDerivative(Sum(terms)):
            return flat(Sum(tuple(TimeDerivative(term, span=term.span) for term in terms), span=tree.span))
        case Negation(Negation(operand)):
            return flat(operand)
        case Product(factors):
            inner = [flat(factor) for factor in factors]
            return replace(tree, factors=tuple(f for each in inner for f in _multiplied(each)))
        case Call() | Quotient() | Power() | Negation() | Vector():
            return with_children(tree, [flat(part) for part in children(tree)])
        case _:
            return tree


def _addends(tree: Node) -> tuple[Node, ...]:
    return tree.terms if isinstance(tree, Sum) else (tree,)


def _multiplied(factor: Node) -> tuple[Node, ...]:
    return factor.factors if isinstance(factor, Product) else (factor,)
