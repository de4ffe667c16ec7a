"""A range of rest: nothing starts what rests anywhere between its ends, f₊ ≤ 0 ≤ f₋.

Source: Magnus, Popp, Sextro, Schwingungen, 8th ed., §3.1.3.
"""

from __future__ import annotations

import sympy as sp
from flint import ctx

from ..equilibria import BITS, start_point
from ..formula import Inserted, Named, Quantity
from ..program import number as value_of
from ..refinement import rational
from ..rest_sets import Place, RestRange
from ..step import Relation, Step
from ..system import System
from ._shape import numbers
from .kink_equilibrium import written

RULE = "rest-range"


def apply(system: System, found: RestRange, number: int) -> Step:
    """Its ends, where it has any."""
    q = system.q(found.coordinate)
    ends = [None if end is None else written(system, end.value, exact=end.exact) for end in (found.low, found.high)]
    inside = Inserted(
        Named(Quantity("coordinate", found.coordinate), q), {**numbers(system), q: _inside(system, found)}
    )
    members = tuple(each for each in (ends[0], inside, ends[1]) if each is not None)
    outcome = "friction" if found.by_friction else "flat"
    return Step(RULE, str(number), (Relation(members, "≤"),), (), {"outcome": outcome, "number": str(number)})


def _inside(system: System, found: RestRange) -> sp.Expr:
    """A place between both ends, or beyond the only one."""
    low, high = (None if end is None else _number(system, end) for end in (found.low, found.high))
    if low is not None and high is not None:
        return (low + high) / 2
    return low + 1 if low is not None else high - 1 if high is not None else sp.Integer(0)


def _number(system: System, place: Place) -> sp.Expr:
    with ctx.workprec(BITS):
        return rational(value_of(place.value, start_point(system)))
