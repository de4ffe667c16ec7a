"""Several steps of motions side by side in one call, each looked at in the parts of its steps.

A loop over steps that no kernel has to be compiled for: it serves all models, and calls the code of a model's series by
its addresses. The step is that of `taylor`, and so is the look at what it really did. Lanes that have come to the end
of a piece of the span, or cannot go on, rest until somebody has decided what becomes of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from ..kernels.ensemble import (
    DEFECTS,
    GONE,
    MARGINS,
    NEW,
    NEW_REST,
    OLD,
    OLD_REST,
    PIVOTS,
    ROWS,
    SIZES,
    THETA,
    UNIT,
    WANTED,
)
from ..kernels.step import LARGEST_VALUE
from ..kernels.taylor import SHORTER
from .code import Code, MachineCode, compiled

LANES = 8  # motions side by side where few are marched in rounds: the fewer rounds, the better
LEAST_PART = 1e-6  # of the step that the series allows, or the span: no shorter one is asked for
# What the code is told: orders, steps, parts, sizes of things, where they begin among the rows, and whom it calls.
ORDER, STEPS, PARTS, WIDTH, RATED, COMPONENTS = 0, 1, 2, 3, 4, 5
AT_STATES, AT_TOLD, AT_PLANS, AT_RECORDS, RECORD, JET, ADVANCE, MEASURE, SLOT = 6, 7, 8, 9, 10, 11, 12, 13, 14
PROGRAM = 15
# Rows of plans: the time, the largest step that may be tried, whether the lane goes on, how often it has tried; the end
# of its piece of the span and its bound there; the bound of all steps, where a condition changes, the largest defect
# that is no surprise, and the least step.
NOW, LEAST, STATUS, TRIED, END, BOUND, CAP, CUT, ALLOWED, SMALLEST = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
PLANS = 10
GOES, RESTS, STUCK, FAILED, ENDED = 0.0, 1.0, 2.0, 3.0, 4.0
# Rows of the record of a step: whether it was taken, its beginning, unit, size, end and what was wanted; then the state
# with its rest, and for each part a row (q, q̇, t) with the rates of (q, q̇) at its end.
TAKEN, STARTED, UNITS, SIZE, ENDS, WISHED = 0, 1, 2, 3, 4, 5
RECORDED = 6


@dataclass(frozen=True)
class Layout:
    """Where things stand among the rows of lanes: what the jet is given, states, what is told, plans, records."""

    width: int
    degrees: int
    constants: int
    steps: int
    parts: int

    @property
    def states(self) -> int:
        """The first row of states, which have five rows each."""
        return self.width + 2 + self.constants

    @property
    def told(self) -> int:
        """The first row of what the code is told of steps, and tells."""
        return self.states + 5 * self.width

    @property
    def plans(self) -> int:
        """The first row of plans."""
        return self.told + ROWS

    @property
    def records(self) -> int:
        """The first row of records."""
        return self.plans + PLANS

    @property
    def record(self) -> int:
        """Rows of one record."""
        return RECORDED + 2 * self.width + self.parts * (4 * self.degrees + 1)

    @property
    def total(self) -> int:
        """All rows."""
        return self.records + self.steps * self.record


@cache
def marching() -> MachineCode:
    """void march(out, given, work, program): `out` has the series of one step after the other, `given` the rows.

    The series where the lanes are is number program[SLOT], before and behind.
    """
    return compiled({"march": _march()}, inner=(_mixed(), _seen()))


def _march() -> Code:
    code = Code(LANES)
    code.label("entry")
    number = [code.new(f"load i64, ptr {_gep('i64', code, '%program', place)}") for place in range(PROGRAM)]
    states, told, plans, records = (code.at("%given", number[i]) for i in (AT_STATES, AT_TOLD, AT_PLANS, AT_RECORDS))
    slot = code.new(f"mul i64 {code.new(f'add i64 {number[ORDER]}, 1')}, {number[COMPONENTS]}")
    at_slot = code.at("%out", code.new(f"mul i64 {slot}, {number[SLOT]}"))
    _mix(code, "%out", at_slot, slot, _all(code))
    code.do("br label %step")
    code.label("step")
    code.do("%k = phi i64 [ 0, %entry ], [ %kn, %next ]")
    goes = _compared(code, "oeq", code.load(plans, STATUS), code.number(GOES))
    code.do(f"br i1 {_any(code, goes)}, label %body, label %done")
    code.label("body")
    record = code.at(records, _times(code, "%k", number[RECORD]))
    _Step(code, number, states, told, plans, goes, slot, record).write()
    code.label("next")
    code.do("%kn = add i64 %k, 1")
    code.do(f"br i1 {code.new(f'icmp slt i64 %kn, {number[STEPS]}')}, label %step, label %done")
    code.label("done")
    code.do("%made = phi i64 [ %k, %step ], [ %kn, %next ]")
    code.do(f"store i64 %made, ptr {_gep('i64', code, '%program', SLOT)}")
    code.do("ret void")
    return code


@dataclass(frozen=True)
class _Step:
    """Writes one step of the lanes that go on."""

    code: Code
    number: list[str]
    states: str
    told: str
    plans: str
    goes: str
    slot: str
    record: str

    def write(self) -> None:
        """From the label `body` to `next`."""
        code, told, plans = self.code, self.told, self.plans
        series = code.at("%out", _times(code, "%k", self.slot))
        ahead = code.at(series, self.slot)
        now, raw, unit = code.load(plans, NOW), code.load(told, WANTED), code.load("%given", 0)
        wanted = code.smaller(raw, code.load(plans, CAP))
        size, end, is_cut = self._planned(now, wanted)
        code.store(code.divide(size, unit), told, THETA)
        self._call(ADVANCE, series, self.states, told)
        for place, value in {STARTED: now, UNITS: unit, SIZE: size, ENDS: end, WISHED: raw}.items():
            code.store(value, self.record, place)
        self._look(series, (size, now, end, unit))
        following = self._unit(size, unit)
        self._expand(ahead, end, size, following)
        refused, taken, failed = self._verdict(size, wanted, is_cut)
        self._decide(now, wanted, size, end, (refused, taken, failed))
        code.do(f"br i1 {_any(code, refused)}, label %back, label %next")
        code.label("back")
        width = self.number[WIDTH]
        _mix(code, ahead, series, self.slot, refused)
        _mix(code, self._state(NEW), self._state(OLD), width, refused)
        _mix(code, self._state(NEW_REST), self._state(OLD_REST), width, refused)
        code.store(code.select(refused, unit, following), "%given", 0)
        code.store(code.select(refused, raw, code.load(told, WANTED)), told, WANTED)
        code.do("br label %next")

    def _state(self, row: int) -> str:
        return self.code.at(self.states, _times(self.code, str(row), self.number[WIDTH]))

    def _call(self, whom: int, *arguments: str) -> None:
        address = self.code.new(f"inttoptr i64 {self.number[whom]} to ptr")
        self.code.do(f"call void {address}({', '.join(f'ptr {each}' for each in (*arguments, '%program'))})")

    def _planned(self, now: str, wanted: str) -> tuple[str, str, str]:
        """Size and end of a step within the piece, and whether it ends where a condition changes."""
        code, plans = self.code, self.plans
        size = code.smaller(code.smaller(wanted, code.load(plans, LEAST)), code.load(plans, BOUND))
        end, cut = code.load(plans, END), code.load(plans, CUT)
        left = code.subtract(end, now)
        is_last = _compared(code, "oge", code.multiply(size, code.number(1.0 + 1e-9)), left)
        size = code.select(is_last, left, size)
        end = code.select(is_last, end, code.add(now, size))
        is_cut = _compared(code, "olt", cut, size)
        size = code.select(self.goes, code.select(is_cut, cut, size), code.number(0.0))
        end = code.select(is_cut, code.add(now, size), end)
        return size, code.select(self.goes, end, now), is_cut

    def _look(self, series: str, places: tuple[str, str, str, str]) -> None:
        """The state, and what is seen at the ends of parts, go into the record."""
        code, width = self.code, self.number[WIDTH]
        kept = code.at(self.record, RECORDED)
        _mix(code, kept, self._state(OLD), width, _all(code))
        behind = code.at(kept, width)
        _mix(code, behind, self._state(OLD_REST), width, _all(code))
        given = [f"ptr {each}" for each in (series, code.at(behind, width), kept, behind, "%program")]
        code.do(f"call void @seen({', '.join([*given, *(f'{code.kind} {each}' for each in places)])})")

    def _unit(self, size: str, unit: str) -> str:
        """A power of two near the step, the unit of time that there is where that is near enough."""
        code = self.code
        small = _compared(code, "olt", size, code.multiply(code.number(0.25), unit))
        large = _compared(code, "ogt", size, code.multiply(code.number(4.0), unit))
        power = code.of_bits(code.on_bits("and", code.bits(size), 0x7FF << 52))
        return code.select(_both(code, _either(code, small, large), self.goes), power, unit)

    def _expand(self, ahead: str, end: str, size: str, unit: str) -> None:
        """The series at the end, and what it tells of the step."""
        code, width, told = self.code, self.number[WIDTH], self.told
        code.store(unit, "%given", 0)
        _mix(code, code.at("%given", 1), self._state(NEW), width, _all(code))
        code.store(end, "%given", code.new(f"add i64 {width}, 1"))
        self._call(JET, ahead, "%given", "%work")
        code.store(code.divide(size, unit), told, GONE)
        code.store(unit, told, UNIT)
        self._call(MEASURE, ahead, self.states, told)

    def _verdict(self, size: str, wanted: str, is_cut: str) -> tuple[str, str, str]:
        """Whether the step is tried again, taken, or the end of the motion."""
        code, told = self.code, self.told
        fine = _both(
            code,
            _compared(code, "ole", code.load(told, SIZES), code.number(LARGEST_VALUE)),
            _compared(code, "ogt", code.load(told, MARGINS), code.number(0.0)),
        )
        pivots = code.load(told, PIVOTS)
        fine = _both(code, fine, _compared(code, "ord", pivots, pivots))
        worse = _compared(code, "ogt", code.load(told, DEFECTS), code.load(self.plans, ALLOWED))
        bad = _either(code, _both(code, worse, _not(code, is_cut)), _not(code, fine))
        can_be_less = _compared(code, "ogt", size, code.multiply(code.number(LEAST_PART), wanted))
        refused = _both(code, self.goes, _both(code, bad, can_be_less))
        stays = _both(code, self.goes, _not(code, refused))
        return refused, _both(code, stays, fine), _both(code, stays, _not(code, fine))

    def _decide(self, now: str, wanted: str, size: str, end: str, verdict: tuple[str, str, str]) -> None:
        """Where the lanes are then, and whether they go on."""
        code, plans, (refused, taken, failed) = self.code, self.plans, verdict
        shorter = code.multiply(code.number(SHORTER), size)
        least = code.select(taken, code.number(float("inf")), code.load(plans, LEAST))
        code.store(code.select(refused, shorter, least), plans, LEAST)
        code.store(code.select(taken, end, now), plans, NOW)
        one = code.select(self.goes, code.number(1.0), code.number(0.0))
        code.store(code.add(code.load(plans, TRIED), one), plans, TRIED)
        code.store(code.select(taken, code.number(1.0), code.number(0.0)), self.record, TAKEN)
        # where steps become so short the motion has a singularity, and never comes to the end of the span
        following = code.select(refused, code.smaller(wanted, shorter), wanted)
        stuck = _either(
            code,
            _compared(code, "olt", following, code.load(plans, SMALLEST)),
            _compared(code, "ole", code.add(now, following), now),
        )
        is_over = _both(code, taken, _compared(code, "oge", end, code.load(plans, END)))
        status = code.select(is_over, code.number(RESTS), code.number(GOES))
        status = code.select(stuck, code.number(STUCK), code.select(failed, code.number(FAILED), status))
        code.store(code.select(self.goes, status, code.load(plans, STATUS)), plans, STATUS)


def _seen() -> str:
    """Rows (q, q̇, t) and rates of (q, q̇) at the ends of the parts of a step, by Horner's rule."""
    code = Code(LANES)
    code.label("entry")
    order, parts, rated, components = (
        code.new(f"load i64, ptr {_gep('i64', code, '%program', place)}") for place in (ORDER, PARTS, RATED, COMPONENTS)
    )
    theta, share = code.divide("%size", "%unit"), code.divide(code.number(1.0), _double(code, parts))
    last_row = _times(code, order, components)
    code.do("br label %part")
    code.label("part")
    code.do("%p = phi i64 [ 1, %entry ], [ %pn, %told ]")
    code.do("%to = phi ptr [ %into, %entry ], [ %ton, %told ]")
    here = code.multiply(_double(code, "%p"), share)
    x = code.multiply(theta, here)
    code.do("br label %component")
    code.label("component")
    code.do("%d = phi i64 [ 0, %part ], [ %dn, %summed ]")
    _horner(code, x, last_row, components)
    change = code.add(code.multiply("%value", x), code.load("%rest", "%d"))
    code.store(code.add(code.load("%old", "%d"), change), "%to", "%d")
    rates = code.at("%to", code.new(f"add i64 {rated}, 1"))
    code.store(code.divide(code.multiply_add("%slope", x, "%value"), "%unit"), rates, "%d")
    code.do("%dn = add i64 %d, 1")
    code.do(f"br i1 {code.new(f'icmp slt i64 %dn, {rated}')}, label %component, label %told")
    code.label("told")
    is_last = code.new(f"icmp eq i64 %p, {parts}")
    time = code.add("%now", code.multiply("%size", here))
    code.store(code.new(f"select i1 {is_last}, {code.kind} %end, {code.kind} {time}"), "%to", rated)
    code.do(f"%ton = getelementptr inbounds {code.kind}, ptr {rates}, i64 {rated}")
    code.do("%pn = add i64 %p, 1")
    code.do(f"br i1 {is_last}, label %over, label %part")
    code.label("over")
    code.do("ret void")
    numbers = ", ".join(f"{code.kind} %{name}" for name in ("size", "now", "end", "unit"))
    head = f"define internal void @seen(ptr %series, ptr %into, ptr %old, ptr %rest, ptr %program, {numbers}) #0 {{"
    return "\n".join([*sorted(code.declared), head, *code.lines, "}"])


