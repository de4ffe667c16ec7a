"""How long δq's formulas are beside those of textbooks.

The measure is the number of operations of the plain text: additions and subtractions, multiplications and divisions,
powers, roots and calls of functions. Signs in front, dots and deltas are parts of a symbol; numbers side by side, and a
fraction of two numbers, are one number. So ½ m v² has three operations, in whichever way it is written.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import sympy as sp
from tests.lecture.textbook_corpus import BOOKS, Book

from deltaq.derivation.matrix_form import left_side
from deltaq.derivation.system import System
from deltaq.language.order import Order
from deltaq.language.parser import parse
from deltaq.language.plain_printer import plain
from deltaq.language.tree import Call, Name, Negation, Node, Number, Power, Product, Quotient, Rate, Sum
from deltaq.mechanics.document import read_scene

HELD_OUT_SEED, HELD_OUT = 20261122, 20  # systems drawn once; what they print was looked at only when all was done


@dataclass(frozen=True)
class Line:
    """A printed line, and what δq shows for it."""

    book: Book
    quantity: str
    printed: str

    @property
    def id(self) -> str:
        return f"{self.book.id}: {self.quantity}"

    @property
    def value(self) -> sp.Expr:
        """δq's result."""
        return _value(_system(self.book), self.quantity)

    @property
    def shown(self) -> str:
        """The same in plain text."""
        return plain(self.value, Order(_system(self.book).scene.names))

    @property
    def printed_value(self) -> sp.Expr:
        system = _system(self.book)
        return system.expression(parse(self.printed, system.scene.names).tree)

    @property
    def ratio(self) -> float:
        """Operations shown over operations printed."""
        names = _system(self.book).scene.names
        return count(parse(self.shown, names).tree) / max(count(parse(self.printed, names).tree), 1)


def lines(*, held_out: bool) -> list[Line]:
    """Those to work with, or those that were kept apart."""
    drawn = set(random.Random(HELD_OUT_SEED).sample(sorted(book.id for book in BOOKS), HELD_OUT))
    books = [book for book in BOOKS if (book.id in drawn) is held_out]
    return [Line(book, quantity, printed) for book in books for quantity, printed in book.lines.items()]


@cache
def _system(book: Book) -> System:
    return System(read_scene(document(book)))


def document(book: Book) -> dict[str, object]:
    """The scene of a system."""
    guided = [{"coordinate": q, "value": value} for q, value in book.guides.items()]
    bodies = list(_bodies(book))
    return {
        "id": book.id,
        "dimension": len(bodies[0]["position"]),
        "coordinates": [{"name": name, "value": 0.3 + 0.2 * i} for i, name in enumerate(book.coordinates.split())],
        "parameters": [{"name": name, "value": 4.0 - 0.4 * i} for i, name in enumerate(book.parameters.split())],
        "points": [{"name": name, "position": _parts(text)} for name, text in book.points.items()],
        "bodies": bodies,
        "loads": list(book.loads),
        "guides": guided,
    }


def _bodies(book: Book) -> Iterator[dict[str, object]]:
    for number, (mass, position, inertia, turning) in enumerate(book.bodies, 1):
        particle = {"name": f"body{number}", "mass": mass, "position": _parts(position)}
        space = len(_parts(position)) == 3
        if not inertia:
            yield particle | {"kind": "particle"}
        elif space:
            rest = {"inertia": _parts(inertia), "angular_velocity": _parts(turning)}
            yield particle | {"kind": "rigid"} | rest
        else:
            yield particle | {"kind": "rigid", "inertia": inertia, "angle": turning}


def _parts(text: str) -> list[str]:
    return [part.strip() for part in text.split(";")]


def _value(system: System, quantity: str) -> sp.Expr:
    kind, _, coordinate = quantity.partition(" ")
    if kind == "E":
        return system.kinetic_energy
    if kind == "V":
        return system.potential_energy
    return left_side(system, coordinate) if kind == "eq" else system.momentum(coordinate)


def count(node: Node) -> int:
    """The operations of a tree."""
    match node:
        case Number() | Name() | Rate():
            return 0
        case Negation(operand):
            return count(operand)
        case Sum(terms):
            return len(terms) - 1 + sum(map(count, terms))
        case Product() | Quotient():
            return _count_factors(node)
        case Power(base, _):
            return 1 + count(base)
        case Call(_, arguments):
            return 1 + sum(map(count, arguments))
    raise TypeError(type(node).__name__)


def _count_factors(node: Node) -> int:
    above, below = _factors(node)
    others = [f for f in (*above, *below) if not isinstance(f, Number)]
    numbers = [f for f in (*above, *below) if isinstance(f, Number) and f.value != 1]
    bare = not any(f in others for f in above) and not any(f.value != 1 for f in above if isinstance(f, Number))
    ones = 1 if bare and len(others) + bool(numbers) >= 1 else 0
    return len(others) + bool(numbers) - 1 + ones + sum(map(count, others))


def _factors(node: Node) -> tuple[list[Node], list[Node]]:
    """Factors above and below the line."""
    match node:
        case Product(factors):
            parts = [_factors(factor) for factor in factors]
            return [f for above, _ in parts for f in above], [f for _, below in parts for f in below]
        case Quotient(numerator, denominator):
            (a, b), (c, d) = _factors(numerator), _factors(denominator)
            return a + d, b + c
        case Negation(operand):
            return _factors(operand)
    return [node], []
