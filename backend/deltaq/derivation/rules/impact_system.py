"""Impact with constraints: the jumps of the rates and all impulses from one linear system,

    ⎡ M  Aᵀ wᵀ ⎤ ⎡ Δq̇  ⎤   ⎡     0      ⎤
    ⎢ A  0  0  ⎥ ⎢ −Λ_c ⎥ = ⎢     0      ⎥   with w = ∂g/∂q.
    ⎣ w  0  0  ⎦ ⎣ −Λ   ⎦   ⎣ −(1 + e) ġ ⎦

Constraints hold before and behind the impact, so that their rates do not jump; Newton's hypothesis says how the gap
opens. The matrix is that of accelerations and multipliers with one row more.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 8; Haug, Computer Aided Kinematics and
Dynamics, vol. 1, ch. 7.
"""

from __future__ import annotations

import sympy as sp

from ...mechanics.event import Event
from ..calculus import column
from ..formula import Equation, Explicit, Formula, MatrixTimes, Named, Plus, Quantity, Stack, Term, Times, minus
from ..impacts import bouncing, gap_rate, restitution, slopes
from ..matrix_form import mass_matrix
from ..step import Relation, Step
from ..system import System
from .augmented_system import RULE as AUGMENTED
from .augmented_system import augmented_matrix
from .constrained_variation import slope
from .contact_gap import RULE as GAP
from .contact_gap import slope_of

RULE = "impact-system"


def apply(system: System, event: Event) -> Step:
    """The laws one below the other, and as one system with its matrix written out."""
    laws = [_momentum_law(system, event, q) for q in system.free]
    laws += [_along(system, {q: slope(system, each, q) for q in system.bound(each)}) for each in system.conditions]
    laws.append(_along(system, {q: slope_of(system, event, q) for q in slopes(system, event)}))
    opening = Explicit(system.display(-(1 + restitution(system, event)) * gap_rate(system, event)))
    still: list[Formula] = [Explicit(system.zero)] * (len(laws) - 1)
    right = column([*(system.zero for _ in still), opening.value])
    impulses = (Plus((minus(each),)) for each in _impulses(system, event))
    unknown = Stack((*(_jump(system, q) for q in system.free), *impulses))
    written = Equation(MatrixTimes(Explicit(_matrix(system, event)), unknown), Explicit(right))
    line = Relation((Equation(Stack(tuple(laws)), Stack((*still, opening))), written), "⇔")
    premises = (f"{GAP}:{event.name}", AUGMENTED)
    return Step(RULE, event.name, (line,), system.constraint_sources, {"event": event.name}, premises=premises)


def _jump(system: System, coordinate: str) -> Named:
    """Δq̇: a symbol that is free at the points of the verification stands for it, as for the impulses."""
    return Named(Quantity("rate-jump", coordinate), system.variation(coordinate))


def _impulses(system: System, event: Event) -> list[Named]:
    """Λ of each constraint, then that of the contact."""
    pairs = zip(system.conditions, system.multipliers, strict=True)
    of = event.name if len(bouncing(system)) > 1 else ""
    answers = (Named(Quantity("constraint-impulse", each.source), symbol) for each, symbol in pairs)
    return [*answers, Named(Quantity("impulse", of), system.omega)]


def _momentum_law(system: System, event: Event, coordinate: str) -> Formula:
    """Σ Mᵢⱼ Δq̇ⱼ − Σ Λ_c aᵢ − Λ ∂g/∂qᵢ"""
    row = mass_matrix(system).row(system.free.index(coordinate))
    masses = ((entry, q) for entry, q in zip(row, system.free, strict=True) if entry != 0)
    inertia = tuple(Term(Times((Explicit(entry), _jump(system, q)))) for entry, q in masses)
    *answers, contact = _impulses(system, event)
    acting = [
        minus(Times((name, slope(system, each, coordinate))))
        for name, each in zip(answers, system.conditions, strict=True)
        if coordinate in system.bound(each)
    ]
    if coordinate in slopes(system, event):
        acting.append(minus(Times((contact, slope_of(system, event, coordinate)))))
    return Plus((*inertia, *acting))


def _along(system: System, factors: dict[str, Formula]) -> Formula:
    """Σ aᵢ Δq̇ᵢ"""
    return Plus(tuple(Term(Times((factor, _jump(system, q)))) for q, factor in factors.items()))


def _matrix(system: System, event: Event) -> sp.ImmutableMatrix:
    """The matrix of accelerations and multipliers, bordered by ∂g/∂q."""
    inner, along = augmented_matrix(system), slopes(system, event)
    row = [along.get(q, system.zero) for q in system.free] + [system.zero] * len(system.conditions)
    border = sp.Matrix([row])
    return sp.ImmutableMatrix(sp.Matrix([[inner, border.T], [border, sp.zeros(1, 1)]]))
