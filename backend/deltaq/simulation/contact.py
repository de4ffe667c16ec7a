"""The forces of contacts along a motion: λ ≥ 0 along ∂g/∂q while g = 0 is kept, 0 while the contact is open.

Of a taut string λ is its tension where the gap is the length that is left of it; impulses of impacts are not in it.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..model.modes import Modes
from .problem import Floats, Stretch, inputs_of_stretches


def contacts_along(modes: Modes, times: Floats, states: Floats, stretches: tuple[Stretch, ...]) -> Mapping[str, Floats]:
    """By event, the force of a contact at each state in the mode of its stretch, shape (samples,).

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    if not stretches or not modes.contacts:
        return {}
    inputs, bounded = inputs_of_stretches(times, states, stretches), modes.bounded
    reactions = modes.facts.table(inputs)[:, modes.single_facts[-1]]
    flags = inputs[:, -(modes.rows + modes.watched) : -modes.watched]
    acting = np.where(flags > 0.0, reactions, 0.0)
    names = (modes.scene.events[index].name for index in modes.contacts)
    return {name: acting[:, bounded + j] for j, name in enumerate(names)}
