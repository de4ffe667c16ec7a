"""Expressions to machine code, by SymEngine's LLVM back end."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
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

    def __getstate__(self) -> dict[str, object]:
        """All but the addresses, which are those of this process."""
        return {name: value for name, value in self.__dict__.items() if name not in ("addresses", "_one_row")}

    @cached_property
    def addresses(self) -> tuple[int, int]:
        """The function's address and that of its data, the last argument of every call."""
        pointer, data = self.function.as_ctypes()
        return int(ctypes.cast(pointer, ctypes.c_void_p).value or 0), int(data.value or 0)

    def table(self, rows: Floats) -> Floats:
        """The outputs for each row of inputs: shape (rows, inputs) to shape (rows, outputs)."""
        values = self.function(np.ascontiguousarray(rows, dtype=np.float64))
        return np.asarray(values, dtype=np.float64).reshape(len(rows), self.outputs)

    def at(self, row: Floats) -> Floats:
        """The outputs for one row of inputs, contiguous: shape (inputs,) to shape (outputs,).

        The same numbers as `table` has, without its detours: behind an event there are many such rows, one by one.
        """
        call, make, inputs, data = self._one_row
        values = make()
        call(values, inputs(row), data)
        return np.frombuffer(values)

    @cached_property
    def _one_row(self) -> tuple[Any, Any, Any, int]:
        """The function for one row, C's array of its outputs, a view of its inputs as such a one, and its data."""
        address, data = self.addresses
        return _function_at(address), _numbers(self.outputs), _numbers(self.inputs).from_buffer, data


@lru_cache(maxsize=256)
def _function_at(address: int) -> Any:
    return ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)(address)


@lru_cache(maxsize=256)
def _numbers(count: int) -> Any:
    """So many numbers as C has them; where they are an array's own, they are had sooner than its address."""
    return ctypes.c_double * count


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
