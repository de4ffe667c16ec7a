"""Recurrences as code of their own: one operation after the other, and the sums of all of them in one loop.

A step's coefficients are found order by order. All sums Σ uⱼ vₖ₋ⱼ of an order k need lower orders only, so that those
of different operations are computed side by side in the lanes of vectors; their operands stand side by side in memory,
wherever they are needed. Where several motions run side by side, the lanes are theirs.

Of a sum the two ends, u₁ vₖ₋₁ and uₖ₋₁ v₁, come last. Of few sums they are found one by one, from what was found just
before, which is not read from memory then: the rest waits for nothing of the order before, and is computed meanwhile.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

from ...model import recurrences as r
from ...model.recurrences import Recurrences, Series, Term
from ..kernels.taylor import MOST_ORDERS
from .code import THOROUGH, Code, MachineCode, compiled, host
from .operations import COMPARISONS, Operands, first, kept, later
from .shape import Shape

TOGETHER = 5  # sums in one loop, whose parts have to stay in registers
FEW = 12  # sums of one motion whose ends are found one by one


class Sums(Protocol):
    """How the sums of an order are computed, and where the coefficients that they need are kept."""

    @property
    def size(self) -> int:
        """Doubles of work space."""

    @property
    def places(self) -> Mapping[Series, Sequence[int]]:
        """Where the coefficients of each series that a sum needs are kept, behind the address of their order."""

    def row(self, code: Code, order: str) -> str:
        """The address of an order: all places of its coefficients are constants."""

    @property
    def before(self) -> Sequence[Series]:
        """Series whose coefficients of the order before are asked for, by `_name`."""

    def write(self, code: Code, order: str) -> dict[Term, str]:
        """The sums of an order, from the block `order` to the beginning of the block `chain`."""


@dataclass(frozen=True)
class OfOperations:
    """Sums of one motion, those of several operations in the lanes of a vector."""

    terms: tuple[Term, ...]
    width: int

    @property
    def groups(self) -> int:
        return -(-len(self.terms) // self.width)

    @property
    def size(self) -> int:
        return 2 * self.groups * MOST_ORDERS * self.width

    def _base(self, group: int, side: int) -> int:
        return (2 * group + side) * MOST_ORDERS * self.width

    def row(self, code: Code, order: str) -> str:
        return code.new(f"getelementptr inbounds <{self.width} x double>, ptr %work, i64 {order}")

    @cached_property
    def places(self) -> Mapping[Series, Sequence[int]]:
        found: dict[Series, list[int]] = {}
        for number, term in enumerate(self.terms):
            for side, series in enumerate(term):
                place = self._base(number // self.width, side) + number % self.width
                found.setdefault(series, []).append(place)
        return found

    @property
    def are_few(self) -> bool:
        """Whether their ends cost less one by one than it takes to wait until they stand side by side in memory."""
        return len(self.terms) <= FEW

    @property
    def before(self) -> Sequence[Series]:
        return list(self.places) if self.are_few else []

    def write(self, code: Code, order: str) -> dict[Term, str]:
        found = _loop(self._vector(code), order, "order", self._pairs, has_ends=not self.are_few)
        if self.are_few:
            found = self._ended(code, order, self._apart(code, found))
        else:
            _begin_chain(code)
            found = self._apart(code, found)
        return dict(zip(self.terms, found, strict=True))

    def _ended(self, code: Code, order: str, inner: list[str]) -> list[str]:
        """Sums with their ends, from u₁ and v₁, and from uₖ₋₁ and vₖ₋₁ as they were found; for k ≤ 2 there are none."""
        code.do("br label %inner")
        code.label("inner")
        code.do(f"br i1 {code.new(f'icmp sgt i64 {order}, 2')}, label %ends, label %chain")
        code.label("ends")
        first, whole = {each: code.load("%work", at[0] + self.width) for each, at in self.places.items()}, []
        for (u, v), value in zip(self.terms, inner, strict=True):
            half = code.multiply_add(first[u], f"%{_name(v)}", value)
            whole.append(code.multiply_add(f"%{_name(u)}", first[v], half))
        _begin_chain(code)
        pairs = zip(inner, whole, strict=True)
        return [code.new(f"phi {code.kind} [ {one}, %inner ], [ {other}, %ends ]") for one, other in pairs]

    def _vector(self, code: Code) -> Code:
        return Code(self.width, code.lines, code.declared, prefix="w")

    @property
    def _pairs(self) -> list[list[int]]:
        return [[(2 * group + side) * MOST_ORDERS for side in (0, 1)] for group in range(self.groups)]

    def _apart(self, code: Code, found: list[str]) -> list[str]:
        kind = Code(self.width).kind
        return [
            code.new(f"extractelement {kind} {found[number // self.width]}, i32 {number % self.width}")
            for number in range(len(self.terms))
        ]


@dataclass(frozen=True)
class OfMotions:
    """Sums of several motions, which have the lanes of a vector."""

    terms: tuple[Term, ...]
    lanes: int

    @cached_property
    def places(self) -> Mapping[Series, Sequence[int]]:
        every = dict.fromkeys(series for term in self.terms for series in term)
        return {series: (number * MOST_ORDERS,) for number, series in enumerate(every)}

    @property
    def size(self) -> int:
        return len(self.places) * MOST_ORDERS * self.lanes

    def row(self, code: Code, order: str) -> str:
        return code.at("%work", order)

    @property
    def before(self) -> Sequence[Series]:
        return []

    def write(self, code: Code, order: str) -> dict[Term, str]:
        found: dict[Term, str] = {}
        begin = "order"
        for number, some in enumerate(_grouped(self.terms, TOGETHER)):
            pairs = [[self.places[series][0] for series in term] for term in some]
            found |= dict(zip(some, _loop(code, order, begin, pairs, f"{number}"), strict=True))
            begin = f"summed{number}"
        _begin_chain(code)
        return found


def _grouped(terms: Sequence[Term], most: int) -> list[list[Term]]:
    """Groups of so many sums, of which those are together that share series: what is read serves several then."""
    left, groups = list(terms), list[list[Term]]()
    while left:
        group = [left.pop(0)]
        while left and len(group) < most:
            known = {(side, series) for term in group for side, series in enumerate(term)}
            best = max(left, key=lambda term: sum((side, series) in known for side, series in enumerate(term)))
            left.remove(best)
            group.append(best)
        groups.append(group)
    return groups


def _loop(
    code: Code, order: str, begin: str, pairs: Sequence[Sequence[int]], name: str = "", *, has_ends: bool = True
) -> list[str]:
    """Σ uⱼ vₖ₋ⱼ for pairs of places of u₀ and v₀ in `work`, from the block `begin` to the block `summed` + name.

    First come 1 < j < k − 1 and then, if it `has_ends`, 1 and k − 1; for k = 2 in any case 1.
    """
    zero, start = code.number(0.0), f"sum{name}"
    sums = [f"%s{name}.{i}" for i in range(len(pairs))]
    nexts = [f"%n{name}.{i}" for i in range(len(pairs))]
    last = code.new(f"sub i64 {order}, 1")
    is_second = code.new(f"icmp eq i64 {order}, 2")
    inner = code.new(f"select i1 {is_second}, i64 2, i64 {code.new(f'sub i64 {order}, 2')}")
    end = order if has_ends else inner
    code.do(f"br label %{start}")
    code.label(start)
    code.do(f"%i{name} = phi i64 [ 2, %{begin} ], [ %in{name}, %body{name} ]")
    for one, following in zip(sums, nexts, strict=True):
        code.do(f"{one} = phi {code.kind} [ {zero}, %{begin} ], [ {following}, %body{name} ]")
    more = code.new(f"icmp sle i64 %i{name}, {end}")
    code.do(f"br i1 {more}, label %body{name}, label %summed{name}")
    code.label(f"body{name}")
    is_last = code.new(f"icmp eq i64 %i{name}, {order}")
    j = code.new(f"select i1 {is_last}, i64 {last}, i64 1")
    is_inner = code.new(f"icmp slt i64 %i{name}, {last}")
    j = code.new(f"select i1 {is_inner}, i64 %i{name}, i64 {j}")
    ahead, back = code.at("%work", j), code.at("%work", code.new(f"sub i64 {order}, {j}"))
    for one, following, (u, v) in zip(sums, nexts, pairs, strict=True):
        found = code.multiply_add(code.load(ahead, u), code.load(back, v), one)
        code.do(f"{following} = bitcast {code.kind} {found} to {code.kind}")
    code.do(f"%in{name} = add i64 %i{name}, 1")
    code.do(f"br label %{start}")
    code.label(f"summed{name}")
    return sums


def _begin_chain(code: Code) -> None:
    code.do("br label %chain")
    code.label("chain")


def _name(series: Series) -> str:
    """What the coefficient of the order before is called."""
    return f"q{series[0]}{'k' if series[1] else ''}"


@dataclass(frozen=True)
class Jet:
    """Code that finds the Taylor coefficients of a motion: void jet(out, given, work, program).

    `program` begins with the order, `work` has that many doubles.
    """

    code: MachineCode
    shape: Shape
    work: int
    program: tuple[int, ...] = ()


def jet_of(recurrences: Recurrences, lanes: int = 1, effort: int = THOROUGH) -> Jet:
    """The code of some recurrences, for one motion or for so many side by side; any effort gives the same digits."""
    every = (t for i, each in enumerate(recurrences.operations) for t in each.sums(recurrences.inputs + i))
    terms = tuple(dict.fromkeys(every))
    sums: Sums = OfOperations(terms, 8 if host().width >= 8 else 4) if lanes == 1 else OfMotions(terms, lanes)
    shape = Shape.of(recurrences, lanes)
    writer = _Writer(recurrences, shape, sums, Code(lanes))
    writer.write()
    return Jet(compiled({"jet": writer.code}, effort), shape, sums.size)


@dataclass(frozen=True)
class _Writer:
    """Writes a jet: the first coefficients, then a loop over the orders."""

    recurrences: Recurrences
    shape: Shape
    sums: Sums
    code: Code

    def write(self) -> None:
        """The whole function."""
        r_, code, shape = self.recurrences, self.code, self.shape
        code.label("entry")
        code.do("%last = load i64, ptr %program")
        unit, constants = code.load("%given", 0), self._constants()
        state = [code.load("%given", 1 + d) for d in range(shape.width)]
        time = code.load("%given", 1 + shape.width)
        inputs = [*state[: 2 * r_.degrees], time]
        begin, kept_, conditions = self._first(inputs, constants)
        self._out("0", state, begin)
        for number, place in enumerate(place for pair in r_.pivots for place in pair):
            code.store(begin[place], "%out", shape.first_pivot + number)
        following = self._integrated(state, begin, unit, code.number(1.0))
        self._out_state("1", following)
        code.do("br label %order")
        code.label("order")
        code.do("%k = phi i64 [ 1, %entry ], [ %kn, %chain ]")
        now = [f"%x{d}" for d in range(shape.width)]
        for d, value in enumerate(following):
            code.do(f"{now[d]} = phi {code.kind} [ {value}, %entry ], [ %xn{d}, %chain ]")
        code.do(f"%t = phi {code.kind} [ {unit}, %entry ], [ {code.number(0.0)}, %chain ]")
        for name in map(_name, self.sums.before):
            code.do(f"%{name} = phi {code.kind} [ {code.number(0.0)}, %entry ], [ %{name}.n, %chain ]")
        self._order([*now[: 2 * r_.degrees], "%t"], now, begin, kept_, conditions, constants, unit)

    def _constants(self) -> list[str]:
        return [self.code.load("%given", self.shape.first_constant + i) for i in range(self.shape.constants)]

    def _first(self, inputs: list[str], constants: list[str]) -> tuple[list[str], list[str], list[str]]:
        """The coefficients of order 0, what operations keep of them, and which conditions hold."""
        r_, code = self.recurrences, self.code
        values = list(inputs)
        truths: dict[int, str] = {}
        extras: list[str] = []
        for operation in r_.operations:
            truth = ""
            if operation.code == r.CHOICE:
                if operation.a not in truths:
                    condition = r_.conditions[operation.a]
                    truths[operation.a] = code.is_true(COMPARISONS[condition.kind], values[condition.argument])
                truth = truths[operation.a]
            name = r.FUNCTIONS[operation.c] if operation.code in r.WITH_FUNCTION else ""
            x = self._operands(operation, values, a=truth, constant=self._constant(operation, constants))
            values.append(first(code, operation.code, x, name))
        for place, operation in enumerate(r_.operations, len(inputs)):
            extras.append(kept(code, operation.code, self._operands(operation, values, y0=values[place])))
        return values, extras, [truths.get(i, "") for i in range(len(r_.conditions))]

    @staticmethod
    def _operands(operation: r.Operation, values: list[str], **more: Any) -> Operands:
        """What is known of an operation: the first coefficients of its operands, if there are such, and more."""
        a0, b0, c0 = (values[p] if p < len(values) else "" for p in (operation.a, operation.b, operation.c))
        return Operands(a0=a0, b0=b0, c0=c0, **more)

    @staticmethod
    def _constant(operation: r.Operation, constants: list[str]) -> str:
        return constants[operation.constant] if operation.code in r.WITH_CONSTANT else ""

    def _order(
        self,
        inputs: list[str],
        state: list[str],
        begin: list[str],
        extras: list[str],
        conditions: list[str],
        constants: list[str],
        unit: str,
    ) -> None:
        """The block of order k: sums, operations, and the next coefficients of the state."""
        r_, code = self.recurrences, self.code
        sums = self.sums.write(code, "%k")
        order = code.spread(code.new("sitofp i64 %k to double"))
        inverse = code.divide(code.number(1.0), order)
        values = list(inputs)
        row = self.sums.row(code, "%k")
        for place, value in enumerate(inputs):
            self._keep(place, value, order, row)
        for place, operation in enumerate(r_.operations, len(inputs)):
            a, b, c = (values[p] if p < len(values) else "" for p in (operation.a, operation.b, operation.c))
            x = self._operands(
                operation,
                begin,
                a=conditions[operation.a] if operation.code == r.CHOICE else a,
                b=b,
                c=c,
                y0=begin[place],
                extra=extras[place - len(inputs)],
                constant=self._constant(operation, constants),
                sums=tuple(sums[t] for t in operation.sums(place)),
                order=order,
                inverse=inverse,
            )
            joined = self._joined(operation, values, constants)
            values.append(joined or later(code, operation.code, x))
            self._keep(place, values[-1], order, row)
        self._end(state, values, unit)

    def _joined(self, operation: r.Operation, values: list[str], constants: list[str]) -> str:
        """A sum or difference in which the later operand is a series times a constant, rounded once; else nothing."""
        code, r_ = self.code, self.recurrences
        if operation.code not in (r.ADD, r.SUBTRACT):
            return ""
        places = [place for place in (operation.a, operation.b) if place >= r_.inputs]
        scaled = [place for place in places if r_.operations[place - r_.inputs].code == r.SCALE]
        if not scaled or operation.a == operation.b:
            return ""
        place = max(scaled)
        factor, series = constants[r_.operations[place - r_.inputs].constant], r_.operations[place - r_.inputs].a
        other = values[operation.a if place == operation.b else operation.b]
        if operation.code == r.SUBTRACT and place == operation.a:
            other = code.negative(other)
        elif operation.code == r.SUBTRACT:
            factor = code.negative(factor)
        return code.multiply_add(factor, values[series], other)

    def _end(self, state: list[str], values: list[str], unit: str) -> None:
        """What an order leaves: coefficients of the state and of conditions' arguments; and the next order, if any."""
        code = self.code
        code.do("%kn = add i64 %k, 1")
        next_order = code.spread(code.new("sitofp i64 %kn to double"))
        following = self._integrated(state, values, unit, next_order)
        self._out_conditions("%k", values)
        self._out_state("%kn", following)
        for d, value in enumerate(following):
            code.do(f"%xn{d} = bitcast {code.kind} {value} to {code.kind}")
        code.do(f"br i1 {code.new('icmp slt i64 %kn, %last')}, label %order, label %end")
        code.label("end")
        code.do("ret void")

    def _keep(self, place: int, value: str, order: str, row: str) -> None:
        """Keeps a coefficient for later sums, and k times it."""
        for times_order in (False, True):
            series = (place, times_order)
            if series in self.sums.places:
                kept_ = self.code.multiply(order, value) if times_order else value
                for at in self.sums.places[series]:
                    self.code.store(kept_, row, at)
                if series in self.sums.before:
                    self.code.do(f"%{_name(series)}.n = bitcast {self.code.kind} {kept_} to {self.code.kind}")

    def _integrated(self, state: list[str], values: list[str], unit: str, next_order: str) -> list[str]:
        """The next coefficients of the state: those of its derivative times H / (k + 1)."""
        r_, code = self.recurrences, self.code
        share = code.divide(unit, next_order)
        rates = [*state[r_.degrees : 2 * r_.degrees], *(values[place] for place in r_.accelerations)]
        rates += [] if r_.power is None else [values[r_.power]]
        return [code.multiply(rate, share) for rate in rates]

    def _out(self, order: str, state: list[str], values: list[str]) -> None:
        self._out_state(order, state)
        self._out_conditions(order, values)

    def _out_state(self, order: str, state: list[str]) -> None:
        row = self.code.new(f"mul i64 {order}, {self.shape.components}")
        base = self.code.at("%out", row)
        for d, value in enumerate(state):
            self.code.store(value, base, d)

    def _out_conditions(self, order: str, values: list[str]) -> None:
        r_ = self.recurrences
        if not r_.conditions:
            return
        base = self.code.at("%out", self.code.new(f"mul i64 {order}, {self.shape.components}"))
        for number, condition in enumerate(r_.conditions):
            self.code.store(values[condition.argument], base, self.shape.width + number)
