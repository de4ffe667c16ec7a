"""Rest at a kink: forces jump over balance, and what acts there may be anything between what they are on either side.

Of a potential, 0 is in its generalized gradient: V = |x| has its minimum where no slope vanishes.
Source: Clarke, Optimization and Nonsmooth Analysis, §2.3; Filippov, Differential Equations with Discontinuous
Righthand Sides, §4.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..formula import AtEquilibrium, Explicit, Formula, Inserted, Named, Plus, Quantity, Rounded, Term, Times
from ..matrix_form import forces_at_rest
from ..rest_sets import KinkRest
from ..step import Relation, Step
from ..switches import beside
from ..system import System
from ._shape import at_rest, numbers, place, plain_value, valued, zero
from .contact_gap import RULE as GAP
from .contact_gap import named_gap

RULE = "kink-equilibrium"


def apply(system: System, found: KinkRest, number: int) -> Step:
    """Where it is, that the switching functions vanish there, and the forces beside it or what balances them."""
    known = found.equilibrium
    there = at_rest(system, known)
    lines = (
        *(place(system, known, q) for q in system.free if system.q(q) in known.values),
        *(Relation((_at(system, Explicit(s), there), zero(1))) for s in found.switches),
        *(Relation((_at(system, named_gap(system, each), there), zero(1))) for each in found.contacts),
        *(_sides(system, found) if found.sides else _shares(system, found, there)),
    )
    rest = "-in-the-others" if found.stability == "stable" and known.free else ""
    outcome = f"{'one' if found.sides else 'several'}-{found.stability}{rest}"
    about = {"outcome": outcome, "number": str(number), "coordinate": ", ".join(known.free)}
    return Step(RULE, str(number), lines, (), about, premises=tuple(f"{GAP}:{each.name}" for each in found.contacts))


def _at(system: System, law: Formula, there: dict[sp.Symbol, sp.Expr]) -> Formula:
    """At the scene's values: for others a switch may have another sign."""
    return Inserted(AtEquilibrium(law, there), numbers(system))


def _sides(system: System, found: KinkRest) -> Iterator[Relation]:
    """f₋ and f₊, and their signs at the scene's values."""
    for quantity, value in zip(("force-below", "force-above"), found.sides or (), strict=True):
        name = Named(Quantity(quantity), value)
        yield valued(name, value, found.equilibrium)
        number = sp.sign(sp.N(value.xreplace(dict(system.parameter_values)), 30))
        members = (Explicit(system.zero), Inserted(name, numbers(system)))
        yield Relation(members if number >= 0 else members[::-1], "<" if number else "=")


def _shares(system: System, found: KinkRest, there: dict[sp.Symbol, sp.Expr]) -> Iterator[Relation]:
    """−1 ≤ σ ≤ 1, and that the forces balance with it."""
    several = len(found.shares) > 1
    names = [Named(Quantity("kink-share", str(k) if several else ""), s) for k, s in enumerate(found.shares, 1)]
    for name, share in zip(names, found.shares, strict=True):
        yield valued(name, share, found.equilibrium)
        ends = (Explicit(sp.Integer(-1)), Inserted(name, numbers(system)), Explicit(sp.Integer(1)))
        yield Relation(ends, "≤")
    if not (found.contacts or system.conditions):
        yield Relation((_at(system, _balance(system, found, names), there), zero(len(system.free))))


def _balance(system: System, found: KinkRest, names: list[Named]) -> Formula:
    """f with a σ for the sign of each switching function: its mean, and the half of each jump."""
    sigmas = [sp.Dummy(real=True) for _ in names]
    forces = beside(system, forces_at_rest(system), dict(zip(found.switches, sigmas, strict=True)))
    mean = sp.Matrix(forces).xreplace(dict.fromkeys(sigmas, sp.Integer(0)))
    halves = [sp.Matrix(forces).diff(each) for each in sigmas]
    parts = [plain_value(system.display(sp.ImmutableMatrix(each))) for each in (mean, *halves)]
    jumps = [Term(Times((name, Explicit(half)))) for name, half in zip(names, parts[1:], strict=True)]
    return Plus((Term(Explicit(parts[0])), *jumps))


def written(system: System, value: sp.Expr, *, exact: bool) -> Formula:
    """A value in closed form or as a number, at the scene's values."""
    return Inserted(Explicit(value) if exact else Rounded(value), numbers(system))
