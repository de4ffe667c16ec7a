"""A constant of motion as it is written last: the shortest that is constant with it."""

from __future__ import annotations

from collections.abc import Iterator

from ...language.symbols import Symbols
from ..clearing import constant_of_motion
from ..formula import Called, Explicit, Formula, Named, Power, Quantity, Times, Value
from ..step import Relation


def constant(name: Called, value: Value, symbols: Symbols) -> Iterator[Relation]:
    """c · nameⁿ = g where that is shorter, then g = const."""
    shown, power, factor = constant_of_motion(value, symbols)
    if shown != value:
        raised: Formula = name if power == 1 else Power(name, power)
        yield Relation((raised if factor == 1 else Times((Explicit(factor), raised)), Explicit(shown)))
    yield Relation((Explicit(shown), Named(Quantity("constant"), shown)))
