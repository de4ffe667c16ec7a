"""Integrals of motion that belong to a symmetry: equal up to a factor, a constant, and other integrals.

That dI/dt = 0 along the motion is decided exactly. What it is made of is told by ranks: I = λ J + Σ cₖ Jₖ + c₀
with λ ≠ 0 for the right one J and the other known ones Jₖ, at random states, for several sets of parameters.
"""

from __future__ import annotations

import random
from collections.abc import Iterator

import sympy as sp

from ...derivation.compiled import compiled
from ..sampling import Sampler, defined, echelon
from ..solution import Solution
from . import Fingerprint, Match, Parts, conserved, equation

STATES = 6  # for each coefficient
SETS = 3  # of parameters

Row = list[float]


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """() for what is constant; else numbers do not tell, for other integrals may be added."""
    return () if conserved.fingerprint(parts, sampler) == () else None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether it is conserved, and whether it is the one that is asked for."""
    (own,) = given
    if not own.free_symbols & {solution.rate(q) for q in solution.free}:
        return Match(equal=False, remark="not-conserved")
    alike = conserved.same(given, right, solution)
    if alike.equal:
        return alike
    held = equation.same_solved((solution.time_derivative(own),), solution).equal
    if not held:
        return Match(held, "" if held is None else "not-conserved")
    others = [each for each in solution.integrals if each != right[0]]
    return Match(equal=True, remark="with-others") if _consists_of(own, right[0], others, solution) else OTHER


OTHER = Match(equal=False, remark="other-integral")


def _consists_of(own: sp.Expr, right: sp.Expr, others: list[sp.Expr], solution: Solution) -> bool:
    """own = λ right + Σ cₖ otherₖ + c₀ with λ ≠ 0, by the ranks of their values at many states."""
    return all(_adds_nothing(*rows) for rows in _samples([own, right, *others], solution))


def _adds_nothing(own: Row, right: Row, *others: Row) -> bool:
    known = [[1.0] * len(own), *others]
    if not defined([*own, *right]):
        return False
    return _rank([*known, right, own]) == _rank([*known, right]) and _rank([*known, own]) > _rank(known)


def _rank(rows: list[Row]) -> int:
    return len(echelon(rows))


def _samples(integrals: list[sp.Expr], solution: Solution) -> Iterator[list[Row]]:
    """The values of all integrals at many states, relative to the largest, for several sets of parameters."""
    moving = [*map(solution.q, solution.free), *map(solution.rate, solution.free), solution.t]
    slots = {symbol: slot for slot, symbol in enumerate([*moving, *solution.parameter_values])}
    functions = [compiled(each, slots) for each in integrals]
    source = random.Random(5)
    for _ in range(SETS):
        parameters = [source.uniform(0.4, 1.6) for _ in solution.parameter_values]
        states = [[source.uniform(0.3, 1.7) for _ in moving] for _ in range(STATES * (len(integrals) + 1))]
        yield [_scaled([function([*state, *parameters]) for state in states]) for function in functions]


def _scaled(values: Row) -> Row:
    size = max(map(abs, values)) or 1.0
    return [value / size for value in values]
