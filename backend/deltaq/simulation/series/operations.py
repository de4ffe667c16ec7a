"""What each operation does: its first coefficient, and the coefficient of order k from lower ones.

With y = a b, say, yₖ = a₀ bₖ + aₖ b₀ + Σ aⱼ bₖ₋ⱼ, 0 < j < k; the sum is computed before by whoever asks. `Operands` is
how the coefficients that are needed are called in the code that is written.
Source: À. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99–117, proposition 2.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ...model import recurrences as r
from ...model import tape as t
from .circular import sine_and_cosine
from .code import Code

COMPARISONS: Mapping[int, str] = MappingProxyType(
    {t.POSITIVE: "ogt", t.NOT_NEGATIVE: "oge", t.NEGATIVE: "olt", t.NOT_POSITIVE: "ole"}
)


@dataclass(frozen=True)
class Operands:
    """Coefficients of order k of a, b and c (`a`, `b`, `c`), and of order 0 of these and of the result (`a0` … `y0`).

    `extra` is what the operation keeps from order 0 on, `sums` the sums that it needs, `order` and `inverse` are k and
    1/k. `constant` is its constant.
    """

    a: str = ""
    b: str = ""
    c: str = ""
    a0: str = ""
    b0: str = ""
    c0: str = ""
    y0: str = ""
    extra: str = ""
    constant: str = ""
    sums: tuple[str, ...] = ()
    order: str = ""
    inverse: str = ""


def first(code: Code, kind: int, x: Operands, function: str) -> str:
    """y₀; `function` is the name of the function that y₀ is of a₀, where it is one."""
    if kind in _FIRST:
        return _FIRST[kind](code, x)
    if function in ("sin", "cos"):
        return sine_and_cosine(code, x.a0)[function == "cos"]
    return code.function(function, x.a0)


def kept(code: Code, kind: int, x: Operands) -> str:
    """What is the same in all orders: the reciprocal of what is divided by, or 2 a₀; 0 where there is nothing."""
    return _KEPT[kind](code, x) if kind in _KEPT else code.number(0.0)


def later(code: Code, kind: int, x: Operands) -> str:
    """yₖ for k ≥ 1."""
    return _LATER[kind](code, x)


def beginnings(kind: int) -> tuple[str, ...]:
    """What `later` reads of order 0: names among a0, b0, y0 and extra."""
    return _BEGINNINGS.get(kind, ())


def _multiply(code: Code, x: Operands) -> str:
    return code.multiply_add(x.a0, x.b, code.multiply_add(x.a, x.b0, x.sums[0]))


def _divide(code: Code, x: Operands) -> str:
    """a = y b solved for yₖ; a, which comes last, is waited for by one operation only, as in what follows."""
    rest = code.multiply(code.multiply_add(x.y0, x.b, x.sums[0]), x.extra)
    return code.multiply_add(x.a, x.extra, code.negative(rest))


def _reciprocal(code: Code, x: Operands) -> str:
    return code.negative(code.multiply(code.multiply_add(x.y0, x.b, x.sums[0]), x.extra))


def _root(code: Code, x: Operands) -> str:
    """a = y² solved for yₖ."""
    return code.multiply_add(x.a, x.extra, code.negative(code.multiply(x.sums[0], x.extra)))


def _power(code: Code, x: Operands) -> str:
    """a y′ = γ y a′ solved for yₖ: γ Σ j aⱼ yₖ₋ⱼ − Σ (k − j) aⱼ yₖ₋ⱼ, without products of k and yₖ to wait for."""
    share = code.multiply(code.add(x.constant, code.number(1.0)), x.inverse)
    rest = code.multiply_add(share, x.sums[0], code.negative(x.sums[1]))
    slope = code.multiply(code.multiply(x.constant, x.y0), x.extra)
    return code.multiply_add(x.a, slope, code.multiply(rest, x.extra))


def _rise(code: Code, x: Operands) -> str:
    """y′ = b a′."""
    return code.multiply_add(x.a, x.b0, code.multiply(x.sums[0], x.inverse))


def _quotient(code: Code, x: Operands) -> str:
    """b y′ = a′ solved for yₖ."""
    return code.multiply_add(x.a, x.extra, code.negative(code.multiply(x.sums[0], code.multiply(x.inverse, x.extra))))


def _negative_quotient(code: Code, x: Operands) -> str:
    """b y′ = −a′."""
    return code.negative(code.multiply(code.multiply_add(x.sums[0], x.inverse, x.a), x.extra))


def _angle(code: Code, x: Operands) -> str:
    """c y′ = b a′ − a b′."""
    across = code.subtract(code.subtract(x.sums[0], x.sums[1]), x.sums[2])
    ends = code.multiply_add(x.a, x.b0, code.multiply(across, x.inverse))
    return code.multiply(code.multiply_add(code.negative(x.b), x.a0, ends), x.extra)


_FIRST: Mapping[int, Callable[[Code, Operands], str]] = MappingProxyType(
    {
        r.CONSTANT: lambda _code, x: x.constant,
        r.SHIFT: lambda code, x: code.add(x.a0, x.constant),
        r.SCALE: lambda code, x: code.multiply(x.constant, x.a0),
        r.ADD: lambda code, x: code.add(x.a0, x.b0),
        r.SUBTRACT: lambda code, x: code.subtract(x.a0, x.b0),
        r.MULTIPLY: lambda code, x: code.multiply(x.a0, x.b0),
        r.SQUARE: lambda code, x: code.multiply(x.a0, x.a0),
        r.DIVIDE: lambda code, x: code.divide(x.a0, x.b0),
        r.RECIPROCAL: lambda code, x: code.divide(x.constant, x.b0),
        r.ROOT: lambda code, x: code.root(x.a0),
        r.POWER: lambda code, x: code.function("pow", x.a0, x.constant),
        r.ANGLE: lambda code, x: code.function("atan2", x.a0, x.b0),
        r.CHOICE: lambda code, x: code.select(x.a, x.b0, x.c0),
    }
)
_KEPT: Mapping[int, Callable[[Code, Operands], str]] = MappingProxyType(
    {
        r.SQUARE: lambda code, x: code.add(x.a0, x.a0),
        r.DIVIDE: lambda code, x: code.divide(code.number(1.0), x.b0),
        r.RECIPROCAL: lambda code, x: code.divide(code.number(1.0), x.b0),
        r.ROOT: lambda code, x: code.divide(code.number(0.5), x.y0),
        r.POWER: lambda code, x: code.divide(code.number(1.0), x.a0),
        r.QUOTIENT: lambda code, x: code.divide(code.number(1.0), x.b0),
        r.NEGATIVE_QUOTIENT: lambda code, x: code.divide(code.number(1.0), x.b0),
        r.ANGLE: lambda code, x: code.divide(code.number(1.0), x.c0),
    }
)
_BEGINNINGS: Mapping[int, tuple[str, ...]] = MappingProxyType(
    {
        r.MULTIPLY: ("a0", "b0"),
        r.SQUARE: ("extra",),
        r.DIVIDE: ("y0", "extra"),
        r.RECIPROCAL: ("y0", "extra"),
        r.ROOT: ("extra",),
        r.POWER: ("y0", "extra"),
        r.RISE: ("b0",),
        r.FALL: ("b0",),
        r.QUOTIENT: ("extra",),
        r.NEGATIVE_QUOTIENT: ("extra",),
        r.ANGLE: ("a0", "b0", "extra"),
    }
)
_LATER: Mapping[int, Callable[[Code, Operands], str]] = MappingProxyType(
    {
        r.CONSTANT: lambda code, _x: code.number(0.0),
        r.SHIFT: lambda _code, x: x.a,
        r.SCALE: lambda code, x: code.multiply(x.constant, x.a),
        r.ADD: lambda code, x: code.add(x.a, x.b),
        r.SUBTRACT: lambda code, x: code.subtract(x.a, x.b),
        r.MULTIPLY: _multiply,
        r.SQUARE: lambda code, x: code.multiply_add(x.extra, x.a, x.sums[0]),
        r.DIVIDE: _divide,
        r.RECIPROCAL: _reciprocal,
        r.ROOT: _root,
        r.POWER: _power,
        r.RISE: _rise,
        r.FALL: lambda code, x: code.negative(_rise(code, x)),
        r.QUOTIENT: _quotient,
        r.NEGATIVE_QUOTIENT: _negative_quotient,
        r.ANGLE: _angle,
        r.CHOICE: lambda code, x: code.select(x.a, x.b, x.c),
    }
)
