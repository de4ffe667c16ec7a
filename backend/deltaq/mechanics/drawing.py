"""How a scene is drawn: a list of elements that hang on its points and bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from ..errors import Problem
from .checks import demand
from .reader import Reader

Vertical = Literal["up", "down"]

# Each kind of element, and the fields that say where it hangs.
ELEMENTS: dict[str, tuple[str, ...]] = {
    "angle": ("at",),
    "azimuth": ("at", "to"),
    "block": ("at",),
    "bob": ("at",),
    "cart": ("at",),
    "damper": ("from", "to"),
    "dimension": ("from", "to"),
    "disc": ("at",),
    "force": (),
    "ground": ("at",),
    "guide": ("at",),
    "hoop": ("at",),
    "moment": ("at",),
    "pivot": ("at",),
    "polar": ("from", "to"),
    "rod": ("from", "to"),
    "spring": ("from", "to"),
    "string": ("from", "to"),
    "top": ("from", "to"),
    "trail": ("at",),
    "wall": ("from", "to"),
    "weight": ("at",),
    "wheel": ("at", "from", "to"),
    "wire": ("at",),
}
TEXTS = ("load", "coordinate", "direction", "label")
SIZES = ("radius", "width", "height", "offset")  # a number, or the name of a parameter


@dataclass(frozen=True)
class Element:
    """One primitive: its kind, the places it hangs on, and its options."""

    kind: str
    places: tuple[tuple[str, str], ...] = ()
    options: tuple[tuple[str, str | float], ...] = ()

    def __post_init__(self) -> None:
        known = self.kind in ELEMENTS
        demand(None if known else Problem("unknown-kind", "/kind", parameters={"kind": self.kind[:40]}))

    @classmethod
    def read(cls, table: Reader) -> Element:
        """The element in a table; options that its kind does not have are left unread, which the reader notes."""
        kind = table.text("kind")
        places = tuple((key, table.place(key)) for key in ELEMENTS.get(kind, ()))
        texts = ((key, table.text(key)) for key in TEXTS if key in table.table)
        sizes = ((key, _size(table, key)) for key in SIZES if key in table.table)
        return cls(kind, places, (*texts, *sizes))

    def write(self) -> dict[str, object]:
        """The element as it stands in a document."""
        return {"kind": self.kind, **dict(self.places), **dict(self.options)}


def _size(table: Reader, key: str) -> str | float:
    return table.text(key) if isinstance(table.table[key], str) else table.number(key, 1.0)


@dataclass(frozen=True)
class Drawing:
    """`vertical` is where the second component grows on the screen; `view` is xmin, xmax, ymin, ymax."""

    vertical: Vertical = "up"
    view: tuple[float, ...] | None = None
    elements: tuple[Element, ...] = ()

    def __post_init__(self) -> None:
        demand(
            None if self.vertical in ("up", "down") else Problem("unknown-direction", "/vertical"),
            None if self._view_is_box() else Problem("invalid-view", "/view"),
        )

    @property
    def sizes(self) -> frozenset[str]:
        """The names of parameters that sizes are given by."""
        options = (option for element in self.elements for option in element.options)
        return frozenset(value for key, value in options if key in SIZES and isinstance(value, str))

    def _view_is_box(self) -> bool:
        if self.view is None:
            return True
        is_box = len(self.view) == 4 and self.view[0] < self.view[1] and self.view[2] < self.view[3]
        return is_box and all(map(math.isfinite, self.view))
