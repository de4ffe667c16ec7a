"""Dry friction: it holds a system at rest wherever the other forces are not larger than it, in either direction.

Source: Magnus, Popp, Sextro, Schwingungen, 8th ed., §3.1.3.
"""

from __future__ import annotations

import sympy as sp

from ..formula import AtEquilibrium, Explicit, Formula, Inserted, Named, Quantity, Rounded, Substituted
from ..friction import Band, directions
from ..linearization import Linearization
from ..step import Relation, Step
from ..system import System
from ._shape import at_rest, numbers, zero

RULE = "friction-band"


def apply(system: System, linear: Linearization, band: Band, number: int) -> Step:
    """Both ends, at each of which the force in one direction vanishes: the same one, where friction wins in between."""
    (name,) = system.free
    q = system.q(name)
    here = Inserted(Named(Quantity("coordinate", name), q), {**numbers(system), **at_rest(system, linear.equilibrium)})
    low, high = (_written(system, band, end) for end in (band.low, band.high))
    lines = [Relation((low, Inserted(here, numbers(system)), high), "≤")]
    forces = directions(system) or ()
    ends = [(min(forces, key=lambda force: _gap(system, force, end)), end) for end in (band.low, band.high)]
    for force, end in sorted(ends, key=lambda each: forces.index(each[0])):
        there = (Substituted if band.exact else AtEquilibrium)(Explicit(force), {q: end})
        lines.append(Relation((there if band.exact else Inserted(there, numbers(system)), zero(1))))
    return Step(RULE, str(number), tuple(lines), (), {"number": str(number)}, premises=(f"equilibrium:{number}",))


def _written(system: System, band: Band, value: sp.Expr) -> Formula:
    shown = Explicit(value) if band.exact else Rounded(value)
    return Inserted(shown, numbers(system))


def _gap(system: System, force: sp.Expr, value: sp.Expr) -> float:
    (name,) = system.free
    there = force.xreplace({system.q(name): value})
    return abs(float(there.xreplace(dict(system.parameter_values))))
