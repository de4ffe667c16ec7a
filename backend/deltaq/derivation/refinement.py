"""Roots to hundreds of digits: Newton's method in ball arithmetic, from a root in floats."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp
from flint import arb, ctx

from ..language.derivatives import diff
from .newton import solved
from .program import number

BITS = 640
STEPS = 14
SMALL = arb(2) ** -420
TINY = arb(2) ** -260  # keeps the normal equations solvable where roots are not isolated


def refined(equations: list[sp.Expr], start: Mapping[sp.Symbol, float]) -> dict[sp.Symbol, sp.Expr] | None:
    """The root as exact binary fractions that are right to more than 400 bits; None if it does not converge.

    What is smaller than its error is 0: beside a pole of coordinates a mass matrix would seem to have an inverse.
    """
    slopes = [[diff(equation, q) for q in start] for equation in equations]
    with ctx.workprec(BITS):
        point = {q.name: arb(value) for q, value in start.items()}
        for _ in range(STEPS):
            step = _step([number(e, point) for e in equations], [[number(s, point) for s in row] for row in slopes])
            if step is None:
                return None
            point = {name: (value + d).mid() for (name, value), d in zip(point.items(), step, strict=True)}
            if all(abs(d) < SMALL for d in step):
                return {q: rational(point[q.name] if abs(point[q.name]) > SMALL else arb(0)) for q in start}
    return None


def in_numbers(
    values: Mapping[sp.Symbol, sp.Expr], parameters: Mapping[sp.Symbol, sp.Expr]
) -> dict[sp.Symbol, sp.Expr]:
    """Expressions in the parameters as exact binary fractions, as precise as refined roots."""
    with ctx.workprec(BITS):
        point = {symbol.name: number(value, {}) for symbol, value in parameters.items()}
        return {q: rational(number(value, point)) for q, value in values.items()}


def _step(value: list[arb], slopes: list[list[arb]]) -> list[arb] | None:
    """The shortest step that solves F + J d = 0."""
    columns = [[part.mid() for part in column] for column in zip(*slopes, strict=True)]
    value = [part.mid() for part in value]
    normal = [[_dot(a, b) for b in columns] for a in columns]
    for i, row in enumerate(normal):
        row[i] += TINY * (1 + row[i])
    step = solved(normal, [-_dot(column, value) for column in columns])
    return None if step is None or not all(d.is_finite() for d in step) else [d.mid() for d in step]


def _dot(left: list[arb], right: list[arb]) -> arb:
    return sum((a * b for a, b in zip(left, right, strict=True)), arb(0)).mid()


def rational(value: arb) -> sp.Rational:
    """The middle of the ball, exactly."""
    mantissa, exponent = value.mid().man_exp()
    return sp.Integer(int(mantissa)) * sp.Integer(2) ** int(exponent)
