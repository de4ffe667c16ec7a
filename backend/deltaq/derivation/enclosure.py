"""All roots of a system of equations in a box, by subdivision with interval Newton steps.

A box holds no root where an enclosure of an equation leaves out zero. Else the Krawczyk operator
K(B) = m − Y f(m) + (1 − Y J(B)) (B − m), Y ≈ J(m)⁻¹, holds all roots of B: where K misses B there is none, and where
K lies inside B there is exactly one. What neither decides is divided, until it is tiny or the budget is spent. Boxes
are enlarged before the test, so that a root on a common face is proved as well.
Source: Neumaier, Interval Methods for Systems of Equations, §5.1–5.2; Moore, Kearfott, Cloud, Introduction to Interval
Analysis, §8.2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy as sp
from flint import arb, arb_mat, ctx

from ..language.derivatives import diff
from .program import BY_CLASS, CONSTANTS
from .tree_evaluation import power

BITS = 53
TINY = 1e-7  # of the first box: what is undecided there is left to others
ENLARGED = 0.06
OFF_CENTRE = 0.4871  # where boxes are cut: symmetric systems have roots in the middle
MOST_LEFT = 64  # undecided tiny boxes: more of them make a continuum
CONTRACTIONS = 40

Box = tuple[tuple[float, float], ...]
Point = tuple[float, ...]


@dataclass
class Budget:
    """Operations in ball arithmetic that may still be spent: counted, so that the same question has the same answer."""

    left: int
    look: Callable[[], None] = lambda: None  # raises what ends the search before

    def pays(self, cost: int) -> bool:
        """Whether there was enough; it is spent then."""
        self.look()
        self.left -= cost
        return self.left >= 0


@dataclass(frozen=True)
class Enclosed:
    """Proved single roots; middles of tiny boxes that may hold others; boxes on which everything vanishes."""

    roots: tuple[Point, ...]
    undecided: tuple[Point, ...] = ()
    flat: tuple[Box, ...] = ()
    complete: bool = True


class OutsideDomainError(ArithmeticError):
    """Nowhere in the box is the expression real."""


@dataclass(frozen=True)
class Tape:
    """Expressions as operations on a list of balls, what they have in common computed once."""

    constants: tuple[tuple[int, arb], ...]
    operations: tuple[tuple[Callable[..., Any], tuple[int, ...]], ...]
    outputs: tuple[int, ...]
    inputs: int

    @property
    def cost(self) -> int:
        """How many operations one evaluation takes."""
        return len(self.operations) + 1

    def __call__(self, values: Sequence[Any]) -> list[Any]:
        """The expressions at a point, over a box, or as power series."""
        known = [*values, *(constant for _, constant in self.constants)]
        for operation, parts in self.operations:
            known.append(operation(*[known[part] for part in parts]))
        return [known[output] for output in self.outputs]


@dataclass
class Recorder:
    """Writes the tape of expressions, in the functions it is given by the names of SymPy's classes."""

    functions: Mapping[str, Callable[..., Any]]
    inputs: Sequence[sp.Symbol]
    constants: dict[sp.Basic, arb] = field(default_factory=dict)
    order: list[sp.Basic] = field(default_factory=list)
    seen: set[sp.Basic] = field(default_factory=set)

    def visit(self, expression: sp.Basic) -> None:
        """Takes in an expression after all its parts, each once."""
        if expression in self.seen or expression in self.inputs:
            return
        self.seen.add(expression)
        if isinstance(expression, sp.Rational):
            self.constants[expression] = arb(expression.p) / arb(expression.q)
        elif expression in CONSTANTS:
            self.constants[expression] = CONSTANTS[expression]()
        else:
            for part in expression.args:
                self.visit(part)
            self.order.append(expression)

    def tape(self, outputs: Sequence[sp.Expr]) -> Tape:
        """The tape of expressions; KeyError for a function that is not given."""
        for output in outputs:
            self.visit(output)
        slots: dict[sp.Basic, int] = {q: slot for slot, q in enumerate(self.inputs)}
        for expression in (*self.constants, *self.order):
            slots[expression] = len(slots)
        operations = [(self.functions[type(e).__name__], tuple(slots[part] for part in e.args)) for e in self.order]
        constants = tuple((slots[e], value) for e, value in self.constants.items())
        return Tape(constants, tuple(operations), tuple(slots[e] for e in outputs), len(self.inputs))


