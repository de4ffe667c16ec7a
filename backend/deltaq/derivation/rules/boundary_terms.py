"""Boundary terms: at fixed ends δx = 0, so [∂F/∂ẋ δx] vanishes; at free ends δI = 0 demands ∂F/∂ẋ = 0.

The latter are the natural boundary conditions.
Source: Gelfand, Fomin, Calculus of Variations, §4 and §6; Lanczos, The Variational Principles of Mechanics, ch. II.15.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..differential_expression import direction
from ..formula import AtTime, Equation, Explicit, Partial
from ..functional import Functional
from ..step import Relation, Step
from .integration_by_parts import boundary

RULE = "boundary-terms"
OUTCOMES = {(True, True): "fixed", (False, False): "free", (True, False): "mixed", (False, True): "mixed"}
ZERO = Explicit(sp.Integer(0))


def apply(functional: Functional) -> Step:
    lines = (line for x in functional.moving for line in (*_vanishing(functional, x), *_natural(functional, x)))
    return Step(RULE, "", tuple(lines), (), {"outcome": OUTCOMES[functional.fixed]})


def _vanishing(functional: Functional, x: str) -> Iterator[Relation]:
    """δx = 0 at each fixed end; if both are, the boundary term is zero."""
    ends = (AtTime(Explicit(direction(x)), end) for end in functional.fixed_ends)
    yield from (Relation((value, ZERO)) for value in ends)
    if not functional.free_ends:
        momentum = Partial(functional.named, functional.symbols.rate(x, 1))
        yield Relation((boundary(functional, momentum, x), ZERO))


def _natural(functional: Functional, x: str) -> Iterator[Relation]:
    """∂F/∂ẋ = 0 at each free end."""
    momentum = Partial(functional.named, functional.symbols.rate(x, 1))
    written = Explicit(functional.momentum(x))
    for end in functional.free_ends:
        yield Relation((Equation(AtTime(momentum, end), ZERO), Equation(AtTime(written, end), ZERO)), "⇔")
