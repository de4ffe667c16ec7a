"""A coordinate held at its initial value: q := q₀. One degree of freedom less, and no forces along it.

Source: the guides of the lecture; Lurie, Analytical Mechanics, ch. 4 (constraints that hold a coordinate).
"""

from __future__ import annotations

from collections.abc import Iterator

from ....mechanics.changes import change
from ..findings import Part
from ..footing import Footing, Kind, Simplified


def _offered(footing: Footing) -> Iterator[Part]:
    free = footing.scene.free
    yield from (Part("frozen", {"coordinate": each.name}) for each in free if len(free) > 1)


def _simplify(footing: Footing, part: Part) -> Simplified:
    return Simplified(change(footing.scene, freeze=(part.parameters["coordinate"],)))


KIND = Kind("frozen", _offered, _simplify)
