"""What holds a released length, angle or guided coordinate, as a function of the scene's own motion.

With l let go the scene has one coordinate more, whose equation Mₗ q̈ + bₗ = Qₗ + (Aᵀλ)ₗ + Z lacks Z, δW = Z δl.
In the motion of the scene l is as it was; put in, the equation says what Z is.
Source: Szabó, Höhere Technische Mechanik, §I.4; Lanczos, The Variational Principles of Mechanics, ch. III.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import symengine as se

from ..mechanics.contributions import Friction
from ..mechanics.jumps import frictions_of, without_dry_friction
from ..mechanics.release import find_held, let_go
from ..mechanics.scene import Scene
from .compiled import Compiled, Floats, compile_expressions
from .equations import Equations, equations, guided_into
from .functions import Expr
from .kinetic import ZERO, dot, velocity
from .model import Model
from .modes import InModes, in_modes, modes_of, modes_of_model
from .slopes import slope
from .symbols import CLOCK, Symbols
from .symengine_algebra import to_symengine


@dataclass(frozen=True)
class HeldBy:
    """Z of what is released: of what a model reads, then q̈ of the free coordinates and λ, as the model orders them.

    `at_states` reads what the model of the scene does; `in_modes`, where motions go on behind events, what that in
    modes does, and at last λ of every row that may be held. `has_rival` says of each whether dry friction holds it as
    well: that of a coordinate which a guide keeps at rest.
    """

    at_states: Compiled
    in_modes: Compiled | None
    has_rival: tuple[bool, ...]

    def along(self, model: Model, rows: Floats) -> Floats:
        """Z by name of (inputs, q̈, λ of constraints), shape (states, those): shape (states, names)."""
        modes = modes_of_model(model) if model.is_in_modes else None
        if modes is None or self.in_modes is None:
            return self.at_states.table(rows)
        held = modes.facts.table(rows[:, : modes.facts.inputs])[:, modes.single_facts[-1]]
        return self.in_modes.table(np.hstack([rows, held]))

    def shares(self, inputs: Floats) -> Floats:
        """How Z changes with q̈, then with λ of each constraint and of each row that may be held: shape (names, those).

        `inputs` are those of the model in modes at one state, shape (inputs,); Z is linear in all of these.
        """
        if self.in_modes is None:
            return np.zeros((self.at_states.outputs, 0))
        count = self.in_modes.inputs - len(inputs)
        varied = np.vstack([np.zeros(count), np.eye(count)])
        found = self.in_modes.table(np.hstack([np.tile(inputs, (count + 1, 1)), varied]))
        return np.asarray((found[1:] - found[0]).T)


def reactions(scene: Scene, names: tuple[str, ...]) -> HeldBy:
    """Z of each name. Raises UnknownNameError, at the place in /release, for what nothing holds."""
    own = Symbols.of(scene)
    multipliers = tuple(se.Symbol(f"r{k}") for k in range(len(scene.conditions)))
    wider = [_Wider.of(scene, name, f"/release/{k}") for k, name in enumerate(names)]
    others = (*(own.accelerations[name] for name in own.free), *multipliers)
    at_states = compile_expressions((*own.inputs, *others), [each.reaction(multipliers) for each in wider])
    has_rival = tuple(each.has_rival for each in wider)
    if modes_of(scene) is None:
        return HeldBy(at_states, None, has_rival)
    modes, slippery = in_modes(scene), without_dry_friction(scene)
    free_of_it = [_Wider.of(slippery, name, f"/release/{k}") for k, name in enumerate(names)]
    in_motion = [
        modes.in_motion(smooth.reaction(multipliers)) - each.held_otherwise(modes)
        for smooth, each in zip(free_of_it, wider, strict=True)
    ]
    read = (*modes.inputs, *others, *modes.reactions)
    return HeldBy(at_states, compile_expressions(read, in_motion), has_rival)


@dataclass(frozen=True)
class _Wider:
    """A `scene`, its equations where a `coordinate` more is let go, and the symbols there in terms of its own."""

    scene: Scene
    released: Scene
    coordinate: str
    equations: Equations
    own: Mapping[Expr, Expr]

    @classmethod
    def of(cls, scene: Scene, name: str, pointer: str) -> _Wider:
        """Raises UnknownNameError at the pointer for what nothing holds."""
        free = let_go(scene, find_held(scene, name, pointer))
        wide = equations(free.scene)
        return cls(scene, free.scene, free.coordinate, wide, _own(scene, Symbols.of(scene), wide, free.coordinate))

    def reaction(self, multipliers: tuple[Expr, ...]) -> Expr:
        """Mₗ q̈ + bₗ − Qₗ − (Aᵀλ)ₗ, what dry friction holds being told by its sign."""
        wide = self.equations
        row = wide.symbols.free.index(self.coordinate)
        inertia = (
            entry * wide.symbols.accelerations[each]
            for each, entry in zip(wide.symbols.free, wide.mass_matrix[row], strict=True)
        )
        kept = (rows[row] * multipliers[k] for k, rows in enumerate(wide.constraints.jacobian))
        total = sum(inertia, ZERO) - wide.forcing[row] - sum(kept, ZERO)
        return self._as_held(total)

    @property
    def has_rival(self) -> bool:
        """Whether friction on what guides keep at rest would hold it as well: nothing tells how much each takes."""
        rubbing = frictions_of(self.scene)
        return any(
            isinstance(part, Friction)
            and part not in rubbing
            and self._rests(part)
            and self._along(self._place(part)) != 0
            for part in self.scene.contributions
        )

    def held_otherwise(self, modes: InModes) -> Expr:
        """Σ R ∂c/∂l + Σ λ ∂g/∂l: what dry friction and contacts exert on what is released."""
        slid = [self._along(self._place(part)) for part in frictions_of(self.scene)]
        touched = (force * self._along(self.equations.events[k]) for k, force in modes.contacts.items())
        return sum((dot(slid, modes.frictions), *touched), ZERO)

    def _place(self, part: Friction) -> Expr:
        """c(q, t) of what slips, guides but that which was released put in."""
        return guided_into(self.released, to_symengine(part.coordinate, self.equations.symbols))

    def _rests(self, part: Friction) -> bool:
        """Whether ċ = u always."""
        symbols = Symbols.of(self.scene)
        slip = velocity((to_symengine(part.coordinate, symbols),), symbols)[0] - to_symengine(
            part.surface_rate, symbols
        )
        return bool(se.expand(guided_into(self.scene, slip)) == 0)

    def _along(self, gap: Expr) -> Expr:
        """∂g/∂l where l is held."""
        return self._as_held(slope(gap, self.equations.symbols.values[self.coordinate]))

    def _as_held(self, expression: Expr) -> Expr:
        return se.sympify(expression).xreplace(self.own)


def _own(scene: Scene, own: Symbols, wide: Equations, name: str) -> Mapping[Expr, Expr]:
    """The wider scene's symbols by the scene's own; the released coordinate as it is held."""
    there = wide.symbols
    values = {there.values[each]: own.values[each] for each in there.values if each in own.values}
    rates = {there.rates[each]: own.rates[each] for each in there.free if each != name}
    accelerations = {there.accelerations[each]: own.accelerations[each] for each in there.free if each != name}
    guide = next((guide for guide in scene.guides if guide.coordinate == name), None)
    value = own.values.get(name, ZERO) if guide is None else to_symengine(guide.value.tree, own)
    rate = ZERO if guide is None else slope(value, own.values[CLOCK])
    acceleration = ZERO if guide is None else slope(rate, own.values[CLOCK])
    as_held = {there.values[name]: value, there.rates[name]: rate, there.accelerations[name]: acceleration}
    return {**values, **rates, **accelerations, **as_held}
