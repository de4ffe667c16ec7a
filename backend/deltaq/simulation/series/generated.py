"""Recurrences as code of their own: one operation after the other, and the sums of all of them in one loop (`sums`)."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any, overload

from ...model import recurrences as r
from ...model.recurrences import Recurrences
from .code import Code, MachineCode, compiled
from .operations import COMPARISONS, Operands, beginnings, first, kept, later
from .shape import Shape
from .sums import Blocks, OfMotions, OfOperations, Sums, name_of, terms_of, width_of_sums


@dataclass(frozen=True)
class Joined:
    """A sum of the series at a place times a constant, and of that at another place; or a difference."""

    series: int
    constant: int
    other: int
    is_less: bool  # the product is subtracted
    is_from: bool  # the other one is subtracted


def joined(recurrences: Recurrences, operation: r.Operation) -> Joined | None:
    """A sum or difference in which the later operand is a series times a constant; else nothing."""
    inputs, operations = recurrences.inputs, recurrences.operations
    if operation.code not in (r.ADD, r.SUBTRACT) or operation.a == operation.b:
        return None
    places = [place for place in (operation.a, operation.b) if place >= inputs]
    scaled = [place for place in places if operations[place - inputs].code == r.SCALE]
    if not scaled:
        return None
    place = max(scaled)
    found, is_second, is_less = operations[place - inputs], place == operation.b, operation.code == r.SUBTRACT
    other = operation.a if is_second else operation.b
    return Joined(found.a, found.constant, other, is_less and is_second, is_less and not is_second)


def wanted(recurrences: Recurrences) -> set[int]:
    """Places whose coefficients of order 1 and more are asked for; those of series that are only `joined` are not."""
    found, inputs = set[int](), recurrences.inputs
    left = [*recurrences.accelerations, *(condition.argument for condition in recurrences.conditions)]
    left += [] if recurrences.power is None else [recurrences.power]
    while left:
        place = left.pop()
        if place not in found and place >= inputs:
            operation = recurrences.operations[place - inputs]
            one = joined(recurrences, operation)
            left += (one.series, one.other) if one else r.operands(operation)
            left += [each for term in operation.sums(place) for each, _ in term]
        found.add(place)
    return found


MANY = 48  # sums, from which on a function of its own finds an order


@dataclass(frozen=True)
class Jet:
    """Code that finds the Taylor coefficients of a motion: void jet(out, given, work, program).

    `program` begins with the order, `work` has that many doubles.
    """

    code: MachineCode
    shape: Shape
    work: int
    program: tuple[int, ...] = ()


def jet_of(recurrences: Recurrences, lanes: int = 1) -> Jet:
    """The code of some recurrences, for one motion or for so many side by side."""
    terms, shape = terms_of(recurrences), Shape.of(recurrences, lanes)
    if lanes == 1 and len(terms) > MANY and not recurrences.conditions:
        return _InParts(recurrences, shape, Blocks(terms, width_of_sums()), Code(1, is_rare=True)).jet()
    sums: Sums = OfOperations(terms, width_of_sums()) if lanes == 1 else OfMotions(terms, lanes)
    writer = _Writer(recurrences, shape, sums, Code(lanes))
    writer.write()
    return Jet(compiled({"jet": writer.code}), shape, sums.size)


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
        unit, constants, begin, kept_, conditions, following = self._entry()
        code.do("br label %order")
        code.label("order")
        code.do("%k = phi i64 [ 1, %entry ], [ %kn, %chain ]")
        now = [f"%x{d}" for d in range(shape.width)]
        for d, value in enumerate(following):
            code.do(f"{now[d]} = phi {code.kind} [ {value}, %entry ], [ %xn{d}, %chain ]")
        code.do(f"%t = phi {code.kind} [ {unit}, %entry ], [ {code.number(0.0)}, %chain ]")
        code.do("%inverse = phi double [ 1.0, %entry ], [ %inverse.n, %chain ]")
        for name in map(name_of, self.sums.before):
            code.do(f"%{name} = phi {code.kind} [ {code.number(0.0)}, %entry ], [ %{name}.n, %chain ]")
        self._order([*now[: 2 * r_.degrees], "%t"], now, begin, kept_, conditions, constants, unit)

    def _entry(self) -> tuple[str, list[str], list[str], list[str], list[str], list[str]]:
        """The first block: H, the constants, the first coefficients, what is kept, conditions, and the next state."""
        r_, code, shape = self.recurrences, self.code, self.shape
        code.label("entry")
        code.do("%last = load i64, ptr %program")
        unit, constants = code.load("%given", 0), self._constants()
        state = [code.load("%given", 1 + d) for d in range(shape.width)]
        time = code.load("%given", 1 + shape.width)
        begin, kept_, conditions = self._first([*state[: 2 * r_.degrees], time], constants)
        self._out("0", state, begin)
        for number, place in enumerate(place for pair in r_.pivots for place in pair):
            code.store(begin[place], "%out", shape.first_pivot + number)
        following = self._integrated(state, begin, unit, code.number(1.0))
        self._out_state("1", following)
        return unit, constants, begin, kept_, conditions, following

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
    def _operands(operation: r.Operation, values: Sequence[str], **more: Any) -> Operands:
        """What is known of an operation: the first coefficients of its operands, if there are such, and more."""
        a0, b0, c0 = (values[p] if p < len(values) else "" for p in (operation.a, operation.b, operation.c))
        return Operands(a0=a0, b0=b0, c0=c0, **more)

    @staticmethod
    def _now(operation: r.Operation, values: list[str], conditions: list[str]) -> dict[str, str]:
        """The coefficients of order k of an operation's operands; of a choice whether its condition holds, as `a`."""
        places = {"a": operation.a, "b": operation.b, "c": operation.c}
        found = {name: values[place] if place < len(values) else "" for name, place in places.items()}
        return found | {"a": conditions[operation.a]} if operation.code == r.CHOICE else found

    @staticmethod
    def _constant(operation: r.Operation, constants: Sequence[str]) -> str:
        return constants[operation.constant] if operation.code in r.WITH_CONSTANT else ""

    def _order(
        self,
        inputs: list[str],
        state: list[str],
        begin: Sequence[str],
        extras: Sequence[str],
        conditions: list[str],
        constants: Sequence[str],
        unit: str,
    ) -> None:
        """The block of order k: sums, operations, and the next coefficients of the state."""
        r_, code = self.recurrences, self.code
        sums = self.sums.write(code, "%k")
        order = code.spread(code.new("sitofp i64 %k to double"))
        inverse = code.spread("%inverse")
        values = list(inputs)
        row, asked = self.sums.row(code, "%k"), wanted(r_)
        for place, value in enumerate(inputs):
            self._keep(place, value, order, row)
        for place, operation in enumerate(r_.operations, len(inputs)):
            if place not in asked:
                values.append("")
                continue
            value = self._joined(operation, values, constants)
            if not value:
                places = {"a0": operation.a, "b0": operation.b, "y0": place}
                asked_first = beginnings(operation.code)  # only these are read
                x = Operands(
                    **self._now(operation, values, conditions),
                    **{name: begin[places[name]] for name in asked_first if name != "extra"},
                    extra=extras[place - len(inputs)] if "extra" in asked_first else "",
                    constant=self._constant(operation, constants),
                    sums=tuple(sums[t] for t in operation.sums(place)),
                    order=order,
                    inverse=inverse,
                )
                value = later(code, operation.code, x)
            values.append(value)
            self._keep(place, value, order, row)
        self._end(state, values, unit)

    def _joined(self, operation: r.Operation, values: list[str], constants: Sequence[str]) -> str:
        """A sum or difference in which the later operand is a series times a constant, rounded once; else nothing."""
        code, one = self.code, joined(self.recurrences, operation)
        if one is None:
            return ""
        factor, other = constants[one.constant], values[one.other]
        if one.is_from:
            other = code.negative(other)
        elif one.is_less:
            factor = code.negative(factor)
        return code.multiply_add(factor, values[one.series], other)

    def _end(self, state: list[str], values: list[str], unit: str) -> None:
        """What an order leaves: coefficients of the state and of conditions' arguments; and the next order, if any."""
        code = self.code
        code.do("%kn = add i64 %k, 1")
        code.do(f"%inverse.n = fdiv double 1.0, {code.new('sitofp i64 %kn to double')}")
        for d, value in enumerate(self._next(state, values, unit)):
            code.do(f"%xn{d} = bitcast {code.kind} {value} to {code.kind}")
        self._repeat()

    def _next(self, state: list[str], values: list[str], unit: str) -> list[str]:
        """The next coefficients of the state, written down with those of conditions' arguments."""
        following = self._integrated(state, values, unit, self.code.spread("%inverse.n"))
        self._out_conditions("%k", values)
        self._out_state("%kn", following)
        return following

    def _repeat(self) -> None:
        """The next order, if any, or the end."""
        code = self.code
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
                    self.code.do(f"%{name_of(series)}.n = bitcast {self.code.kind} {kept_} to {self.code.kind}")

    def _integrated(self, state: list[str], values: list[str], unit: str, inverse: str) -> list[str]:
        """The next coefficients of the state: those of its derivative times H / (k + 1), 1/(k + 1) being known."""
        r_, code = self.recurrences, self.code
        share = code.multiply(unit, inverse)
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


