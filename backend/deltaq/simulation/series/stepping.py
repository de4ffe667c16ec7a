"""What motions side by side do besides finding their coefficients: they go a step, and tell what it did.

All is written for vectors of so many lanes: a loop over lanes in a kernel would do one after the other.
"""

from __future__ import annotations

from math import factorial, log, sqrt

from ..kernels.ensemble import (
    DEFECTS,
    GONE,
    MARGINS,
    NEW,
    NEW_REST,
    OLD,
    OLD_REST,
    PIVOTS,
    SIZES,
    SLOPES,
    THETA,
    TOLERANCE,
    UNIT,
    WANTED,
)
from .code import Code
from .shape import Shape

TOGETHER = 2  # components in one loop
BITS = 52  # behind the point of a double
FAR = 1000.0  # the largest exponent of 2 that is asked for
OF_LOGARITHM = [2.0 / (2 * k + 1) / log(2.0) for k in range(7)]  # of log₂ m by powers of (m − 1)/(m + 1)
OF_POWER = [log(2.0) ** k / factorial(k) for k in range(11)]  # of 2^x
SAFETY = 0.7  # Jorba and Zou, §3.2


def advance(shape: Shape) -> Code:
    """All lanes go their step θ, by Horner's rule for the states and for what their series end with as h ẋ.

    `out` has the coefficients, `given` the rows of states, `work` those of steps. A lane rests where θ = 0.
    """
    code = Code(shape.lanes)
    code.label("entry")
    code.do("%last = load i64, ptr %program")
    theta, zero = code.load("%work", THETA), code.number(0.0)
    goes = code.new(f"fcmp one {code.kind} {theta}, {zero}")
    block = "entry"
    for start in range(0, shape.width, TOGETHER):
        some = range(start, min(start + TOGETHER, shape.width))
        for d, value, slope in summed(code, shape, some, theta, block):
            old, rest = code.load("%given", NEW * shape.width + d), code.load("%given", NEW_REST * shape.width + d)
            code.store(old, "%given", OLD * shape.width + d)
            code.store(rest, "%given", OLD_REST * shape.width + d)
            change = code.add(code.select(goes, code.multiply(value, theta), zero), rest)
            new = code.add(old, change)
            code.store(new, "%given", NEW * shape.width + d)
            code.store(code.subtract(change, code.subtract(new, old)), "%given", NEW_REST * shape.width + d)
            grown = code.multiply(theta, code.multiply_add(theta, slope, value))
            code.store(code.select(goes, grown, zero), "%given", SLOPES * shape.width + d)
        block = f"summed{start}"
    code.do("ret void")
    return code


def summed(code: Code, shape: Shape, some: range, theta: str, block: str) -> list[tuple[int, str, str]]:
    """Of some components Σ cₖ θ^(k−1) and its derivative by θ; ends in the block `summed` + the first of them."""
    name, kind, zero = some[0], code.kind, code.number(0.0)
    row = code.new(f"mul i64 %last, {shape.components}")
    firsts = [code.load("%out", code.new(f"add i64 {row}, {d}")) for d in some]
    code.do(f"br label %sum{name}")
    code.label(f"sum{name}")
    code.do(f"%k{name} = phi i64 [ %last, %{block} ], [ %kn{name}, %body{name} ]")
    for d, first in zip(some, firsts, strict=True):
        code.do(f"%c{d} = phi {kind} [ {first}, %{block} ], [ %cn{d}, %body{name} ]")
        code.do(f"%s{d} = phi {kind} [ {zero}, %{block} ], [ %sn{d}, %body{name} ]")
    code.do(f"%kn{name} = sub i64 %k{name}, 1")
    more = code.new(f"icmp sgt i64 %kn{name}, 0")
    code.do(f"br i1 {more}, label %body{name}, label %summed{name}")
    code.label(f"body{name}")
    row = code.new(f"mul i64 %kn{name}, {shape.components}")
    for d in some:
        slope = code.multiply_add(f"%s{d}", theta, f"%c{d}")
        value = code.multiply_add(f"%c{d}", theta, code.load("%out", code.new(f"add i64 {row}, {d}")))
        code.do(f"%sn{d} = bitcast {kind} {slope} to {kind}")
        code.do(f"%cn{d} = bitcast {kind} {value} to {kind}")
    code.do(f"br label %sum{name}")
    code.label(f"summed{name}")
    return [(d, f"%c{d}", f"%s{d}") for d in some]


