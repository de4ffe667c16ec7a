"""Functions in LLVM's language, written as text and compiled in milliseconds.

Numbers are doubles, or vectors of them where several motions run side by side: each operation then does the same for
all. Products and sums are joined into one rounding only where it says so, by every writer alike, so that all kinds of
code give the same digits.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from itertools import count
from threading import RLock
from typing import Any

import llvmlite.binding as llvm

from ...model.recurrences import FUNCTIONS

LIBRARY = "deltaq.math."  # before the names of functions of the C library
MORE = ("pow", "atan2")  # of these
# Of LLVM. With 0 compiling takes a third of the time and runs twice as long; with 2 a tenth more, and runs as long.
EFFORT = 1
_LOCK = RLock()
_CALLED = re.compile(rf'@"{re.escape(LIBRARY)}([^"]+)"')
_NUMBERS = count()  # of libraries: each has a name of its own
TOGETHER = 64  # libraries of one linker


@dataclass
class Code:
    """A function that is being written, line by line, in numbers of `lanes` doubles."""

    lanes: int
    lines: list[str] = field(default_factory=list)
    declared: set[str] = field(default_factory=set)
    circular: dict[str, tuple[str, str]] = field(default_factory=dict)  # sine and cosine of a number
    prefix: str = "v"  # of names, where two write the same function
    is_rare: bool = False  # run so seldom that it is written as fast as can be, with an effort of 0
    _count: int = 0

    @cached_property
    def kind(self) -> str:
        """The type of a number."""
        return "double" if self.lanes == 1 else f"<{self.lanes} x double>"

    def new(self, instruction: str) -> str:
        """The result of an instruction."""
        self._count += 1
        name = f"%{self.prefix}{self._count}"
        self.lines.append(f"  {name} = {instruction}")
        return name

    def do(self, instruction: str) -> None:
        """An instruction without a result."""
        self.lines.append(f"  {instruction}")

    def label(self, name: str) -> None:
        """A block begins."""
        self.lines.append(f"{name}:")

    def number(self, value: float) -> str:
        """A constant, the same in all lanes."""
        bits = ctypes.c_uint64.from_buffer(ctypes.c_double(value)).value
        one = f"0x{bits:016X}"
        return one if self.lanes == 1 else f"<{', '.join(['double ' + one] * self.lanes)}>"

    @property
    def whole(self) -> str:
        """The type of the bits of a number, as an integer."""
        return "i64" if self.lanes == 1 else f"<{self.lanes} x i64>"

    def integer(self, value: int) -> str:
        """A constant integer, the same in all lanes."""
        return str(value) if self.lanes == 1 else f"<{', '.join([f'i64 {value}'] * self.lanes)}>"

    def bits(self, a: str) -> str:
        """The bits of a number."""
        return self.new(f"bitcast {self.kind} {a} to {self.whole}")

    def of_bits(self, a: str) -> str:
        """The number with these bits."""
        return self.new(f"bitcast {self.whole} {a} to {self.kind}")

    def on_bits(self, what: str, a: str, b: int | str) -> str:
        """An operation of LLVM (and, shl …) on integers, the second of which may be a constant."""
        other = self.integer(b) if isinstance(b, int) else b
        return self.new(f"{what} {self.whole} {a}, {other}")

    def add(self, a: str, b: str) -> str:
        """a + b."""
        return self.new(f"fadd {self.kind} {a}, {b}")

    def subtract(self, a: str, b: str) -> str:
        """a − b."""
        return self.new(f"fsub {self.kind} {a}, {b}")

    def multiply(self, a: str, b: str) -> str:
        """a b."""
        return self.new(f"fmul {self.kind} {a}, {b}")

    def divide(self, a: str, b: str) -> str:
        """a / b."""
        return self.new(f"fdiv {self.kind} {a}, {b}")

    def negative(self, a: str) -> str:
        """−a."""
        return self.new(f"fneg {self.kind} {a}")

    def multiply_add(self, a: str, b: str, c: str) -> str:
        """a b + c, rounded once where the processor can, else twice."""
        if not host().has_fma:
            return self.add(self.multiply(a, b), c)
        return self._intrinsic("fma", a, b, c)

    def horner(self, coefficients: Sequence[float], x: str) -> str:
        """Σ cₖ xᵏ."""
        found = self.number(coefficients[-1])
        for each in reversed(coefficients[:-1]):
            found = self.multiply_add(found, x, self.number(each))
        return found

    def in_halves(self, coefficients: Sequence[float], x: str) -> str:
        """Σ cₖ xᵏ, even and odd powers by themselves, so that half as many operations wait for each other."""
        square = self.multiply(x, x)
        even, odd = (self.horner(coefficients[first::2], square) for first in (0, 1))
        return self.multiply_add(odd, x, even)

    def spread(self, number: str) -> str:
        """One double in all lanes."""
        if self.lanes == 1:
            return number
        one = self.new(f"insertelement {self.kind} poison, double {number}, i32 0")
        return self.new(f"shufflevector {self.kind} {one}, {self.kind} poison, <{self.lanes} x i32> zeroinitializer")

    def root(self, a: str) -> str:
        """√a."""
        return self._intrinsic("sqrt", a)

    def size(self, a: str) -> str:
        """|a|."""
        return self._intrinsic("fabs", a)

    def _intrinsic(self, name: str, *arguments: str) -> str:
        suffix = "f64" if self.lanes == 1 else f"v{self.lanes}f64"
        kinds = ", ".join([self.kind] * len(arguments))
        self.declared.add(f"declare {self.kind} @llvm.{name}.{suffix}({kinds})")
        given = ", ".join(f"{self.kind} {each}" for each in arguments)
        return self.new(f"call {self.kind} @llvm.{name}.{suffix}({given})")

    def function(self, name: str, *arguments: str) -> str:
        """A function of the C library, lane by lane."""
        self.declared.add(f'declare double @"{LIBRARY}{name}"({", ".join(["double"] * len(arguments))})')
        if self.lanes == 1:
            given = ", ".join(f"double {each}" for each in arguments)
            return self.new(f'call double @"{LIBRARY}{name}"({given})')
        found = "poison"
        for lane in range(self.lanes):
            parts = [self.new(f"extractelement {self.kind} {each}, i32 {lane}") for each in arguments]
            given = ", ".join(f"double {each}" for each in parts)
            one = self.new(f'call double @"{LIBRARY}{name}"({given})')
            found = self.new(f"insertelement {self.kind} {found}, double {one}, i32 {lane}")
        return found

    def is_true(self, comparison: str, a: str) -> str:
        """Whether a `comparison` (ogt, oge, olt, ole) 0 holds, lane by lane."""
        return self.new(f"fcmp {comparison} {self.kind} {a}, {self.number(0.0)}")

    def select(self, condition: str, a: str, b: str) -> str:
        """a where the condition holds, else b."""
        truth = "i1" if self.lanes == 1 else f"<{self.lanes} x i1>"
        return self.new(f"select {truth} {condition}, {self.kind} {a}, {self.kind} {b}")

    def larger(self, a: str, b: str) -> str:
        """The larger of two numbers, a where b is none."""
        truth = self.new(f"fcmp ogt {self.kind} {b}, {a}")
        return self.select(truth, b, a)

    def smaller(self, a: str, b: str) -> str:
        """The smaller of two numbers, a where b is none."""
        truth = self.new(f"fcmp olt {self.kind} {b}, {a}")
        return self.select(truth, b, a)

    def at(self, base: str, place: str | int) -> str:
        """The address of number `place` behind an address."""
        return self.new(f"getelementptr inbounds {self.kind}, ptr {base}, i64 {place}")

    def load(self, base: str, place: str | int) -> str:
        """The number at a place behind an address."""
        return self.new(f"load {self.kind}, ptr {self.at(base, place)}, align 8")

    def store(self, value: str, base: str, place: str | int) -> None:
        """Keeps a number at a place behind an address.

        As `volatile`, so that LLVM does not look which of some hundred stores could be joined: a tenth of its time.
        """
        self.do(f"store volatile {self.kind} {value}, ptr {self.at(base, place)}, align 8")


READ, NAME = re.compile(r" *(%\w+) = (?:load|getelementptr|add|fcmp) "), re.compile(r"%[\w.]+")


def used(lines: Sequence[str], results: Sequence[str]) -> list[str]:
    """Lines without jumps, but for those that read what neither a later line nor anybody who wants results needs."""
    wanted, found = set(results), list[str]()
    for line in reversed(lines):
        read = READ.match(line)
        if read is None or read[1] in wanted:
            wanted.update(NAME.findall(line))
            found.append(line)
    return found[::-1]


@dataclass(frozen=True)
class Host:
    """The processor that code is written for."""

    name: str
    features: str
    has_fma: bool
    width: int  # doubles in one of its vectors
    library: Mapping[str, int]  # where functions of the C library are


@cache
def _machine() -> Any:
    """What writes code for this processor; to make it and to use it once takes as long as a small function."""
    here, target = host(), llvm.Target.from_default_triple  # of which there is none before
    return target().create_target_machine(cpu=here.name, features=here.features, opt=EFFORT, jit=True)


@lru_cache(1)
def _linker(_number: int) -> Any:
    """What brings code into memory, and out of it again; some kilobytes of each library go with the linker alone.

    It stays as long as any of its libraries does.
    """
    return llvm.create_lljit_compiler()


@cache
def host() -> Host:
    """This processor, with the C library's functions."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    features = llvm.get_host_cpu_features()
    library = ctypes.CDLL(ctypes.util.find_library("m"))
    addresses = {name: ctypes.cast(getattr(library, name), ctypes.c_void_p).value or 0 for name in (*FUNCTIONS, *MORE)}
    is_arm = llvm.get_default_triple().startswith(("aarch64", "arm64"))
    wide = 8 if features.get("avx512f") else 4 if features.get("avx2") else 2
    has_fma = bool(features.get("fma")) or is_arm
    return Host(llvm.get_host_cpu_name(), features.flatten(), has_fma, wide, addresses)


