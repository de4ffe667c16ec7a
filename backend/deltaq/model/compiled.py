"""Expressions to machine code, by SymEngine's LLVM back end."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import symengine as se
from numpy.typing import NDArray

from ..errors import Problem, SceneError
from .functions import Expr
from .parts import parts

Floats = NDArray[np.float64]

# What LLVM does for its code: QUICK takes a third of the time to compile, THOROUGH two thirds of the time to run.
QUICK, THOROUGH = 0, 3
HALF = se.Rational(1, 2)


@dataclass(frozen=True)
class Compiled:
    """A function from `inputs` to `outputs` doubles: void f(double *out, const double *in, void *data).

    The addresses are valid as long as this object lives.
    """

    function: Any
    inputs: int
    outputs: int

    @cached_property
    def addresses(self) -> tuple[int, int]:
        """The function's address and that of its data, the last argument of every call."""
        pointer, data = self.function.as_ctypes()
        return int(ctypes.cast(pointer, ctypes.c_void_p).value or 0), int(data.value or 0)

    def table(self, rows: Floats) -> Floats:
        """The outputs for each row of inputs: shape (rows, inputs) to shape (rows, outputs)."""
        values = self.function(np.ascontiguousarray(rows, dtype=np.float64))
        return np.asarray(values, dtype=np.float64).reshape(len(rows), self.outputs)


def compile_expressions(inputs: Sequence[Expr], outputs: Sequence[Expr], effort: int = QUICK) -> Compiled:
    """Machine code for the outputs, with common subexpressions computed once; both efforts give the same numbers.

    Raises SceneError if one of them has no real value whatever the inputs.
    """
    try:
        function = se.Lambdify(list(inputs), [_with_roots(outputs)], backend="llvm", cse=True, opt_level=effort)
    except RuntimeError as error:  # a complex or infinite constant, 1/(x − x) or √(−1), say
        raise SceneError(Problem("not-computable", parameters={"detail": str(error)[:80]})) from None
    return Compiled(function, len(inputs), len(outputs))


def _with_roots(outputs: Sequence[Expr]) -> list[Expr]:
    """The same with (√x)³ for x to the power 3/2, and so on: roots and products are instructions, powers a function.

    √x is positive, so that its absolute value, which costs nothing, keeps SymEngine from writing a power again.
    """
    roots = {
        power: se.Abs(se.sqrt(base)) ** (2 * exponent)
        for power in parts(outputs, se.Pow)
        for base, exponent in [power.args]
        if exponent != HALF and (2 * exponent).is_Integer and not exponent.is_Integer
    }
    return [se.sympify(each).subs(roots) for each in outputs] if roots else list(outputs)
