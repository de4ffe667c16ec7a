"""The error of each motion in lanes, carried along by a neighbour: a motion that lies beside it by as much, enlarged.

What a step does wrong is told by the defect at its end, a vector: x′ of the series lacks the terms k cₖ θᵏ behind the
order p, and x lacks cₖ θᵏ, which is about the (p + 1)-th part. What errors become along the way is the difference of
two motions that are near each other. So near, a few orders of their series tell it to many digits; with many steps it
takes more of them.
The distance of the neighbour is the error times a power of two, chosen anew for each step, by which it is a millionth
of what the motion does in the step: far above rounding, and small enough to be linear.

Rounding is enlarged as well: neighbours begin and have constants some units in the last place away, and in each step
some more are added to h ẋ, and to x where forces are found: away from the motion, so that they never cancel out.

A series cannot tell what forces do in places that it knows nothing of: next to a wall, say, that is thinner than a step
is long. So it is looked within each step as well whether they are what the series says.
"""

from __future__ import annotations

from ..kernels.ensemble import (
    APART,
    APART_AHEAD,
    APART_FOUND,
    ERRORS,
    ERRORS_FOUND,
    GONE,
    INSIDE,
    INSIDE_STATES,
    KEPT,
    ROWS,
    SCALE,
    SHARE,
    SLOPES,
    STATES,
    THETA,
    UNIT,
)
from .code import Code
from .shape import Shape
from .stepping import TOGETHER, summed

NEAR = 2.0**-20  # the distance over what the motion does in a step
PLACE = 0.46  # in a step where it is looked at forces: between two ends, and never in step with equal steps
WITHIN = 0.5  # of a step, in which a coordinate may change by what is wrong with its velocity
AMONG_OTHERS = 2.0**-6  # what others of its kind do counts so much for a coordinate
# How many times an error is enlarged: constants are nudged by so much more than rounding; and by how little, where it
# is nearly as large as what the motion does.
MOST, LEAST = 2.0**30, 2.0**-20
OF_STEP, OF_STATE = 2.0**-51, 2.0**-53  # what rounding does to h ẋ, and to x where forces are found
OF_TIME = 2.0**-52  # and to the phase of a drive, by that of the time and of its product with a frequency
EXPONENT, SIGN = 0x7FF << 52, 1 << 63  # of the bits of a number


def settle(shape: Shape) -> Code:
    """Behind a step: the distance with what the step did wrong, and the largest error so far.

    `out` has the coefficients behind it, `given` the rows of states, `work` those of steps.
    """
    code = Code(shape.lanes)
    code.label("entry")
    share, gone, scale = (code.load("%work", row) for row in (SHARE, GONE, SCALE))
    zero, endless = code.number(0.0), code.number(float("inf"))
    is_step = code.new(f"fcmp ogt {code.kind} {share}, {zero}")
    step, smaller = code.multiply(gone, code.load("%work", UNIT)), code.divide(code.number(1.0), scale)
    n, errors, sizes = shape.degrees, dict[int, str](), dict[int, str]()
    for d in [*range(n, 2 * n), *range(n)]:
        rate = code.multiply(gone, code.load("%out", shape.components + d))
        defect = code.subtract(code.load("%given", SLOPES * shape.width + d), rate)
        if d < n:  # the rate at the end is wrong by what the velocity is
            defect = code.multiply_add(step, errors[n + d], defect)
        errors[d] = code.multiply(defect, share)
        ahead = code.load("%given", APART_AHEAD * shape.width + d)
        noise = _rounding(code, OF_STEP, rate, ahead)
        wrong = code.select(is_step, code.multiply(scale, code.add(errors[d], noise)), zero)
        found = code.add(ahead, wrong)
        code.store(found, "%given", APART_FOUND * shape.width + d)
        sizes[d] = code.size(found)
        if d < n:  # it may be zero at the end, and something on the way
            on_the_way = code.multiply(code.number(WITHIN), code.multiply(step, sizes[n + d]))
            sizes[d] = code.larger(sizes[d], code.select(is_step, on_the_way, zero))
        error, before = code.multiply(smaller, sizes[d]), code.load("%given", ERRORS * shape.width + d)
        is_known = code.new(f"fcmp olt {code.kind} {error}, {endless}")
        largest = code.select(is_known, code.larger(before, error), endless)
        code.store(largest, "%given", ERRORS_FOUND * shape.width + d)
    code.do("ret void")
    return code


