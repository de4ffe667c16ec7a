"""Boundary terms: at fixed ends δx = 0, so [∂F/∂ẋ δx] vanishes; at free ends δI = 0 demands ∂F/∂ẋ = 0.

The latter are the natural boundary conditions.
Source: Gelfand, Fomin, Calculus of Variations, §4 and §6; Lanczos, The Variational Principles of Mechanics, ch. II.15.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..formula import Equation, Explicit, Partial
from ..function_formula import AtTime
from ..functional import Functional, direction
from ..step import Relation, Step
from .integration_by_parts import boundary

RULE = "boundary-terms"
ZERO = Explicit(sp.Integer(0))


def apply(functional: Functional) -> Step:
    lines = _vanishing(functional) if functional.has_fixed_ends else _natural(functional)
    return Step(RULE, "", tuple(lines), (), {"outcome": "fixed" if functional.has_fixed_ends else "free"})


def _vanishing(functional: Functional) -> Iterator[Relation]:
    """δx = 0 at both ends, and with it the boundary term."""
    for x in functional.moving:
        ends = (AtTime(Explicit(direction(x)), end) for end in _ends(functional))
        yield from (Relation((value, ZERO)) for value in ends)
        momentum = Partial(functional.named, functional.symbols.rate(x, 1))
        yield Relation((boundary(functional, momentum, x), ZERO))


def _natural(functional: Functional) -> Iterator[Relation]:
    """∂F/∂ẋ = 0 at each end."""
    for x in functional.moving:
        momentum = Partial(functional.named, functional.symbols.rate(x, 1))
        written = Explicit(functional.momentum(x))
        for end in _ends(functional):
            yield Relation((Equation(AtTime(momentum, end), ZERO), Equation(AtTime(written, end), ZERO)), "⇔")


def _ends(functional: Functional) -> tuple[sp.Expr, sp.Expr]:
    return functional.interval.lower, functional.interval.upper
