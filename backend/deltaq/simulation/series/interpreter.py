"""Recurrences without code of their own: one function goes through their operations, the same for all models.

It is there at once, where code for a model takes milliseconds to compile; for a step it takes two to three times as
long. It does what `generated` writes, operation by operation, so that both give the same digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

from ...model import recurrences as r
from ...model.recurrences import Recurrences
from . import program as p
from .code import Code, MachineCode, compiled, shared, used
from .generated import Jet
from .operations import COMPARISONS, Operands, first, kept, later
from .shape import Shape


def interpreted(recurrences: Recurrences) -> Jet:
    """The series of some recurrences, interpreted."""
    return Jet(interpreter(), Shape.of(recurrences), (layout := p.Layout(recurrences)).size, layout.program)


def interpreter() -> MachineCode:
    """The function, void jet(out, given, work, program)."""
    return shared("interpreter", _interpreter)


def _interpreter() -> MachineCode:
    code = Code(1)
    code.label("entry")
    _Writer(code).write()
    code.do("ret void")
    return compiled({"jet": code})


@dataclass(frozen=True)
class _Writer:
    """Writes the function."""

    code: Code

    def write(self) -> None:
        """The first coefficients, then order by order the others."""
        code = self.code
        head = {at: self.item(str(at)) for at in range(p.HEAD)}
        now, begin, kept_, sums = (code.at("%work", head[at]) for at in (p.NOW, p.BEGIN, p.KEPT, p.SUMS))
        constants = code.at("%given", head[p.FIRST_CONSTANT])
        unit, time = code.load("%given", 0), code.new(f"sub i64 {head[p.INPUTS]}, 1")
        states = code.at("%given", 1)

        def input_of_0(number: str) -> None:
            code.store(code.load(states, number), begin, number)

        def state_of_0(number: str) -> None:
            code.store(code.load(states, number), "%out", number)

        def pivot(number: str) -> None:
            place = self.item(code.new(f"add i64 {head[p.PIVOTS]}, {number}"))
            code.store(code.load(begin, place), "%out", code.new(f"add i64 {head[p.FIRST_PIVOT]}, {number}"))

        self.times("input", time, input_of_0)
        code.store(code.load(states, head[p.WIDTH]), begin, time)
        firsts = _Firsts(self, begin, kept_, constants)
        self._records("first", head[p.BEGINNINGS], head[p.BEGINNINGS + 1], firsts.write)
        self.times("state", head[p.WIDTH], state_of_0)
        self.times("pivot", head[p.PIVOTS + 1], pivot)
        self._conditions("zero", head, "0", begin)
        self._next("zero", head, "1", begin, now, code.divide(unit, code.number(1.0)))
        code.store(unit, now, time)

        def order(number: str) -> None:
            k = code.new(f"add i64 {number}, 1")
            times = code.new(f"sitofp i64 {k} to double")
            laters = _Laters(self, begin, kept_, constants, now, sums, times, code.divide(code.number(1.0), times))
            self._sums(head, k, sums)
            self._records("later", head[p.OPERATIONS], head[p.OPERATIONS + 1], laters.write)
            row = code.at("%work", code.new(f"mul i64 {k}, {head[p.ROW]}"))
            self._stored("plain", head[p.PLAIN], head[p.PLAIN + 1], now, row)
            self._stored("multiple", head[p.MULTIPLE], head[p.MULTIPLE + 1], now, row, times)
            self._conditions("any", head, k, now)
            following = code.new(f"add i64 {k}, 1")
            inverse = code.divide(code.number(1.0), code.new(f"sitofp i64 {following} to double"))
            self._next("any", head, following, now, now, code.multiply(unit, inverse))
            code.store(code.number(0.0), now, time)

        self.times("order", code.new(f"sub i64 {head[0]}, 1"), order)

    def item(self, at: str) -> str:
        """A number of the program."""
        return self.code.new(f"load i64, ptr {self.code.new(f'getelementptr inbounds i64, ptr %program, i64 {at}')}")

    def of_record(self, at: str, field: int) -> str:
        """A number of a record."""
        return self.item(self.code.new(f"add i64 {at}, {field}"))

    def times(self, name: str, count: str, body: Callable[[str], None]) -> None:
        """The body for each number from 0 on, in a loop of its own."""
        code = self.code
        code.do(f"br label %{name}.before")
        code.label(f"{name}.before")
        code.do(f"br label %{name}.head")
        code.label(f"{name}.head")
        code.do(f"%{name}.i = phi i64 [ 0, %{name}.before ], [ %{name}.n, %{name}.next ]")
        more = code.new(f"icmp slt i64 %{name}.i, {count}")
        code.do(f"br i1 {more}, label %{name}.body, label %{name}.end")
        code.label(f"{name}.body")
        body(f"%{name}.i")
        code.do(f"br label %{name}.next")
        code.label(f"{name}.next")
        code.do(f"%{name}.n = add i64 %{name}.i, 1")
        code.do(f"br label %{name}.head")
        code.label(f"{name}.end")

    def _records(self, name: str, start: str, count: str, body: Callable[[str], None]) -> None:
        """The body for the place of each record."""
        code = self.code
        self.times(name, count, lambda i: body(code.new(f"add i64 {start}, {code.new(f'mul i64 {i}, {p.RECORD}')}")))

    def choice(self, name: str, kind: str, cases: Mapping[int, Callable[[], tuple[str, ...]]]) -> tuple[str, ...]:
        """What the case of a kind finds: some numbers, as many in each."""
        code, found = self.code, dict[int, tuple[str, ...]]()
        labels = " ".join(f"i64 {each}, label %{name}.{each}" for each in cases)
        code.do(f"switch i64 {kind}, label %{name}.none [ {labels} ]")
        for each, case in cases.items():
            code.label(f"{name}.{each}")
            code.circular.clear()  # no case has what another finds
            begin = len(code.lines)
            found[each] = case()
            code.lines[begin:] = used(code.lines[begin:], found[each])
            code.do(f"br label %{name}.found")
        code.label(f"{name}.none")
        code.do("unreachable")
        code.label(f"{name}.found")
        count = len(next(iter(found.values())))
        ends = (", ".join(f"[ {found[each][i]}, %{name}.{each} ]" for each in found) for i in range(count))
        return tuple(code.new(f"phi {code.kind} {each}") for each in ends)

    def _stored(self, name: str, start: str, count: str, now: str, row: str, times: str = "") -> None:
        """Coefficients go where sums need them, or so many times each."""
        code = self.code

        def store(number: str) -> None:
            at = code.new(f"add i64 {start}, {code.new(f'mul i64 {number}, 2')}")
            value = code.load(now, self.item(at))
            code.store(code.multiply(times, value) if times else value, row, self.of_record(at, 1))

        self.times(name, count, store)

    def _sums(self, head: Mapping[int, str], k: str, sums: str) -> None:
        """The sums of an order, block by block."""
        code, loop = self.code, self.code.new(f"inttoptr i64 {head[p.LOOP]} to ptr")

        def find(number: str) -> None:
            block = code.at("%work", code.new(f"mul i64 {number}, {head[p.BLOCK]}"))
            out = code.at(sums, code.new(f"mul i64 {number}, {head[p.TOGETHER]}"))
            code.do(f"call void {loop}(ptr {block}, i64 {k}, ptr {out})")

        self.times("block", head[p.BLOCKS], find)

    def _conditions(self, name: str, head: Mapping[int, str], order: str, values: str) -> None:
        """The arguments of conditions go out."""
        code = self.code
        row = code.at("%out", code.new(f"mul i64 {order}, {head[p.COMPONENTS]}"))

        def body(number: str) -> None:
            place = self.item(code.new(f"add i64 {head[p.ARGUMENTS]}, {number}"))
            code.store(code.load(values, place), row, code.new(f"add i64 {head[p.WIDTH]}, {number}"))

        self.times(f"condition.{name}", head[p.ARGUMENTS + 1], body)

    def _next(self, name: str, head: Mapping[int, str], order: str, values: str, now: str, share: str) -> None:
        """The state's coefficients of an order, from those of its rates before."""
        code = self.code
        row = code.at("%out", code.new(f"mul i64 {order}, {head[p.COMPONENTS]}"))

        def integrate(number: str) -> None:
            place = self.item(code.new(f"add i64 {head[p.RATES]}, {number}"))
            code.store(code.multiply(code.load(values, place), share), row, number)

        def keep(number: str) -> None:
            code.store(code.load(row, number), now, number)

        self.times(f"rate.{name}", head[p.RATES + 1], integrate)
        self.times(f"state.{name}", code.new(f"sub i64 {head[p.INPUTS]}, 1"), keep)


