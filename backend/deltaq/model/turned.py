"""Expressions in which coordinates are put in by others, angles by their sines and cosines where these are known.

An angle that closes a loop is ψ = atan2(s, c) with s² + c² = 1: sin ψ and cos ψ are s and c, without branches or jumps
by 2π, and what stands in waves of sums follows by the addition theorems.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import reduce

import symengine as se

from .functions import Expr

Waves = tuple[Expr, Expr]  # sine and cosine


@dataclass(frozen=True)
class Turned:
    """What is put in: `values` by symbols, `waves` by the symbols of angles among them."""

    values: Mapping[Expr, Expr]
    waves: Mapping[Expr, Waves] = field(default_factory=dict)

    def into(self, expression: Expr) -> Expr:
        """The expression with all of it put in."""
        angles = set(self.waves)
        found = [wave for wave in expression.atoms(se.sin, se.cos) if wave.args[0].free_symbols & angles]
        put = {wave: self._of(wave.args[0])[isinstance(wave, se.cos)] for wave in found}
        # Names stand for the waves meanwhile: what takes their place may have waves of the same angles no more.
        marks = {wave: se.Symbol(f"wave {number}") for number, wave in enumerate(put)}
        shown = expression.subs(marks).subs(dict(self.values)) if marks else expression.subs(dict(self.values))
        return shown.subs({marks[wave]: value for wave, value in put.items()})

    def _of(self, angle: Expr) -> Waves:
        """Sine and cosine of an angle in which some are put in."""
        if angle.is_Add:
            return reduce(_together, map(self._of, angle.args))
        if angle.is_Mul and angle.args[0] == -1:
            sine, cosine = self._of(-angle)
            return -sine, cosine
        if angle in self.waves:
            return self.waves[angle]
        value = angle.subs(dict(self.values))
        return se.sin(value), se.cos(value)


def _together(one: Waves, other: Waves) -> Waves:
    """Of the sum of two angles."""
    return one[0] * other[1] + one[1] * other[0], one[1] * other[1] - one[0] * other[0]
