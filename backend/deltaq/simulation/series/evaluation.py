"""Polynomials of many motions at many places, with their derivatives, by one function for all models."""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .code import THOROUGH, Code, MachineCode, compiled

Floats = NDArray[np.float64]
_CALL = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)


def evaluated(coefficients: Floats, theta: Floats) -> tuple[Floats, Floats]:
    """Σ cₖ θᵏ over k ≥ 1 and its derivative by θ, by Horner's rule.

    `coefficients` has shape (order + 1, width, lanes), lanes side by side; `theta` has shape (parts, lanes). Both
    results have shape (parts, width, lanes).
    """
    rows, width, lanes = coefficients.shape
    if coefficients.strides[2] != coefficients.itemsize:
        coefficients = np.ascontiguousarray(coefficients)
    out, places = np.empty((2, len(theta), width, lanes)), np.ascontiguousarray(theta)
    strides = (stride // coefficients.itemsize for stride in coefficients.strides[:2])
    program = np.array([rows - 1, len(theta) * width * lanes, width, lanes, *strides])
    _call()(*(array.ctypes.data for array in (out, coefficients, places, program)))
    return out[0], out[1]


@cache
def _machine() -> MachineCode:
    return compiled({"evaluate": _code()}, THOROUGH)


@cache
def _call() -> Any:
    return _CALL(_machine().address)


def _code() -> Code:
    """One number after the other, since their loops wait for nothing of each other."""
    code = Code(1)
    code.label("entry")
    order, count, width, lanes, row, column = (
        code.new(f"load i64, ptr {code.new(f'getelementptr i64, ptr %program, i64 {place}')}") for place in range(6)
    )
    last = code.new(f"mul i64 {order}, {row}")
    code.do("br label %next")
    code.label("next")
    code.do("%i = phi i64 [ 0, %entry ], [ %in, %done ]")
    lane, above = (code.new(f"{what} i64 %i, {lanes}") for what in ("urem", "udiv"))
    component, part = (code.new(f"{what} i64 {above}, {width}") for what in ("urem", "udiv"))
    x = code.load("%work", code.new(f"add i64 {code.new(f'mul i64 {part}, {lanes}')}, {lane}"))
    first = code.at("%given", code.new(f"add i64 {code.new(f'mul i64 {component}, {column}')}, {lane}"))
    start = code.load(first, last)
    code.do("br label %order")
    code.label("order")
    code.do(f"%k = phi i64 [ {last}, %next ], [ %kn, %body ]")
    code.do(f"%value = phi double [ {start}, %next ], [ %valuen, %body ]")
    code.do("%slope = phi double [ 0.0, %next ], [ %slopen, %body ]")
    code.do(f"%kn = sub i64 %k, {row}")
    code.do(f"br i1 {code.new('icmp sgt i64 %kn, 0')}, label %body, label %done")
    code.label("body")
    slope = code.multiply_add("%slope", x, "%value")
    value = code.multiply_add("%value", x, code.load(first, "%kn"))
    code.do(f"%slopen = bitcast double {slope} to double")
    code.do(f"%valuen = bitcast double {value} to double")
    code.do("br label %order")
    code.label("done")
    code.store(code.multiply("%value", x), "%out", "%i")
    code.store(code.multiply_add("%slope", x, "%value"), code.at("%out", count), "%i")
    code.do("%in = add i64 %i, 1")
    code.do(f"br i1 {code.new(f'icmp slt i64 %in, {count}')}, label %next, label %end")
    code.label("end")
    code.do("ret void")
    return code