def tape(expressions: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], *, clipped: bool = False) -> Tape:
    """The tape of expressions in the unknowns alone; `clipped`: arguments are cut to where functions are real."""
    recorder = Recorder({**BY_CLASS, **CLIPPED} if clipped else BY_CLASS, unknowns)
    return recorder.tape([centred(each, unknowns) for each in expressions])


def centred(expression: sp.Expr, unknowns: Sequence[sp.Symbol]) -> sp.Expr:
    """The same with completed squares: over a box (x + a)² is known better than x² + 2ax + a²."""
    sums = [each for each in expression.atoms(sp.Add) if each.has(*unknowns) and each != expression]
    return expression.xreplace({each: _squares(each, unknowns) for each in sums})


def _squares(total: sp.Expr, unknowns: Sequence[sp.Symbol]) -> sp.Expr:
    present = [q for q in unknowns if total.has(q)]
    if not total.is_polynomial(*present):
        return total
    terms = sp.Poly(total, *present).terms()
    if not all(sum(powers) <= 2 and max(powers) == sum(powers) for powers, _ in terms):
        return total
    rest = sum((each for powers, each in terms if not any(powers)), sp.Integer(0))
    for index, q in enumerate(present):
        linear, square = (
            sum((each for powers, each in terms if powers[index] == degree), sp.Integer(0)) for degree in (1, 2)
        )
        rest += linear * q if square == 0 else square * (q + linear / square / 2) ** 2 - linear**2 / square / 4
    return rest


def _cut(x: arb, low: float, high: float) -> arb:
    """The part of a ball between two numbers. Raises OutsideDomainError if there is none."""
    if not x.is_finite():
        return x
    below, above = ends(x)
    if above < low or below > high:
        raise OutsideDomainError
    return x if low <= below and above <= high else ball(max(below, low), min(above, high))


def _power(base: arb, exponent: arb) -> arb:
    whole = exponent.unique_fmpz()
    if whole is None:
        return _cut(base, 0.0, math.inf) ** exponent
    if whole > 0 and whole % 2 == 0:
        return abs(base) ** whole
    return power(base, exponent)


CLIPPED: Mapping[str, Callable[..., arb]] = {
    "Pow": _power,
    "log": lambda x: _cut(x, 0.0, math.inf).log(),
    "asin": lambda x: _cut(x, -1.0, 1.0).asin(),
    "acos": lambda x: _cut(x, -1.0, 1.0).acos(),
    "acosh": lambda x: _cut(x, 1.0, math.inf).acosh(),
    "atanh": lambda x: _cut(x, -1.0, 1.0).atanh(),
}


def ball(low: float, high: float) -> arb:
    """The ball that holds an interval."""
    return arb((low + high) / 2, (high - low) / 2 * (1 + 1e-15) + abs(low + high) * 1e-16)


def ends(x: arb) -> tuple[float, float]:
    """The interval of a ball, outwards by a rounding."""
    middle, radius = float(x.mid()), float(x.rad())
    return middle - radius, middle + radius


def enclosed(equations: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], box: Box, budget: Budget) -> Enclosed:
    """The roots of as many equations as unknowns in a box."""
    with ctx.workprec(BITS):
        return _Search(equations, unknowns, box, budget).run()


