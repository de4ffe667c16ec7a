"""Mass and centre of mass of a continuum, m = ∫ dm and r_S = ∫ r dm / m, as expressions of its scene."""

from __future__ import annotations

import symengine as se

from ..language.expression import Expression
from ..mechanics.bodies.continuum import Continuum
from ..mechanics.material import Material
from ..mechanics.scene import Scene
from .functions import Expr
from .symbols import Symbols
from .symengine_algebra import to_symengine
from .writing import Writer

# Boole's rule: exact for polynomials of degree 5, with weights that are read as fractions.
WEIGHTS = tuple(se.Integer(weight) / 90 for weight in (7, 32, 12, 32, 7))


def mass_centre(body: Continuum, scene: Scene) -> tuple[Expression, tuple[Expression, ...]]:
    """Mass and position of the centre of mass; exact where density and position are polynomials of degree 5 together.

    Source: Davis, Rabinowitz, Methods of Numerical Integration, 2nd ed., §2.5 (Boole's rule).
    """
    symbols = Symbols.of(scene).within(scene.material)
    writer = Writer(symbols, scene.names)
    density = to_symengine(body.density.tree, symbols)
    mass = _integral(density, body.material, symbols)
    moments = (_integral(density * to_symengine(x.tree, symbols), body.material, symbols) for x in body.position)
    return writer.expression(mass), tuple(writer.expression((moment / mass).expand()) for moment in moments)


def _integral(integrand: Expr, material: tuple[Material, ...], symbols: Symbols) -> Expr:
    for each in material:
        symbol = symbols.values[each.name]
        lower, upper = (to_symengine(bound.tree, symbols) for bound in (each.lower, each.upper))
        nodes = (lower + (upper - lower) * se.Integer(k) / 4 for k in range(5))
        values = (weight * integrand.subs({symbol: node}) for weight, node in zip(WEIGHTS, nodes, strict=True))
        integrand = ((upper - lower) * sum(values, se.Integer(0))).expand()
    return integrand
