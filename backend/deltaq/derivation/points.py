"""Points at which formulas are evaluated, and the curves through them along which they are differentiated."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from itertools import takewhile

from flint import arb

from ..language.spelling import spell_rate

Point = Mapping[str, arb]  # values of names, `dot(name)`, `ddot(name)`, `delta(name)` and `d(name)`

STEP = arb(2) ** -128
HIGHEST = 4  # the rates that an Euler–Poisson equation holds


class Place(dict[str, arb]):
    """A point that remembers what was evaluated at it, and the points beside it.

    `origin` is the place it was moved from, and `moved` names what has another value than there: an expression without
    any of these has its value from the origin. What is remembered has the precision of the first evaluation.
    """

    def __init__(self, values: Point, origin: Place | None = None, moved: Iterable[str] = ()) -> None:
        super().__init__(values)
        self.origin = origin
        self.moved = frozenset(moved)
        self.known: dict[Hashable, arb] = {}
        self.beside: dict[Hashable, tuple[Point, ...]] = {}


def moved(point: Point, changes: Point) -> Place:
    """The point with other values for some names."""
    return Place({**point, **changes}, point, changes) if isinstance(point, Place) else Place({**point, **changes})


def beside(point: Point, curve: Hashable, along: Callable[[arb], Point], places: Iterable[arb]) -> tuple[Point, ...]:
    """The points at these places of a curve through a point; one that remembers makes them once for each curve."""
    known = point.beside if isinstance(point, Place) else {}
    if curve not in known:
        known[curve] = tuple(map(along, places))
    return known[curve]


def pair(point: Point, curve: Hashable, along: Callable[[arb], Point]) -> tuple[Point, ...]:
    """The points one STEP ahead and behind."""
    return beside(point, curve, along, (STEP, -STEP))


def central_difference(function: Callable[[arb], arb]) -> arb:
    """f′(0) as (f(h) − f(−h))/2h; the relative error is about h² = 2⁻²⁵⁶."""
    return (function(STEP) - function(-STEP)) / (2 * STEP)


def along_motion(point: Point, h: arb) -> Point:
    """Where the system is a time h later: q + q̇h + q̈h²/2 + …, and its rates, as far as the point knows them."""
    changes = {"t": point["t"] + h}
    for name in point:
        if spell_rate(name, 1) in point and spell_rate(name, 2) in point:
            changes |= _taylor(_jet(name, point), h)
    return moved(point, changes)


def _jet(name: str, point: Point) -> dict[str, arb]:
    """A function and its rates, without a gap."""
    spellings = (spell_rate(name, order) for order in range(HIGHEST + 1))
    return {spelling: point[spelling] for spelling in takewhile(point.__contains__, spellings)}


def _taylor(jet: dict[str, arb], h: arb) -> dict[str, arb]:
    """All but the last of them, which is constant, a time h later."""
    values = list(jet.values())
    found: dict[str, arb] = {}
    for order, name in enumerate(list(jet)[:-1]):
        total = values[-1]
        for place in range(len(values) - 2, order - 1, -1):
            total = values[place] + total * h / (place - order + 1)
        found[name] = total
    return found


def varied(point: Point, h: arb) -> Point:
    """The neighbouring configuration q + h δq at the same time."""
    return shifted(point, {name: h * point[f"delta({name})"] for name in point if f"delta({name})" in point})


def shifted(point: Point, shifts: Point) -> Point:
    """The point with a number added to some of its values."""
    return moved(point, {name: point[name] + shift for name, shift in shifts.items()})
