"""Which reading is taken where usage is divided.

Scenes are read strictly: `1/2 m` is an error that shows both readings. Answers of people are read with `Choices`: at
each such place the first reading is the conventional one, and the others are there to be asked for by their place.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass
class Choices:
    """`taken`: by place in the text the number of the reading wanted there, 0 where none is named.

    `met` fills while a text is read: by place how many readings there are, and from which one on they were typed so
    loosely that only dimensions can speak for them.
    """

    taken: Mapping[int, int] = field(default_factory=dict)
    met: dict[int, tuple[int, int]] = field(default_factory=dict)

    def at(self, place: int, readings: int, loose: int) -> int:
        """The number of the reading to take at a place that has so many, those from `loose` on being loose."""
        self.met[place] = (readings, loose)
        return min(self.taken.get(place, 0), readings - 1)
