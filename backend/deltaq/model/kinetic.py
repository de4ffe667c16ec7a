"""Kinetic energies: E = ∫ ½ v·v dm, one function for each of the kinds that bodies come down to."""

from __future__ import annotations

from collections.abc import Sequence
from functools import singledispatch

import symengine as se

from ..language.tree import Node
from ..mechanics.kinetics import Distribution, Rotation, Translation
from .functions import Expr
from .quadrature import integral
from .slopes import gradient
from .symbols import CLOCK, Symbols
from .symengine_algebra import to_symengine

ZERO = se.Integer(0)
Vector = tuple[Expr, ...]


def components(nodes: tuple[Node, ...], symbols: Symbols) -> Vector:
    """A vector, in components."""
    return tuple(to_symengine(node, symbols) for node in nodes)


def velocity(r: Vector, symbols: Symbols) -> Vector:
    """v = Σ ∂r/∂qⱼ q̇ⱼ over all that moves; for the clock this is ∂r/∂t times its rate."""
    values, rates = ([each[name] for name in symbols.moving] for each in (symbols.values, symbols.rates))
    return tuple(dot(gradient(x, values), rates) for x in r)


def dot(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    """a·b"""
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


@singledispatch
def kinetic_energy(kinetics: object, _symbols: Symbols) -> Expr:
    """The kinetic energy in q, q̇, t; homogeneous of degree 2 in all rates, that of the clock included."""
    raise TypeError(f"no kinetic energy is known for {type(kinetics).__name__}")


@kinetic_energy.register
def _of_translation(kinetics: Translation, symbols: Symbols) -> Expr:
    """E = m/2 v·v"""
    v = velocity(components(kinetics.position, symbols), symbols)
    return to_symengine(kinetics.mass, symbols) * _square(v) / 2


@kinetic_energy.register
def _of_rotation(kinetics: Rotation, symbols: Symbols) -> Expr:
    """E = 1/2 Σ Jₖₗ ωₖ ωₗ"""
    spins = [_homogeneous(spin, symbols) for spin in components(kinetics.angular_velocity, symbols)]
    products = (to_symengine(j, symbols) * spins[k] * spins[l] / (1 + (k == l)) for k, l, j in kinetics.entries)
    return sum(products, ZERO)


@kinetic_energy.register
def _of_distribution(kinetics: Distribution, symbols: Symbols) -> Expr:
    """E = ∫ 1/2 v·v dm"""
    inside = symbols.within(kinetics.material)
    v = velocity(components(kinetics.position, inside), inside)
    return integral(to_symengine(kinetics.density, inside) * _square(v) / 2, kinetics.material, inside)


def _square(v: Vector) -> Expr:
    return sum((x**2 for x in v), ZERO)


def _homogeneous(spin: Expr, symbols: Symbols) -> Expr:
    """An angular velocity, affine in the rates, with the clock's rate at the part that none of them causes."""
    clock = symbols.rates[CLOCK]
    slowed = {symbols.rates[name]: symbols.rates[name] / clock for name in symbols.moving if name != CLOCK}
    return se.expand(clock * spin.subs(slowed))