@dataclass(frozen=True)
class _Firsts:
    """Writes how the first coefficients are found."""

    writer: _Writer
    begin: str
    kept: str
    constants: str

    def write(self, at: str) -> None:
        """Of the operation whose record begins at a place."""
        code, of = self.writer.code, self.writer.of_record
        a0, b0, c0 = (code.load(self.begin, of(at, each)) for each in (p.A, p.B, p.C))
        constant, result = code.load(self.constants, of(at, p.CONSTANT)), of(at, p.RESULT)
        function = code.new(f"inttoptr i64 {of(at, p.FUNCTION)} to ptr")
        truth = code.new(f"fcmp one double {a0}, {code.number(0.0)}")

        def found(kind: int, y0: str) -> tuple[str, str]:
            return y0, kept(code, kind, Operands(a0=a0, b0=b0, c0=c0, y0=y0))

        def simple(kind: int, name: str = "") -> tuple[str, str]:
            a = truth if kind == r.CHOICE else ""
            return found(kind, first(code, kind, Operands(a=a, a0=a0, b0=b0, c0=c0, constant=constant), name))

        def called(kind: int) -> tuple[str, str]:
            return found(kind, code.new(f"call double {function}(double {a0})"))

        def condition(comparison: str) -> tuple[str, str]:
            holds = code.is_true(comparison, a0)
            return code.select(holds, code.number(1.0), code.number(0.0)), code.number(0.0)

        cases: dict[int, Callable[[], tuple[str, ...]]] = {kind: partial(simple, kind) for kind in p.SIMPLE}
        cases |= {p.TRUTH + kind: partial(condition, each) for kind, each in COMPARISONS.items()}
        for kind in r.WITH_FUNCTION:
            cases[kind + p.SINE] = partial(simple, kind, "sin")
            cases[kind + p.COSINE] = partial(simple, kind, "cos")
            cases[kind + p.CALLED] = partial(called, kind)
        y0, extra = self.writer.choice("kind", of(at, p.KIND), cases)
        code.store(y0, self.begin, result)
        code.store(extra, self.kept, result)


