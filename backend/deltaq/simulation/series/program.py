"""The operations of a model as a list of numbers, for the interpreter, and where its numbers stand in the work space.

These are the coefficients that sums need, order by order, and the sums; then for each place the coefficient of order k,
that of order 0, and what its operation keeps. Truths of conditions, 1 or 0, are places behind the others.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from ...model import recurrences as r
from ...model.recurrences import Operation, Recurrences, Term
from .code import address_of
from .generated import joined, wanted
from .shape import Shape
from .sums import Blocks, terms_of, width_of_sums

# Places in the program, which begins with the order: addresses of code and of numbers in the work space, sizes, and
# lists, of which each has its place and its length.
LOOP, ROW, SUMS, NOW, BEGIN, KEPT = 1, 2, 3, 4, 5, 6
INPUTS, WIDTH, COMPONENTS, FIRST_PIVOT, FIRST_CONSTANT = 7, 8, 9, 10, 11
BLOCKS, BLOCK, TOGETHER = 12, 13, 14  # of sums that one call finds: how many, their numbers, and sums in one
BEGINNINGS, OPERATIONS, RATES, ARGUMENTS, PIVOTS, PLAIN, MULTIPLE = 15, 17, 19, 21, 23, 25, 27
HEAD = 29
RECORD = 9  # numbers of an operation
KIND, A, B, C, CONSTANT, RESULT, FIRST_SUM = 0, 1, 2, 3, 4, 5, 6
FUNCTION = FIRST_SUM  # of those that tell first coefficients

# Kinds of first coefficients beside the codes of operations: conditions, and functions of the C library.
TRUTH, SINE, COSINE, CALLED = 100, 200, 300, 400
# Kinds of later ones: a sum or difference with γ a series, rounded once; the factor or the other one may be negative.
JOINED, LESS, FROM = 500, 501, 502
SIMPLE = tuple(sorted(set(range(r.CHOICE + 1)) - r.WITH_FUNCTION))


@dataclass(frozen=True)
class Layout:
    """Where the numbers of a model stand, and the list of its operations."""

    recurrences: Recurrences

    @cached_property
    def terms(self) -> tuple[Term, ...]:
        """The sums that are needed."""
        return terms_of(self.recurrences)

    @cached_property
    def wanted(self) -> set[int]:
        """Places whose later coefficients are asked for."""
        return wanted(self.recurrences)

    @cached_property
    def sums(self) -> Blocks:
        """Where the sums stand, and what they are made of."""
        return Blocks(self.terms, width_of_sums())

    @property
    def first_place(self) -> int:
        """Where the coefficients by places begin."""
        return self.sums.size

    @property
    def places(self) -> int:
        """Inputs, operations and conditions."""
        return self.recurrences.inputs + len(self.recurrences.operations) + len(self.recurrences.conditions)

    @property
    def size(self) -> int:
        """Doubles of work space."""
        return self.first_place + 3 * self.places

    @property
    def program(self) -> tuple[int, ...]:
        """What stands behind the order."""
        r_, shape = self.recurrences, Shape.of(self.recurrences)
        rates = [*range(r_.degrees, 2 * r_.degrees), *r_.accelerations, *(() if r_.power is None else (r_.power,))]
        lists: dict[int, Sequence[Sequence[int]]] = {
            BEGINNINGS: list(self._beginnings()),
            OPERATIONS: list(self._operations()),
            RATES: [[place] for place in rates],
            ARGUMENTS: [[condition.argument] for condition in r_.conditions],
            PIVOTS: [[place] for pair in r_.pivots for place in pair],
            PLAIN: self._stored(is_multiple=False),
            MULTIPLE: self._stored(is_multiple=True),
        }
        head = [0] * HEAD
        head[LOOP], head[ROW], head[SUMS] = self.sums.loop, self.sums.stride, self.sums.first_sum
        head[NOW], head[BEGIN], head[KEPT] = (self.first_place + number * self.places for number in range(3))
        head[INPUTS], head[WIDTH], head[COMPONENTS] = r_.inputs, shape.width, shape.components
        head[FIRST_PIVOT], head[FIRST_CONSTANT] = shape.first_pivot, shape.first_constant
        head[BLOCKS], head[BLOCK], head[TOGETHER] = self.sums.blocks, self.sums.block, self.sums.together
        body: list[int] = []
        for at, records in lists.items():
            head[at : at + 2] = HEAD + len(body), len(records)
            body += [number for record in records for number in record]
        return (*head[1:], *body)

    def _stored(self, *, is_multiple: bool) -> list[list[int]]:
        """The places whose coefficients, or k times these, sums need, each with where in an order it belongs."""
        places = self.sums.places
        return [[place, at] for (place, kind), every in places.items() if kind is is_multiple for at in every]

    def _beginnings(self) -> Iterable[list[int]]:
        """What tells the first coefficients: the operations, and before the first that needs it each condition."""
        r_, known = self.recurrences, set[int]()
        truths = r_.inputs + len(r_.operations)
        for place, operation in enumerate(r_.operations, r_.inputs):
            record = self._record(operation, place)
            if operation.code == r.CHOICE:
                if operation.a not in known:
                    condition = r_.conditions[operation.a]
                    yield [TRUTH + condition.kind, condition.argument, 0, 0, 0, truths + operation.a, *[0] * 3]
                known.add(operation.a)
                record[A] = truths + operation.a
            if operation.code in r.WITH_FUNCTION:
                record[C] = 0
                name = r.FUNCTIONS[operation.c]
                record[KIND] += {"sin": SINE, "cos": COSINE}.get(name, CALLED)
                record[FUNCTION] = address_of(name)
            yield record

    def _operations(self) -> Iterable[list[int]]:
        """What tells the later ones."""
        r_, terms = self.recurrences, {term: number for number, term in enumerate(self.terms)}
        for place, operation in enumerate(r_.operations, r_.inputs):
            record = self._record(operation, place)
            for number, term in enumerate(operation.sums(place)):
                record[FIRST_SUM + number] = terms[term]
            if operation.code == r.CHOICE:
                record[A] = r_.inputs + len(r_.operations) + operation.a
            if (one := joined(r_, operation)) is not None:
                record[KIND] = FROM if one.is_from else LESS if one.is_less else JOINED
                record[A], record[B], record[CONSTANT] = one.series, one.other, one.constant
            if place in self.wanted:
                yield record

    @staticmethod
    def _record(operation: Operation, place: int) -> list[int]:
        return [operation.code, operation.a, operation.b, operation.c, operation.constant, place, *[0] * 3]
