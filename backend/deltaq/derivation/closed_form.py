"""Recognizing roots that were found as numbers: angles at multiples of π/2, then one equation for one unknown each.

An equation gives its unknown if it is linear in it, or in its sine or its cosine, if it is a binomial or a quadratic in
it, or has one root of such. Nothing is believed before the equations vanish identically; what is not recognized
quickly stays a number.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import sympy as sp

from .calculus import Calculus

NEAR = 1e-7
LONGEST = 60  # operations in an equation that is still worth a try
SINE, COSINE = sp.Dummy("s", real=True), sp.Dummy("c", real=True)

Known = dict[sp.Symbol, sp.Expr]


@dataclass(frozen=True)
class Sought:
    """Equations (each = 0), the unknowns with their numbers, which of them are angles, and the parameters' values."""

    calculus: Calculus
    equations: tuple[sp.Expr, ...]
    numbers: Mapping[sp.Symbol, float]
    angles: frozenset[sp.Symbol]
    parameters: Mapping[sp.Symbol, sp.Rational]


def closed_form(sought: Sought) -> Known | None:
    """The unknowns as expressions in the parameters, if they can be recognized."""
    simple = {q: value for q, number in sought.numbers.items() if (value := _simple(sought, q, number)) is not None}
    for known in _guesses(simple):
        found = _eliminated(sought, dict(known))
        if found is not None and _solves(sought, found):
            return found
    return None


def _guesses(simple: Known) -> Iterator[Known]:
    """All that look simple; all but one, as l₁ − l₂ is zero by chance where both are 1 m; none."""
    yield simple
    if len(simple) > 1:
        yield from ({q: value for q, value in simple.items() if q != other} for other in reversed(simple))
    if simple:
        yield {}


def _simple(sought: Sought, q: sp.Symbol, number: float) -> sp.Expr | None:
    """0, or a multiple of π/2 for an angle."""
    quarters = number / (math.pi / 2)
    if abs(number) < NEAR:
        return sp.Integer(0)
    return round(quarters) * sp.pi / 2 if q in sought.angles and abs(quarters - round(quarters)) < NEAR else None


def _solves(sought: Sought, known: Known) -> bool:
    return all(sought.calculus.is_zero(equation.xreplace(known)) for equation in sought.equations)


def _eliminated(sought: Sought, known: Known) -> Known | None:
    """One unknown after the other, each from an equation in which it is the only one left."""
    missing = [q for q in sought.numbers if q not in known]
    while missing:
        found = next(_single(sought, known, missing), None) or _jointly(sought, known, missing)
        if found is None:
            return None
        known |= found
        missing = [q for q in missing if q not in found]
    return known


def _single(sought: Sought, known: Known, missing: list[sp.Symbol]) -> Iterator[Known]:
    for equation in sought.equations:
        left = equation.xreplace(known)
        unknown = [q for q in missing if left.has(q)]
        if len(unknown) == 1 and left.count_ops() <= LONGEST:
            q = unknown[0]
            for value in _candidates(left, q, angle=q in sought.angles):
                if _matches(sought, q, value):
                    yield {q: _written(sought, value)}


def _written(sought: Sought, value: sp.Expr) -> sp.Expr:
    """The value as it is shown; a fraction of fractions over one line."""
    shown = sought.calculus.display(value)
    if not any(factor.is_Add and _has_quotient(factor) for factor in shown.args if shown.is_Mul):
        return shown
    upper, lower = map(sought.calculus.display, sp.fraction(sp.together(shown)))
    return sp.Mul(upper, 1 / lower)


def _has_quotient(expr: sp.Expr) -> bool:
    return any(p.exp.is_Rational and p.exp.is_negative for p in expr.atoms(sp.Pow))


def _matches(sought: Sought, q: sp.Symbol, value: sp.Expr) -> bool:
    """Whether the expression has the number that was found, for an angle up to whole turns."""
    number = sp.N(value.xreplace(dict(sought.parameters)), 20)
    if not number.is_Float and not number.is_Integer:
        return False
    gap = float(number) - sought.numbers[q]
    if q in sought.angles:
        gap = math.remainder(gap, 2 * math.pi)
    return abs(gap) < NEAR * (1 + abs(sought.numbers[q]))