def _horner(code: Code, x: str, last_row: str, components: str) -> None:
    """%value, Σ cₖ x^(k−1) of component %d, and its derivative %slope; begins in the block `component`."""
    first = code.load("%series", code.new(f"add i64 {last_row}, %d"))
    code.do("br label %sum")
    code.label("sum")
    code.do(f"%row = phi i64 [ {last_row}, %component ], [ %rown, %term ]")
    code.do(f"%value = phi {code.kind} [ {first}, %component ], [ %valuen, %term ]")
    code.do(f"%slope = phi {code.kind} [ {code.number(0.0)}, %component ], [ %slopen, %term ]")
    code.do(f"%rown = sub i64 %row, {components}")
    code.do(f"br i1 {code.new('icmp sgt i64 %rown, 0')}, label %term, label %summed")
    code.label("term")
    slope = code.multiply_add("%slope", x, "%value")
    value = code.multiply_add("%value", x, code.load("%series", code.new("add i64 %rown, %d")))
    code.do(f"%slopen = bitcast {code.kind} {slope} to {code.kind}")
    code.do(f"%valuen = bitcast {code.kind} {value} to {code.kind}")
    code.do("br label %sum")
    code.label("summed")


def _mixed() -> str:
    """Numbers at `from` go to `to` in the lanes where `which` holds."""
    code = Code(LANES)
    code.label("entry")
    code.do("br label %one")
    code.label("one")
    code.do("%i = phi i64 [ 0, %entry ], [ %in, %one ]")
    code.store(code.select("%which", code.load("%from", "%i"), code.load("%to", "%i")), "%to", "%i")
    code.do("%in = add i64 %i, 1")
    code.do(f"br i1 {code.new('icmp slt i64 %in, %count')}, label %one, label %over")
    code.label("over")
    code.do("ret void")
    head = f"define internal void @mixed(ptr %to, ptr %from, i64 %count, {_truth(code)} %which) #0 {{"
    return "\n".join([head, *code.lines, "}"])


