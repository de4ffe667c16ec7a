"""Reactions by release: what holds a length or a guided coordinate, from the equation that it would have if free.

With l let go, the scene has a coordinate more, whose equation d/dt ∂L/∂l̇ − ∂L/∂l = Q + Z has the reaction Z on the
right, δW = Z δl. In the motion of the scene l is as it was; put in, the equation says what Z is. A length that a rod or
string keeps has the force S = −Z, positive in tension: it pulls where l grows. Where l also says what bodies are made
of, the coordinate more is a displacement u of places, which is zero in the motion.
Source: Szabó, Höhere Technische Mechanik, §I.4; Lanczos, The Variational Principles of Mechanics, ch. III.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..language.derivatives import diff
from ..language.display import size
from ..mechanics.release import Held, find_held, let_go
from ..vocabulary import HoldKind
from .accelerations import LONGEST, accelerations
from .calculus import V
from .matrix_form import left_side
from .system import System


@dataclass(frozen=True, eq=False)
class Release:
    """A scene's `system`, what it holds, and the `wider` one, in which `coordinate` is a coordinate as well."""

    system: System
    wider: System
    coordinate: str
    held: Held

    @classmethod
    def of(cls, system: System, name: str, pointer: str = "/release/0") -> Release:
        """Raises UnknownNameError at the pointer where nothing holds it."""
        found = find_held(system.scene, name, pointer)
        free = let_go(system.scene, found)
        return cls(system, System(free.scene), free.coordinate, found)

    @property
    def name(self) -> str:
        """What is released."""
        return self.held.name

    @property
    def kind(self) -> HoldKind:
        """What holds it."""
        return self.held.kind

    @property
    def is_of_rod(self) -> bool:
        """Whether −Z is the force of one rod or string, of one with mass that at its near end."""
        return self.kind in ("length", "rod")

    @cached_property
    def reaction(self) -> sp.Expr:
        """Z for any motion of the released coordinate: d/dt ∂L/∂l̇ − ∂L/∂l − Qᵈ."""
        return left_side(self.wider, self.coordinate)

    @cached_property
    def constancy(self) -> Mapping[sp.Symbol, sp.Expr]:
        """The released coordinate as the scene holds it: constant, zero, or by its guide, with two derivatives."""
        wider, system = self.wider, self.system
        value = wider.q(self.coordinate)
        rates = {wider.rate(self.coordinate): system.zero, wider.acceleration(self.coordinate): system.zero}
        if self.kind == "guide":
            return {symbol: system.guides[symbol] for symbol in (value, *rates)}
        return rates if self.held.shift is None else {value: system.zero, **rates}

    @cached_property
    def in_motion(self) -> sp.Expr:
        """Z in the scene's own motion, with its accelerations, in the scene's own symbols."""
        return self.as_held(self.reaction)

    def as_held(self, expression: V) -> V:
        """What an expression of the wider system is in the scene's own motion."""
        own = {self.wider.q(self.name): self.system.q(self.name)} if self.kind != "guide" else {}
        return self.system.display(expression.xreplace(dict(self.constancy)).xreplace(own))

    @property
    def displacements(self) -> Mapping[str, sp.ImmutableMatrix]:
        """∂r/∂l of the places that move with what was released, in the scene's own motion."""
        wider, symbol = self.wider, self.wider.q(self.coordinate)
        moved = {place: self.as_held(diff(wider.position(place), symbol)) for place in self.system.scene.places}
        return {place: along for place, along in moved.items() if not along.is_zero_matrix}

    @cached_property
    def accelerations(self) -> Mapping[sp.Symbol, sp.Expr] | None:
        """q̈ by the equations of motion; None where they are too long to be read, or Z does not hold them."""
        if not self.in_motion.free_symbols & {
            *map(self.system.acceleration, self.system.free),
            *self.system.multipliers,
        }:
            return None
        return accelerations(self.system)

    @cached_property
    def closed(self) -> sp.Expr | None:
        """Z(q, q̇, t), where it is short; None where accelerations stay in it."""
        if self.accelerations is None:
            held_fast = self.in_motion.free_symbols & {*map(self.system.acceleration, self.system.free)}
            return None if held_fast else self.in_motion
        value = self.system.display(self.in_motion.xreplace(dict(self.accelerations)))
        return value if size(value) <= LONGEST else None

    @property
    def value(self) -> sp.Expr:
        """Z without accelerations where it can be had, else with them."""
        return self.in_motion if self.closed is None else self.closed
