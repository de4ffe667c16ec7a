"""The first variation of a functional as a derivation: by the definition and by the chain rule, each step verified."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from .differential_expression import direction
from .domain import Interval
from .function_points import function_points
from .functional import Functional
from .grounds import Grounds
from .normal_algebra import NormalAlgebra
from .rules import (
    beltrami_identity,
    both_routes,
    boundary_terms,
    cleared_equation,
    collected_variation,
    cyclic_function,
    euler_lagrange_equation,
    functional,
    integration_by_parts,
    variation_by_chain_rule,
    variation_by_definition,
)
from .step import Chapter, Derivation, Step
from .verification import SAMPLED, verified_step

FORMULATION = "first-variation"


def vary(subject: Functional) -> Derivation:
    """The chapters: what is varied, the two routes, that they agree; for an integral the Euler–Lagrange equations."""
    points = function_points(subject)
    at_ends = function_points(subject, held=subject.held)
    chapters = {
        "functional": (functional.apply(subject),),
        "variation-by-definition": (variation_by_definition.apply(subject),),
        "variation-by-chain-rule": (variation_by_chain_rule.apply(subject),),
        "both-routes": (both_routes.apply(subject),),
    }
    found = [Chapter(name, tuple(verified_step(s, points) for s in steps)) for name, steps in chapters.items()]
    if isinstance(subject.domain, Interval):
        found += [Chapter(name, tuple(verified_step(s, at_ends) for s in steps)) for name, steps in _integral(subject)]
    return _grounds(subject).of(Derivation(FORMULATION, tuple(found)))


def _grounds(subject: Functional) -> Grounds:
    """How steps about a functional are told; the second algebra knows where its variations vanish."""
    held = (
        (direction(x, order).name, end)
        for x in subject.functions
        for order in range(2)
        for end in _held(subject, order)
    )
    plain = NormalAlgebra(subject.functions)
    fixed = NormalAlgebra(subject.functions, frozenset(held), plain.reader)
    return Grounds(plain, lambda relation: plain.holds(relation) or fixed.holds(relation), SAMPLED)


def _held(subject: Functional, order: int) -> tuple[sp.Expr, ...]:
    return subject.held_ends(order) if isinstance(subject.domain, Interval) else ()


def _integral(subject: Functional) -> Iterator[tuple[str, tuple[Step, ...]]]:
    """Integration by parts, the ends, the fundamental lemma, and what is constant along the solutions."""
    parts = (step for x in subject.moving for step in integration_by_parts.steps(subject, x))
    ends = (boundary_terms.apply(subject),) if subject.moving else ()
    yield "integration-by-parts", (*parts, *ends, collected_variation.apply(subject))
    yield "euler-lagrange", tuple(step for x in subject.present for step in _equation(subject, x))
    yield "first-integrals", tuple(_constants(subject))


def _constants(subject: Functional) -> Iterator[Step]:
    """The first integrals that there are."""
    yield from (cyclic_function.apply(subject, x) for x in subject.ignorable)
    if subject.has_energy:
        yield beltrami_identity.apply(subject)


def _equation(subject: Functional, function: str) -> Iterator[Step]:
    """As it follows, then without denominators and common factors."""
    yield euler_lagrange_equation.apply(subject, function)
    clear = cleared_equation.apply(subject, function)
    if clear is not None:
        yield clear
