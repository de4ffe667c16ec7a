"""The search for equilibria: how many there are, where they were sought, and whether that is all of them.

An enclosure of the forces over a box that leaves out zero proves that there is none in it.
Source: Neumaier, Interval Methods for Systems of Equations, §5.1; Basu, Pollack, Roy, Algorithms in Real Algebraic
Geometry, §10.2.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import sympy as sp

from ..contact_equilibria import ContactSearch
from ..equilibria import Search
from ..formula import Explicit, Inserted, Named, Quantity
from ..step import Relation, Step
from ..system import System

RULE = "equilibrium-search"


def apply(system: System, search: Search, resting: ContactSearch | None, shown: int, others: tuple[Step, ...]) -> Step:
    """The ranges, and the equilibria that are not told in full, one below the other."""
    about = {"outcome": _outcome(search, resting), "shown": str(shown), "count": str(search.count)}
    about["listed"] = str(len(search.found))
    if search.left_out == "contacts":
        about["resting"] = str(len(resting.found) if resting else 0)
    ranges = {**(resting.ranges if resting else {}), **search.ranges}
    return Step(RULE, "", tuple(_ranges(system, ranges)), (), about, others, premises=("equilibrium-condition",))


def _outcome(search: Search, resting: ContactSearch | None) -> str:
    if search.left_out == "contacts":
        return _outcome_with_contacts(search, resting)
    if not search.complete:
        return search.left_out if search.found else f"{search.left_out}-none"
    if not search.found:
        return "none-in-range"
    if search.count > len(search.found):
        return "many-in-range" if search.ranges else "many"
    return "in-range" if search.ranges else "everywhere"


def _outcome_with_contacts(search: Search, resting: ContactSearch | None) -> str:
    is_any = bool(search.found or (resting and resting.found))
    if resting is None or not resting.complete:
        return "contacts" if is_any else "contacts-none"
    ranged = "-in-range" if search.ranges or resting.ranges else ""
    return f"contacts-{'all' if is_any else 'without'}{ranged}"


def _ranges(system: System, ranges: Mapping[str, tuple[float, float]]) -> Iterator[Relation]:
    """−10 ≤ x ≤ 10"""
    for name, (low, high) in ranges.items():
        q = Named(Quantity("coordinate", name), system.q(name))
        ends = [Explicit(sp.nsimplify(round(end, 6), rational=True)) for end in (low, high)]
        yield Relation((ends[0], Inserted(q, {system.q(name): sp.Integer(0)}), ends[1]), "≤")
