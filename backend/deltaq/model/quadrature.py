"""Integrals over material coordinates, by Gauss–Legendre quadrature.

Exact to rounding for polynomials of degree 2n − 1 in each coordinate (n nodes), and as good as exact for the smooth
fields of beams, chords and plates. Source: Davis, Rabinowitz, Methods of Numerical Integration, 2nd ed., §2.7.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import symengine as se

from ..mechanics.material import Material
from .functions import Expr
from .symbols import Symbols
from .symengine_algebra import to_symengine

NODES = {1: 16, 2: 8, 3: 5}  # per coordinate, by the number of coordinates


def integral(integrand: Expr, material: Sequence[Material], symbols: Symbols) -> Expr:
    """∫ … ∫ integrand over all material coordinates between their bounds."""
    count = NODES[len(material)]
    return se.expand(_over(integrand, list(material), count, symbols))


def _over(integrand: Expr, material: list[Material], count: int, symbols: Symbols) -> Expr:
    if not material:
        return integrand
    first, rest = material[0], material[1:]
    lower, upper = (to_symengine(bound.tree, symbols) for bound in (first.lower, first.upper))
    middle, half = (lower + upper) / 2, (upper - lower) / 2
    symbol = symbols.values[first.name]
    nodes = zip(*np.polynomial.legendre.leggauss(count), strict=True)
    inner = _over(integrand, rest, count, symbols)
    return half * sum((float(w) * inner.subs({symbol: middle + half * float(x)}) for x, w in nodes), se.Integer(0))
