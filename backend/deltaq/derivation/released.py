"""Reactions by release: what holds a length or a guided coordinate, from the equation that it would have if free.

With l let go, the scene has a coordinate more, whose equation d/dt ∂L/∂l̇ − ∂L/∂l = Q + Z has the reaction Z on the
right, δW = Z δl. In the motion of the scene l is as it was; put in, the equation says what Z is. A length that a rod or
string keeps has the force S = −Z, positive in tension: it pulls where l grows.
Source: Szabó, Höhere Technische Mechanik, §I.4; Lanczos, The Variational Principles of Mechanics, ch. III.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..language.display import size
from ..mechanics.release import held, released
from ..vocabulary import HoldKind
from .accelerations import LONGEST, accelerations
from .matrix_form import left_side
from .system import System


@dataclass(frozen=True, eq=False)
class Release:
    """A scene's `system`, and the one in which `name` is a coordinate as well."""

    system: System
    wider: System
    name: str
    kind: HoldKind

    @classmethod
    def of(cls, system: System, name: str, pointer: str = "/release/0") -> Release:
        """Raises UnknownNameError at the pointer where nothing holds it."""
        wider = System(released(system.scene, name, pointer))
        return cls(system, wider, name, next(each.kind for each in held(system.scene) if each.name == name))

    @cached_property
    def reaction(self) -> sp.Expr:
        """Z for any motion of the released coordinate: d/dt ∂L/∂l̇ − ∂L/∂l − Qᵈ."""
        return left_side(self.wider, self.name)

    @cached_property
    def constancy(self) -> Mapping[sp.Symbol, sp.Expr]:
        """The released coordinate as the scene holds it: constant, or by its guide, with two derivatives."""
        wider, system = self.wider, self.system
        kept = {wider.rate(self.name): system.zero, wider.acceleration(self.name): system.zero}
        return kept if self.kind != "guide" else {s: system.guides[s] for s in (wider.q(self.name), *kept)}

    @cached_property
    def in_motion(self) -> sp.Expr:
        """Z in the scene's own motion, with its accelerations, in the scene's own symbols."""
        own = {self.wider.q(self.name): self.system.q(self.name)} if self.kind != "guide" else {}
        return self.system.display(self.reaction.xreplace(dict(self.constancy)).xreplace(own))

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
