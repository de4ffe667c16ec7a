"""Noether's theorem: where a small change of the motion δqᵢ = ε (ξᵢ − τ q̇ᵢ) changes L, with the work of the forces that
have no potential, by a total derivative ε dF/dt only, I = Σ ∂L/∂q̇ᵢ δqᵢ/ε − F is constant along the motion.

Source: Noether, Nachr. Ges. Wiss. Göttingen (1918) 235; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §13.7;
Arnold, Mathematical Methods of Classical Mechanics, 2nd ed., §20.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ..displacement import meaning
from ..formula import (
    Called,
    Directional,
    Explicit,
    Formula,
    Inserted,
    Named,
    Partial,
    Plus,
    Quantity,
    Rate,
    Term,
    Times,
    minus,
)
from ..generator import Symmetry, solved
from ..impacts import contacts_of
from ..step import Relation, Step
from ..system import System

RULE = "noether"
SIZE = sp.Rational(1, 7)  # of ε, when a step is verified: the lines hold for every value


def apply(system: System, symmetry: Symmetry, number: int) -> Step:
    """The generator, what it does to L, the integral, and its rate by Lagrange's equations."""
    changes = symmetry.generator.characteristic(system)
    gauge = system.display(symmetry.gauge_at_fixed_time(system))
    integral = Named(Quantity("integral-of-motion", str(number)), symmetry.value)
    lines = (
        *_conditions(system, symmetry),
        *(_change(system, q, change) for q, change in changes.items()),
        _invariance(system, changes, gauge),
        Relation((integral, _law(system, changes, gauge), Explicit(symmetry.value))),
        Relation((Rate(integral), _left_sides(system, changes))),
    )
    special = solved(symmetry.conditions, system)
    kept = tuple(_under(line, special) for line in lines) if special else lines
    return Step(RULE, str(number), kept, (), _about(system, symmetry, number))


def _about(system: System, symmetry: Symmetry, number: int) -> dict[str, str]:
    what = meaning(system, symmetry.generator)
    moved = ", ".join(symmetry.generator.shifts)
    outcome = _outcome(system, symmetry)
    if symmetry.conditions:
        outcome += "-special"
    word = f"{what.word}-of" if what.bodies else what.word
    met = contacts_of(system, symmetry.generator)
    between = {"contacts": ", ".join(met)} if met else {}
    about = between | {
        "outcome": outcome,
        "symmetry": word,
        "integral": word,
        "number": str(number),
        "coordinate": moved,
    }
    return {**about, "place": ", ".join(what.bodies)} if what.bodies else about


def _outcome(system: System, symmetry: Symmetry) -> str:
    """What the change does to L; `impulse` where it is always the same and the forces along it depend on time alone.

    Then it is not the momentum that is conserved, but what is left of it without their impulse.
    """
    if symmetry.generator.time != 0:
        return "time"
    if symmetry.gauge == 0:
        return "invariant"
    time = sp.Symbol("t", real=True)
    moving = {symbol for q in system.coordinates for symbol in (system.q(q), system.rate(q))}
    grows = any(change.has(time) for change in symmetry.generator.shifts.values())
    return "gauge" if grows or symmetry.gauge.free_symbols & moving else "impulse"


def _under(line: Relation, special: Mapping[sp.Symbol, sp.Expr]) -> Relation:
    """The line for these values of the parameters."""
    return Relation(tuple(Inserted(member, special) for member in line.members), line.sign)


def _conditions(system: System, symmetry: Symmetry) -> tuple[Relation, ...]:
    """What the parameters must fulfil: κ = 1."""
    found = solved(symmetry.conditions, system)
    return tuple(Relation((Explicit(symbol), Explicit(value))) for symbol, value in found.items())


def epsilon(system: System) -> sp.Symbol:
    """The small number of a change."""
    return system.fresh(*(name for name in ("epsilon", "eta", "sigma", "varepsilon_0") if name != system.h.name))


def _change(system: System, coordinate: str, change: sp.Expr) -> Relation:
    """δq = ε (ξ − τ q̇)"""
    small = epsilon(system)
    variation = Inserted(Explicit(system.variation(coordinate)), {system.variation(coordinate): SIZE * change})
    shown = system.display(change)
    turned = shown.could_extract_minus_sign()
    product = _times_epsilon(small, -shown if turned else shown)
    return Relation((variation, Inserted(Plus((Term(product, (), -1 if turned else 1),)), {small: SIZE})))


def _times_epsilon(small: sp.Symbol, change: sp.Expr) -> Formula:
    return Explicit(small) if change == 1 else Times((Explicit(small), Explicit(change)))


def _invariance(system: System, changes: Mapping[str, sp.Expr], gauge: sp.Expr) -> Relation:
    """δL + Σ Qᵢᵈ δqᵢ = ε dF/dt"""
    small = epsilon(system)
    along = {system.q(q): SIZE * change for q, change in changes.items()}
    along |= {system.rate(q): SIZE * system.time_derivative(change) for q, change in changes.items()}
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    varied = Called(Quantity("variation-of-lagrangian"), Directional(lagrangian, along, system.h))
    directions = {system.variation(q): SIZE * change for q, change in changes.items()}
    works = (
        Term(Times((Named(Quantity("nonconservative-force", q), force), Explicit(system.variation(q)))))
        for q in changes
        if (force := system.nonconservative_force(q)) != 0
    )
    whole = Plus((Term(varied), *works))
    nothing: Formula = Explicit(system.zero)
    right = Inserted(Times((Explicit(small), Rate(Explicit(gauge)))), {small: SIZE}) if gauge != 0 else nothing
    return Relation((Inserted(whole, directions), right))


def _law(system: System, changes: Mapping[str, sp.Expr], gauge: sp.Expr) -> Formula:
    """Σ pᵢ (ξᵢ − τ q̇ᵢ) − F"""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    parts = [Term(_product(change, Partial(lagrangian, system.rate(q)))) for q, change in changes.items()]
    return Plus((*parts, minus(Explicit(gauge)))) if gauge != 0 else Plus(tuple(parts))


def _product(change: sp.Expr, of: Formula) -> Formula:
    if change == 1:
        return of
    return Times((Explicit(change), of))


def _left_sides(system: System, changes: Mapping[str, sp.Expr]) -> Formula:
    """Σ (ξᵢ − τ q̇ᵢ)(d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ − Qᵢᵈ), where every bracket vanishes along the motion."""
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)

    def left(q: str) -> Formula:
        slope = Rate(Partial(lagrangian, system.rate(q)))
        force = system.nonconservative_force(q)
        outside = (minus(Named(Quantity("nonconservative-force", q), force)),) if force != 0 else ()
        return Plus((Term(slope), minus(Partial(lagrangian, system.q(q))), *outside))

    return Plus(tuple(Term(_product(change, left(q))) for q, change in changes.items()))
