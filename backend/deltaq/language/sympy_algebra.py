"""Expression trees → SymPy. Derivatives are carried out; nothing is ever read from text here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NoReturn, TypeAlias

import sympy

from ..errors import ExpressionError, Parameter, Problem
from .derivatives import diff, without_idle_impulses
from .display import size
from .form_calculus import plain_form
from .fourier import TooLargeError
from .functions import CLASSES, FUNCTIONS
from .measure import MAX_EXPONENT
from .memory import cached_method
from .symbols import Symbols
from .tree import Node, fold

# SymPy objects: Expr, Matrix, Eq or Tuple. SymPy is not typed.
Value: TypeAlias = Any

_BOUNDED_DOMAIN = frozenset({"log", "asin", "acos", "acosh", "atanh"})
_SAME_NAME = FUNCTIONS.keys() - set(CLASSES.values())
_FUNCTIONS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {name: getattr(sympy, name) for name in _SAME_NAME} | {name: getattr(sympy, own) for own, name in CLASSES.items()}
)
_UNDEFINED = (sympy.zoo, sympy.nan, sympy.oo, -sympy.oo)
_NOT_A_VALUE: Mapping[str, tuple[Any, ...]] = MappingProxyType(
    {"not-real": (sympy.I,), "division-by-zero": (*_UNDEFINED, sympy.AccumBounds)}
)


def to_sympy(node: Node, symbols: Symbols) -> Value:
    """The SymPy value of a tree: Expr; a column or matrix for a Vector; Eq (unevaluated); a Tuple of Eq for a system.

    Raises ExpressionError `division-by-zero`, `not-real` or `not-differentiable` if the value does not exist.
    """
    value = fold(node, SympyAlgebra(symbols))
    for code, strangers in _NOT_A_VALUE.items():
        if value.has(*strangers):
            _refuse(code)
    return value


def time_derivative(expr: Value, symbols: Symbols) -> Value:
    """d/dt along the motion, by the chain rule: df/dt = Σ ∂f/∂q q̇ + ∂f/∂q̇ q̈ + … + ∂f/∂t; of a matrix by entries."""
    if isinstance(expr, sympy.MatrixBase):
        return expr.applyfunc(lambda entry: time_derivative(entry, symbols))
    rates = rates_of(symbols)
    if expr.free_symbols.isdisjoint(rates):
        return sympy.S.Zero
    form = plain_form(expr)
    with suppress(TooLargeError):
        if form is not None and len(form.form) <= size(expr):  # else it would be multiplied out for nothing
            return form.total_derivative(rates).expression
    constant, moving = expr.as_independent(*rates, as_Add=False)
    # Term by term: a term has few symbols, a long sum has all of them.
    changes = (
        constant * diff(term, symbol) * rates[symbol]
        for term in sympy.Add.make_args(moving)
        for symbol in sorted(term.free_symbols & rates.keys(), key=str)
    )
    total = without_idle_impulses(sympy.Add(*changes))
    if total.has(sympy.DiracDelta, sympy.Derivative, sympy.Subs):
        _refuse("not-differentiable")
    return total


@cached_method
def rates_of(symbols: Symbols) -> Mapping[Value, Value]:
    """How fast everything changes that does: t, and each q, q̇, q̈, δq, δq̇."""
    rates = {symbols.time: sympy.Integer(1)}
    for name in symbols.names.coordinates:
        chain = (symbols.name(name), *(symbols.rate(name, order) for order in range(1, 5)))
        rates |= dict(pairwise(chain))
        rates |= dict(pairwise(symbols.variation(name, order) for order in range(4)))
    return rates


def _refuse(code: str, **parameters: Parameter) -> NoReturn:
    raise ExpressionError(Problem(code, parameters=parameters))


@dataclass(frozen=True)
class SympyAlgebra:
    """The Algebra whose values are SymPy objects."""

    symbols: Symbols

    def number(self, value: Fraction) -> Value:
        return sympy.Rational(value.numerator, value.denominator)

    def name(self, name: str) -> Value:
        return self.symbols.name(name)

    def rate(self, name: str, order: int) -> Value:
        return self.symbols.rate(name, order)

    def variation(self, name: str, order: int) -> Value:
        return self.symbols.variation(name, order)

    def differential(self, name: str) -> Value:
        return self.symbols.differential(name)

    def sum(self, terms: tuple[Value, ...]) -> Value:
        if isinstance(terms[0], sympy.MatrixBase):
            return sum(terms[1:], terms[0])
        return sympy.Add(*terms)

    def product(self, factors: tuple[Value, ...]) -> Value:
        scalar = sympy.Mul(*(f for f in factors if not isinstance(f, sympy.MatrixBase)))
        arrays = [f for f in factors if isinstance(f, sympy.MatrixBase)]
        if len(arrays) < 2:
            return scalar * (arrays[0] if arrays else 1)
        first, second = arrays  # more are refused by the bounds
        return (first.dot(second) if first.shape == second.shape else first * second) * scalar

    def quotient(self, numerator: Value, denominator: Value) -> Value:
        if denominator.is_zero:
            _refuse("division-by-zero")
        return numerator / denominator

    def negation(self, operand: Value) -> Value:
        return -operand

    def power(self, base: Value, exponent: Value) -> Value:
        if base.is_zero and not exponent.is_positive:
            _refuse("division-by-zero")
        return base**exponent

    def call(self, function: str, arguments: tuple[Value, ...]) -> Value:
        if function == "exp":
            _check_exponential(arguments[0])
        try:
            value = _FUNCTIONS[function](*arguments)
        except ValueError:  # the larger of two numbers that are not real
            _refuse("not-real")
        if value in _UNDEFINED:
            _refuse("division-by-zero")
        if function in _BOUNDED_DOMAIN and value.is_extended_real is False:
            _refuse("not-real")
        return value

    def time_derivative(self, operand: Value) -> Value:
        return time_derivative(operand, self.symbols)

    def partial_derivative(self, operand: Value, variable: Value) -> Value:
        value = diff(operand, variable)
        if value.has(sympy.DiracDelta, sympy.Derivative, sympy.Subs):
            _refuse("not-differentiable")
        return value

    def vector(self, components: tuple[Value, ...]) -> Value:
        if isinstance(components[0], sympy.Eq):
            return sympy.Tuple(*components)
        if isinstance(components[0], sympy.MatrixBase):
            return sympy.ImmutableMatrix([list(row) for row in components])
        return sympy.ImmutableMatrix(components)

    def equation(self, left: Value, right: Value) -> Value:
        if isinstance(left, sympy.MatrixBase) and not isinstance(right, sympy.MatrixBase):
            right = sympy.ImmutableMatrix.zeros(*left.shape)
        return sympy.Eq(left, right, evaluate=False)


def _check_exponential(argument: Value) -> None:
    """SymPy turns exp(n log a) into a^n at once: n must be small before it does."""
    if argument.has(sympy.log) and any(abs(n) > MAX_EXPONENT for n in argument.atoms(sympy.Rational)):
        _refuse("exponent-too-large", limit=MAX_EXPONENT)
    if any(term.is_number and abs(term.evalf(15)) > 700 for term in sympy.Add.make_args(argument)):
        _refuse("value-too-large", limit="exp(700)")
