"""The search for equilibria: how many there are, where they were sought, and whether that is all of them.

An enclosure of the forces over a box that leaves out zero proves that there is none in it.
Source: Neumaier, Interval Methods for Systems of Equations, §5.1; Basu, Pollack, Roy, Algorithms in Real Algebraic
Geometry, §10.2.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..equilibria import Search
from ..formula import Explicit, Inserted, Named, Quantity
from ..step import Relation, Step
from ..system import System

RULE = "equilibrium-search"


def apply(system: System, search: Search, shown: int, others: tuple[Step, ...]) -> Step:
    """The ranges, and the equilibria that are not told in full, one below the other."""
    about = {"outcome": _outcome(search), "shown": str(shown), "count": str(search.count)}
    about["listed"] = str(len(search.found))
    return Step(RULE, "", tuple(_ranges(system, search)), (), about, others, premises=("equilibrium-condition",))


def _outcome(search: Search) -> str:
    if not search.complete:
        return search.left_out if search.found else f"{search.left_out}-none"
    if not search.found:
        return "none-in-range"
    if search.count > len(search.found):
        return "many-in-range" if search.ranges else "many"
    return "in-range" if search.ranges else "everywhere"


def _ranges(system: System, search: Search) -> Iterator[Relation]:
    """−10 ≤ x ≤ 10"""
    for name, (low, high) in search.ranges.items():
        q = Named(Quantity("coordinate", name), system.q(name))
        ends = [Explicit(sp.nsimplify(round(end, 6), rational=True)) for end in (low, high)]
        yield Relation((ends[0], Inserted(q, {system.q(name): sp.Integer(0)}), ends[1]), "≤")
