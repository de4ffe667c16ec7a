"""Vectors and matrices of the model; with one degree of freedom they are numbers, and written as such."""

from __future__ import annotations

import sympy as sp

from ..formula import Explicit, Inserted, Named, Quantity, Value
from ..linearization import Linearization, deviations
from ..step import Relation
from ..system import System


def is_scalar(system: System) -> bool:
    """Whether the system has one degree of freedom, so that M, f, x are numbers."""
    return len(system.free) == 1


def plain_value(value: sp.ImmutableMatrix) -> Value:
    """A vector or matrix, or the number in it if it has just one."""
    return value[0, 0] if value.shape == (1, 1) else value


def shaped(system: System, kind: str, form: str, value: sp.ImmutableMatrix) -> Named:
    """`kind` under its bold symbol as `form` (matrix or vector), or as a plain letter."""
    return Named(Quantity(f"{kind}-{'scalar' if is_scalar(system) else form}"), plain_value(value))


def zero(system: System) -> Named | Explicit:
    """The right side 0 of an equation of motion: a number, or a bold zero of as many rows as coordinates are free."""
    if is_scalar(system):
        return Explicit(system.zero)
    return Named(Quantity("zero-vector"), sp.ImmutableMatrix.zeros(len(system.free), 1))


def matrices(system: System, linear: Linearization) -> tuple[Named, Named, Named]:
    """M₀, D₀ and K₀."""
    values = {"linear-mass": linear.mass, "linear-damping": linear.damping, "linear-stiffness": linear.stiffness}
    mass, damping, stiffness = (shaped(system, kind, "matrix", value) for kind, value in values.items())
    return mass, damping, stiffness


def motions(system: System) -> tuple[Named, Named, Named]:
    """ẍ, ẋ and x."""
    x, speed, acceleration = deviations(system)
    return (
        shaped(system, "deviation-acceleration", "vector", acceleration),
        shaped(system, "deviation-rate", "vector", speed),
        shaped(system, "deviation", "vector", x),
    )


def at_rest(system: System, linear: Linearization) -> dict[sp.Symbol, sp.Expr]:
    """The equilibrium with all rates zero."""
    return {**linear.equilibrium.values, **{system.rate(q): system.zero for q in system.free}}


def numbers(system: System) -> dict[sp.Symbol, sp.Expr]:
    """Parameters at the scene's values; coordinates that an equilibrium leaves free, where the scene starts."""
    start = {system.q(c.name): sp.Rational(repr(float(c.value))) for c in system.scene.free}
    return {**start, **system.parameter_values}


def inequality(system: System, smaller: sp.Expr, larger: sp.Expr) -> Relation:
    """smaller < larger at the scene's values."""
    return Relation((Inserted(Explicit(smaller), numbers(system)), Inserted(Explicit(larger), numbers(system))), "<")
