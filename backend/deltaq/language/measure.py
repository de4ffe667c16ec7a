"""The size of what a tree would become: its degree, its value, its shape, found without building it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from .functions import FUNCTIONS
from .tokens import fail
from .tree import (
    Call,
    Differential,
    Equation,
    Name,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Power,
    Product,
    Quotient,
    Rate,
    Span,
    Sum,
    TimeDerivative,
    Variation,
    Vector,
)

MAX_EXPONENT = 64
MAX_DEGREE = 64
MAX_VALUE = 1e300
MAX_EXPONENTIAL = 700

Shape = tuple[int, ...]
Real: TypeAlias = Fraction | float


@dataclass(frozen=True)
class Measure:
    """What a part would become: its composed degree, its value if it holds no names, its shape (() = scalar)."""

    degree: int = 1
    value: Real | None = None
    shape: Shape = ()


def measure(node: Node) -> Measure:  # noqa: C901, PLR0911, PLR0912 - one case for each kind of node
    """The measure of a part. Raises ExpressionError where it is too large or not defined."""
    match node:
        case Number(value):
            return Measure(0, value)
        case Name("pi"):
            return Measure(0, math.pi)
        case Name() | Rate() | Variation() | Differential():
            return Measure()
        case Sum(terms):
            return _sum([measure(t) for t in terms], node)
        case Product(factors):
            return _product([measure(f) for f in factors], node)
        case Quotient(numerator, denominator):
            return _quotient(measure(numerator), _scalar(denominator), node)
        case Negation(operand):
            inner = measure(operand)
            return Measure(inner.degree, None if inner.value is None else -inner.value, inner.shape)
        case Power(base, exponent):
            return _power(_scalar(base), _scalar(exponent), node)
        case Call():
            return _call(node)
        case TimeDerivative(operand):
            return Measure(measure(operand).degree + 1, None, measure(operand).shape)
        case PartialDerivative(operand, _):
            return Measure(measure(operand).degree, None, measure(operand).shape)
        case Vector(components):
            return _vector([measure(c) for c in components], node)
        case Equation(left, right):
            return _equation(measure(left), measure(right), node)


def _scalar(node: Node) -> Measure:
    found = measure(node)
    if found.shape:
        fail("scalar-expected", node.span, shape=shape_text(found.shape))
    return found


def shape_text(shape: Shape) -> str:
    """`2` for a vector of two components, `2×2` for a matrix."""
    return "×".join(map(str, shape)) or "1"


def _bounded(value: Real, span: Span) -> Real:
    size = _magnitude(value)
    if not size <= MAX_VALUE:
        fail("value-too-large", span, limit="1e300")
    if value and size < 1 / MAX_VALUE:
        fail("value-too-small", span, limit="1e-300")
    # Fractions of very long numbers are not worth keeping exact.
    long = isinstance(value, Fraction) and value.denominator.bit_length() + value.numerator.bit_length() > 4000
    return float(value) if long else value


def _magnitude(value: Real) -> float:
    try:
        return math.fabs(value)
    except OverflowError:
        return math.inf


def _sum(parts: list[Measure], node: Node) -> Measure:
    if len({p.shape for p in parts}) > 1:
        first, second = sorted({p.shape for p in parts})[:2]
        fail("shapes-differ", node.span, first=shape_text(first), second=shape_text(second))
    known = [p.value for p in parts if p.value is not None]
    value: Real = Fraction(0)
    for summand in known:
        value = _bounded(value + summand, node.span)
    return Measure(max(p.degree for p in parts), value if len(known) == len(parts) else None, parts[0].shape)


def _product(parts: list[Measure], node: Node) -> Measure:
    value: Real | None = Fraction(1)
    for part in parts:
        value = None if value is None or part.value is None else _bounded(value * part.value, node.span)
    shapes = [p.shape for p in parts if p.shape]
    if len(shapes) == 2 and shapes[1] == shapes[0][1:]:
        return Measure(sum(p.degree for p in parts), value, shapes[0][:1])  # a matrix times a vector
    if len(shapes) > 2 or (len(shapes) == 2 and (shapes[0] != shapes[1] or len(shapes[0]) > 1)):
        fail("vector-product", node.span, first=shape_text(shapes[0]), second=shape_text(shapes[1]))
    return Measure(sum(p.degree for p in parts), value, shapes[0] if len(shapes) == 1 else ())


def _quotient(numerator: Measure, denominator: Measure, node: Quotient) -> Measure:
    if denominator.value == 0:
        fail("division-by-zero", node.denominator.span)
    value = None
    if numerator.value is not None and denominator.value is not None:
        value = _bounded(numerator.value / denominator.value, node.span)
    return Measure(numerator.degree + denominator.degree, value, numerator.shape)


def _power(base: Measure, exponent: Measure, node: Power) -> Measure:
    if exponent.value is None:
        fail("symbolic-exponent", node.exponent.span)
    if not isinstance(exponent.value, Fraction):
        fail("irrational-exponent", node.exponent.span)
    if abs(exponent.value) > MAX_EXPONENT or exponent.value.denominator > MAX_EXPONENT:
        fail("exponent-too-large", node.exponent.span, limit=MAX_EXPONENT)
    degree = math.ceil(base.degree * abs(exponent.value))
    if degree > MAX_DEGREE:
        fail("degree-too-large", node.span, degree=degree, limit=MAX_DEGREE)
    return Measure(degree, None if base.value is None else _constant_power(base.value, exponent.value, node))


def _constant_power(base: Real, exponent: Fraction, node: Power) -> Real:
    if base == 0 and exponent <= 0:
        fail("division-by-zero" if exponent else "zero-to-the-zero", node.span)
    if float(base) < 0 and exponent.denominator > 1:
        fail("not-real", node.span)
    if base and abs(math.log10(math.fabs(base)) * exponent) > 300:
        fail(
            "value-too-large" if (math.fabs(base) > 1) == (exponent > 0) else "value-too-small",
            node.span,
            limit="1e±300",
        )
    value: Real = float(base) ** float(exponent) if exponent.denominator > 1 else base**exponent.numerator
    return _bounded(value, node.span)


def _call(node: Call) -> Measure:
    arguments = [_scalar(a) for a in node.arguments]
    degree = max(a.degree for a in arguments)
    if any(a.value is None for a in arguments):
        return Measure(max(degree, 1))
    values = [float(a.value) for a in arguments if a.value is not None]
    if node.function == "exp" and abs(values[0]) > MAX_EXPONENTIAL:
        fail("value-too-large" if values[0] > 0 else "value-too-small", node.span, limit="exp(±700)")
    try:
        value = FUNCTIONS[node.function].evaluate(*values)
    except OverflowError:
        fail("value-too-large", node.span, limit="1e300")
    except (ValueError, ZeroDivisionError):
        fail("outside-domain", node.span, function=node.function)
    return Measure(0, _bounded(value, node.span))


def _vector(parts: list[Measure], node: Vector) -> Measure:
    shapes = {p.shape for p in parts}
    if len(shapes) > 1:
        fail("ragged-matrix", node.span)
    inner = parts[0].shape
    if len(inner) > 1:
        fail("too-many-dimensions", node.span)
    return Measure(max(p.degree for p in parts), None, (len(parts), *inner))


def _equation(left: Measure, right: Measure, node: Equation) -> Measure:
    zero = right.value == 0 and not right.shape
    if left.shape != right.shape and not zero:
        fail("shapes-differ", node.span, first=shape_text(left.shape), second=shape_text(right.shape))
    return Measure(max(left.degree, right.degree), None, left.shape)
