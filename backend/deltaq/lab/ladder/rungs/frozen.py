"""A coordinate held at its initial value: q := q₀. One degree of freedom less, and no forces along it.

Source: the guides of the lecture; Lurie, Analytical Mechanics, ch. 4 (constraints that hold a coordinate).
"""

from __future__ import annotations

from collections.abc import Iterator

from ....mechanics.changes import change
from ..findings import Part
from ..simplification import Kind, SimplificationContext, Simplified


def _offered(context: SimplificationContext) -> Iterator[Part]:
    free = context.scene.free
    yield from (Part("frozen", {"coordinate": each.name}) for each in free if len(free) > 1)


def _simplify(context: SimplificationContext, part: Part) -> Simplified:
    return Simplified(change(context.scene, freeze=(part.parameters["coordinate"],)))


KIND = Kind("frozen", _offered, _simplify)