class _Search:
    def __init__(self, equations: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], box: Box, budget: Budget) -> None:
        self.size = len(unknowns)
        self.field = tape(equations, unknowns, clipped=True)
        self.slopes = tape([diff(e, q) for e in equations for q in unknowns], unknowns)
        self.start, self.budget = box, budget
        self.widths = [high - low for low, high in box]
        self.one = arb_mat(self.size, self.size, [int(i == k) for i in range(self.size) for k in range(self.size)])
        self.roots: list[Point] = []
        self.undecided: list[Point] = []
        self.flat: list[Box] = []

    def run(self) -> Enclosed:
        """Halves boxes until each has one root for certain or none, or the budget is spent."""
        stack, complete = [self.start], True
        while stack and complete:
            stack += self._pieces(stack.pop())
            complete = self.budget.left > 0 and len(self.undecided) < MOST_LEFT
        return Enclosed(tuple(self.roots), tuple(self.undecided), tuple(self.flat), complete)

    def _pieces(self, box: Box) -> list[Box]:
        """What is left to look at of a box."""
        if not self._may_vanish(box):
            return []
        if max(self._relative(box)) < TINY:
            self.undecided.append(tuple((low + high) / 2 for low, high in box))
            return []
        narrowed = self._narrowed(box)
        if narrowed is None:
            return []
        wide, narrow = self._relative(box), self._relative(narrowed)
        return [narrowed] if max(narrow) < 0.6 * max(wide) else self._halves(narrowed, narrow)

    def _may_vanish(self, box: Box) -> bool:
        """Whether the enclosures leave it open; where everything vanishes all over a box, that is kept."""
        self.budget.pays(self.field.cost)
        try:
            values = self.field([ball(*each) for each in box])
        except OutsideDomainError:
            return False
        flat = all(value == 0 for value in values)
        if flat:
            self.flat.append(box)
        return not flat and not any(value.is_finite() and not value.contains(0) for value in values)

    def _relative(self, box: Box) -> list[float]:
        return [(high - low) / width for (low, high), width in zip(box, self.widths, strict=True)]

    def _halves(self, box: Box, relative: list[float]) -> list[Box]:
        axis = max(range(self.size), key=lambda i: relative[i])
        low, high = box[axis]
        cut = low + OFF_CENTRE * (high - low)
        return [(*box[:axis], part, *box[axis + 1 :]) for part in ((cut, high), (low, cut))]

    def _narrowed(self, box: Box) -> Box | None:
        """The part of the box that can hold roots; None if there is none, or just one that is known now."""
        self.budget.pays(self.slopes.cost + self.field.cost + self.size**3)
        larger = tuple((low - ENLARGED * (high - low), high + ENLARGED * (high - low)) for low, high in box)
        image = self._krawczyk(larger)
        if image is None:
            return box
        if all(low < a and b < high for (a, b), (low, high) in zip(image, larger, strict=True)):
            self._take(image)
            return None
        both = [(max(a, low), min(b, high)) for (a, b), (low, high) in zip(image, box, strict=True)]
        return tuple(both) if all(a <= b for a, b in both) else None

    def _krawczyk(self, box: Box) -> Box | None:
        """K(B); None where it is not defined."""
        slopes = self.slopes([ball(*each) for each in box])
        if not all(slope.is_finite() for slope in slopes):
            return None
        J = arb_mat(self.size, self.size, slopes)
        middle = [arb((low + high) / 2) for low, high in box]
        try:
            Y = arb_mat(self.size, self.size, [slope.mid() for slope in slopes]).inv()
            there = self.field(middle)
        except (ZeroDivisionError, OutsideDomainError):
            return None
        m = arb_mat(self.size, 1, middle)
        aside = arb_mat(self.size, 1, [ball(*each) for each in box]) - m
        image = (m - Y * arb_mat(self.size, 1, there) + (self.one - Y * J) * aside).entries()
        return tuple(ends(each) for each in image) if all(each.is_finite() for each in image) else None

    def _take(self, box: Box) -> None:
        """Keeps the one root in the box, to the digits of doubles, if it is a new one."""
        for _ in range(CONTRACTIONS):
            image = self._krawczyk(box)
            both = [(max(a, c), min(b, d)) for (a, b), (c, d) in zip(image or box, box, strict=True)]
            if tuple(both) == box or any(low > high for low, high in both):
                break
            box = tuple(both)
        root = tuple((low + high) / 2 for low, high in box)
        if not any(near(root, other, self.widths) for other in self.roots):
            self.roots.append(root)


def near(one: Sequence[float], other: Sequence[float], widths: Sequence[float]) -> bool:
    """Whether two are the same but for rounding."""
    return all(abs(a - b) <= 1e-7 * width for a, b, width in zip(one, other, widths, strict=True))