def _mix(code: Code, to: str, of: str, count: str, which: str) -> None:
    code.do(f"call void @mixed(ptr {to}, ptr {of}, i64 {count}, {_truth(code)} {which})")


def _gep(kind: str, code: Code, base: str, place: int) -> str:
    return code.new(f"getelementptr inbounds {kind}, ptr {base}, i64 {place}")


def _times(code: Code, a: str, b: str) -> str:
    return code.new(f"mul i64 {a}, {b}")


def _double(code: Code, whole: str) -> str:
    return code.spread(code.new(f"sitofp i64 {whole} to double"))


def _truth(code: Code) -> str:
    return f"<{code.lanes} x i1>"


def _all(code: Code) -> str:
    return f"<{', '.join(['i1 true'] * code.lanes)}>"


def _compared(code: Code, what: str, a: str, b: str) -> str:
    return code.new(f"fcmp {what} {code.kind} {a}, {b}")


def _both(code: Code, a: str, b: str) -> str:
    return code.new(f"and {_truth(code)} {a}, {b}")


def _either(code: Code, a: str, b: str) -> str:
    return code.new(f"or {_truth(code)} {a}, {b}")


def _not(code: Code, a: str) -> str:
    return code.new(f"xor {_truth(code)} {a}, {_all(code)}")


def _any(code: Code, truths: str) -> str:
    bits = code.new(f"bitcast {_truth(code)} {truths} to i{code.lanes}")
    return code.new(f"icmp ne i{code.lanes} {bits}, 0")
