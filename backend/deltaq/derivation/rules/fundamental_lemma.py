"""Fundamental lemma: if ∫ Gᵢ δqᵢ dt = 0 for all δqᵢ, each Gᵢ vanishes; here Gᵢ = ∂L/∂qᵢ − d/dt ∂L/∂q̇ᵢ + Qᵢᵈ.

Source: Gelfand, Fomin, Calculus of Variations, §3, lemma 1; Goldstein, Poole, Safko, Classical Mechanics, §2.2.
"""

from __future__ import annotations

from ..action import Action
from ..formula import Equation, Explicit, Plus, Term, Times
from ..functional import direction
from ..step import Relation, Step
from .collected_variation import euler_expression
from .hamilton_principle import has_other_force, other_force

RULE = "fundamental-lemma"


def apply(action: Action) -> Step:
    """The integral that vanishes, and what follows for each coordinate."""
    system, zero = action.system, Explicit(action.system.zero)
    factors = {x: factor(action, x) for x in action.present}
    products = [Times((each, Explicit(direction(x)))) for x, each in factors.items()]
    inside = products[0] if len(products) == 1 else Plus(tuple(map(Term, products)))
    lines = [Relation((Equation(action.on(inside), zero),))]
    for x, each in factors.items():
        value = system.display(action.euler_lagrange(x) + system.nonconservative_force(x))
        lines.append(Relation((Equation(each, zero), Equation(Explicit(value), zero)), "⇔"))
    return Step(RULE, "", tuple(lines))


def factor(action: Action, coordinate: str) -> Plus:
    """∂L/∂qᵢ − d/dt ∂L/∂q̇ᵢ, and Qᵢᵈ where there is any."""
    inner = euler_expression(action, coordinate)
    other = (Term(other_force(action, coordinate)),) if has_other_force(action, coordinate) else ()
    return Plus((*inner.terms, *other))
