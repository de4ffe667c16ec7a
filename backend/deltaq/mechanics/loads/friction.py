"""Dry friction by Coulomb: it opposes slipping with a given force, and holds what sticks with as much as it takes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression
from ...language.tree import Rate, walk
from ..bodies import Body
from ..checks import demand
from ..contributions import Friction
from ..reader import NOTHING, Reader
from . import Places


@dataclass(frozen=True)
class DryFriction:
    """Coulomb friction on a coordinate: Q = −F sgn(q̇ − u) while it slips, |Q| ≤ F₀ where it sticks.

    F(q, q̇, t) ≥ 0 is `force`, F₀ is `static` (F at rest if it is not given), u(t) is the rate of the surface.
    Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 5.
    """

    kind: ClassVar[str] = "friction"

    name: str
    coordinate: Expression
    force: Expression
    static: Expression | None = None
    surface_rate: Expression = field(default=NOTHING)

    def __post_init__(self) -> None:
        demand(*(_acceleration(getattr(self, key), key) for key in ("force", "static", "surface_rate")))

    @classmethod
    def read(cls, table: Reader) -> DryFriction:
        symbols = {symbol.name: symbol.kind for symbol in table.named.names.symbols}
        moving = {name for name, kind in symbols.items() if kind == "coordinate"}
        name = table.text("coordinate").strip()
        if name and name not in moving:
            table.complain("unknown-coordinate", "coordinate", name=name[:40], known=", ".join(sorted(moving)))
        coordinate = table.parsed(name, "coordinate") if name in moving else NOTHING
        force = table.expression("force")
        static = table.expression("static") if "static" in table.table else None
        surface = table.expression("surface_rate", "0")
        for name in sorted((surface.names & moving) | surface.rates):
            table.complain("surface-rate-by-coordinate", "surface_rate", name=name)
        return cls(table.name(), coordinate, force, static, surface)

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[Friction, ...]:
        static = self.force if self.static is None else self.static
        trees = (self.coordinate.tree, self.force.tree, static.tree, self.surface_rate.tree)
        return (Friction(self.name, *trees),)


def _acceleration(expression: Expression | None, key: str) -> Problem | None:
    if expression is None:
        return None
    faster = (node for node in walk(expression.tree) if isinstance(node, Rate) and node.order > 1)
    problems = (Problem("friction-with-acceleration", f"/{key}", parameters={"coordinate": n.name}) for n in faster)
    return next(problems, None)
