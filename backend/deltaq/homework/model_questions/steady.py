r"""Steady motions: what ties the rate of a cyclic coordinate to the position at which the other one rests.

`dot(psi)^2 = g/(l*cos(theta))`, `omega = sqrt(g/(l*cos(theta)))`, or the condition as it falls out of ∂L/∂q = 0. With
a Ω² + b Ω + c = 0 for the right rates, an answer f(Ω) = 0 is right if this divides f, and what is left over holds no
other rate than 0. One root of two that differ by sign alone is right as well: it is the same motion the other way.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import sympy as sp

from ...derivation.optional import steady_motions_of
from ...derivation.steady import SteadyMotion
from ...language.canonical import display, is_zero
from ...language.latex_printer import Typography, latex
from ...language.memory import cached_method
from ...language.names import Symbol
from ...language.parser import Syntax
from ...language.plain_printer import plain
from ..equality import Parts
from ..solution import Solution
from ..verdict import Verdict
from . import Understood, Written
from .wording import Formulas, Piece, blanked, both_signs, formulas, is_number, prepared, refuse, split

HALF = 0.5
BETWEEN = re.compile(r"\b(?:oder|or|und|and|bzw)\b\.?|\\\\|\n|\\(?:lor|land|vee|wedge|q?quad)(?![A-Za-z])")
RATES = (Symbol("omega", "parameter", r"\omega"), Symbol("Omega", "parameter", r"\Omega"))


@cached_method
def motions(solution: Solution) -> tuple[SteadyMotion, ...]:
    """The steady motions of the scene: one, or two that differ by more than their sign."""
    return steady_motions_of(solution.model)


def asked(solution: Solution) -> tuple[str, ...]:
    """The coordinate that turns evenly."""
    return tuple(dict.fromkeys(each.turning for each in motions(solution)))


class Steady:
    """Judges a condition on the rate."""

    def read(self, solution: Solution, subject: str, text: str, syntax: Syntax) -> Understood[None]:
        """Residuals of the equations; an expression alone is the rate."""
        found = tuple(_residuals(solution, subject, _prepared(text, syntax), formulas(solution, syntax, RATES)))
        shown = tuple(sp.Eq(each, 0, evaluate=False) for each in found)
        typography = Typography(solution.scene.names)
        return Understood(
            found,
            "; ".join(map(plain, shown)),
            latex(sp.Tuple(*shown) if len(shown) > 1 else shown[0], typography),
            None,
        )

    def verdict(self, solution: Solution, subject: str, given: Understood[None]) -> Verdict:
        """Several equations hold for several motions."""
        rate, right = solution.rate(subject), motions(solution)
        residual = sp.Mul(*given.parts)
        if is_zero(residual, solution.symbols):
            return Verdict("wrong", remark="steady-empty")
        held = [_holds(residual, each, rate, solution) for each in right]
        if None in held:
            return Verdict("undecided")
        share = sum(map(bool, held)) / len(held)
        if share < 1:
            remark = "steady-missing" if share else "steady-wrong"
            return Verdict("wrong", remark=remark, partial=HALF * share)
        if _has_more(residual, right, rate):
            return Verdict("wrong", remark="steady-more", partial=HALF)
        return Verdict("correct")

    def written(self, solution: Solution, subject: str, _language: str) -> Written:
        """Ω² where that is simpler, else each root."""
        typography = Typography(solution.scene.names)
        shown = tuple(_equation(each, solution.rate(subject)) for each in motions(solution))
        return Written(tuple(map(plain, shown)), tuple(latex(each, typography) for each in shown))


def value(solution: Solution, subject: str) -> Parts:
    """The residual of each steady motion."""
    rate = solution.rate(subject)
    equations = (_equation(each, rate) for each in motions(solution))
    return tuple(each.lhs - each.rhs for each in equations)


def _equation(motion: SteadyMotion, rate: sp.Expr) -> sp.Eq:
    if motion.square is not None:
        return sp.Eq(rate**2, motion.square, evaluate=False)
    return sp.Eq(rate, motion.rate, evaluate=False)


def _holds(residual: sp.Expr, motion: SteadyMotion, rate: sp.Expr, solution: Solution) -> bool | None:
    """Whether a steady motion fulfils the equation, one way around or the other."""
    ways = [motion.rate] if motion.square is None else [motion.rate, -motion.rate]
    outcomes = [is_zero(_at(residual, rate, way), solution.symbols) for way in ways]
    return True if True in outcomes else None if None in outcomes else False


def _at(residual: sp.Expr, rate: sp.Expr, value: sp.Expr) -> sp.Expr:
    """The residual with Ω put in; its powers first, so that roots go where they can."""
    number, _ = sp.fraction(sp.together(residual))
    if not number.is_polynomial(rate):
        return residual.xreplace({rate: value})
    terms = sp.Poly(number, rate).all_coeffs()[::-1]
    return sp.Add(*(term * sp.expand(value**power) for power, term in enumerate(terms)))


def _has_more(residual: sp.Expr, right: tuple[SteadyMotion, ...], rate: sp.Expr) -> bool:
    """Whether an equation has other roots than the right ones and Ω = 0."""
    number, _ = sp.fraction(sp.together(residual))
    if not number.is_polynomial(rate):
        return False
    powers = [power for (power,) in sp.Poly(number, rate).monoms()]
    return bool(max(powers) - min(powers) > sum(2 if each.square is not None else 1 for each in right))


def _prepared(text: str, syntax: Syntax) -> Piece:
    return Piece(blanked(BETWEEN, prepared(text, syntax), ";"), 0)


def _residuals(solution: Solution, subject: str, text: Piece, reader: Formulas) -> Iterator[sp.Expr]:
    rate = solution.rate(subject)
    known = {*solution.parameter_values, *map(solution.q, solution.free), *map(solution.rate, solution.free)}
    names = {sp.Symbol(each.name, real=True): rate for each in RATES if solution.scene.names.get(each.name) is None}
    pieces = list(split(text, ";"))
    if not pieces:
        raise refuse("empty", text)
    for piece in pieces:
        for one in both_signs(piece):
            found = reader.value(one)
            sides = (found.lhs, found.rhs) if isinstance(found, sp.Eq) else (rate, found)
            if not all(map(is_number, sides)):
                raise refuse("answer-steady", piece, rate=str(rate))
            residual = sp.Add(sides[0], -sides[1]).xreplace(names)
            if residual.free_symbols - known or not residual.has(rate):
                raise refuse("answer-steady", piece, rate=str(rate))
            yield display(residual.expand(), solution.symbols)
