"""Relative equilibrium: a motion whose cyclic coordinates run evenly while the others rest, an equilibrium of Routh's
function. U(q, p), which is −R at rest, has there ∂U/∂q = 0; with fixed momenta it is stable if ∂²U/∂q² > 0.

Source: Routh, Stability of a Given State of Motion (1877); Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §3.3
and §5.7; Merkin, Introduction to the Theory of Stability, §3.5.
"""

from __future__ import annotations

import sympy as sp

from ..formula import AtEquilibrium, Explicit, Inserted, Named, Partial, Power, Quantity, Substituted
from ..steady import SteadyMotion
from ..step import Relation, Step
from ..system import System

RULE = "relative-equilibrium"


def apply(system: System, motion: SteadyMotion, number: int) -> Step:
    """The effective potential, the rate that balances, the proof that it does, and the curvature."""
    q, turning = system.q(motion.coordinate), system.rate(motion.turning)
    lagrangian = Named(Quantity("lagrangian"), system.lagrangian)
    potential = Named(Quantity("effective-potential"), motion.potential)
    still = {system.rate(motion.coordinate): system.zero}
    law = Inserted(Partial(lagrangian, q), still)
    condition = system.derivative(system.lagrangian, q).xreplace(still)
    lines = (
        _effective(system, motion, potential),
        Relation((law, Explicit(system.display(condition)))),
        _rate(motion, turning),
        Relation((AtEquilibrium(Partial(lagrangian, q), motion.steady), Explicit(system.zero))),
        Relation((_curvature(potential, q, motion), Explicit(motion.curvature))),
    )
    about = {
        "outcome": motion.stability,
        "number": str(number),
        "coordinate": motion.coordinate,
        "rate": f"{motion.number:.4g}",
        "unit": next(c.unit for c in system.scene.free if c.name == motion.turning) or "1",
    }
    return Step(RULE, str(number), lines, (), about)


def _effective(system: System, motion: SteadyMotion, potential: Named) -> Relation:
    """U = −R at rest of the coordinate, for any constant momenta."""
    momenta = {p: system.momentum(q) for q, p in motion.reduction.momenta.items()}
    still = {system.rate(motion.coordinate): system.zero}
    routh = Named(Quantity("negative-routh-function"), -motion.reduction.function)
    members = (potential, Substituted(routh, still), Explicit(motion.potential))
    return Relation(tuple(Inserted(member, momenta) for member in members))


def _rate(motion: SteadyMotion, turning: sp.Symbol) -> Relation:
    """Ω, or Ω² where that is all that the condition has."""
    given = {turning: motion.rate}
    if motion.square is None:
        return Relation((Inserted(Explicit(turning), given), Explicit(motion.rate)))
    return Relation((Inserted(Power(Explicit(turning), 2), given), Explicit(motion.square)))


def _curvature(potential: Named, q: sp.Symbol, motion: SteadyMotion) -> AtEquilibrium:
    """∂²U/∂q² with the momenta of the motion."""
    return AtEquilibrium(Partial(Partial(potential, q), q), motion.momenta)