@dataclass(frozen=True)
class _Laters:
    """Writes how the coefficients of order k are found, and keeps them for sums."""

    writer: _Writer
    begin: str
    kept: str
    constants: str
    now: str
    sums: str
    order: str
    inverse: str

    def write(self, at: str) -> None:
        """Of the operation whose record begins at a place."""
        code, of = self.writer.code, self.writer.of_record
        result = of(at, p.RESULT)

        def loaded(kind: int) -> Operands:
            """All operands; what a case does not use is not compiled."""
            place = {each: of(at, each) for each in (p.A, p.B, p.C)}
            a, b, c = (code.load(self.now, place[each]) for each in (p.A, p.B, p.C))
            a0, b0, c0 = (code.load(self.begin, place[each]) for each in (p.A, p.B, p.C))
            y0, extra = code.load(self.begin, result), code.load(self.kept, result)
            if kind == r.CHOICE:
                a = code.new(f"fcmp one double {a0}, {code.number(0.0)}")
            sums = tuple(code.load(self.sums, of(at, p.FIRST_SUM + number)) for number in range(3))
            constant = code.load(self.constants, of(at, p.CONSTANT))
            return Operands(a, b, c, a0, b0, c0, y0, extra, constant, sums, self.order, self.inverse)

        def simple(kind: int) -> tuple[str, ...]:
            return (later(code, kind, loaded(kind)),)

        def of_product(kind: int) -> tuple[str, ...]:
            x = loaded(kind)
            factor = code.negative(x.constant) if kind == p.LESS else x.constant
            return (code.multiply_add(factor, x.a, code.negative(x.b) if kind == p.FROM else x.b),)

        cases: dict[int, Callable[[], tuple[str, ...]]] = {
            kind: partial(simple, kind) for kind in (*p.SIMPLE, *r.WITH_FUNCTION)
        }
        cases |= {kind: partial(of_product, kind) for kind in (p.JOINED, p.LESS, p.FROM)}
        (value,) = self.writer.choice("operation", of(at, p.KIND), cases)
        code.store(value, self.now, result)
