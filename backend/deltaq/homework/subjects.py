"""What a quantity is asked of: bodies, coordinates, or the scene as a whole ("")."""

from __future__ import annotations

import sympy as sp

from ..derivation.multipliers import multipliers
from ..derivation.optional import motions_of
from ..language.display import size
from .equality import frequencies
from .solution import Solution

MOST_SYMMETRIES = 6
LONGEST_AT_REST = 60  # parts of a multiplier in a position of rest


def bodies(solution: Solution) -> list[str]:
    """Each body."""
    return [body.name for body in solution.scene.bodies]


def coordinates(solution: Solution) -> tuple[str, ...]:
    """Each free coordinate."""
    return solution.free


def whole(_solution: Solution) -> tuple[str, ...]:
    """The scene as a whole."""
    return ("",)


def loaded(solution: Solution) -> tuple[str, ...]:
    """The scene, if loads act on it."""
    return ("",) if solution.load_names else ()


def with_potential(solution: Solution) -> tuple[str, ...]:
    """The scene, if a load has a potential that does anything: that of a spring of constant length is a constant."""
    moving = (not solution.is_zero(solution.potential_slope(q)) for q in solution.free)
    return ("",) if any(map(solution.is_conservative, solution.load_names)) and any(moving) else ()


def coupled(solution: Solution) -> tuple[str, ...]:
    """The scene, if it has several degrees of freedom."""
    return ("",) if len(solution.free) > 1 else ()


def resting(solution: Solution) -> tuple[str, ...]:
    """Each free coordinate, if there is a position of rest at which the equations have slopes; √(ẋ² + ẏ²) has none."""
    return solution.free if solution.rest is not None and _has_slopes(solution) else ()


def _has_slopes(solution: Solution) -> bool:
    return not any(solution.linear_equation(q).has(sp.nan, sp.zoo) for q in solution.free)


def oscillating(solution: Solution) -> tuple[str, ...]:
    """The scene, if it oscillates about a position of rest."""
    return ("",) if solution.rest is not None and _positive(solution) else ()


def _positive(solution: Solution) -> bool:
    return bool(solution.frequencies) and all(
        frequencies.number_of(each, solution) > 1e-9 for each in solution.frequencies
    )


def reacting(solution: Solution) -> tuple[str, ...]:
    """Each constraint, if its multiplier is short enough to be asked for."""
    found = multipliers(solution.model)
    return tuple(condition.source for condition in solution.conditions) if found else ()


def struck(solution: Solution) -> list[str]:
    """Each coordinate whose momentum jumps: of the first contact by its name, of others as `contact:coordinate`."""
    first = solution.bounces[:1]
    return [
        q if contact in first else f"{contact}:{q}" for contact in solution.bounces for q in solution.struck_by(contact)
    ]


def contact_of(solution: Solution, subject: str) -> str:
    """The contact of a subject: its own name, that before a coordinate, or the first one."""
    name = subject.partition(":")[0]
    return name if name in solution.bounces else "".join(solution.bounces[:1])


def coordinate_of(subject: str) -> str:
    """The coordinate of `contact:coordinate`, or the subject itself."""
    return subject.rpartition(":")[2]


def carrying(solution: Solution) -> tuple[str, ...]:
    """Each constraint whose multiplier is known in closed form where the system rests, stably if anywhere."""
    known = motions_of(solution.model) if solution.conditions else ()
    if not known or not known[0].equilibrium.exact or known[0].equilibrium.is_family:
        return ()
    return tuple(each.source for each in solution.conditions if _is_short(solution, each.source))


def _is_short(solution: Solution, source: str) -> bool:
    """Whether λ₀ of a constraint can be read, and there is something to be told."""
    value = solution.rest_reaction(source)
    return value != 0 and size(value) <= LONGEST_AT_REST


def numbered(solution: Solution) -> list[str]:
    """Each conserved quantity, by its number."""
    return [str(n) for n, _ in enumerate(solution.conserved_of, 1)]


def symmetric(solution: Solution) -> list[str]:
    """Each integral of a symmetry that is not seen at a glance, by its number, the first ones."""
    return list(solution.symmetries)[:MOST_SYMMETRIES]
