"""Expressions as programs in ball arithmetic: each part is evaluated once at a point, however many formulas hold it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import sympy as sp
from flint import arb

from ..language.functions import CLASSES
from .points import Place, Point
from .tree_evaluation import FUNCTIONS, power

# Operations by the names of SymPy's classes.
BY_CLASS: Mapping[str, Callable[..., arb]] = {
    **FUNCTIONS,
    **{own: FUNCTIONS[name] for own, name in CLASSES.items()},
    "Add": lambda *terms: sum(terms, arb(0)),
    "Mul": lambda *factors: math.prod(factors, start=arb(1)),
    "Pow": power,
    # The slope of a jump: nothing beside it, and no value at it.
    "DiracDelta": lambda x, *_order: arb("nan") if x.contains(0) else arb(0),
}
CONSTANTS: Mapping[sp.Basic, Callable[[], arb]] = {
    sp.pi: arb.pi,
    sp.E: arb.const_e,
    **dict.fromkeys((sp.oo, -sp.oo, sp.zoo, sp.nan), lambda: arb("nan")),  # where a number was too large
}


def number(expression: sp.Basic, point: Point) -> arb:
    """The expression's value, evaluated from the leaves up."""
    return program(expression).value(point if isinstance(point, Place) else Place(point))


@dataclass(frozen=True, eq=False, slots=True)
class Program:
    """An expression as a function of the place: an operation on its parts, and the names that it depends on."""

    operation: Callable[..., arb]
    parts: tuple[Program, ...] = ()
    names: frozenset[str] = frozenset()

    def value(self, place: Place) -> arb:
        """Evaluated once at each place; where nothing in it has moved, as it was before."""
        known = place.known.get(self)
        if known is None:
            known = place.known[self] = self._evaluated(place)
        return known

    def _evaluated(self, place: Place) -> arb:
        if place.origin is not None and self.names.isdisjoint(place.moved):
            return self.value(place.origin)
        return self.operation(*[part.value(place) for part in self.parts])


@dataclass(frozen=True, eq=False, slots=True)
class Leaf(Program):
    """A symbol."""

    name: str = ""

    def value(self, place: Place) -> arb:
        return place[self.name]


@lru_cache(maxsize=1 << 13)
def program(expression: sp.Basic) -> Program:
    """The expression's program; the same parts come again at every point and in many formulas."""
    if isinstance(expression, sp.Symbol):
        return Leaf(arb, (), frozenset({expression.name}), expression.name)
    if isinstance(expression, sp.Rational):
        return Program(lambda: arb(expression.p) / arb(expression.q))
    if expression in CONSTANTS:
        return Program(CONSTANTS[expression])
    parts = tuple(map(program, expression.args))
    names = frozenset[str]().union(*(part.names for part in parts))
    return Program(BY_CLASS[type(expression).__name__], parts, names)