ATTRIBUTES = (
    'attributes #0 = { nounwind "no-builtins" }',
    'attributes #1 = { nounwind noinline optnone "no-builtins" }',
)
ARGUMENTS = "ptr %out, ptr %given, ptr noalias %work, ptr %program"  # of all functions that kernels call


@dataclass(frozen=True)
class MachineCode:
    """Compiled functions; their addresses are valid as long as this object lives."""

    library: Any
    addresses: Mapping[str, int]

    @property
    def address(self) -> int:
        """That of the first one."""
        return next(iter(self.addresses.values()))


def compiled(
    functions: Mapping[str, Code],
    returned: str = "void",
    given: str = ARGUMENTS,
    inner: Sequence[str] = (),
) -> MachineCode:
    """Machine code of functions `returned name(given)`, usually `void name(out, given, work, program)`.

    Functions that only these call are `inner`, as text.
    """
    lines = [*sorted(set[str]().union(*(code.declared for code in functions.values()))), *inner]
    for name, code in functions.items():
        lines += [f"define {returned} @{name}({given}) #{int(code.is_rare)} {{", *code.lines, "}"]
    text = "\n".join([*lines, *ATTRIBUTES, ""])
    with _LOCK:
        module = llvm.parse_assembly(text)
        module.triple = llvm.get_default_triple()
        library = llvm.JITLibraryBuilder().add_object_img(_machine().emit_object(module)).add_current_process()
        for name in functions:
            library.export_symbol(name)
        for name in set(_CALLED.findall(text)):
            library.import_symbol(LIBRARY + name, address_of(name))
        number = next(_NUMBERS)
        linked = library.link(_linker(number // TOGETHER), f"deltaq.{number}")
    return MachineCode(linked, {name: linked[name] for name in functions})


def address_of(name: str) -> int:
    """Where a function is that code calls as LIBRARY + `name`."""
    return _shared()[name].address if name in _shared() else host().library[name]


def shared(name: str, make: Callable[[], MachineCode]) -> MachineCode:
    """A function that is made when it is first wanted and kept from then on; code may call it as LIBRARY + `name`."""
    with _LOCK:
        if name not in _shared():
            _shared()[name] = make()
        return _shared()[name]


@cache
def _shared() -> dict[str, MachineCode]:
    """Functions that are made once, by name."""
    return {}