NUMBERS = "i64 %k, double %t, double %inverse, double %inverse.n"  # the order, the coefficient of t, 1/k, 1/(k + 1)


@dataclass(frozen=True)
class _InParts(_Writer):
    """Writes the function of the first coefficients, which calls another one for each order (`_OneOrder`).

    Without a loop around so many operations LLVM takes two thirds of the time. What an order needs of the first
    coefficients stands in memory behind the sums: these by places, and then what the operations keep.
    """

    def jet(self) -> Jet:
        """The jet of both."""
        one = _OneOrder(self.recurrences, self.shape, self.sums, Code(1))
        one.write()
        self._write(one.asked)
        self.code.declared.update(one.code.declared)
        later = f"define internal void @later(ptr noalias %out, ptr noalias %given, ptr noalias %work, {NUMBERS})"
        text = "\n".join([f"{later} noinline #0 {{", *one.code.lines, "}"])
        size = self.sums.size + len(_behind(self.recurrences))
        return Jet(compiled({"jet": self.code}, inner=[text]), self.shape, size)

    def _write(self, asked: Collection[int]) -> None:
        code = self.code
        unit, _, begin, kept_, _, _ = self._entry()
        for number, value in enumerate((*begin, *kept_)):
            if number in asked:
                code.store(value, "%work", self.sums.size + number)
        code.do("br label %order")
        code.label("order")
        code.do("%k = phi i64 [ 1, %entry ], [ %kn, %order ]")
        code.do(f"%t = phi double [ {unit}, %entry ], [ {code.number(0.0)}, %order ]")
        code.do("%inverse = phi double [ 1.0, %entry ], [ %inverse.n, %order ]")
        code.do("%kn = add i64 %k, 1")
        code.do(f"%inverse.n = fdiv double 1.0, {code.new('sitofp i64 %kn to double')}")
        code.do(f"call void @later(ptr %out, ptr %given, ptr %work, {NUMBERS})")
        self._repeat()


