"""The search for equilibria: how many there are, where they were sought, and whether that is all of them.

An enclosure of the forces over a box that leaves out zero proves that there is none in it.
Source: Neumaier, Interval Methods for Systems of Equations, §5.1; Basu, Pollack, Roy, Algorithms in Real Algebraic
Geometry, §10.2.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import sympy as sp

from ...vocabulary import SearchEnd
from ..contact_equilibria import ContactSearch
from ..equilibria import Search
from ..formula import Explicit, Inserted, Named, Quantity
from ..optional import contact_search_of, kink_search_of, left_out_of
from ..rest_sets import RestSearch
from ..step import Relation, Step
from ..system import System

RULE = "equilibrium-search"


def apply(system: System, search: Search, shown: int, others: tuple[Step, ...]) -> Step:
    """The ranges, and the equilibria that are not told in full, one below the other."""
    resting, kinked = contact_search_of(system), kink_search_of(system)
    about = {"outcome": _outcome(system, search, resting, kinked), "shown": str(shown), "count": str(search.count)}
    about["listed"] = str(len(search.found))
    if search.left_out == "contacts" or "kinks" in about["outcome"]:
        about["resting"] = str(len(resting.found) if resting else 0)
    if "kinks" in about["outcome"]:
        about["kinks"] = str(len(kinked.kinks) if kinked else 0)
        about["spans"] = str(len(kinked.found) if kinked else 0)
    ranges = {**(kinked.ranges if kinked else {}), **(resting.ranges if resting else {}), **search.ranges}
    return Step(RULE, "", tuple(_ranges(system, ranges)), (), about, others, premises=("equilibrium-condition",))


def _outcome(system: System, search: Search, resting: ContactSearch | None, kinked: RestSearch | None) -> str:
    reason = left_out_of(system)
    if reason != "contacts" and (reason == "kinks" or _is_kinked(search, kinked)):
        return _outcome_with_kinks(system, search, kinked, reason)
    if search.left_out == "contacts":
        return _outcome_with_contacts(search, resting)
    if reason:
        return reason if search.found else f"{reason}-none"
    if not search.found:
        return "none-in-range"
    if search.count > len(search.found):
        return "many-in-range" if search.ranges else "many"
    return "in-range" if search.ranges else "everywhere"


def _is_kinked(search: Search, kinked: RestSearch | None) -> bool:
    """Whether there is rest at kinks or in ranges, or jumps at which it was sought."""
    return search.left_out == "kinks" or bool(kinked and (kinked.kinks or kinked.found))


def _outcome_with_kinks(system: System, search: Search, kinked: RestSearch | None, reason: SearchEnd | None) -> str:
    resting = contact_search_of(system)
    is_any = bool(search.found or (kinked and (kinked.kinks or kinked.found)) or (resting and resting.found))
    if reason:
        return f"{'kinks' if reason == 'kinks' else f'{reason}-with-kinks'}{'' if is_any else '-none'}"
    ranged = "-in-range" if search.ranges or (kinked and kinked.ranges) else ""
    return f"kinks-{'all' if is_any else 'without'}{ranged}"


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
        ends = [Explicit(sp.Rational(str(round(end, 6)))) for end in (low, high)]
        yield Relation((ends[0], Inserted(q, {system.q(name): sp.Integer(0)}), ends[1]), "≤")
