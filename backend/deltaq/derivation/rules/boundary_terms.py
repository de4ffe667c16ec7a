"""Boundary terms: where δx = 0, [∂F/∂ẋ δx] vanishes; where δx is arbitrary, δI = 0 demands ∂F/∂ẋ = 0.

The latter are the natural boundary conditions. With ẍ in the integrand there are two for each end: the factor of δx
is ∂F/∂ẋ − d/dt ∂F/∂ẍ (of a beam the shear force), that of δẋ is ∂F/∂ẍ (its bending moment).
Source: Gelfand, Fomin, Calculus of Variations, §4, §6 and §11; Lanczos, The Variational Principles of Mechanics,
ch. II.15; Courant, Hilbert, Methods of Mathematical Physics, vol. I, ch. IV, §5.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..differential_expression import direction
from ..formula import AtTime, Equation, Explicit
from ..functional import Functional
from ..step import Relation, Step
from .integration_by_parts import boundary_term, momentum

RULE = "boundary-terms"
ZERO = Explicit(sp.Integer(0))


def apply(functional: Functional) -> Step:
    """For each δx⁽ⁿ⁾ of the boundary terms: δx⁽ⁿ⁾ = 0 at the ends that hold it, its factor = 0 at those that are free.

    The outcome in `about` is `fixed` or `free` where all ends are alike; else `mixed`, or `partly` with second rates.
    """
    pairs = tuple(functional.boundary)
    lines = (line for pair in pairs for line in (*_vanishing(functional, *pair), *_natural(functional, *pair)))
    return Step(RULE, "", tuple(lines), (), {"outcome": _outcome(functional, pairs)})


def _outcome(functional: Functional, pairs: tuple[tuple[str, int], ...]) -> str:
    """Whether the variations vanish at all ends, at none, or at some; with second rates also which of them."""
    if not any(functional.free_ends(n) for _, n in pairs):
        return "fixed"
    if not any(functional.held_ends(n) for _, n in pairs):
        return "free"
    return "mixed" if functional.highest == 1 else "partly"


def _vanishing(functional: Functional, x: str, order: int) -> Iterator[Relation]:
    """δx⁽ⁿ⁾ = 0 where it is held; if it is at both ends, the boundary term is zero."""
    ends = (AtTime(Explicit(direction(x, order)), end) for end in functional.held_ends(order))
    yield from (Relation((value, ZERO)) for value in ends)
    if not functional.free_ends(order):
        yield Relation((boundary_term(functional, momentum(functional, x, order), x, order), ZERO))


def _natural(functional: Functional, x: str, order: int) -> Iterator[Relation]:
    """The factor of δx⁽ⁿ⁾ is zero at each free end."""
    factor, written = momentum(functional, x, order), Explicit(functional.momentum(x, order))
    for end in functional.free_ends(order):
        yield Relation((Equation(AtTime(factor, end), ZERO), Equation(AtTime(written, end), ZERO)), "⇔")
