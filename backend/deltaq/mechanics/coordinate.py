"""Generalized coordinates, with initial values and ranges."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import Problem
from .checks import demand, latex_problem, name_problem, range_problems

LARGEST = 1e15  # of initial values: no motion is followed beyond


@dataclass(frozen=True)
class Coordinate:
    """Generalized coordinate q(t), with its initial value and rate.

    `latex` is the symbol to print ("" lets the name make it); `min` and `max` bound the slider of the initial value.
    """

    name: str
    latex: str = ""
    unit: str = ""
    value: float = 0.0
    rate: float = 0.0
    min: float | None = None
    max: float | None = None

    def __post_init__(self) -> None:
        rate = None if math.isfinite(self.rate) else Problem("not-finite", "/rate")
        demand(
            name_problem(self.name), latex_problem(self.latex), rate, *range_problems(self.value, self.min, self.max)
        )
        demand(*self._too_large())

    def _too_large(self) -> Iterator[Problem]:
        for key, number in (("/value", self.value), ("/rate", self.rate)):
            if abs(number) > LARGEST:
                yield too_large(number, key)


def too_large(number: float, pointer: str) -> Problem:
    """That a motion cannot begin with such a value or rate."""
    return Problem("initial-too-large", pointer, parameters={"value": number, "most": LARGEST})
