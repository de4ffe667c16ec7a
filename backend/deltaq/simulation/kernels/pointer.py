"""Calling a compiled model, or its series, from inside a kernel, and keeping numbers out of vectors.

The addresses are arguments, so one compiled kernel serves every model and can be cached on disk. Here is what the
interpreter does; `instructions` has the same for machine code.
"""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import compiler
from .compiler import instruction

Array = NDArray[Any]
Floats = NDArray[np.float64]
_PLACE, _REAL = ctypes.c_void_p, ctypes.c_double


@instruction
def call(address: int, data: int, outputs: Floats, inputs: Floats) -> None:
    """void f(double *out, const double *in, void *data) at `address`.

    `outputs` and `inputs` have shape (numbers,), or any other where they are contiguous.
    """
    _three(int(address))(outputs.ctypes.data, inputs.ctypes.data, int(data))
    compiler.checkpoint()


@instruction
def call_finish(
    address: int, data: int, t: float, h: float, old: Floats, new: Floats, before: Floats, after: Floats
) -> int:
    """int64 f(void *data, double t, double h, 4 × double *) at `address`; the arrays have shape (width,)."""
    places = (old.ctypes.data, new.ctypes.data, before.ctypes.data, after.ctypes.data)
    outcome = int(_finish(int(address))(int(data), t, h, *places))
    compiler.checkpoint()
    return outcome


@instruction
def call_jet(address: int, out: Array, given: Array, work: Array, program: Array) -> None:
    """void f(void *, void *, void *, void *) at `address`; arrays of any shape, contiguous."""
    _four(int(address))(out.ctypes.data, given.ctypes.data, work.ctypes.data, program.ctypes.data)
    compiler.checkpoint()


@instruction
def doubles_at(address: int, size: int) -> Floats:
    """Numbers in memory that is owned elsewhere, shape (size,)."""
    found: Floats = _numbers_at(_REAL * int(size), address, np.float64)
    return found


@instruction
def integers_at(address: int, size: int) -> NDArray[np.int64]:
    """Integers in memory that is owned elsewhere, shape (size,)."""
    found: NDArray[np.int64] = _numbers_at(ctypes.c_int64 * int(size), address, np.int64)
    return found


@instruction
def prevent_vectorization() -> None:
    """The function in which this stands, and what it is a part of, is not vectorized."""


@instruction
def checkpoint() -> None:
    """Stands in loops that call nothing: who is interpreted looks whether the time is up."""
    compiler.checkpoint()


def _numbers_at(kind: Any, address: int, of: Any) -> Any:
    return np.ndarray(kind._length_, of, kind.from_address(int(address)))


@lru_cache(maxsize=256)
def _three(address: int) -> Any:
    return ctypes.PYFUNCTYPE(None, _PLACE, _PLACE, _PLACE)(address)


@lru_cache(maxsize=256)
def _four(address: int) -> Any:
    return ctypes.PYFUNCTYPE(None, _PLACE, _PLACE, _PLACE, _PLACE)(address)


@lru_cache(maxsize=256)
def _finish(address: int) -> Any:
    return ctypes.PYFUNCTYPE(ctypes.c_int64, _PLACE, _REAL, _REAL, _PLACE, _PLACE, _PLACE, _PLACE)(address)