@dataclass(frozen=True)
class _OneOrder(_Writer):
    """Writes the function of the coefficients of one order."""

    asked: set[int] = field(default_factory=set)  # what is read of the numbers behind the sums

    def write(self) -> None:
        """The whole function."""
        r_, code, shape = self.recurrences, self.code, self.shape
        code.label("entry")
        row = code.at("%out", code.new(f"mul i64 %k, {shape.components}"))
        state = [code.load(row, d) for d in range(shape.width)]
        behind = _Read(code, code.at("%work", self.sums.size), _behind(r_))
        inputs = [*state[: 2 * r_.degrees], "%t"]
        begin, kept_ = behind[: r_.inputs + len(r_.operations)], behind[r_.inputs + len(r_.operations) :]
        constants = _Read(code, code.at("%given", shape.first_constant), range(shape.constants))
        self._order(inputs, state, begin, kept_, [], constants, code.load("%given", 0))
        self.asked.update(behind.asked)

    def _end(self, state: list[str], values: list[str], unit: str) -> None:
        self.code.do("%kn = add i64 %k, 1")
        self._next(state, values, unit)
        self.code.do("ret void")


def _behind(recurrences: Recurrences) -> range:
    """The numbers behind the sums."""
    return range(recurrences.inputs + 2 * len(recurrences.operations))


@dataclass(frozen=True)
class _Read(Sequence[str]):
    """Numbers in memory, each read where it is asked for; `asked` are those that were read."""

    code: Code
    base: str
    places: range
    asked: set[int] = field(default_factory=set)

    def __len__(self) -> int:
        return len(self.places)

    @overload
    def __getitem__(self, number: int) -> str: ...
    @overload
    def __getitem__(self, number: slice) -> Sequence[str]: ...
    def __getitem__(self, number: int | slice) -> str | Sequence[str]:
        if isinstance(number, slice):
            return _Read(self.code, self.base, self.places[number], self.asked)
        self.asked.add(self.places[number])
        return self.code.load(self.base, self.places[number])
