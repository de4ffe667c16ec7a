"""What a derivation leads to, as expressions: the answer that programs read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from ..mechanics.scene import Scene
from .system import System
from .terms import terms_by_source


@dataclass(frozen=True)
class Conserved:
    """A quantity that does not change along the motion: a momentum or the Jacobi energy."""

    kind: str
    coordinate: str
    value: sp.Expr


@dataclass(frozen=True)
class Result:
    """Expressions in the scene's symbols; vectors are columns, forces and equations go by coordinate.

    An equation is the left side of `… = 0`; mass matrix and forcing are those of M(q, t) q̈ = f(q, q̇, t).
    """

    scene: Scene
    positions: Mapping[str, sp.ImmutableMatrix]
    virtual_displacements: Mapping[str, sp.ImmutableMatrix]
    virtual_work: sp.Expr
    kinetic_energy: sp.Expr
    potential_energy: sp.Expr
    total_forces: Mapping[str, sp.Expr]
    conservative_forces: Mapping[str, sp.Expr]
    nonconservative_forces: Mapping[str, sp.Expr]
    lagrangian: sp.Expr
    equations: Mapping[str, sp.Expr]
    mass_matrix: sp.ImmutableMatrix
    forcing: sp.ImmutableMatrix
    conserved: tuple[Conserved, ...]


def result_of(system: System) -> Result:
    bodies = [body.name for body in system.scene.bodies]
    equations = {q: _equation(system, q) for q in system.free}
    accelerations = [system.acceleration(q) for q in system.free]
    return Result(
        scene=system.scene,
        positions={name: system.position(name) for name in bodies},
        virtual_displacements={name: system.virtual_displacement(name) for name in bodies},
        virtual_work=system.collected(sum(map(system.virtual_work, system.scene.contributions), system.zero)),
        kinetic_energy=system.kinetic_energy,
        potential_energy=system.potential_energy,
        total_forces={q: system.generalized_force(q) for q in system.free},
        conservative_forces={q: system.derivative(-system.potential_energy, system.q(q)) for q in system.free},
        nonconservative_forces={q: system.nonconservative_force(q) for q in system.free},
        lagrangian=system.lagrangian,
        equations=equations,
        mass_matrix=system.display(
            sp.ImmutableMatrix([[e.diff(a) for a in accelerations] for e in equations.values()])
        ),
        forcing=system.display(sp.ImmutableMatrix([[_rest(e, accelerations)] for e in equations.values()])),
        conserved=tuple(_conserved(system)),
    )


def _equation(system: System, coordinate: str) -> sp.Expr:
    terms = terms_by_source(system, coordinate)
    return sp.Add(*(term.sign * term.formula.value for term in terms))  # type: ignore[union-attr]


def _rest(equation: sp.Expr, accelerations: list[sp.Symbol]) -> sp.Expr:
    return -equation.xreplace(dict.fromkeys(accelerations, sp.Integer(0)))


def _conserved(system: System) -> list[Conserved]:
    """Momenta of cyclic coordinates, and the Jacobi energy Σ q̇ ∂L/∂q̇ − L where L does not depend on time."""
    passive = {q: system.is_zero(system.nonconservative_force(q)) for q in system.free}
    lagrangian = system.lagrangian
    found = [
        Conserved("momentum", q, system.momentum(q))
        for q in system.free
        if passive[q] and system.is_zero(lagrangian.diff(system.q(q)))
    ]
    if all(passive.values()) and not lagrangian.has(system.t):
        work = sp.Add(*(system.rate(q) * system.momentum(q) for q in system.free))
        found.append(Conserved("energy", "", system.display(work - lagrangian)))
    return found
