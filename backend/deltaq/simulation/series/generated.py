"""Recurrences as code of their own: one operation after the other, and the sums of all of them in one loop.

A step's coefficients are found order by order. All sums Σ uⱼ vₖ₋ⱼ of an order k need lower orders only, so that those
of different operations are computed side by side in the lanes of vectors; their operands stand side by side in memory,
wherever they are needed. Where several motions run side by side, the lanes are theirs.

Of a sum the two ends, u₁ vₖ₋₁ and uₖ₋₁ v₁, come last. Of few sums they are found one by one, from what was found just
before, which is not read from memory then: the rest waits for nothing of the order before, and is computed meanwhile.
All coefficients of an order stand together in memory, so that each pass of that loop reads two runs of neighbours.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

from ...model import recurrences as r
from ...model.recurrences import Recurrences, Series, Term
from ..kernels.taylor import MOST_ORDERS
from .code import LIBRARY, QUICK, THOROUGH, Code, MachineCode, compiled, host, shared
from .operations import COMPARISONS, Operands, first, kept, later
from .shape import Shape

TOGETHER = 5  # sums in one loop, whose parts have to stay in registers
FEW = 12  # sums of one motion whose ends are found one by one
USUAL = 4  # groups of sums of one motion; the loops for so many are made at once

Factors = tuple[str, str]
End = Callable[[Code, int], Factors]  # what is multiplied at an end of the sum with this number


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
    is_called: bool = False  # whether the loop is a function that all code calls: in quick code it would be slow

    @property
    def groups(self) -> int:
        return -(-len(self.terms) // self.width)

    @property
    def stride(self) -> int:
        """Vectors of one order: of each group those of u and those of v."""
        return 2 * self.groups

    @property
    def size(self) -> int:
        return (self.stride * MOST_ORDERS + self.groups) * self.width

    def row(self, code: Code, order: str) -> str:
        return _row(code, order, self.stride * self.width)

    @cached_property
    def places(self) -> Mapping[Series, Sequence[int]]:
        found: dict[Series, list[int]] = {}
        for number, term in enumerate(self.terms):
            for side, series in enumerate(term):
                place = (2 * (number // self.width) + side) * self.width + number % self.width
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
        if not self.terms:
            _begin_chain(code)
            return {}
        wide, pairs = self._vector(code), _pairs(self.groups)
        inner = self._called(wide, order) if self.is_called else _inner(wide, order, self.stride, pairs)
        if self.are_few:
            found = _ended(code, order, self._apart(code, inner), self._first, self._second)
        else:
            found = self._apart(wide, _ended(wide, order, inner, *_ends(wide, order, self.stride, pairs)))
        _begin_chain(code)
        return dict(zip(self.terms, found, strict=True))

    def _first(self, code: Code, number: int) -> Factors:
        u, v = self.terms[number]
        return self._of_order_1(code, u), f"%{_name(v)}"

    def _second(self, code: Code, number: int) -> Factors:
        u, v = self.terms[number]
        return f"%{_name(u)}", self._of_order_1(code, v)

    def _of_order_1(self, code: Code, series: Series) -> str:
        return code.load("%work", self.stride * self.width + self.places[series][0])

    def _called(self, code: Code, order: str) -> list[str]:
        """The inner sums by a function that leaves them behind the coefficients; it may be there from other models."""
        name = _loop_of(self.width, self.groups)
        shared(name, lambda: loops(self.width, range(1, USUAL + 1) if self.groups <= USUAL else (self.groups,)))
        code.declared.add(f'declare void @"{LIBRARY}{name}"(ptr, i64, ptr)')
        place = code.at("%work", self.stride * MOST_ORDERS)
        code.do(f'call void @"{LIBRARY}{name}"(ptr %work, i64 {order}, ptr {place})')
        found = [code.load(place, group) for group in range(self.groups)]
        code.do("br label %summed")
        code.label("summed")
        return found

    def _vector(self, code: Code) -> Code:
        return Code(self.width, code.lines, code.declared, prefix="w")

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
        return {series: (number,) for number, series in enumerate(every)}

    @property
    def size(self) -> int:
        return len(self.places) * MOST_ORDERS * self.lanes

    def row(self, code: Code, order: str) -> str:
        return _row(code, order, len(self.places))

    @property
    def before(self) -> Sequence[Series]:
        return []

    def write(self, code: Code, order: str) -> dict[Term, str]:
        found: dict[Term, str] = {}
        begin, stride = "order", len(self.places)
        for number, some in enumerate(_grouped(self.terms, TOGETHER)):
            pairs = [(self.places[u][0], self.places[v][0]) for u, v in some]
            inner = _inner(code, order, stride, pairs, begin, f"{number}")
            whole = _ended(code, order, inner, *_ends(code, order, stride, pairs), f"{number}")
            found |= dict(zip(some, whole, strict=True))
            begin = f"ended{number}"
        _begin_chain(code)
        return found


def loops(width: int, counts: Iterable[int]) -> MachineCode:
    """The inner sums of some numbers of groups: void loop(work, order, out), the coefficients standing in `work`."""
    made = {}
    for groups in counts:
        code = made[_loop_of(width, groups)] = Code(width, prefix="w")
        code.label("order")
        for group, value in enumerate(_inner(code, "%k", 2 * groups, _pairs(groups))):
            code.store(value, "%out", group)
        code.do("ret void")
    return compiled(made, THOROUGH, given="ptr noalias %work, i64 %k, ptr noalias %out")


def _loop_of(width: int, groups: int) -> str:
    return f"sums.{width}.{groups}"


def _pairs(groups: int) -> list[tuple[int, int]]:
    """The vectors of u and v in an order of so many groups."""
    return [(2 * group, 2 * group + 1) for group in range(groups)]


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


def _row(code: Code, order: str, stride: int) -> str:
    """The address of an order, of so many numbers."""
    return code.new(f"getelementptr [{stride} x {code.kind}], ptr %work, i64 {order}")


def _inner(
    code: Code, order: str, stride: int, pairs: Sequence[tuple[int, int]], begin: str = "order", name: str = ""
) -> list[str]:
    """Σ uⱼ vₖ₋ⱼ, 1 < j < k − 1, for pairs of places in an order, from the block `begin` to the one `summed` + name."""
    zero, start = code.number(0.0), f"sum{name}"
    sums = [f"%s{name}.{i}" for i in range(len(pairs))]
    nexts = [f"%n{name}.{i}" for i in range(len(pairs))]
    first, last = _row(code, "2", stride), _row(code, code.new(f"sub i64 {order}, 2"), stride)
    code.do(f"br label %{start}")
    code.label(start)
    code.do(f"%ahead{name} = phi ptr [ {first}, %{begin} ], [ %farther{name}, %body{name} ]")
    code.do(f"%back{name} = phi ptr [ {last}, %{begin} ], [ %nearer{name}, %body{name} ]")
    for one, following in zip(sums, nexts, strict=True):
        code.do(f"{one} = phi {code.kind} [ {zero}, %{begin} ], [ {following}, %body{name} ]")
    code.do(f"br i1 {code.new(f'icmp ule ptr %ahead{name}, {last}')}, label %body{name}, label %summed{name}")
    code.label(f"body{name}")
    for one, following, (u, v) in zip(sums, nexts, pairs, strict=True):
        found = code.multiply_add(code.load(f"%ahead{name}", u), code.load(f"%back{name}", v), one)
        code.do(f"{following} = bitcast {code.kind} {found} to {code.kind}")
    code.do(f"%farther{name} = getelementptr [{stride} x {code.kind}], ptr %ahead{name}, i64 1")
    code.do(f"%nearer{name} = getelementptr [{stride} x {code.kind}], ptr %back{name}, i64 -1")
    code.do(f"br label %{start}")
    code.label(f"summed{name}")
    return sums


def _ends(code: Code, order: str, stride: int, pairs: Sequence[tuple[int, int]]) -> tuple[End, End]:
    """The ends of sums, from memory."""
    first, last = _row(code, "1", stride), _row(code, code.new(f"sub i64 {order}, 1"), stride)
    return (
        lambda code, i: (code.load(first, pairs[i][0]), code.load(last, pairs[i][1])),
        lambda code, i: (code.load(last, pairs[i][0]), code.load(first, pairs[i][1])),
    )


def _ended(code: Code, order: str, inner: Sequence[str], first: End, second: End, name: str = "") -> list[str]:
    """Sums with u₁ vₖ₋₁ for k > 1 and uₖ₋₁ v₁ for k > 2, from the block `summed` + name to the block `ended` + name."""
    half, whole = f"half{name}", f"whole{name}"
    code.do(f"br i1 {code.new(f'icmp sgt i64 {order}, 1')}, label %{half}, label %ended{name}")
    code.label(half)
    halves = [code.multiply_add(*first(code, i), one) for i, one in enumerate(inner)]
    code.do(f"br i1 {code.new(f'icmp sgt i64 {order}, 2')}, label %{whole}, label %ended{name}")
    code.label(whole)
    wholes = [code.multiply_add(*second(code, i), one) for i, one in enumerate(halves)]
    code.do(f"br label %ended{name}")
    code.label(f"ended{name}")
    return [
        code.new(f"phi {code.kind} [ {a}, %summed{name} ], [ {b}, %{half} ], [ {c}, %{whole} ]")
        for a, b, c in zip(inner, halves, wholes, strict=True)
    ]


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
    width = 8 if host().width >= 8 else 4
    sums: Sums = OfOperations(terms, width, effort == QUICK) if lanes == 1 else OfMotions(terms, lanes)
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
