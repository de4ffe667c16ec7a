"""Where the right-hand side of a model has no finite value: at zeros of divisors, ends of roots and logarithms, poles.

Each part of M, f, A and γ that is a power, a logarithm or another function without values for some numbers has a
margin, which may not become zero (what is divided by) or negative (what a root is taken of).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import symengine as se
from numpy.typing import NDArray

from .compiled import Compiled, Floats, compile_expressions
from .functions import Expr
from .parts import parts
from .spelt import spelt
from .symbols import Symbols

# What may not become zero where some function stands; and what may not become negative either.
POLES: Mapping[type, Callable[[Expr], Expr]] = MappingProxyType(
    {se.tan: se.cos, se.sec: se.cos, se.cot: se.sin, se.csc: se.sin}
)
ENDS: Mapping[type, Callable[[Expr], Expr]] = MappingProxyType(
    {
        se.log: lambda x: x,
        se.asin: lambda x: 1 - x**2,
        se.acos: lambda x: 1 - x**2,
        se.atanh: lambda x: 1 - x**2,
        se.acosh: lambda x: x - 1,
    }
)


@dataclass(frozen=True)
class Margins:
    """The margins of a model as the language of scenes has them, which of them may not be negative, and their values.

    `ends` has shape (margins,).
    """

    names: tuple[str, ...]
    ends: NDArray[np.bool_]
    values: Compiled

    def at(self, rows: Floats) -> Floats:
        """The margins in rows of inputs, shape (rows, inputs): shape (rows, margins)."""
        return self.values.table(rows)

    def left(self, values: Floats) -> Floats:
        """How much is left of margins of these values, shape (rows, margins): nothing where there is no value."""
        found = np.where(self.ends, np.maximum(values, 0.0), np.abs(values))
        return np.where(np.isnan(found), 0.0, found)


def margins_of(outputs: Sequence[Expr], symbols: Symbols) -> Margins | None:
    """The margins that move with a model, of some expressions in its inputs; None if there are none to be told."""
    moving = {*symbols.inputs[: 2 * len(symbols.free) + 1]}
    told = {value: (spelt(value, symbols), ends) for value, ends in _margins(outputs) if value.free_symbols & moving}
    known = {value: (name, ends) for value, (name, ends) in told.items() if name is not None}
    if not known:
        return None
    names, ends = zip(*known.values(), strict=True)
    return Margins(names, np.array(ends), compile_expressions(symbols.inputs, list(known)))


def _margins(outputs: Sequence[Expr]) -> Iterator[tuple[Expr, bool]]:
    for power in sorted(parts(outputs, se.Pow), key=str):
        base, exponent = power.args
        if base != se.E and not (exponent.is_Integer and exponent > 0):
            yield base, not exponent.is_Integer
    for kinds, ends in ((POLES, False), (ENDS, True)):
        for kind, margin in kinds.items():
            yield from ((margin(call.args[0]), ends) for call in sorted(parts(outputs, kind), key=str))
