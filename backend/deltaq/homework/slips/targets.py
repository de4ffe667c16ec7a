"""What an answer should be worth at the sampling points, if all of it but one term is right.

An equation may be the right one times a factor, a potential may have a constant of its own, a conserved quantity both:
each hypothesis on these is one target.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import sympy as sp

from ...language.canonical import display
from ..equality.equations import system_of
from ..sampling import Sampler, Values
from ..solution import Solution
from ..task import Task
from .lexicon import near

MOST_OPERATIONS = 100  # of a factor that is looked at in symbols: common divisors of more may take seconds
MOST_TERMS = 20
UNUSUAL = 0.35


@dataclass(frozen=True)
class Target:
    """The values wanted of one part: `scale` times those of the right one, and a constant.

    `factor` is the scale in symbols where it is known; `cost` is how unlikely the hypothesis is.
    """

    values: Values
    scale: Values
    factor: sp.Expr | None = None
    cost: float = 0.0


def targets(task: Task, given: sp.Expr, right: sp.Expr, sampler: Sampler) -> Iterator[Target]:
    """The hypotheses on one part, the likeliest first."""
    if task.quantity.form in ("equation", "equations"):
        yield from _scaled_equation(given, right, sampler)
        return
    true = sampler.values(right)
    one = (1.0,) * len(true)
    yield Target(true, one, sp.Integer(1))
    if task.quantity.up_to_constant:
        yield from _with_own_constant(given, right, sampler)
    if task.quantity.kind == "conserved":
        yield from _scaled_by_terms(given, right, sampler)


def _with_own_constant(given: sp.Expr, right: sp.Expr, sampler: Sampler) -> Iterator[Target]:
    constants = [_constant_of(part, sampler.solution) for part in (given, right)]
    own, true = (sampler.values(constant) for constant in constants)
    if not near(own, true) and constants[0] != constants[1]:
        values = tuple(r + a - b for r, a, b in zip(sampler.values(right), own, true, strict=True))
        yield Target(values, (1.0,) * len(values), sp.Integer(1), 0.05)


def _constant_of(part: sp.Expr, solution: Solution) -> sp.Expr:
    """The terms that hold no coordinate and no rate."""
    constant, _ = part.expand().as_independent(*_moving(solution), as_Add=True)
    return constant


def _moving(solution: Solution) -> list[sp.Symbol]:
    kinds = (solution.q, solution.rate, solution.acceleration)
    return [kind(q) for kind in kinds for q in solution.coordinates]


def _scaled_by_terms(given: sp.Expr, right: sp.Expr, sampler: Sampler) -> Iterator[Target]:
    """The factors by which some term of the answer differs from one of the right one."""
    moving = _moving(sampler.solution)
    own, true = ([t for t in sp.Add.make_args(part.expand()) if t.has(*moving)] for part in (given, right))
    constants = [sampler.values(_constant_of(part, sampler.solution)) for part in (given, right)]
    differences = [v - c for v, c in zip(sampler.values(right), constants[1], strict=True)]
    seen: list[float] = [1.0]
    for a, b in product(own[:MOST_TERMS], true[:MOST_TERMS]):
        scale = tuple(x / y if y else math.nan for x, y in zip(sampler.values(a), sampler.values(b), strict=True))
        # The parameters are the same at all points: what is constant depends on them alone.
        if not near(scale, scale[:1] * len(scale)) or any(near(scale[:1], (other,)) for other in seen):
            continue
        seen.append(scale[0])
        factor = a / b
        wanted = tuple(s * d + c for s, d, c in zip(scale, differences, constants[0], strict=True))
        yield Target(wanted, scale, factor, 0.1 if abs(factor.as_coeff_Mul()[0]) == 1 else 0.45)


def _scaled_equation(given: sp.Expr, right: sp.Expr, sampler: Sampler) -> Iterator[Target]:
    """The factor is told by any column of (A, b) that has no mistake in it; besides, the usual ones are tried."""
    own, true = sampler.rows(given), sampler.rows(right)
    found: list[Target] = []
    for column in range(len(sampler.solution.free) + 1):
        scale = tuple(a[column] / b[column] if b[column] else math.nan for a, b in zip(own, true, strict=True))
        if _is_new(scale, found):
            found.append(_scaled(scale, _factor(given, right, column, sampler), right, sampler))
    judged = [_judged(target, given, right, sampler) for target in found]
    for factor in _usual(right, sampler):
        scale = sampler.values(factor)
        if _is_new(scale, found):
            found.append(_scaled(scale, factor, right, sampler))
            judged.append(replace(found[-1], cost=UNUSUAL))
    yield from sorted(judged, key=lambda target: target.cost)


def _is_new(scale: Values, found: list[Target]) -> bool:
    regular = all(map(math.isfinite, scale)) and all(scale)
    return regular and not any(near(scale, target.scale) for target in found)


def _scaled(scale: Values, factor: sp.Expr | None, right: sp.Expr, sampler: Sampler) -> Target:
    return Target(tuple(s * v for s, v in zip(scale, sampler.values(right), strict=True)), scale, factor)


def _usual(right: sp.Expr, sampler: Sampler) -> Iterator[sp.Expr]:
    """1, and what makes an acceleration bare: for mistakes that are in every column."""
    yield sp.Integer(1)
    for q in sampler.solution.free:
        entry = right.diff(sampler.solution.acceleration(q))
        if entry != 0 and entry.count_ops() <= MOST_OPERATIONS:
            yield 1 / display(entry.expand(), sampler.solution.symbols)


def _factor(given: sp.Expr, right: sp.Expr, column: int, sampler: Sampler) -> sp.Expr | None:
    """The quotient of the two columns in symbols, in short form."""
    solution = sampler.solution
    entries = []
    for part in (given, right):
        matrix, rest = system_of((part,), solution)
        entries.append(matrix.row_join(rest)[0, column])
    if sum(entry.count_ops() for entry in entries) > MOST_OPERATIONS:
        return None
    above, below = (display(entry.expand(), solution.symbols) for entry in entries)
    return sp.cancel(above / below) if below != 0 else None


def _judged(target: Target, given: sp.Expr, right: sp.Expr, sampler: Sampler) -> Target:
    """The target with its cost: factors without a number, or that make the acceleration bare, are usual."""
    if target.factor is None:
        return Target(target.values, target.scale, None, 0.3)
    number, rest = sp.factor_terms(target.factor).as_coeff_Mul()
    sign = 0.2 if number < 0 else 0.0
    monic = any(near(target.scale, inverse) for inverse in _inverses(sampler.rows(right)))
    whole = not any(r.q != 1 for r in given.expand().atoms(sp.Rational))
    plain = 0.0 if rest == 1 else 0.1 if monic or _divides(rest, right) else 0.15
    numbered = 0.0 if abs(number) == 1 or monic else 0.3 if whole else 0.5
    return Target(target.values, target.scale, target.factor, sign + plain + numbered)


def _divides(factor: sp.Expr, right: sp.Expr) -> bool:
    """Whether nothing but the numbers is left in a denominator of the equation times the factor."""
    terms = (sp.Mul(factor, term) for term in sp.Add.make_args(right.expand()))
    return not any(sp.fraction(term)[1].free_symbols for term in terms)


def _inverses(rows: tuple[Values, ...]) -> Iterator[Values]:
    """One over every column but the last."""
    for column in zip(*rows, strict=True):
        yield tuple(1 / entry if entry else math.nan for entry in column)
