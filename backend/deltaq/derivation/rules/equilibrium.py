"""Stability: an equilibrium is stable where the potential has a strict minimum, and unstable where small motions grow.

Source: Lagrange, Mécanique analytique (1788), part 1, §3; Dirichlet, J. reine angew. Math. 32 (1846), 85; Merkin,
Introduction to the Theory of Stability, §2.3 and §4.2.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..conservation import potential_that_decides
from ..formula import AtEquilibrium, Formula, Inserted
from ..linearization import Linearization
from ..matrix_form import forces_at_rest
from ..step import Relation, Step
from ..system import System
from ._shape import at_rest, balanced, multiplier, numbers, place, shaped, zero

RULE = "equilibrium"


def apply(system: System, linear: Linearization, number: int) -> Step:
    """Where it is, the proof that nothing acts there, and how it behaves."""
    # The rates first: a damper whose ends meet has no direction there, but its force is zero while nothing moves.
    force = balanced(system, shaped("forcing", "vector", forces_at_rest(system)))
    laws = (force, *map(system.named_condition, system.conditions))
    proofs = (Relation((_there(system, linear, law), zero(rows))) for law, rows in _rows(system, laws))
    known = linear.equilibrium
    places = tuple(place(system, known, q) for q in system.free if system.q(q) in known.values)
    free = tuple(q for q in linear.equilibrium.free if _moves(system, linear, q))
    about = {"outcome": _outcome(linear, free), "number": str(number), "coordinate": ", ".join(free)}
    about |= potential_that_decides(system)
    if linear.verdict.derivative:
        about["derivative"] = str(linear.verdict.derivative)
        about["degree"] = str(linear.verdict.derivative + 1)
    held = tuple(multiplier(system, symbol, known) for symbol in system.multipliers)
    return Step(RULE, str(number), (*places, *held, *proofs), (), about)


def _moves(system: System, linear: Linearization, coordinate: str) -> bool:
    """Whether a coordinate that may be chosen freely moves anything: at ϑ = 0 the azimuth of a pendulum does not."""
    if linear.tangent is not None:  # its masses are those of other coordinates
        return True
    return not linear.mass[:, system.free.index(coordinate)].is_zero_matrix


def _rows(system: System, laws: tuple[Formula, ...]) -> Iterator[tuple[Formula, int]]:
    """The forces have as many as there are coordinates, a constraint has one."""
    return ((law, len(system.free) if place == 0 else 1) for place, law in enumerate(laws))


def _there(system: System, linear: Linearization, law: Formula) -> Formula:
    there = AtEquilibrium(law, at_rest(system, linear.equilibrium))
    return there if linear.equilibrium.exact else Inserted(there, numbers(system))


def _outcome(linear: Linearization, free: tuple[str, ...]) -> str:
    """Which sentence is true: where it cannot be linearized that is said as well, and what nothing holds."""
    if linear.verdict.kind:
        return f"{linear.verdict.kind}-{linear.stability}"
    rest = "-in-the-others" if linear.stability == "stable" and free else ""
    if linear.spectrum is None:
        reason = "singular" if linear.is_smooth else "jumps"
        return reason if linear.stability == "undecided" else f"{reason}-{linear.stability}{rest}"
    if linear.verdict.derivative > 1:
        return f"{linear.stability}-by-{'form' if linear.verdict.by_form else 'derivative'}{rest}"
    return f"{linear.stability}{rest}"
