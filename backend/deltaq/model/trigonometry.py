"""sin² x + cos² x = 1, wherever a sum has both with the same factor.

Kinetic energies are full of such pairs: every rotation leaves one in the square of a velocity. What they cost comes
back in each derivative, so that a right-hand side without them is a fraction of one with them.
"""

from __future__ import annotations

from collections.abc import Mapping
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
    squares = {sine**2: se.cos(sine.args[0]) ** 2 for sine in expanded.atoms(se.sin)}
    while (shorter := _joined(found, squares)) != found:  # the pairs of one angle may make those of another
        found = shorter
    return expression if found == expanded else found


def _joined(total: Expr, squares: Mapping[Expr, Expr]) -> Expr:
    """A sum with its pairs replaced; `squares` has the cos² of every sin²."""
    terms, changes = dict.fromkeys(total.args if total.is_Add else ()), []
    for term in tuple(terms):
        for sine in (part for part in (term.args if term.is_Mul else (term,)) if part in squares):
            factor = term / sine
            partner = factor * squares[sine]
            if term in terms and partner in terms:
                del terms[term], terms[partner]
                changes += [factor, -term, -partner]
    return se.Add(total, *changes)


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
