"""Lagrange's equation of the released coordinate, with its reaction: Z = d/dt ∂L/∂l̇ − ∂L/∂l − Qᵈ.

Source: Lanczos, The Variational Principles of Mechanics, ch. III.5; Goldstein, Poole, Safko, 3rd ed., §2.4.
"""

from __future__ import annotations

from ..formula import Explicit, Named, Partial, Plus, Quantity, Rate, Term, minus
from ..released import Release
from ..step import Relation, Step
from ..terms import terms_by_source
from . import release as release_rule
from ._lagrange import right_terms
from .lagrange_equation import parts

RULE = "reaction-equation"


def apply(release: Release) -> Step:
    """Z by the letters, and written out for any motion of the released coordinate; its parts as substeps."""
    wider, name, free = release.wider, release.name, release.coordinate
    lagrangian = Named(Quantity("lagrangian"), wider.lagrangian)
    law = (Term(Rate(Partial(lagrangian, wider.rate(free)))), minus(Partial(lagrangian, wider.q(free))))
    others = tuple(minus(term.formula, *term.sources) for term in right_terms(wider, free))
    terms = terms_by_source(wider, free)
    written = Plus(terms) if terms else Explicit(wider.zero)
    sources = tuple(dict.fromkeys(source for term in terms for source in term.sources))
    line = Relation((Named(Quantity("reaction", name), release.reaction), Plus((*law, *others)), written))
    premises = (f"{release_rule.RULE}:{name}",)
    step = Step(RULE, name, (line,), sources, {"coordinate": free}, premises=premises)
    return step.with_substeps(*parts(wider, free, lagrangian))
