"""Fundamental lemma: if ∫ Gᵢ δqᵢ dt = 0 for all δqᵢ, each Gᵢ vanishes; here Gᵢ = ∂L/∂qᵢ − d/dt ∂L/∂q̇ᵢ + Qᵢᵈ.

Source: Gelfand, Fomin, Calculus of Variations, §3, lemma 1; Goldstein, Poole, Safko, Classical Mechanics, §2.2.
"""

from __future__ import annotations

from dataclasses import replace

from ..action import Action
from ..differential_expression import direction
from ..formula import Equation, Explicit, Plus, Term, Times
from ..step import Relation, Step
from ..terms import terms_by_source
from ._lagrange import right_terms
from .collected_variation import euler_expression

RULE = "fundamental-lemma"


def apply(action: Action) -> Step:
    """The integral that vanishes, and what follows for each coordinate."""
    system, zero = action.system, Explicit(action.system.zero)
    factors = {x: factor(action, x) for x in action.present}
    products = [Times((each, Explicit(direction(x)))) for x, each in factors.items()]
    inside = products[0] if len(products) == 1 else Plus(tuple(map(Term, products)))
    lines = [Relation((Equation(action.on(inside), zero),))]
    for x, each in factors.items():
        written = tuple(replace(term, sign=-term.sign) for term in terms_by_source(system, x))
        lines.append(Relation((Equation(each, zero), Equation(Plus(written) if written else zero, zero)), "⇔"))
    sources = (source for x in factors for term in terms_by_source(system, x) for source in term.sources)
    return Step(RULE, "", tuple(lines), tuple(dict.fromkeys(sources)))


def factor(action: Action, coordinate: str) -> Plus:
    """∂L/∂qᵢ − d/dt ∂L/∂q̇ᵢ, and Qᵢᵈ and reactions where there are any."""
    return Plus((*euler_expression(action, coordinate).terms, *right_terms(action.system, coordinate)))
