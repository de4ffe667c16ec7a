"""sin² x + cos² x = 1, wherever a sum has both with the same factor.

Kinetic energies are full of such pairs: every rotation leaves one in the square of a velocity. What they cost comes
back in each derivative, so that a right-hand side without them is a fraction of one with them.
"""

from __future__ import annotations

from math import comb, prod

import symengine as se

from .functions import Expr

MOST_TERMS = 5000  # of a sum that is worth looking through


def shortened(expression: Expr) -> Expr:
    """The same function, expanded and without such pairs; untouched where there is none, or too much to look through.

    Only whole pairs go: 1 − cos² x in place of a lone sin² x would lose its digits where that is small.
    """
    if _terms(expression) > MOST_TERMS:
        return expression
    found = expanded = se.expand(expression)
    angles = sorted((each.args[0] for each in expanded.atoms(se.sin)), key=str)
    before = None
    while found != before:
        before = found
        for angle in angles:
            found = _joined(found, angle)
    return expression if found == expanded else found


def _joined(total: Expr, angle: Expr) -> Expr:
    """A sum with the pairs of one angle replaced."""
    sine, cosine = se.sin(angle) ** 2, se.cos(angle) ** 2
    terms = set(total.args if total.is_Add else ())
    change = []
    for term in terms:
        if sine in (term.args if term.is_Mul else (term,)):
            factor = term / sine
            if factor * cosine in terms:
                change += [factor, -term, -factor * cosine]
    return se.Add(total, *change)


def _terms(expression: Expr) -> int:
    """How many terms the expanded expression has at most."""
    if expression.is_Add:
        return sum(map(_terms, expression.args))
    if expression.is_Mul:
        return prod(map(_terms, expression.args))
    if expression.is_Pow and expression.args[1].is_Integer and expression.args[1] > 0:
        base, power = _terms(expression.args[0]), int(expression.args[1])
        return comb(base + power - 1, power)
    return 1
