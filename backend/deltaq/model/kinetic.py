"""Kinetic energies of the bodies: E = ∫ ½ v·v dm, one function for each kind of body."""

from __future__ import annotations

from functools import singledispatch

import symengine as se

from ..language.expression import Expression
from ..mechanics.bodies.particle import Particle
from .functions import Expr
from .symbols import Symbols
from .symengine_algebra import to_symengine

Vector = tuple[Expr, ...]


def position(expressions: tuple[Expression, ...], symbols: Symbols) -> Vector:
    """A position field, in components."""
    return tuple(to_symengine(expression.tree, symbols) for expression in expressions)


def velocity(r: Vector, symbols: Symbols) -> Vector:
    """v = Σ ∂r/∂qⱼ q̇ⱼ over all that moves; for the clock this is ∂r/∂t times its rate."""
    return tuple(
        sum((x.diff(symbols.values[name]) * symbols.rates[name] for name in symbols.moving), se.Integer(0)) for x in r
    )


@singledispatch
def kinetic_energy(body: object, _symbols: Symbols) -> Expr:
    """The kinetic energy of a body in q, q̇, t."""
    raise TypeError(f"no kinetic energy is known for {type(body).__name__}")


@kinetic_energy.register
def _of_particle(body: Particle, symbols: Symbols) -> Expr:
    """E = m/2 v·v"""
    speeds = velocity(position(body.position, symbols), symbols)
    return to_symengine(body.mass.tree, symbols) * sum((v**2 for v in speeds), se.Integer(0)) / 2
