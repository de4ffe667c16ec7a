"""Vectors and matrices of the model; with one degree of freedom they are numbers, and written as such."""

from __future__ import annotations

import sympy as sp

from ...mechanics.reaction_units import reaction_unit
from ..calculus import column
from ..equilibria import Equilibrium
from ..formula import Explicit, Formula, Inserted, MatrixTimes, Named, Plus, Quantity, Rounded, Term, Times, Value
from ..linearization import Linearization, deviations
from ..step import Relation
from ..system import System


def is_scalar(system: System) -> bool:
    """Whether the system has one coordinate, so that M and f are numbers."""
    return len(system.free) == 1


def plain_value(value: sp.ImmutableMatrix) -> Value:
    """A vector or matrix, or the number in it if it has just one."""
    return value[0, 0] if value.shape == (1, 1) else value


def shaped(kind: str, form: str, value: sp.ImmutableMatrix) -> Named:
    """`kind` under its bold symbol as `form` (matrix or vector), or as a plain letter if it is one number."""
    return Named(Quantity(f"{kind}-{'scalar' if value.shape == (1, 1) else form}"), plain_value(value))


def zero(rows: int) -> Named | Explicit:
    """The right side 0 of an equation: a number, or a bold zero of several rows."""
    if rows == 1:
        return Explicit(sp.Integer(0))
    return Named(Quantity("zero-vector"), sp.ImmutableMatrix.zeros(rows, 1))


def matrices(linear: Linearization) -> tuple[Named, Named, Named]:
    """M₀, D₀ and K₀ of the small motions; with constraints, those on their tangent space."""
    values = {"mass": linear.mass, "damping": linear.damping, "stiffness": linear.stiffness}
    kind = "reduced" if linear.tangent else "linear"
    mass, damping, stiffness = (shaped(f"{kind}-{name}", "matrix", value) for name, value in values.items())
    return mass, damping, stiffness


def motions(system: System, linear: Linearization) -> tuple[Named, Named, Named]:
    """ẍ, ẋ and x; with constraints, ÿ, ẏ and y of the coordinates that may be chosen."""
    x, speed, acceleration = deviations(system, linear)
    kind = "chosen-deviation" if linear.tangent else "deviation"
    return (
        shaped(f"{kind}-acceleration", "vector", acceleration),
        shaped(f"{kind}-rate", "vector", speed),
        shaped(kind, "vector", x),
    )


def at_rest(system: System, equilibrium: Equilibrium) -> dict[sp.Symbol, sp.Expr]:
    """The equilibrium with all rates zero, and the multipliers that hold it."""
    return {**equilibrium.values, **equilibrium.reactions, **system.zero_rates}


def place(system: System, equilibrium: Equilibrium, coordinate: str) -> Relation:
    """q = q₀, in closed form, or as a number with its unit."""
    value = equilibrium.values[system.q(coordinate)]
    name = Named(Quantity("coordinate", coordinate), value)
    if equilibrium.exact:
        return Relation((name, Explicit(value)))
    unit = next(c.unit for c in system.scene.coordinates if c.name == coordinate)
    return Relation((name, Rounded(sp.sympify(value), unit)), "≈")


def multiplier(system: System, symbol: sp.Symbol, equilibrium: Equilibrium) -> Relation:
    """λ = λ₀ of a constraint that holds an equilibrium, in closed form, or as a number with its unit."""
    value, unit = equilibrium.reactions[symbol], reaction_unit(system.scene, symbol.name)
    name = Inserted(Explicit(symbol), {symbol: value})
    return valued(name, value, equilibrium, unit if "^" not in unit else "")


def valued(name: Formula, value: sp.Expr, equilibrium: Equilibrium, unit: str = "") -> Relation:
    """What a name stands for in an equilibrium, in closed form or as a number."""
    return Relation((name, Explicit(value))) if equilibrium.exact else Relation((name, Rounded(value, unit)), "≈")


def reactions(system: System) -> Formula:
    """Aᵀλ, the multiplier before it if there is just one."""
    turned = Named(Quantity("constraint-matrix-transposed"), sp.ImmutableMatrix(system.constraint_matrix().T))
    if len(system.multipliers) == 1:
        return Times((Explicit(system.multipliers[0]), turned))
    return MatrixTimes(turned, Named(Quantity("multipliers-vector"), column(system.multipliers)))


def balanced(system: System, force: Named) -> Formula:
    """f, and Aᵀλ where there are constraints."""
    return Plus((Term(force), Term(reactions(system)))) if system.conditions else force


def numbers(system: System) -> dict[sp.Symbol, sp.Expr]:
    """Parameters at the scene's values; coordinates that an equilibrium leaves free, where the scene starts."""
    start = {system.q(c.name): sp.Rational(repr(float(c.value))) for c in system.scene.free}
    return {**start, **system.parameter_values}


def inequality(system: System, smaller: sp.Expr, larger: sp.Expr) -> Relation:
    """smaller < larger at the scene's values."""
    return Relation((Inserted(Explicit(smaller), numbers(system)), Inserted(Explicit(larger), numbers(system))), "<")


def premises(linear: Linearization, number: int) -> tuple[str, ...]:
    """What is named beside the quantities in a step: on constraints M and K have no names of their own before."""
    return (f"linearization:{number}",) if linear.tangent else ()
