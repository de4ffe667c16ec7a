"""The symbols a model is written in.

User names never reach code generation: coordinates are q0, q1 …, their rates u0, u1 …, parameters p0, p1 …
The time is a coordinate too (the clock, rate 1), so that whatever depends on time explicitly has a generalized force
and a power like everything else.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import symengine as se

from ..mechanics.material import Material
from ..mechanics.scene import Scene
from .functions import Expr

CLOCK = "t"


@dataclass(frozen=True)
class Symbols:
    """Names of a scene and their symbols; `free`, `guided` and the clock together are all that moves."""

    free: tuple[str, ...]
    guided: tuple[str, ...]
    parameters: tuple[str, ...]
    material: tuple[str, ...] = ()

    @classmethod
    def of(cls, scene: Scene) -> Symbols:
        """The symbols of a scene."""
        return cls(
            tuple(coordinate.name for coordinate in scene.free),
            tuple(guide.coordinate for guide in scene.guides),
            tuple(parameter.name for parameter in scene.parameters),
        )

    def within(self, material: Sequence[Material]) -> Symbols:
        """The symbols inside a continuum, where each particle has its material coordinates."""
        return replace(self, material=tuple(coordinate.name for coordinate in material))

    @cached_property
    def moving(self) -> tuple[str, ...]:
        """The free coordinates, the guided ones and the clock."""
        return (*self.free, *self.guided, CLOCK)

    @cached_property
    def values(self) -> Mapping[str, Expr]:
        """The symbol of every coordinate, parameter, material coordinate and the time, and the number π."""
        coordinates, parameters = self._numbered("q", self.moving[:-1]), self._numbered("p", self.parameters)
        material = self._numbered("s", self.material)
        return {**coordinates, **parameters, **material, CLOCK: self.time, "pi": se.pi}

    @cached_property
    def rates(self) -> Mapping[str, Expr]:
        """The symbol of every rate, that of the clock included."""
        return self._numbered("u", self.moving)

    @cached_property
    def accelerations(self) -> Mapping[str, Expr]:
        """The symbol of every acceleration."""
        return self._numbered("a", self.moving)

    @cached_property
    def time(self) -> Expr:
        return se.Symbol(CLOCK)

    @cached_property
    def inputs(self) -> tuple[Expr, ...]:
        """What the compiled functions read: q, q̇, t, parameters."""
        coordinates = tuple(self.values[name] for name in self.free)
        rates = tuple(self.rates[name] for name in self.free)
        return (*coordinates, *rates, self.time, *(self.values[name] for name in self.parameters))

    @staticmethod
    def _numbered(letter: str, names: tuple[str, ...]) -> dict[str, Expr]:
        return {name: se.Symbol(f"{letter}{index}") for index, name in enumerate(names)}
