"""Dry friction by Coulomb: it opposes slipping with a given force, and holds what sticks with as much as it takes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression
from ...language.functions import KINKED
from ...language.tree import Call, Rate, walk
from ..bodies import Body
from ..checks import demand
from ..contributions import Friction
from ..reader import NOTHING, Reader
from . import Places


@dataclass(frozen=True)
class DryFriction:
    """Coulomb friction on c(q, t), a coordinate or what slips of several: δW = −F sgn(ċ − u) δc while it slips.

    Where it sticks it is a reaction of at most F₀: δW = R δc, |R| ≤ F₀. F(q, q̇, t) ≥ 0 is `force`, F₀ is `static` (F at
    rest if it is not given), u(t) is the rate of the surface.
    Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 5.
    """

    kind: ClassVar[str] = "friction"

    name: str
    coordinate: Expression
    force: Expression
    static: Expression | None = None
    surface_rate: Expression = field(default=NOTHING)

    def __post_init__(self) -> None:
        demand(
            *(_acceleration(getattr(self, key), key) for key in ("force", "static", "surface_rate")),
            *_not_of_places(self.coordinate),
        )

    @classmethod
    def read(cls, table: Reader) -> DryFriction:
        symbols = {symbol.name: symbol.kind for symbol in table.named.names.symbols}
        moving = {name for name, kind in symbols.items() if kind == "coordinate"}
        coordinate = cls._slipping(table, moving)
        force = table.expression("force")
        static = table.expression("static") if "static" in table.table else None
        surface = table.expression("surface_rate", "0")
        for name in sorted((surface.names & moving) | surface.rates):
            table.complain("surface-rate-by-coordinate", "surface_rate", name=name)
        return cls(table.name(), coordinate, force, static, surface)

    @classmethod
    def _slipping(cls, table: Reader, moving: set[str]) -> Expression:
        """c(q, t): a coordinate by its name, or what follows from several, such as how far two blocks are apart."""
        given = table.table.get("coordinate")
        is_other_name = isinstance(given, str) and given.strip().isidentifier() and given.strip() not in moving
        found = NOTHING if is_other_name else table.expression("coordinate")
        if is_other_name or not (found is NOTHING or found.names & moving):
            name = table.text("coordinate").strip()[:40]
            table.complain("unknown-coordinate", "coordinate", name=name, known=", ".join(sorted(moving)))
        return found

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[Friction, ...]:
        static = self.force if self.static is None else self.static
        trees = (self.coordinate.tree, self.force.tree, static.tree, self.surface_rate.tree)
        return (Friction(self.name, *trees),)


def _not_of_places(slipping: Expression) -> Iterator[Problem]:
    for rate in sorted(slipping.rates)[:1]:
        yield Problem("friction-with-rate", "/coordinate", parameters={"coordinate": rate})
    for node in walk(slipping.tree):
        if isinstance(node, Call) and node.function in KINKED:
            place = node.span
            yield Problem("friction-not-smooth", "/coordinate", place.offset, place.length, {"function": node.function})


def _acceleration(expression: Expression | None, key: str) -> Problem | None:
    if expression is None:
        return None
    faster = (node for node in walk(expression.tree) if isinstance(node, Rate) and node.order > 1)
    problems = (Problem("friction-with-acceleration", f"/{key}", parameters={"coordinate": n.name}) for n in faster)
    return next(problems, None)
