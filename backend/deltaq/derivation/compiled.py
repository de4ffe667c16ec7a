"""Expressions as plain functions of floats: quick enough to search with, without generating code."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import sympy as sp

from ..language.functions import CLASSES, FUNCTIONS

Function = Callable[[Sequence[float]], float]
Vectors = Callable[[Sequence[float]], list[float]]


def compiled(expression: sp.Expr, slots: Mapping[sp.Symbol, int]) -> Function:
    """f(values), where `slots` tells which value each symbol has. Calls give NaN where it is not defined."""
    inner = _compiled(expression, slots)

    def safe(values: Sequence[float]) -> float:
        try:
            return inner(values)
        except (ArithmeticError, ValueError, TypeError):
            return math.nan

    return safe


def compiled_together(expressions: Sequence[sp.Expr], slots: Mapping[sp.Symbol, int]) -> Vectors:
    """f(values) of several expressions, NaN where one is not defined; what they have in common is computed once."""
    common, rest = sp.cse(list(expressions), order="none")
    places = dict(slots)
    intermediate = []
    for symbol, expression in common:
        intermediate.append(compiled(expression, places))
        places[symbol] = len(places)
    outcomes = [compiled(expression, places) for expression in rest]

    def together(values: Sequence[float]) -> list[float]:
        known = list(values)
        for each in intermediate:
            known.append(each(known))
        return [each(known) for each in outcomes]

    return together


def _compiled(expression: sp.Expr, slots: Mapping[sp.Symbol, int]) -> Function:
    if expression in slots:
        slot = slots[expression]
        return lambda values: values[slot]
    if expression.is_number:
        number = math.nan if expression.is_real is False else float(expression)
        return lambda _: number
    parts = [_compiled(argument, slots) for argument in expression.args]
    if expression.is_Add:
        return lambda values: math.fsum(part(values) for part in parts)
    if expression.is_Mul:
        return lambda values: math.prod(part(values) for part in parts)
    if expression.is_Pow:
        base, exponent = parts
        return lambda values: math.pow(base(values), exponent(values))
    name = type(expression).__name__
    function = _impulse if name == "DiracDelta" else FUNCTIONS[CLASSES.get(name, name)].evaluate
    return lambda values: function(*(part(values) for part in parts))


def _impulse(x: float, *_order: float) -> float:
    """The slope of a jump, sgn x/2: nothing but at the jump, where it has no value."""
    return 0.0 if x else math.nan
