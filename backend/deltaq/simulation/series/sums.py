"""The sums that coefficients of Taylor series need, computed side by side.

A step's coefficients are found order by order. All sums Σ uⱼ vₖ₋ⱼ of an order k need lower orders only, so that those
of different operations are computed side by side in the lanes of vectors; their operands stand side by side in memory,
wherever they are needed. Where several motions run side by side, the lanes are theirs.

Of a sum the two ends, u₁ vₖ₋₁ and uₖ₋₁ v₁, come last. Of few sums they are found one by one, from what was found just
before, which is not read from memory then: the rest waits for nothing of the order before, and is computed meanwhile.
All coefficients of an order stand together in memory, so that each pass of that loop reads two runs of neighbours.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from ...model.recurrences import Recurrences, Series, Term
from ..kernels.taylor import MOST_ORDERS
from .code import Code, MachineCode, compiled, host, shared

TOGETHER = 5  # sums in one loop, whose parts have to stay in registers
FEW = 12  # sums of one motion whose ends are found one by one
MOST_GROUPS = 5  # of sums of one motion in a loop that is no part of a model's code

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
        """Series whose coefficients of the order before are asked for, by `name_of`."""

    def write(self, code: Code, order: str) -> Mapping[Term, str]:
        """The sums of an order; with loops, from the block `order` to the beginning of the block `chain`."""


@dataclass(frozen=True)
class OfOperations:
    """Sums of one motion, those of several operations in the lanes of a vector."""

    terms: tuple[Term, ...]
    width: int

    @property
    def groups(self) -> int:
        return -(-len(self.terms) // self.width)

    @property
    def stride(self) -> int:
        """Vectors of one order: of each group those of u and those of v."""
        return 2 * self.groups

    @property
    def size(self) -> int:
        return self.stride * MOST_ORDERS * self.width

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
        inner = _inner(wide, order, self.stride, pairs)
        if self.are_few:
            found = _ended(code, order, self._apart(code, inner), self._first, self._second)
        else:
            found = self._apart(wide, _ended(wide, order, inner, *_ends(wide, order, self.stride, pairs)))
        _begin_chain(code)
        return dict(zip(self.terms, found, strict=True))

    def _first(self, code: Code, number: int) -> Factors:
        u, v = self.terms[number]
        return self._of_order_1(code, u), f"%{name_of(v)}"

    def _second(self, code: Code, number: int) -> Factors:
        u, v = self.terms[number]
        return f"%{name_of(u)}", self._of_order_1(code, v)

    def _of_order_1(self, code: Code, series: Series) -> str:
        return code.load("%work", self.stride * self.width + self.places[series][0])

    def _vector(self, code: Code) -> Code:
        return Code(self.width, code.lines, code.declared, prefix="w")

    def _apart(self, code: Code, found: list[str]) -> list[str]:
        kind = Code(self.width).kind
        return [
            code.new(f"extractelement {kind} {found[number // self.width]}, i32 {number % self.width}")
            for number in range(len(self.terms))
        ]


@dataclass(frozen=True)
class Blocks:
    """Sums of one motion, block by block: functions that all models share find those of one (`loops`).

    A block has all its orders, of each the vectors of u and v group by group. Behind the blocks stand the sums.
    """

    terms: tuple[Term, ...]
    width: int

    @cached_property
    def blocks(self) -> int:
        """How many there are."""
        return -(-self._groups // MOST_GROUPS)

    @cached_property
    def groups(self) -> int:
        """Of sums, in a block."""
        return -(-self._groups // max(1, self.blocks))

    @cached_property
    def _groups(self) -> int:
        return -(-len(self.terms) // self.width)

    @cached_property
    def together(self) -> int:
        """Sums in a block."""
        return self.groups * self.width

    @property
    def stride(self) -> int:
        """Doubles of an order in a block: of each group u and v."""
        return 2 * self.together

    @property
    def block(self) -> int:
        """Doubles of a block."""
        return self.stride * MOST_ORDERS

    @property
    def first_sum(self) -> int:
        """Where the sums begin."""
        return self.blocks * self.block

    @property
    def size(self) -> int:
        return self.first_sum + self.blocks * self.together

    @property
    def loop(self) -> int:
        """The address of the function that finds the sums of a block."""
        return loops(self.width).addresses[f"sums{max(1, self.groups)}"]

    @cached_property
    def places(self) -> Mapping[Series, Sequence[int]]:
        found: dict[Series, list[int]] = {}
        for number, term in enumerate(self.terms):
            block, rest = divmod(number, self.together)
            group, lane = divmod(rest, self.width)
            for side, series in enumerate(term):
                found.setdefault(series, []).append(block * self.block + (2 * group + side) * self.width + lane)
        return found

    def row(self, code: Code, order: str) -> str:
        return _row(code, order, self.stride)

    @property
    def before(self) -> Sequence[Series]:
        return []

    def write(self, code: Code, order: str) -> Mapping[Term, str]:
        sums = code.at("%work", self.first_sum)
        for number in range(self.blocks):
            block, out = code.at("%work", number * self.block), code.at(sums, number * self.together)
            code.do(f"call void inttoptr (i64 {self.loop} to ptr)(ptr {block}, i64 {order}, ptr {out})")
        return _Found(code, sums, {term: number for number, term in enumerate(self.terms)})


@dataclass(frozen=True)
class _Found(Mapping[Term, str]):
    """Sums in memory, each read where it is asked for: an operation of the processor may do that besides."""

    code: Code
    base: str
    places: Mapping[Term, int]

    def __getitem__(self, term: Term) -> str:
        return self.code.load(self.base, self.places[term])

    def __iter__(self) -> Iterator[Term]:
        return iter(self.places)

    def __len__(self) -> int:
        return len(self.places)


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


def loops(width: int) -> MachineCode:
    """Functions that find the sums of 1, 2 … groups of an order, `sums1` and so on: void loop(work, order, out)."""
    return shared(f"loops.{width}", lambda: _loops(width))


def _loops(width: int) -> MachineCode:
    made = {}
    for groups in range(1, MOST_GROUPS + 1):
        code, pairs, stride = Code(width, prefix="w"), _pairs(groups), 2 * groups
        code.label("order")
        inner = _inner(code, "%k", stride, pairs)
        for group, value in enumerate(_ended(code, "%k", inner, *_ends(code, "%k", stride, pairs))):
            code.store(value, "%out", group)
        code.do("ret void")
        made[f"sums{groups}"] = code
    return compiled(made, given="ptr noalias %work, i64 %k, ptr noalias %out")


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


def name_of(series: Series) -> str:
    """What the coefficient of the order before is called."""
    return f"q{series[0]}{'k' if series[1] else ''}"


def terms_of(recurrences: Recurrences) -> tuple[Term, ...]:
    """The sums that some recurrences need, each once."""
    every = (t for i, each in enumerate(recurrences.operations) for t in each.sums(recurrences.inputs + i))
    return tuple(dict.fromkeys(every))


def width_of_sums() -> int:
    """How many sums of one motion are found side by side."""
    return 8 if host().width >= 8 else 4
