"""What kernels ask of the machine itself, as Numba's intrinsics; `pointer` has what the interpreter does for them."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array


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


def _call_finish(
    _context: Any, _address: Any, _data: Any, _t: Any, _h: Any, old: Any, new: Any, before: Any, after: Any
) -> Any:
    """call_finish(address, data, t, h, old, new, before, after): int64 f(void *data, t, h, 4 × double *) there."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        real, memory = ir.DoubleType(), ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.IntType(64), [memory, real, real, *(real.as_pointer() for _ in range(4))])
        function = builder.inttoptr(arguments[0], kind.as_pointer())
        arrays = zip(signature.args[4:], arguments[4:], strict=True)
        data = [context.make_array(array)(context, builder, value).data for array, value in arrays]
        return builder.call(function, [builder.inttoptr(arguments[1], memory), *arguments[2:4], *data])

    return types.int64(types.int64, types.int64, types.float64, types.float64, old, new, before, after), generate


def _array_at(element: Any) -> Any:
    """An intrinsic f(address, size): an array of numbers of that kind, in memory that is owned elsewhere."""
    array = types.Array(element, 1, "C")

    def typed(_context: Any, _address: Any, _size: Any) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            made = context.make_array(array)(context, builder)
            width = context.get_constant(types.intp, 8)
            data = builder.inttoptr(arguments[0], context.get_data_type(element).as_pointer())
            fill: Any = populate_array
            fill(made, data=data, shape=[arguments[1]], strides=[width], itemsize=width, meminfo=None)
            return made._getvalue()  # noqa: SLF001 - as Numba's own code does

        return array(types.int64, types.int64), generate

    return intrinsic(typed)


def _call_jet(_context: Any, _address: Any, out: Any, given: Any, work: Any, program: Any) -> Any:
    """call_jet(address, out, given, work, program): void f(void *, void *, void *, void *) at `address`."""

    def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        memory = ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [memory] * 4)
        function = builder.inttoptr(arguments[0], kind.as_pointer())
        arrays = zip((out, given, work, program), arguments[1:], strict=True)
        data = [context.make_array(array)(context, builder, value).data for array, value in arrays]
        builder.call(function, [builder.bitcast(each, memory) for each in data])
        return context.get_dummy_value()

    return types.void(types.int64, out, given, work, program), generate


def _prevent_vectorization(_context: Any) -> Any:
    """prevent_vectorization(): the function in which this stands, and what it is a part of, is not vectorized.

    Vectors of numbers that were stored one by one just before are what a processor must wait for: with them, a
    right-hand side of two coordinates takes a quarter longer.
    """

    def generate(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
        builder.function.attributes.add("noimplicitfloat")
        return context.get_dummy_value()

    return types.void(), generate


def _nothing(_context: Any) -> Any:
    """checkpoint(): nothing; only who is interpreted looks at the clock."""

    def generate(context: Any, _builder: Any, _signature: Any, _arguments: Any) -> Any:
        return context.get_dummy_value()

    return types.void(), generate


call: Any = intrinsic(_call)
call_finish: Any = intrinsic(_call_finish)
doubles_at: Any = _array_at(types.float64)
integers_at: Any = _array_at(types.int64)
call_jet: Any = intrinsic(_call_jet)
prevent_vectorization: Any = intrinsic(_prevent_vectorization)
checkpoint: Any = intrinsic(_nothing)
