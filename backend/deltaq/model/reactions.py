"""What holds a released length, angle or guided coordinate, as a function of the scene's own motion.

With l let go the scene has one coordinate more, whose equation Mₗ q̈ + bₗ = Qₗ + (Aᵀλ)ₗ + Z lacks Z, δW = Z δl.
In the motion of the scene l is as it was; put in, the equation says what Z is.
Source: Szabó, Höhere Technische Mechanik, §I.4; Lanczos, The Variational Principles of Mechanics, ch. III.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import symengine as se

from ..mechanics.release import find_held, let_go
from ..mechanics.scene import Scene
from .compiled import Compiled, compile_expressions
from .equations import Equations, equations
from .functions import Expr
from .kinetic import ZERO
from .model import Model
from .modes import in_modes, modes_of
from .slopes import slope
from .symbols import CLOCK, Symbols
from .symengine_algebra import to_symengine


@dataclass(frozen=True)
class HeldBy:
    """Z of what is released, of what a model reads and then q̈ of the free coordinates and λ, as it orders them.

    `at_states` reads what the model of the scene does; `in_modes`, where motions go on behind events, what that in
    modes does: on which side of a kink the motion is stands in its parameters alone.
    """

    at_states: Compiled
    in_modes: Compiled | None

    def of(self, model: Model) -> Compiled:
        """The function of what a model reads."""
        return self.in_modes if model.is_in_modes and self.in_modes else self.at_states


def reactions(scene: Scene, names: tuple[str, ...]) -> HeldBy:
    """Z of each name. Raises UnknownNameError, at the place in /release, for what nothing holds."""
    own = Symbols.of(scene)
    multipliers = tuple(se.Symbol(f"r{k}") for k in range(len(scene.conditions)))
    found = [_reaction(scene, own, name, f"/release/{k}", multipliers) for k, name in enumerate(names)]
    others = (*(own.accelerations[name] for name in own.free), *multipliers)
    at_states = compile_expressions((*own.inputs, *others), found)
    if modes_of(scene) is None:
        return HeldBy(at_states, None)
    inputs, in_motion = in_modes(scene, found)
    return HeldBy(at_states, compile_expressions((*inputs, *others), in_motion))


def _reaction(scene: Scene, own: Symbols, name: str, pointer: str, multipliers: tuple[Expr, ...]) -> Expr:
    found = find_held(scene, name, pointer)
    free = let_go(scene, found)
    wide = equations(free.scene)
    row = wide.symbols.free.index(free.coordinate)
    inertia = (
        entry * wide.symbols.accelerations[each]
        for each, entry in zip(wide.symbols.free, wide.mass_matrix[row], strict=True)
    )
    held = wide.constraints
    kept = (rows[row] * multipliers[k] for k, rows in enumerate(held.jacobian))
    total = sum(inertia, ZERO) - wide.forcing[row] - sum(kept, ZERO)
    return se.sympify(total).xreplace(_own(scene, own, wide, free.coordinate))


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
