"""Cyclic coordinates removed by Routh's reduction: exact, with fewer degrees of freedom.

Their momenta p are constants, given by the initial values; an effective potential ½ pᵀ M_c⁻¹ p takes their place. The
way back is q̇_c = M_c⁻¹ (p − M_cn q̇ₙ), integrated over time. A scene that moves uniformly is reduced where it rests.
Source: Routh (1877); Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.3; Lurie, Analytical Mechanics, §7.16.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from ....language.names import Symbol
from ....mechanics.changes import change
from ....mechanics.coordinate import Coordinate
from ....mechanics.event import Event
from ....mechanics.loads.potential import Potential
from ....mechanics.parameter import Parameter
from ....mechanics.scene import Scene
from ....model.cyclic import cyclic_coordinates
from ....model.elimination import eliminated
from ....model.routh import reduction
from ....simulation.problem import Floats
from ..findings import Part
from ..momenta import Conserved
from ..names import fresh, tidied, with_parameters
from ..quadrature import running_integral
from ..rest_frame import in_rest_frame
from ..simplification import Back, Kind, Motion, SimplificationContext, Simplified


def _offered(context: SimplificationContext) -> Iterator[Part]:
    names = cyclic_coordinates(in_rest_frame(context.scene))
    if 0 < len(names) < len(context.scene.free):
        yield Part("cyclic", {"coordinate": ", ".join(names)})


def _simplify(context: SimplificationContext, _part: Part) -> Simplified:
    scene = in_rest_frame(context.scene)
    conserved = Conserved.of(scene)
    coordinates = tuple(each for each in scene.free if each.name in conserved.names)
    momenta = {each.name: fresh(scene, f"p_{each.name}") for each in coordinates}
    starts = {each.name: fresh(scene, f"{each.name}_0") for each in coordinates}
    values = zip(coordinates, conserved.values.tolist(), strict=True)
    constants = tuple(_momentum(each, momenta[each.name], value) for each, value in values)
    held = tuple(Parameter(starts[c.name], unit=c.unit, value=c.value, positive=False) for c in coordinates)
    found = reduction(with_parameters(scene, constants + held), momenta, starts)
    wider = with_parameters(replace(scene, events=_events(scene, conserved)), constants)
    potentials = (Potential(_load_name(scene), found.potential),) if found.potential else ()
    with_potential = replace(wider, loads=(*wider.loads, *potentials))
    if not found.values:
        return Simplified(tidied(change(with_potential, freeze=tuple(momenta)), scene.labels), _back(scene, conserved))
    reduced = with_parameters(with_potential, held)
    for name, value in found.values.items():
        reduced = eliminated(reduced, name, value)
    return Simplified(tidied(reduced, scene.labels), _back(scene, conserved))


def _events(scene: Scene, conserved: Conserved) -> tuple[Event, ...]:
    """Those that can still be told: of the cyclic rates nothing is known while the reduced scene moves."""
    return tuple(event for event in scene.events if not event.value.rates & set(conserved.names))


def _momentum(coordinate: Coordinate, name: str, value: float) -> Parameter:
    """p as a parameter; its unit is that of an action over that of the coordinate."""
    typeset = Symbol(coordinate.name, "coordinate", coordinate.latex).typeset
    return Parameter(name, f"p_{{{typeset}}}", f"J s/({coordinate.unit or '1'})", value, positive=False)


def _load_name(scene: Scene) -> str:
    taken = {load.name for load in scene.loads}
    return next(
        name for k in range(len(taken) + 1) if (name := f"centrifugal_{k}" if k else "centrifugal") not in taken
    )


def _back(scene: Scene, conserved: Conserved) -> Back:
    """The cyclic coordinates by integrating their rates, which the momenta give."""
    starts = {each.name: each.value for each in scene.free}

    def back(motion: Motion) -> Motion:
        def column(found: Mapping[str, Floats], name: str) -> Floats:
            return np.zeros(len(motion.times)) if name in conserved.names else found[name]

        values = np.column_stack([column(motion.values, name) for name in starts])
        rates = np.column_stack([column(motion.rates, name) for name in starts])
        all_rates = conserved.rates(motion.times, np.hstack([values, rates]))
        own = {name: all_rates[:, place] for name, place in zip(conserved.names, conserved.places, strict=True)}
        step = float(motion.times[-1] - motion.times[0]) / max(1, len(motion.times) - 1)
        turned = {name: starts[name] + running_integral(rate, step) for name, rate in own.items()}
        return Motion(motion.times, {**motion.values, **turned}, {**motion.rates, **own})

    return back


KIND = Kind("cyclic", _offered, _simplify, ("linearized",))
