"""Whether a potential has a minimum where its second derivatives have a one-dimensional kernel n.

Along the curve q(ξ) = q₀ + ξ n + w₂ ξ² + … on which the forces across n vanish, the force along n is −c ξᴺ + …: the
potential has a strict minimum if N is odd and c > 0, else none (splitting lemma). The curve is found order by order, as
power series in ball arithmetic.
Source: Koiter, Proc. Kon. Ned. Ak. Wet. B 68 (1965), 107; Poston, Stewart, Catastrophe Theory and Its Applications,
§4.5.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

import sympy as sp
from flint import arb, arb_mat, arb_series

from .enclosure import Recorder, Tape

HIGHEST = 8  # order of the force that is looked at
NOTHING = arb(2) ** -160  # of the largest coefficient


class NotAnalyticError(ArithmeticError):
    """A force has no power series at the point."""


@dataclass(frozen=True)
class Leading:
    """The first order N of the force along the curve, and whether it drives back on both sides."""

    order: int
    restores: bool


def leading(
    forces: Sequence[sp.Expr],
    unknowns: Sequence[sp.Symbol],
    point: Sequence[arb],
    stiffness: arb_mat,
    kernel: Sequence[arb],
) -> Leading | None:
    """What decides, up to order 8; None where that is zero, or a force is not analytic there."""
    try:
        tape = Recorder(SERIES, unknowns).tape(list(forces))
        return _leading(tape, point, stiffness, kernel)
    except (NotAnalyticError, KeyError, ZeroDivisionError, ValueError):
        return None


def _leading(tape: Tape, point: Sequence[arb], stiffness: arb_mat, kernel: Sequence[arb]) -> Leading | None:
    size = len(point)
    n = arb_mat(size, 1, list(kernel))
    raised = stiffness + n * n.transpose()
    coefficients = [[middle, along] for middle, along in zip(point, kernel, strict=True)]
    scale = max(abs(entry) for entry in stiffness.entries())
    for order in range(2, HIGHEST + 1):
        place = [arb_series(each, order + 1) for each in coefficients]
        forces = [_coefficient(each, order) for each in tape(place)]
        if not all(each.is_finite() for each in forces):
            return None
        along = sum((f * k for f, k in zip(forces, kernel, strict=True)), arb(0))
        scale = max(scale, *map(abs, forces))
        if bool(abs(along) > NOTHING * scale):
            return Leading(order, restores=bool(order % 2) and bool(along < 0))
        across = arb_mat(size, 1, [f - along * k for f, k in zip(forces, kernel, strict=True)])
        bend = raised.solve(across).entries()
        coefficients = [[*each, b.mid()] for each, b in zip(coefficients, bend, strict=True)]
    return None


def _coefficient(value: arb_series | arb, order: int) -> arb:
    return value[order] if isinstance(value, arb_series) else arb(0)


def _sign(x: arb_series) -> int:
    first = x[0]
    if bool(first > 0) or bool(first < 0):
        return 1 if bool(first > 0) else -1
    raise NotAnalyticError


def _power(base: arb_series | arb, exponent: arb_series | arb) -> arb_series | arb:
    fixed = exponent if isinstance(exponent, arb) else exponent[0]
    whole = fixed.unique_fmpz()
    if isinstance(base, arb):
        return base ** (fixed if whole is None else whole)
    if whole is not None:
        power = math.prod([base] * abs(int(whole)), start=arb_series([1], base.prec))
        return power if whole >= 0 else 1 / power
    if not bool(base[0] > 0):
        raise NotAnalyticError
    return (base.log() * fixed).exp()


def _even(x: arb_series) -> arb_series:
    return (x.exp() + (-x).exp()) / 2


def _odd(x: arb_series) -> arb_series:
    return (x.exp() - (-x).exp()) / 2


SERIES: Mapping[str, Callable[..., arb_series | arb]] = {
    "Add": lambda *terms: sum(terms, arb(0)),
    "Mul": lambda *factors: math.prod(factors, start=arb(1)),
    "Pow": _power,
    "sin": lambda x: x.sin(),
    "cos": lambda x: x.cos(),
    "tan": lambda x: x.sin() / x.cos(),
    "cot": lambda x: x.cos() / x.sin(),
    "sec": lambda x: 1 / x.cos(),
    "csc": lambda x: 1 / x.sin(),
    "asin": lambda x: x.asin(),
    "acos": lambda x: x.acos(),
    "atan": lambda x: x.atan(),
    "exp": lambda x: x.exp(),
    "log": lambda x: x.log(),
    "sinh": _odd,
    "cosh": _even,
    "tanh": lambda x: _odd(x) / _even(x),
    "Abs": lambda x: x * _sign(x),
    "sign": lambda x: arb(_sign(x)),
    "Max": lambda *parts: reduce(lambda a, b: a if _sign(a - b) >= 0 else b, parts),
    "Min": lambda *parts: reduce(lambda a, b: b if _sign(a - b) >= 0 else a, parts),
    "Heaviside": lambda x, _at_zero: arb(1 + _sign(x)) / 2,
}
