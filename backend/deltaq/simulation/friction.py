"""The force of dry friction along a motion, and the largest that could hold: |R| ≤ F₀ as long as it sticks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..model.modes import Modes
from .problem import Floats, Stretch, inputs_of_stretches


@dataclass(frozen=True)
class FrictionForce:
    """At the samples, `force` is R in the direction of the coordinate, `largest` F₀ ≥ 0: shape (samples,) each."""

    force: Floats
    largest: Floats

    def first(self, count: int) -> FrictionForce:
        """The first `count` samples."""
        return FrictionForce(self.force[:count], self.largest[:count])


def friction_along(
    modes: Modes, times: Floats, states: Floats, stretches: tuple[Stretch, ...]
) -> Mapping[str, FrictionForce]:
    """By load, the friction of each state in the mode of its stretch.

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    count = len(modes.frictions)
    if not stretches or not count:
        return {}
    facts = modes.facts.table(inputs_of_stretches(times, states, stretches))
    first = modes.rows * (2 * stretches[0].problem.degrees + 2)
    forces, largest = facts[:, -count:], facts[:, first : first + count]
    return {name: FrictionForce(forces[:, k], largest[:, k]) for k, name in enumerate(modes.frictions)}