def _candidates(left: sp.Expr, q: sp.Symbol, *, angle: bool) -> Iterator[sp.Expr]:
    slope = left.diff(q)
    if not slope.has(q):
        if slope != 0:
            yield -left.xreplace({q: sp.Integer(0)}) / slope
        return
    if not angle:
        for part in sp.Mul.make_args(left):
            yield from _of_root(part, q)
        return
    waves = sp.expand_trig(left).expand().xreplace({sp.sin(q): SINE, sp.cos(q): COSINE})
    if waves.has(q):
        return
    for part in _without_factor(waves):
        s, c = part.diff(SINE), part.diff(COSINE)
        rest = part.xreplace({SINE: sp.Integer(0), COSINE: sp.Integer(0)})
        if c == 0 and not s.has(SINE) and s != 0:
            yield from (sp.asin(-rest / s), sp.pi - sp.asin(-rest / s))
        if s == 0 and not c.has(COSINE) and c != 0:
            yield from (sp.acos(-rest / c), -sp.acos(-rest / c))
        if rest == 0 and not (s.has(SINE, COSINE) or c.has(SINE, COSINE)) and s != 0 and c != 0:
            yield from (sp.atan(-c / s), sp.pi + sp.atan(-c / s))


def _of_root(part: sp.Expr, q: sp.Symbol) -> Iterator[sp.Expr]:
    """The zeros of a + b Pʳ, which are those of P − (−a/b)^(1/r); without a root, of the part itself."""
    roots = [each for each in part.atoms(sp.Pow) if each.has(q) and not each.exp.is_Integer]
    if not roots:
        yield from _of_powers(part, q)
    if len(roots) != 1 or not roots[0].exp.is_Rational:
        return
    linear = part.xreplace({roots[0]: SINE})
    slope = linear.diff(SINE)
    if not linear.has(q) and slope != 0 and not slope.has(SINE):
        value = -linear.xreplace({SINE: sp.Integer(0)}) / slope
        yield from _of_powers(roots[0].base - value ** (1 / roots[0].exp), q)


def _of_powers(left: sp.Expr, q: sp.Symbol) -> Iterator[sp.Expr]:
    """The zeros of a + b qⁿ, and of a quadratic, beside q = 0."""
    upper = sp.fraction(sp.together(left))[0]
    if not upper.is_polynomial(q):
        return
    terms = sorted(sp.Poly(upper, q).terms(), reverse=True)
    lowest = terms[-1][0][0]
    powers = {degree - lowest: factor for (degree,), factor in terms}
    n = max(powers)
    if len(powers) == 2:
        ratio = sp.factor_terms(sp.cancel(-powers[0] / powers[n]))
        yield from (sp.root(ratio, n), -sp.root(ratio, n)) if n % 2 == 0 else (sp.root(ratio, n), -sp.root(-ratio, n))
    elif n == 2 and len(powers) == 3:
        a, b, c = (powers[k] for k in (2, 1, 0))
        root = sp.sqrt(sp.factor_terms((b**2 - 4 * a * c).expand()))
        yield from ((-b + root) / (2 * a), (-b - root) / (2 * a))


def _without_factor(waves: sp.Expr) -> Iterator[sp.Expr]:
    """The equation, and what is left of it where all terms share a sine or a cosine."""
    yield waves
    for wave in (SINE, COSINE):
        if waves.xreplace({wave: sp.Integer(0)}) == 0:
            yield (waves / wave).expand()


def _jointly(sought: Sought, known: Known, missing: list[sp.Symbol]) -> Known | None:
    """All that are missing at once, if the equations are linear in them."""
    rows = [left for e in sought.equations if (left := e.xreplace(known)).has(*missing)]
    matrix = sp.Matrix([[row.diff(q) for q in missing] for row in rows])
    if not 2 <= len(rows) == len(missing) <= 3 or matrix.has(*missing):
        return None
    determinant = matrix.det(method="berkowitz").expand()
    if determinant == 0:
        return None
    right = sp.Matrix([-row.xreplace(dict.fromkeys(missing, sp.Integer(0))) for row in rows])
    solution = matrix.adjugate() * right / determinant
    return {q: _written(sought, value) for q, value in zip(missing, solution, strict=True)}
