"""The parts of the last chapter that a derivation is complete without, each within its share of operations.

A part whose share is used up is as if there were nothing to be found; `system.effort.left_out` tells so, as it does of
parts that have no law for scenes with constraints: symmetries that keep them, equilibria with constraints on
rates, or with such as follow from others.
"""

from __future__ import annotations

from ..vocabulary import OptionalPart, SearchEnd
from .bound_equilibria import is_sought, searched
from .conservation import Reduction, reduction
from .contact_equilibria import ContactSearch, contact_search
from .equilibria import Search
from .generator import Symmetry
from .impacts import bouncing, frictions
from .kink_equilibria import kink_search
from .linearization import Linearization, linearizations
from .rest_sets import RestSearch
from .steady import SteadyMotion, steady_motions
from .symmetry import is_searched, symmetries
from .system import System


def search_of(system: System) -> Search | None:
    """The search for equilibria."""
    if not is_sought(system):
        bound = all(condition.is_holonomic for condition in system.conditions)
        system.effort.left_out["equilibria"] = "dependent" if bound else "rates"
        return None
    found = system.effort.afford("equilibria", lambda: searched(system), None)
    if found and found.beyond:
        system.effort.left_out["equilibria"] = "ended"
    return found


def contact_search_of(system: System) -> ContactSearch | None:
    """The search for equilibria on closed contacts; None where there are none."""
    return system.effort.afford("contact-equilibria", lambda: contact_search(system), None)


def kink_search_of(system: System) -> RestSearch | None:
    """The search for equilibria at kinks, and for ranges of rest; None where time is in the laws."""
    return system.effort.afford("kink-equilibria", lambda: kink_search(system), None)


def left_out_of(system: System) -> SearchEnd | None:
    """Why not all positions of rest were found; None where they were, or where nothing was sought."""
    known, resting, kinked = search_of(system), contact_search_of(system), kink_search_of(system)
    if known is None or known.left_out in {"budget", "continuum", "singular"}:
        return known.left_out if known else None
    if kinked is None or not kinked.complete:
        return "friction" if frictions(system) else "kinks"
    is_all = not bouncing(system) or (resting is not None and resting.complete)
    return None if is_all else "contacts"


def motions_of(system: System) -> tuple[Linearization, ...]:
    """The small motions about the equilibria."""
    return linearizations(system) if search_of(system) else ()


def symmetries_of(system: System) -> tuple[Symmetry, ...]:
    """The symmetries besides those of cyclic coordinates and of time."""
    if _is_bound(system, "integrals"):
        return ()
    if not is_searched(system):
        system.effort.left_out["integrals"] = "budget"
    return system.effort.afford("integrals", lambda: symmetries(system), ())


def reduction_of(system: System) -> Reduction | None:
    """Routh's function."""
    if _is_bound(system, "relative-equilibria"):
        return None
    return system.effort.afford("relative-equilibria", lambda: reduction(system), None)


def steady_motions_of(system: System) -> tuple[SteadyMotion, ...]:
    """The relative equilibria."""
    if _is_bound(system, "relative-equilibria"):
        return ()
    return system.effort.afford("relative-equilibria", lambda: steady_motions(system), ())


def _is_bound(system: System, part: OptionalPart) -> bool:
    """Whether constraints keep the part from being sought."""
    if system.conditions:
        system.effort.left_out[part] = "constraints"
    return bool(system.conditions)
