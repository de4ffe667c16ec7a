"""What may stand in the place of what: the symbols and functions of a task with their values, found by these."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from ...language.parser import parse
from ...language.plain_printer import plain
from ...language.tree import (
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
    Variation,
    walk,
)
from ..equality import Parts
from ..sampling import Sampler, Values
from .spots import Valued, exact

EXACT = 1e-9
WAVES = ("sin", "cos", "tan")
POWERS = (1, -1, 2, -2)
MOST_BASES = 40


@dataclass(frozen=True)
class Base:
    """Something that an answer may hold as a factor, and what it is: a symbol of a kind and unit, or a function."""

    node: Node
    values: Values
    kind: str
    unit: str = ""


@dataclass(frozen=True)
class Monomial:
    """A product of powers of a few bases."""

    powers: tuple[tuple[Base, int], ...]
    values: Values

    @property
    def node(self) -> Node:
        """As a factor to be written."""
        factors = tuple(b.node if p == 1 else Power(b.node, exact(p)) for b, p in self.powers)
        return factors[0] if len(factors) == 1 else Product(factors)


@dataclass(frozen=True, eq=False)
class Lexicon:
    """The bases of a task, and every product of powers of one or two of them by its values."""

    bases: tuple[Base, ...]

    @cached_property
    def monomials(self) -> tuple[list[float], list[Monomial]]:
        """In order of the size of their first value."""
        singles = [Monomial(((b, p),), _power(b.values, p)) for b in self.bases for p in POWERS]
        pairs = [
            Monomial((*a.powers, *b.powers), tuple(x * y for x, y in zip(a.values, b.values, strict=True)))
            for a, b in combinations(singles, 2)
            if a.powers[0][0] is not b.powers[0][0]
        ]
        ordered = sorted([*singles, *pairs], key=lambda one: abs(one.values[0]))
        return [abs(one.values[0]) for one in ordered], ordered

    def found(self, values: Values) -> Iterator[tuple[Monomial, int]]:
        """The products with these values, and with which sign."""
        sizes, ordered = self.monomials
        size = abs(values[0])
        if not 1e-12 < size < 1e12:
            return
        for one in ordered[bisect_left(sizes, size * (1 - EXACT)) : bisect_left(sizes, size * (1 + EXACT))]:
            for sign in (1, -1):
                if near(values, tuple(sign * v for v in one.values)):
                    yield one, sign

    def symbols(self, kinds: Iterable[str]) -> Iterator[Base]:
        """The bases of some kinds."""
        wanted = set(kinds)
        return (base for base in self.bases if base.kind in wanted)


def near(left: Values, right: Values) -> bool:
    """Whether values agree at every point; NaN agrees with nothing."""
    return all(abs(a - b) <= EXACT * max(abs(a), abs(b)) for a, b in zip(left, right, strict=True))


def _power(values: Values, power: int) -> Values:
    return tuple(v**power if v else float("nan") for v in values)


def lexicon(sampler: Sampler, right: Parts, own: Iterable[Node], *, virtual: bool, moving: bool) -> Lexicon:
    """What the scene has, with the sines and cosines of the right answer and of `own` arguments of the student's."""
    values = Valued(sampler)
    symbols = sampler.solution.scene.names
    found: dict[Node, Base] = {}

    def add(node: Node, kind: str, unit: str = "") -> None:
        if node not in found and len(found) < MOST_BASES:
            found[node] = Base(node, values(node), kind, unit)

    for node, kind, unit in _symbols(sampler, virtual=virtual, moving=moving):
        add(node, kind, unit)
    trees = [parse(plain(part), symbols, "plain").tree for part in right]
    for argument in (*arguments(trees), *sorted(own, key=repr)):
        for name in WAVES[:2]:
            add(Call(name, (argument,)), "function")
    return Lexicon(tuple(found.values()))


def _symbols(sampler: Sampler, *, virtual: bool, moving: bool) -> Iterator[tuple[Node, str, str]]:
    scene = sampler.solution.scene
    for p in scene.parameters:
        yield Name(p.name), "parameter", p.unit
    guided = {guide.coordinate for guide in scene.guides}
    for c in scene.coordinates:
        if c.name in guided:
            continue
        yield Name(c.name), "coordinate", c.unit
        if moving:
            yield Rate(c.name, 1), "rate", c.unit
            yield Rate(c.name, 2), "acceleration", c.unit
        if virtual:
            yield Variation(c.name), "variation", c.unit
    for m in scene.material:
        yield Name(m.name), "parameter", "m"


def arguments(trees: Iterable[Node]) -> Iterator[Node]:
    """What sines and cosines are taken of."""
    for tree in trees:
        for node in walk(tree):
            if isinstance(node, Call) and node.function in WAVES:
                yield node.arguments[0]


def symbol_kind(node: Node) -> str:
    """The coordinate that a symbol belongs to; empty for what is no symbol."""
    return node.name if isinstance(node, Name | Rate | Variation | Differential) else ""


def occurring(node: Node, power: int = 1) -> dict[Node, int]:
    """What a term holds as factors, with their powers."""
    match node:
        case Product(factors):
            parts = [occurring(factor, power) for factor in factors]
        case Quotient(numerator, denominator):
            parts = [occurring(numerator, power), occurring(denominator, -power)]
        case Negation(operand):
            parts = [occurring(operand, power)]
        case Power(base, Number(value)) if value.denominator == 1:
            parts = [occurring(base, power * int(value))]
        case Number():
            parts = []
        case _:
            return {node: power}
    found: dict[Node, int] = {}
    for part in parts:
        for key, count in part.items():
            found[key] = found.get(key, 0) + count
    return found
