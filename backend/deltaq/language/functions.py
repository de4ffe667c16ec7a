"""The allow-list: every function the expression language knows, and nothing else can be called.

One table for the lexers, the bounds, the printers and the algebras.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Function:
    """A real function: its `name` in the plain language, how to evaluate it and how LaTeX writes it."""

    name: str
    evaluate: Callable[..., float]
    latex: str
    arguments: int = 1
    spellings: tuple[str, ...] = ()
    power_after_name: bool = True
    is_associative: bool = False  # f(a, b, c) is f(f(a, b), c)


def _sign(x: float) -> float:
    return math.copysign(1.0, x) if x else 0.0


def _step(x: float, at_zero: float = 0.5) -> float:
    """0 before and 1 behind the jump; at it the mean, so that step(x) = (1 + sign(x))/2."""
    return 0.5 * (1.0 + _sign(x)) if x else at_zero


_TABLE = (
    Function("sin", math.sin, r"\sin"),
    Function("cos", math.cos, r"\cos"),
    Function("tan", math.tan, r"\tan"),
    Function("cot", lambda x: 1 / math.tan(x), r"\cot", spellings=("cotan",)),
    Function("sec", lambda x: 1 / math.cos(x), r"\sec"),
    Function("csc", lambda x: 1 / math.sin(x), r"\csc", spellings=("cosec",)),
    Function("asin", math.asin, r"\arcsin", spellings=("arcsin",)),
    Function("acos", math.acos, r"\arccos", spellings=("arccos",)),
    Function("atan", math.atan, r"\arctan", spellings=("arctan",)),
    Function("atan2", math.atan2, r"\operatorname{atan2}", arguments=2, spellings=("arctan2",)),
    Function("sinh", math.sinh, r"\sinh"),
    Function("cosh", math.cosh, r"\cosh"),
    Function("tanh", math.tanh, r"\tanh"),
    Function("asinh", math.asinh, r"\operatorname{arsinh}", spellings=("arsinh", "arcsinh")),
    Function("acosh", math.acosh, r"\operatorname{arcosh}", spellings=("arcosh", "arccosh")),
    Function("atanh", math.atanh, r"\operatorname{artanh}", spellings=("artanh", "arctanh")),
    Function("exp", math.exp, r"\exp"),
    Function("log", math.log, r"\ln", spellings=("ln",)),
    Function("sqrt", math.sqrt, r"\sqrt", power_after_name=False),
    Function("abs", abs, r"\operatorname{abs}", power_after_name=False),
    Function("sign", _sign, r"\operatorname{sgn}", spellings=("sgn", "signum"), power_after_name=False),
    Function("max", max, r"\max", arguments=2, power_after_name=False, is_associative=True),
    Function("min", min, r"\min", arguments=2, power_after_name=False, is_associative=True),
    Function("step", _step, r"\operatorname{step}", spellings=("heaviside",), power_after_name=False),
)

FUNCTIONS: Mapping[str, Function] = MappingProxyType({f.name: f for f in _TABLE})
SPELLINGS: Mapping[str, Function] = MappingProxyType({s: f for f in _TABLE for s in (f.name, *f.spellings)})

# Classes of SymPy whose names are not the functions' own.
CLASSES: Mapping[str, str] = MappingProxyType({"Abs": "abs", "Max": "max", "Min": "min", "Heaviside": "step"})
KINKED = frozenset({"abs", "sign", "max", "min", "step"})  # which bend or jump where an argument changes its sign

FREE_NAMES = frozenset({"max", "min", "step"})  # younger than the format: a scene may have a name that is one of them

# Words with a meaning of their own in the plain language; no symbol of a scene may take them.
OPERATORS = frozenset({"dot", "ddot", "dddot", "ddddot", "delta", "d", "diff"})
REFUSED_FUNCTIONS = frozenset(
    {"factorial", "gamma", "eval", "exec", "lambda", "import", "Integral", "integrate", "sum", "product", "limit"}
    | {"solve", "subs", "det", "floor", "ceil", "round", "mod", "erf", "Piecewise", "binomial"}
)
