"""Calling a compiled model from inside a kernel, and keeping numbers out of vectors.

The addresses are arguments, so one compiled kernel serves every model and can be cached on disk.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic


def _call(_context: Any, _address: Any, _data: Any, outputs: Any, inputs: Any) -> Any:
    """call(address, data, outputs, inputs): void f(double *out, const double *in, void *data) at `address`."""

    def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        number, memory = ir.DoubleType().as_pointer(), ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [number, number, memory])
        function = builder.inttoptr(arguments[0], kind.as_pointer())
        out = context.make_array(outputs)(context, builder, arguments[2])
        given = context.make_array(inputs)(context, builder, arguments[3])
        builder.call(function, [out.data, given.data, builder.inttoptr(arguments[1], memory)])
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, outputs, inputs), generate


def _prevent_vectorization(_context: Any) -> Any:
    """prevent_vectorization(): the function in which this stands, and what it is a part of, is not vectorized.

    Vectors of numbers that were stored one by one just before are what a processor must wait for: with them, a
    right-hand side of two coordinates takes a quarter longer.
    """

    def generate(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
        builder.function.attributes.add("noimplicitfloat")
        return context.get_dummy_value()

    return types.void(), generate


call: Any = intrinsic(_call)
prevent_vectorization: Any = intrinsic(_prevent_vectorization)
