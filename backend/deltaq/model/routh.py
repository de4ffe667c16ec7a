"""Routh's reduction as a scene: what is left to move when cyclic coordinates are given by their momenta p.

With the mass matrix in blocks, M_c of the cyclic and M_cn of the mixed entries, Routh's function is

    R = ½ q̇ₙᵀ (M_n − M_ncM_c⁻¹M_cn) q̇ₙ + … − V − ½ (p − b)ᵀ M_c⁻¹ (p − b),   p = M_c q̇_c + M_cn q̇ₙ + b.

It is the Lagrange function of a scene in two cases. If M_cn = 0, the cyclic coordinates are held and the last term
becomes a potential. If M_c is constant and M_cn = ∂P/∂qₙ, as for the displacement of a whole system, they follow the
others by q_c := q₀ − M_c⁻¹ P(qₙ), the motion seen from the centre of mass.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.3; Lurie, Analytical Mechanics, §7.16.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import singledispatch

import symengine as se

from ..errors import Problem, SceneError
from ..language.expression import Expression
from ..language.tree import TimeDerivative
from ..mechanics.kinetics import Distribution, Rotation, Translation
from ..mechanics.scene import Scene
from .equations import Equations, equations
from .functions import Expr
from .kinetic import ZERO, components
from .phase import vanishes
from .quadrature import integral
from .symbols import Symbols
from .symengine_algebra import to_symengine
from .writing import Writer


@dataclass(frozen=True)
class Reduction:
    """The effective potential, None where it is constant, and what each cyclic coordinate becomes.

    Those that are not in `values` are held.
    """

    potential: Expression | None
    values: Mapping[str, Expression]


def reduction(scene: Scene, momenta: Mapping[str, str], starts: Mapping[str, str]) -> Reduction:
    """The reduction of all cyclic coordinates; `momenta` and `starts` name the parameters of p and q₀ for each.

    Raises SceneError where Routh's function is the Lagrange function of no scene of format 1.
    """
    eqs = equations(scene)
    routh = _Routh(scene, eqs, tuple(momenta))
    energy = routh.centrifugal(tuple(eqs.symbols.values[name] for name in momenta.values()))
    writer = Writer(eqs.symbols, scene.names)
    slopes = (energy.diff(eqs.symbols.values[name]) for name in eqs.symbols.moving)
    potential = None if all(map(vanishes, slopes)) else writer.expression(energy)
    if routh.is_orthogonal:
        return Reduction(potential, {})
    shifts = routh.shifts()
    values = {
        name: writer.expression(eqs.symbols.values[starts[name]] - shift)
        for name, shift in zip(momenta, shifts, strict=True)
    }
    return Reduction(potential, values)


@dataclass(frozen=True)
class _Routh:
    scene: Scene
    eqs: Equations
    cyclic: tuple[str, ...]

    @property
    def _places(self) -> tuple[int, ...]:
        return tuple(self.eqs.symbols.free.index(name) for name in self.cyclic)

    @property
    def _others(self) -> tuple[int, ...]:
        return tuple(index for index in range(len(self.eqs.symbols.free)) if index not in self._places)

    def _still(self, expression: Expr) -> Expr:
        """The expression at q_c = 0, on which it does not depend."""
        values = self.eqs.symbols.values
        return se.sympify(expression).subs({values[name]: 0 for name in self.cyclic}).expand()

    @property
    def _masses(self) -> tuple[tuple[Expr, ...], ...]:
        """M_c"""
        return tuple(tuple(self._still(self.eqs.mass_matrix[i][j]) for j in self._places) for i in self._places)

    @property
    def is_orthogonal(self) -> bool:
        return all(vanishes(self.eqs.mass_matrix[i][j]) for i in self._places for j in self._others)

    def centrifugal(self, momenta: tuple[Expr, ...]) -> Expr:
        """½ (p − b)ᵀ M_c⁻¹ (p − b)"""
        symbols = self.eqs.symbols
        at_rest = dict.fromkeys((symbols.rates[name] for name in symbols.free), 0)
        moved = (self.eqs.kinetic.diff(symbols.rates[name]).subs(at_rest) for name in self.cyclic)
        free = [p - self._still(b) for p, b in zip(momenta, moved, strict=True)]
        return sum((a * b for a, b in zip(free, _solution(self._masses, free), strict=True)), ZERO) / 2

    def shifts(self) -> tuple[Expr, ...]:
        """M_c⁻¹ P, if there is such a P."""
        symbols, masses = self.eqs.symbols, self._masses
        kinetics = [part for body in self.scene.bodies for part in body.kinetics]
        for_each = [[_moment(part, name, symbols) for part in kinetics] for name in self.cyclic]
        moments = [self._still(sum(parts, ZERO)) for parts in for_each]
        gaps = [
            moment.diff(symbols.values[symbols.free[j]]) - self._still(self.eqs.mass_matrix[i][j])
            for i, moment in zip(self._places, moments, strict=True)
            for j in self._others
        ]
        moving = [symbols.values[name] for name in symbols.moving]
        slopes = [entry.diff(x) for row in masses for entry in row for x in moving]
        if self.scene.guides or not all(map(vanishes, (*gaps, *slopes))):
            raise SceneError(Problem("ladder-routh", parameters={"name": ", ".join(self.cyclic)}))
        return tuple(each.expand() for each in _solution(masses, moments))


@singledispatch
def _moment(_part: object, _name: str, _symbols: Symbols) -> Expr:
    """The share of a kinetic energy in P: m ∂r/∂q_c · r, and alike for rotations; checked by who asks."""
    return ZERO


@_moment.register
def _of_translation(part: Translation, name: str, symbols: Symbols) -> Expr:
    r = components(part.position, symbols)
    return to_symengine(part.mass, symbols) * sum((x.diff(symbols.values[name]) * x for x in r), ZERO)


@_moment.register
def _of_rotation(part: Rotation, name: str, symbols: Symbols) -> Expr:
    """Of a body that turns in the plane; in space there is no angle to speak of."""
    match part.angular_velocity:
        case (TimeDerivative(operand),):
            angle = to_symengine(operand, symbols)
            return to_symengine(part.inertia[0], symbols) * angle.diff(symbols.values[name]) * angle
    return ZERO


@_moment.register
def _of_distribution(part: Distribution, name: str, symbols: Symbols) -> Expr:
    inside = symbols.within(part.material)
    r = components(part.position, inside)
    moment = sum((x.diff(inside.values[name]) * x for x in r), ZERO)
    return integral(to_symengine(part.density, inside) * moment, part.material, inside)


def _solution(matrix: tuple[tuple[Expr, ...], ...], right: list[Expr]) -> list[Expr]:
    """Cramer's rule, which keeps a few small expressions short."""
    size = range(len(right))
    whole = _determinant(matrix)
    swapped = ([[right[i] if j == k else matrix[i][j] for j in size] for i in size] for k in size)
    return [_determinant(each) / whole for each in swapped]


def _determinant(matrix: object) -> Expr:
    return se.DenseMatrix(matrix).det().expand()