def begin(shape: Shape) -> Code:
    """Before a step θ: where neighbours begin, behind all other rows, as a jet wants it.

    `out` has the coefficients, `given` what the jet was given, `work` all rows.
    """
    code = Code(shape.lanes)
    code.label("entry")
    told = STATES * shape.width
    theta, kept, scale = (code.load("%work", told + row) for row in (THETA, KEPT, SCALE))
    zero = code.number(0.0)
    goes, is_kept = (code.new(f"fcmp one {code.kind} {number}, {zero}") for number in (theta, kept))
    bases = []
    for d in range(2 * shape.degrees):
        kept_base, kept_error = (
            code.select(is_kept, *(code.load("%work", row * shape.width + d) for row in pair))
            for pair in ((APART_FOUND, APART), (ERRORS_FOUND, ERRORS))
        )
        bases.append(kept_base)
        code.store(kept_error, "%work", ERRORS * shape.width + d)
    parts = code.of_bits(code.on_bits("and", code.bits(_too_far(code, shape, bases, theta)), EXPONENT))
    wanted = code.larger(code.number(LEAST), code.smaller(code.number(MOST), code.divide(scale, parts)))
    new_scale = code.select(goes, wanted, scale)
    factor = code.divide(new_scale, scale)
    code.store(new_scale, "%work", told + SCALE)
    constants = shape.constants
    near = told + ROWS + constants
    code.store(code.load("%work", told + UNIT), "%work", near)
    for d in range(shape.width):
        state = code.load("%given", 1 + d)
        if d < len(bases):
            base = code.multiply(factor, bases[d])
            code.store(base, "%work", APART * shape.width + d)
            noise = _rounding(code, OF_STATE, state, base)
            state = code.add(state, code.multiply_add(new_scale, noise, base))
        code.store(state, "%work", near + 1 + d)
    time = code.load("%given", 1 + shape.width)
    noise = _rounding(code, OF_TIME, time, bases[shape.degrees])
    code.store(code.multiply_add(new_scale, noise, time), "%work", near + 1 + shape.width)
    for c in range(constants):
        nudge = code.load("%work", told + ROWS + c)
        number = code.load("%given", shape.first_constant + c)
        code.store(code.multiply_add(new_scale, nudge, number), "%work", near + shape.first_constant + c)
    code.do("ret void")
    return code


def _rounding(code: Code, part: float, number: str, apart: str) -> str:
    """A part of a number, with the sign of the distance that is there."""
    size = code.bits(code.multiply(code.number(part), code.size(number)))
    return code.of_bits(code.on_bits("or", size, code.on_bits("and", code.bits(apart), -SIGN)))


def _too_far(code: Code, shape: Shape, bases: list[str], theta: str) -> str:
    """How many times too far away the neighbours are: the largest of all coordinates and velocities."""
    n, found = shape.degrees, code.number(0.0)
    for start in (0, n):
        moved = []
        for d in range(start, start + n):
            first, second = (code.size(code.load("%out", k * shape.components + d)) for k in (1, 2))
            moved.append(code.multiply(theta, code.multiply_add(theta, second, first)))
        others = moved[0]
        for each in moved[1:]:
            others = code.add(others, each)
        others = code.multiply(code.number(AMONG_OTHERS), others)
        for base, own in zip(bases[start : start + n], moved, strict=True):
            allowed = code.multiply(code.number(NEAR), code.add(own, others))
            found = code.larger(found, code.divide(code.size(base), allowed))
    return found


