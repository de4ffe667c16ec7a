"""Integrals over material coordinates and over the time as numbers: Gauss–Legendre quadrature in ball arithmetic.

With n = 48 nodes it is exact for polynomials up to degree 95, and for sines and cosines good to far more than the
tolerance of the verification. Source: Golub, Welsch, Math. Comp. 23 (1969), 221.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp
from flint import arb

from .formula import Bounds
from .points import Point, along_motion, moved

NODES = 48
# The error is about (half the interval / distance to the next singularity)^2n.
SHORT, FEW_NODES = arb(2) ** -16, 4

Numbers = tuple[arb, ...]


def integral(
    of: Callable[[Point], Numbers],
    material: tuple[Bounds, ...],
    point: Point,
    number: Callable[[sp.Expr, Point], arb],
    nodes: int | None = None,
) -> Numbers:
    """The integral of each component over all material coordinates, the last one innermost.

    Without `nodes` there are as many as the length of the interval needs.
    """
    if not material:
        return of(point)
    first, *rest = material
    lower, upper = number(first.lower, point), number(first.upper, point)
    half, middle = (upper - lower) / 2, (upper + lower) / 2
    total: Numbers = ()
    count = nodes or (FEW_NODES if half < SHORT else NODES)
    for node in range(count):
        place, weight = arb.legendre_p_root(count, node, weight=True)
        inside = placed(point, first.symbol.name, middle + half * place)
        values = integral(of, tuple(rest), inside, number, nodes)
        summands = [half * weight * value for value in values]
        total = tuple(a + b for a, b in zip(total or [arb(0)] * len(summands), summands, strict=True))
    return total


def placed(point: Point, name: str, value: arb) -> Point:
    """The point at another value of a material coordinate, or at another time, where all functions follow."""
    return along_motion(point, value - point["t"]) if name == "t" else moved(point, {name: value})
