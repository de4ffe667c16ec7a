"""Parameters: the constants of a scene."""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import Problem
from .checks import demand, latex_problem, name_problem, range_problems


@dataclass(frozen=True)
class Parameter:
    """Constant of a scene (m, l, g, k, ω …) with its value and the range of its slider.

    `positive` says that only values above zero make sense; laws may then divide by it and take its root.
    """

    name: str
    latex: str = ""
    unit: str = ""
    value: float = 1.0
    min: float | None = None
    max: float | None = None
    positive: bool = True

    def __post_init__(self) -> None:
        demand(
            name_problem(self.name),
            latex_problem(self.latex),
            *range_problems(self.value, self.min, self.max),
            self._sign_problem(),
        )

    def _sign_problem(self) -> Problem | None:
        if self.positive and self.value <= 0:
            return Problem("not-positive", "/value", parameters={"name": self.name, "value": self.value})
        return None
