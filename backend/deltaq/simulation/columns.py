"""How the numbers of an answer are written: as JSON numbers, or packed, for programs that read many.

Packed, an array is the base64 of its doubles in little-endian order, a vector's components side by side. In planes, all
first bytes of these doubles come first, then all second ones, and so on: bytes of one kind are alike, so that they take
less room and time to compress. Numbers are as short as their errors allow, with few decimals or, in planes, few bits.
"""

from __future__ import annotations

import base64
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from .problem import Floats
from .rounding import rounded, rounded_to_bits

Column: TypeAlias = list[float] | list[float | None] | str


@dataclass(frozen=True)
class Writer:
    """A way to write numbers: `write` makes a column of values of shape (samples,) or (samples, dimension).

    `shorten` rounds values of shape (samples, …) before, by errors of shape (samples,).
    """

    write: Callable[[Floats], Column]
    shorten: Callable[[Floats, Floats], Floats] = rounded


def as_numbers(values: Floats) -> Column:
    """A list of the values of shape (samples,), or a list of rows of those of shape (samples, dimension).

    What is not a number in a column is None. Of what rests, as most points of a drawing do, one row stands for all: to
    make many of them takes long.
    """
    first: list[float] = values[:1].tolist()
    if first and (values == values[0]).all():
        return first * len(values)
    found: list[float] = values.tolist()
    if values.ndim == 1 and np.isnan(values).any():
        return [None if math.isnan(each) else each for each in found]
    return found


def packed(values: Floats) -> Column:
    """Base64 of the doubles, row by row; `values` may have any shape (samples, …)."""
    return base64.b64encode(values.astype("<f8").tobytes()).decode("ascii")


def in_planes(values: Floats) -> Column:
    """Base64 of the doubles' bytes, plane by plane; `values` may have any shape (samples, …)."""
    planes = np.ascontiguousarray(values, dtype="<f8").reshape(-1, 1).view(np.uint8).T
    return base64.b64encode(planes.tobytes()).decode("ascii")


WRITERS: Mapping[str, Writer] = MappingProxyType(
    {"numbers": Writer(as_numbers), "base64": Writer(packed), "planes": Writer(in_planes, rounded_to_bits)}
)
