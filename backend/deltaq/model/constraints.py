"""Constraints of a model: A(q, t) q̈ = γ(q, q̇, t), which keeps w = A q̇ + b = 0, and, where it is holonomic, g = 0.

A holonomic constraint g(q, t) = 0 has w = ∂g/∂q q̇ + ∂g/∂t; one that is linear in the rates is w = 0 itself. With the
reaction Aᵀλ in M q̈ = f + Aᵀλ, the second derivative makes λ a function of the state (index 1).
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import symengine as se

from ..mechanics.conditions import Condition
from ..mechanics.scene import Scene
from .functions import Expr
from .kinetic import ZERO, Vector, dot
from .slopes import gradient
from .symbols import Symbols
from .symengine_algebra import to_symengine

HALF = se.Rational(1, 2)


@dataclass(frozen=True)
class ConstraintEquations:
    """All constraints of a scene as expressions in q, q̇, t and the parameters, the holonomic ones first.

    `places` are their places among the scene's constraints, `names` those of their multipliers. `gaps` are the g of the
    holonomic ones; the rows of A are in `jacobian`, γ in `accelerations`, w in `slips` and b in `drives`.
    """

    places: tuple[int, ...]
    names: tuple[str, ...]
    gaps: Vector
    slips: Vector
    jacobian: tuple[Vector, ...]
    accelerations: Vector
    drives: Vector

    @cached_property
    def is_driven(self) -> bool:
        """Whether reactions have a power, −λ·b: where a constraint moves by itself."""
        return any(drive != 0 for drive in self.drives)


NONE = ConstraintEquations((), (), (), (), (), (), ())


def constraint_equations(scene: Scene, symbols: Symbols, guided: Callable[[Vector], Vector]) -> ConstraintEquations:
    """The constraints of a scene; `guided` puts the guides in."""
    conditions = tuple(enumerate(scene.conditions))
    if not conditions:
        return NONE
    holonomic = [each for each in conditions if each[1].is_holonomic]
    ordered = [*holonomic, *(each for each in conditions if not each[1].is_holonomic)]
    lengths = tuple(symbols.values[each.name] for each in scene.parameters if each.positive)
    written = (to_symengine(condition.value, symbols) for _, condition in ordered)
    values = guided(tuple(_without_root(value, lengths) for value in written))
    slips = tuple(_slip(condition, value, symbols) for (_, condition), value in zip(ordered, values, strict=True))
    places = tuple(place for place, _ in ordered)
    rates = tuple(symbols.rates[name] for name in symbols.free)
    at_rest = dict.fromkeys(rates, ZERO)
    return ConstraintEquations(
        places,
        tuple(scene.multipliers[place].name for place in places),
        values[: len(holonomic)],
        slips,
        tuple(gradient(slip, rates) for slip in slips),
        tuple(-_along(slip, symbols) for slip in slips),
        tuple(slip.subs(at_rest) for slip in slips),
    )


def _without_root(value: Expr, lengths: Vector) -> Expr:
    """±(s − √D) of a positive s as ±(s² − D)/(2s), which is zero where that is, with the same derivatives there.

    So λ is the same, and no fractional powers are to be computed.
    """
    signs = {s: sign for s in lengths for sign in (1, -1) if sign * s in value.args}
    if not isinstance(value, se.Add) or len(value.args) != 2 or len(signs) != 1:
        return value
    ((s, sign),) = signs.items()
    root = next(-sign * each for each in value.args if each != sign * s)
    is_root = isinstance(root, se.Pow) and root.args[1] == HALF
    return sign * (s * s - root.args[0]) / (2 * s) if is_root else value


def _slip(condition: Condition, value: Expr, symbols: Symbols) -> Expr:
    return _along(value, symbols) if condition.is_holonomic else value


def _along(value: Expr, symbols: Symbols) -> Expr:
    """The time derivative along a motion, as far as it needs no accelerations."""
    *slopes, by_time = gradient(value, [*(symbols.values[name] for name in symbols.free), symbols.time])
    return by_time + dot(slopes, [symbols.rates[name] for name in symbols.free])
