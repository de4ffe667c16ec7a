"""How the numbers of an answer are written: as JSON numbers, or packed, for programs that read many.

Packed, an array is the base64 of its doubles in little-endian order, a vector's components side by side.
"""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from types import MappingProxyType

from .problem import Floats

Column = list[float] | str


def as_numbers(values: Floats) -> Column:
    """A list of the values of shape (samples,), or a list of rows of those of shape (samples, dimension)."""
    found: list[float] = values.tolist()
    return found


def packed(values: Floats) -> Column:
    """Base64 of the doubles, row by row; `values` may have any shape (samples, …)."""
    return base64.b64encode(values.astype("<f8").tobytes()).decode("ascii")


WRITERS: Mapping[str, Callable[[Floats], Column]] = MappingProxyType({"numbers": as_numbers, "base64": packed})
