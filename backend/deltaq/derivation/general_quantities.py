"""The quantities that the general proof speaks of, under their names."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from .abstract_motion import BODY, VARIABLES, AbstractMotion, H, P, T, each, q, rate, summed, symbol, variation
from .formula import (
    Called,
    Dot,
    Explicit,
    Formula,
    MassIntegral,
    Named,
    Partial,
    Plus,
    Quantity,
    Rate,
    Ratio,
    Summed,
    Term,
    Times,
    minus,
)
from .step import Relation

X, V = symbol("x"), symbol("v")
VECTOR = {symbol(f"x_{n}"): symbol(f"v_{n}") for n in range(1, VARIABLES + 1)}
# The vectors as a whole, which only writing knows.
ALONG = {**VECTOR, symbol("X"): symbol("V")}
ZERO = Explicit(sp.Integer(0))

__all__ = ["ALONG", "VECTOR", "ZERO", "H", "T", "V", "X"]


def for_each(*members: Callable[[str], Formula], sign: str = "=") -> Relation:
    """A line that holds for every i."""
    return Relation(tuple(map(each, members)), sign)


def position(motion: AbstractMotion) -> Named:
    """r(P, t, q)"""
    return Named(Quantity("position"), motion.position, (P, T, q("i")))


def velocity(motion: AbstractMotion) -> Named:
    """v"""
    return Named(Quantity("velocity"), motion.velocity)


def acceleration(motion: AbstractMotion) -> Named:
    """dv/dt"""
    return Named(Quantity("acceleration"), motion.acceleration)


def lever(motion: AbstractMotion, index: str) -> Partial:
    """∂r/∂qᵢ"""
    return Partial(position(motion), q(index))


def half_square(motion: AbstractMotion) -> Ratio:
    """v · v/2"""
    return Ratio(Dot(velocity(motion), velocity(motion)), Explicit(sp.Integer(2)))


def by_mass(motion: AbstractMotion, of: Formula) -> MassIntegral:
    """∫ of dm over the body"""
    return MassIntegral(of, "B", "m", BODY, motion.density)


def inertia(motion: AbstractMotion, index: str) -> MassIntegral:
    """∫ ∂r/∂qᵢ · dv/dt dm"""
    return by_mass(motion, Dot(lever(motion, index), acceleration(motion)))


def kinetic_energy(motion: AbstractMotion) -> Called:
    """E = ∫ v · v/2 dm"""
    return Called(Quantity("kinetic-energy"), by_mass(motion, half_square(motion)))


def potential_energy(motion: AbstractMotion) -> Named:
    """V(q, t) of all forces that have a potential, under its letter."""
    return Named(Quantity("potential-energy"), motion.potential)


def lagrangian(motion: AbstractMotion) -> Called:
    """L = E − V"""
    return Called(Quantity("lagrangian"), Plus((Term(kinetic_energy(motion)), minus(potential_energy(motion)))))


def generalized_force(motion: AbstractMotion, index: str) -> Named:
    """Qᵢ of all forces, under its letter."""
    return Named(Quantity("generalized-force", index), motion.force(index))


def dissipative_force(motion: AbstractMotion, index: str) -> Named:
    """Qᵢᵈ of the forces that have no potential, under its letter."""
    return Named(Quantity("nonconservative-force", index), motion.dissipative(index))


def lagrange_expression(of: Formula, index: str) -> Plus:
    """d/dt ∂of/∂q̇ᵢ − ∂of/∂qᵢ"""
    return Plus((Term(Rate(Partial(of, rate(index)))), minus(Partial(of, q(index)))))


def times_variation(of: Formula, index: str) -> Times:
    """of δqᵢ"""
    return Times((of, Explicit(variation(index))))


def work_by_region(motion: AbstractMotion, arm: Formula) -> Plus:
    """∫ arm · f_S dS + ∫ arm · f_V dV"""
    return Plus(
        tuple(
            Term(
                MassIntegral(
                    Dot(arm, Named(Quantity("force-density", region), motion.force_density(region))),
                    region,
                    region,
                    BODY,
                    sp.Integer(1),
                )
            )
            for region in ("S", "V")
        )
    )


def displacement_by_coordinates(motion: AbstractMotion) -> Summed:
    """∂r/∂qᵢ δqᵢ"""
    return summed(lambda i: times_variation(lever(motion, i), i), "i")


def displacement(motion: AbstractMotion) -> Called:
    """δr"""
    return Called(Quantity("virtual-displacement"), displacement_by_coordinates(motion))