def measure(shape: Shape, smallest_pivot: float) -> Code:
    """What a step did, by the series behind it, and the next one by Jorba and Zou; arguments as for `advance`.

    Defects are h |x′ − f| over max(1, |x|), sizes Σ |c₁| + |c_p| + |x|; margins are pivots above the least that is
    wanted of them.
    """
    code = Code(shape.lanes)
    code.label("entry")
    order = code.new("load i64, ptr %program")
    gone, zero, one = code.load("%work", GONE), code.number(0.0), code.number(1.0)
    last_row = code.at("%out", code.new(f"mul i64 {order}, {shape.components}"))
    row_before = code.at("%out", code.new(f"mul i64 {code.new(f'sub i64 {order}, 1')}, {shape.components}"))
    total = defect = last = before = zero
    for d in range(2 * shape.degrees):
        size = code.size(code.load("%given", NEW * shape.width + d))
        first, highest = code.load("%out", shape.components + d), code.size(code.load(last_row, d))
        scale = code.divide(one, code.larger(one, size))
        apart = code.subtract(code.load("%given", SLOPES * shape.width + d), code.multiply(gone, first))
        total = code.add(total, code.add(code.add(code.size(first), highest), size))
        defect = code.larger(defect, code.multiply(code.size(apart), scale))
        last = code.larger(last, code.multiply(highest, scale))
        before = code.larger(before, code.multiply(code.size(code.load(row_before, d)), scale))
    margin, pivots = code.number(float("inf")), zero
    for place in range(shape.first_pivot, shape.components, 2):
        pivot, least = (
            code.load("%out", place),
            code.multiply(code.number(smallest_pivot), code.load("%out", place + 1)),
        )
        margin = code.smaller(margin, code.subtract(pivot, least))
        pivots = code.add(pivots, pivot)
    found = {SIZES: total, MARGINS: margin, PIVOTS: pivots, DEFECTS: defect, WANTED: _wanted(code, order, last, before)}
    for place, value in found.items():
        code.store(value, "%work", place)
    code.do("ret void")
    return code


def _wanted(code: Code, order: str, last: str, before: str) -> str:
    """H (ε e^−0.7)^(1/(p − 1)) over the larger of |c_p|^(1/p) and |c_(p−1)|^(1/(p − 1)), to ten digits."""
    tolerance, count = (
        logarithm(code, code.load("%work", TOLERANCE)),
        code.spread(code.new(f"sitofp i64 {order} to double")),
    )
    fewer = code.subtract(count, code.number(1.0))
    steepest = code.larger(
        code.divide(logarithm(code, last), count),
        code.divide(logarithm(code, before), fewer),
    )
    safety = code.divide(code.subtract(tolerance, code.number(SAFETY / log(2.0))), fewer)
    return code.multiply(code.load("%work", UNIT), power_of_two(code, code.subtract(safety, steepest)))


def logarithm(code: Code, x: str) -> str:
    """log₂ x for x > 0; about −1023 for 0."""
    bits = code.bits(x)
    mantissa = code.of_bits(code.on_bits("or", code.on_bits("and", bits, 2**BITS - 1), 1023 << BITS))
    is_large = code.new(f"fcmp ogt {code.kind} {mantissa}, {code.number(sqrt(2.0))}")
    half = code.multiply(code.number(0.5), mantissa)
    mantissa = code.select(is_large, half, mantissa)
    # the exponent as a double: its bits behind the point of 2^52
    raw = code.of_bits(code.on_bits("or", code.on_bits("lshr", bits, BITS), (1023 + BITS) << BITS))
    exponent = code.subtract(
        raw, code.select(is_large, code.number(2.0**BITS + 1022.0), code.number(2.0**BITS + 1023.0))
    )
    ratio = code.divide(code.subtract(mantissa, code.number(1.0)), code.add(mantissa, code.number(1.0)))
    return code.multiply_add(ratio, code.in_halves(OF_LOGARITHM, code.multiply(ratio, ratio)), exponent)


def power_of_two(code: Code, x: str) -> str:
    """2^x, for |x| up to FAR."""
    x = code.larger(code.number(-FAR), code.smaller(code.number(FAR), x))
    shifted = code.add(x, code.number(1.5 * 2.0**BITS))
    rest = code.subtract(x, code.subtract(shifted, code.number(1.5 * 2.0**BITS)))
    scale = code.of_bits(code.on_bits("shl", code.on_bits("add", code.bits(shifted), 1023), BITS))
    return code.multiply(scale, code.in_halves(OF_POWER, rest))
