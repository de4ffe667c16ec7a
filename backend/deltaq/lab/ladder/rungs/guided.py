"""A coordinate that runs evenly: q := q₀ + q̇₀ t, as a motor would keep it.

What was to be kept up by itself now costs power: the guide feeds in or takes what the other coordinates exchange.
Source: the guides of the lecture; Lurie, Analytical Mechanics, ch. 4.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ....language.parser import parse
from ....mechanics.guide import Guide
from ....mechanics.parameter import Parameter
from ..findings import Part
from ..names import fresh, with_parameters
from ..simplification import Kind, SimplificationContext, Simplified


def _offered(context: SimplificationContext) -> Iterator[Part]:
    free = context.scene.free
    yield from (Part("guided", {"coordinate": each.name}) for each in free if len(free) > 1 and each.rate != 0.0)


def _simplify(context: SimplificationContext, part: Part) -> Simplified:
    scene, name = context.scene, part.parameters["coordinate"]
    coordinate = next(each for each in scene.free if each.name == name)
    start, speed = fresh(scene, f"{name}_0"), fresh(scene, f"rate_{name}")
    unit = f"{coordinate.unit}/s" if coordinate.unit else ""
    constants = (
        Parameter(start, unit=coordinate.unit, value=coordinate.value, positive=False),
        Parameter(speed, unit=unit, value=coordinate.rate, positive=False),
    )
    wider = with_parameters(scene, constants)
    guide = Guide(name, parse(f"{start} + {speed}*t", wider.names))
    return Simplified(replace(wider, guides=(*wider.guides, guide)))


KIND = Kind("guided", _offered, _simplify)