def carry(shape: Shape) -> Code:
    """What becomes of the distance in a step θ.

    `out` has the coefficients of neighbours, `given` those of the motions, `work` all rows.
    """
    code = Code(shape.lanes)
    code.label("entry")
    theta, zero = code.load("%work", STATES * shape.width + THETA), code.number(0.0)
    goes = code.new(f"fcmp one {code.kind} {theta}, {zero}")
    count = 2 * shape.degrees
    code.do("%last = load i64, ptr %program")
    code.do("br label %sum")
    code.label("sum")
    code.do("%k = phi i64 [ %last, %entry ], [ %kn, %sum ]")
    for d in range(count):
        code.do(f"%c{d} = phi {code.kind} [ {zero}, %entry ], [ %cn{d}, %sum ]")
    row = code.new(f"mul i64 %k, {shape.components}")
    for d in range(count):
        place = code.new(f"add i64 {row}, {d}")
        apart = code.subtract(code.load("%out", place), code.load("%given", place))
        code.do(f"%cn{d} = fmul {code.kind} {theta}, {code.add(f'%c{d}', apart)}")
    code.do("%kn = sub i64 %k, 1")
    code.do(f"br i1 {code.new('icmp sgt i64 %kn, 0')}, label %sum, label %end")
    code.label("end")
    for d in range(count):
        base = code.load("%work", APART * shape.width + d)
        ahead = code.add(base, code.select(goes, f"%cn{d}", zero))
        code.store(ahead, "%work", APART_AHEAD * shape.width + d)
    code.do("ret void")
    return code


def look(shape: Shape) -> Code:
    """The states within a step θ, behind all other rows, as a jet wants them; and h ẋ there, as the series says.

    `out` has the coefficients, `given` what the jet was given, `work` all rows.
    """
    code = Code(shape.lanes)
    code.label("entry")
    code.do("%last = load i64, ptr %program")
    told, constants = STATES * shape.width, shape.constants
    theta, unit = (code.load("%work", told + row) for row in (THETA, UNIT))
    theta = code.multiply(code.number(PLACE), theta)
    near, block = told + ROWS + constants, "entry"
    for start in range(0, shape.width, TOGETHER):
        some = range(start, min(start + TOGETHER, shape.width))
        for d, value, slope in summed(code, shape, some, theta, block):
            state = code.multiply_add(theta, value, code.load("%given", 1 + d))
            code.store(state, "%work", near + 1 + d)
            rate = code.multiply(theta, code.multiply_add(theta, slope, value))
            code.store(rate, "%work", INSIDE_STATES * shape.width + d)
        block = f"summed{start}"
    code.store(unit, "%work", near)
    time = code.load("%given", 1 + shape.width)
    code.store(code.multiply_add(theta, unit, time), "%work", near + 1 + shape.width)
    for c in range(shape.first_constant, shape.first_constant + constants):
        code.store(code.load("%given", c), "%work", near + c)
    code.do("ret void")
    return code


def compare(shape: Shape) -> Code:
    """The defect within a step θ, as that at its end; infinite where forces are not known there.

    `out` has the coefficients of the states within, `given` is not used, `work` has all rows.
    """
    code = Code(shape.lanes)
    code.label("entry")
    told = STATES * shape.width
    near, defect = told + ROWS + shape.constants, code.number(0.0)
    theta = code.multiply(code.number(PLACE), code.load("%work", told + THETA))
    endless = code.number(float("inf"))
    for d in range(2 * shape.degrees):
        rate = code.multiply(theta, code.load("%out", shape.components + d))
        apart = code.size(code.subtract(code.load("%work", INSIDE_STATES * shape.width + d), rate))
        size = code.larger(code.number(1.0), code.size(code.load("%work", near + 1 + d)))
        found = code.divide(apart, size)
        is_known = code.new(f"fcmp olt {code.kind} {found}, {endless}")
        defect = code.larger(defect, code.select(is_known, found, endless))
    code.store(defect, "%work", told + INSIDE)
    code.do("ret void")
    return code
