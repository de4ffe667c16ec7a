"""Recurrences as code of their own: one operation after the other, and the sums of all of them in one loop (`sums`)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...model import recurrences as r
from ...model.recurrences import Recurrences
from .code import Code, MachineCode, compiled
from .operations import COMPARISONS, Operands, first, kept, later
from .shape import Shape
from .sums import OfMotions, OfOperations, Sums, name_of, terms_of, width_of_sums


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
    terms = terms_of(recurrences)
    sums: Sums = OfOperations(terms, width_of_sums()) if lanes == 1 else OfMotions(terms, lanes)
    shape = Shape.of(recurrences, lanes)
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
        code.do("%inverse = phi double [ 1.0, %entry ], [ %inverse.n, %chain ]")
        for name in map(name_of, self.sums.before):
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
        inverse = code.spread("%inverse")
        values = list(inputs)
        row, asked = self.sums.row(code, "%k"), wanted(r_)
        for place, value in enumerate(inputs):
            self._keep(place, value, order, row)
        for place, operation in enumerate(r_.operations, len(inputs)):
            if place not in asked:
                values.append("")
                continue
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
        following = self._integrated(state, values, unit, code.spread("%inverse.n"))
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
