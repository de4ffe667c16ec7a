"""Closed loop: forces have a potential only if their work along every closed path in the coordinates is zero.

Around a rectangle in two coordinates, the others and the time held fixed, it is W = ∮ Qᵢ dqᵢ.
Source: Arnold, Mathematical Methods of Classical Mechanics, 2nd ed., §5 and §6.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import sympy as sp

from ..antiderivative import antiderivative
from ..formula import Bounds, Explicit, Formula, Integral, Named, Plus, Quantity, Substituted, Term
from ..step import Relation, Step
from ..system import System

RULE = "closed-loop"


@dataclass(frozen=True)
class _Edge:
    """One side of the rectangle: along one coordinate, the other held at a value."""

    along: str
    across: str
    value: sp.Expr
    sign: int


def apply(system: System, load: str) -> Step | None:
    """The first rectangle whose work is not zero; none if its work has no closed form."""
    for first, second in combinations(system.free, 2):
        work = _work(system, load, first, second)
        if work is not None and not system.is_zero(work):
            return _step(system, load, first, second, work)
    return None


def _step(system: System, load: str, first: str, second: str, work: sp.Expr) -> Step:
    name = Named(Quantity("work-of-loop"), work)
    sides = _edges(system, first, second)
    law = Plus(tuple(Term(_integral(system, load, edge), (f"load:{load}",), edge.sign) for edge in sides))
    lines = (Relation((name, law, Explicit(work))), Relation((name, Explicit(system.zero)), "≠"))
    return Step(RULE, load, lines, (f"load:{load}",), {"load": load, "coordinate": f"{first}, {second}"})


def _edges(system: System, first: str, second: str) -> tuple[_Edge, ...]:
    """Around the rectangle from the origin, first along the first coordinate."""
    return (
        _Edge(first, second, system.zero, 1),
        _Edge(second, first, _side(system, first), 1),
        _Edge(first, second, _side(system, second), -1),
        _Edge(second, first, system.zero, -1),
    )


def _side(system: System, coordinate: str) -> sp.Expr:
    """How far along a coordinate: a right angle, or a parameter of the same unit, or 1."""
    unit = next(c.unit for c in system.scene.coordinates if c.name == coordinate)
    if unit == "rad":
        return sp.pi / 2
    alike = (p for p in system.scene.parameters if p.unit == unit and p.positive and unit)
    found = next(alike, None)
    return sp.Integer(1) if found is None else system.q(found.name)


def _force(system: System, load: str, edge: _Edge) -> sp.Expr:
    return system.load_force(load, edge.along).xreplace({system.q(edge.across): edge.value})


def _integral(system: System, load: str, edge: _Edge) -> Formula:
    force = Named(Quantity("generalized-force", edge.along, load), system.load_force(load, edge.along))
    there = Substituted(force, {system.q(edge.across): edge.value})
    return Integral(there, (Bounds(system.q(edge.along), system.zero, _side(system, edge.along)),))


def _work(system: System, load: str, first: str, second: str) -> sp.Expr | None:
    total = system.zero
    for edge in _edges(system, first, second):
        force, q = _force(system, load, edge), system.q(edge.along)
        if force.atoms(sp.Function) - force.atoms(sp.sin, sp.cos) or _has_roots(force, q):
            return None
        whole = antiderivative(force, q, system.symbols)
        if whole is None:
            return None
        total += edge.sign * (whole.xreplace({q: _side(system, edge.along)}) - whole.xreplace({q: system.zero}))
    return system.display(total)


def _has_roots(force: sp.Expr, q: sp.Symbol) -> bool:
    """Whether the coordinate stands under a root or a fraction line, where an integral may take long."""
    return any(power.base.has(q) and not (power.exp.is_Integer and power.exp > 0) for power in force.atoms(sp.Pow))
