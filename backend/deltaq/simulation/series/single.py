"""What one motion does besides finding its coefficients: it goes a step, and tells what the step did.

Components of the state are the lanes of vectors, and one function serves states of all widths. Lanes behind the last
component have what stands next in memory, which nobody asks for.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import log, log2
from sys import float_info

from ..kernels.step import LARGEST_VALUE
from ..kernels.taylor import (
    COMPONENTS,
    DEFECT,
    FITS,
    GONE,
    JUDGED,
    LANES,
    NEW,
    NEW_REST,
    OLD,
    OLD_REST,
    ORDER,
    SAFETY,
    SHARES,
    SIZE,
    SLOPES,
    THETA,
    UNIT,
    VECTORS,
    WANTED,
    WIDTH,
)
from .code import Code, MachineCode, compiled, shared
from .stepping import SAFETY as SAFETY_OF_STEPS
from .stepping import logarithm, power_of_two

LARGEST_NUMBER = float_info.max


def single() -> MachineCode:
    """The functions `advance` and `measure`, void f(coefficients, states, told, plan)."""
    return shared("single", lambda: compiled({"advance": _advance(), "measure": _measure()}))


def told_of(order: int, tolerance: float) -> tuple[float, float, float]:
    """What is told of an order p and a tolerance ε: log₂ of (ε e^−0.7)^(1/(p − 1)), 1/p, 1/(p − 1).

    Without a tolerance (0) nobody asks for the step that is wanted.
    """
    bits = log2(tolerance) if tolerance > 0.0 else 0.0
    return (bits - SAFETY_OF_STEPS / log(2.0)) / (order - 1.0), 1.0 / order, 1.0 / (order - 1.0)


@dataclass(frozen=True)
class _Vectors:
    """Writes a loop over the vectors of a state; what it is about stands in memory as `taylor.Series` says."""

    code: Code
    sums: Mapping[str, tuple[str, str]]  # numbers that go from vector to vector: their types, and what they begin with

    def begin(self) -> None:
        """From the block `entry` into the loop."""
        code = self.code
        code.do(f"%length = mul i64 {self.told(VECTORS)}, {LANES}")
        code.do("br label %vector")
        code.label("vector")
        code.do("%first = phi i64 [ 0, %entry ], [ %first.n, %done ]")
        for name, (kind, start) in self.sums.items():
            code.do(f"%{name} = phi {kind} [ {start}, %entry ], [ %{name}.n, %done ]")

    def end(self, found: Mapping[str, str]) -> None:
        """To the next vector, or into the block `end`; these are the numbers behind this one."""
        code = self.code
        code.do("br label %done")
        code.label("done")
        for name, value in found.items():
            kind = self.sums[name][0]
            code.do(f"%{name}.n = bitcast {kind} {value} to {kind}")
        code.do(f"%first.n = add i64 %first, {LANES}")
        code.do(f"br i1 {code.new('icmp slt i64 %first.n, %length')}, label %vector, label %end")
        code.label("end")

    def told(self, place: int) -> str:
        """An integer that the code is told."""
        at = self.code.new(f"getelementptr inbounds i64, ptr %program, i64 {place}")
        return self.code.new(f"load i64, ptr {at}")

    def row(self, base: str, first: str) -> str:
        """The address of this vector in a row of doubles that begins `first` behind an address."""
        at = self.code.new(f"add i64 {first}, %first")
        return self.code.new(f"getelementptr inbounds double, ptr {base}, i64 {at}")

    def load(self, address: str) -> str:
        """The vector there."""
        return self.code.new(f"load {self.code.kind}, ptr {address}, align 8")

    def state(self, row: int) -> str:
        """The address of this vector in a row of states."""
        return self.row("%given", self.code.new(f"mul i64 %length, {row}"))

    def store(self, value: str, row: int) -> None:
        """Keeps the vector in a row of states."""
        self.code.do(f"store {self.code.kind} {value}, ptr {self.state(row)}, align 8")

    def is_behind(self, count: str) -> str:
        """Which lanes do not belong to so many components."""
        kind = self.code.whole
        numbers = ", ".join(f"i64 {lane}" for lane in range(LANES))
        places = self.code.new(f"add {kind} {self._spread('%first')}, <{numbers}>")
        return self.code.new(f"icmp sge {kind} {places}, {self._spread(count)}")

    def _spread(self, whole: str) -> str:
        kind = self.code.whole
        one = self.code.new(f"insertelement {kind} poison, i64 {whole}, i32 0")
        return self.code.new(f"shufflevector {kind} {one}, {kind} poison, <{LANES} x i32> zeroinitializer")


def _advance() -> Code:
    """The step θ, by Horner's rule for the state and for what its series ends with as h ẋ; and whether all fits.

    What the sum of state and change loses to rounding is kept (Knuth, The Art of Computer Programming 2, §4.2.2).
    """
    code = Code(LANES)
    loop, one = _Vectors(code, {"fits": ("i1", "true")}), Code(1, code.lines, code.declared, prefix="o")
    code.label("entry")
    order, components, width, judged = (loop.told(place) for place in (ORDER, COMPONENTS, WIDTH, JUDGED))
    theta = code.spread(one.load("%work", THETA))
    last, back = code.new(f"mul i64 {order}, {components}"), code.new(f"sub i64 0, {components}")
    loop.begin()
    highest = loop.row("%out", last)
    value = loop.load(highest)
    code.do("br label %sum")
    code.label("sum")
    code.do(f"%k = phi i64 [ {order}, %vector ], [ %k.n, %sum ]")
    code.do(f"%at = phi ptr [ {highest}, %vector ], [ %at.n, %sum ]")
    code.do(f"%c = phi {code.kind} [ {value}, %vector ], [ %c.n, %sum ]")
    code.do(f"%s = phi {code.kind} [ {code.number(0.0)}, %vector ], [ %s.n, %sum ]")
    code.do("%k.n = sub i64 %k, 1")
    code.do(f"%at.n = getelementptr inbounds double, ptr %at, i64 {back}")
    found = {"s": code.multiply_add("%s", theta, "%c"), "c": code.multiply_add("%c", theta, loop.load("%at.n"))}
    for name, each in found.items():
        code.do(f"%{name}.n = bitcast {code.kind} {each} to {code.kind}")
    code.do(f"br i1 {code.new('icmp sgt i64 %k.n, 1')}, label %sum, label %summed")
    code.label("summed")
    old, rest = (loop.load(loop.state(row)) for row in (OLD, OLD_REST))
    change = code.multiply_add("%c.n", theta, rest)
    new = code.add(old, change)
    loop.store(new, NEW)
    added = code.subtract(new, old)
    lost = code.add(code.subtract(old, code.subtract(new, added)), code.subtract(change, added))
    loop.store(lost, NEW_REST)
    loop.store(code.multiply(theta, code.multiply_add(theta, "%s.n", "%c.n")), SLOPES)
    bound = code.select(loop.is_behind(judged), code.number(LARGEST_NUMBER), code.number(LARGEST_VALUE))
    is_small = code.new(f"fcmp ole {code.kind} {code.size(new)}, {bound}")  # ∫P dt only has to be a number
    fit = code.new(f"or <{LANES} x i1> {is_small}, {loop.is_behind(width)}")
    all_fit = code.new(f"icmp eq i{LANES} {code.new(f'bitcast <{LANES} x i1> {fit} to i{LANES}')}, -1")
    loop.end({"fits": code.new(f"and i1 %fits, {all_fit}")})
    one.store(code.new("uitofp i1 %fits.n to double"), "%work", FITS)
    code.do("ret void")
    return code


def _measure() -> Code:
    """What a step did, by the series behind it, and the next one by Jorba and Zou.

    The defect is h |x′ − f| over max(1, |x|), the size Σ |c₁| + |c_p|; ∫P dt has no say.
    """
    code = Code(LANES)
    zero, one = code.number(0.0), Code(1, code.lines, code.declared, prefix="o")
    loop = _Vectors(code, dict.fromkeys(("size", "defect", "last", "before"), (code.kind, zero)))
    code.label("entry")
    order, components, judged = (loop.told(place) for place in (ORDER, COMPONENTS, JUDGED))
    gone, last = code.spread(one.load("%work", GONE)), code.new(f"mul i64 {order}, {components}")
    rows = (components, last, code.new(f"sub i64 {last}, {components}"))
    loop.begin()
    is_behind = loop.is_behind(judged)
    first, *highest = (code.select(is_behind, zero, loop.load(loop.row("%out", row))) for row in rows)
    slope = code.select(is_behind, zero, loop.load(loop.state(SLOPES)))
    scale = code.divide(code.number(1.0), code.larger(code.number(1.0), code.size(loop.load(loop.state(NEW)))))
    apart = code.size(code.subtract(slope, code.multiply(gone, first)))
    sizes = [code.size(each) for each in highest]
    found = {"size": code.add("%size", code.add(code.size(first), sizes[0]))}
    for name, each in zip(("defect", "last", "before"), (apart, *sizes), strict=True):
        found[name] = code.larger(f"%{name}", code.multiply(each, scale))
    loop.end(found)
    one.store(_joined(one, one.add, "size"), "%work", SIZE)
    one.store(_joined(one, one.larger, "defect"), "%work", DEFECT)
    one.store(_wanted(one, *(_joined(one, one.larger, name) for name in ("last", "before"))), "%work", WANTED)
    code.do("ret void")
    return code


def _joined(one: Code, how: Callable[[str, str], str], name: str) -> str:
    """The sum, say, of all lanes of a vector."""
    kind = Code(LANES).kind
    found = [one.new(f"extractelement {kind} %{name}.n, i32 {lane}") for lane in range(LANES)]
    while len(found) > 1:
        found = [how(a, b) for a, b in zip(found[::2], found[1::2], strict=True)]
    return found[0]


def _wanted(one: Code, last: str, before: str) -> str:
    """H (ε e^−0.7)^(1/(p − 1)) over the larger of |c_p|^(1/p) and |c_(p−1)|^(1/(p − 1)), to ten digits.

    With the order of Jorba and Zou, p = 1 + ½ ln(1/ε), that is their e^−2 e^(−0.7/(p − 1)).
    """
    two = Code(2, one.lines, one.declared, prefix="t")
    half = two.new(f"insertelement {two.kind} poison, double {last}, i32 0")
    both = two.new(f"insertelement {two.kind} {half}, double {before}, i32 1")
    shares = two.new(f"load {two.kind}, ptr {one.at('%work', SHARES)}, align 8")
    each = two.multiply(logarithm(two, both), shares)
    steepest = one.larger(*(one.new(f"extractelement {two.kind} {each}, i32 {number}") for number in (0, 1)))
    return one.multiply(one.load("%work", UNIT), power_of_two(one, one.subtract(one.load("%work", SAFETY), steepest)))
