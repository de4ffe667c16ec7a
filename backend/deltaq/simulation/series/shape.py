"""Which numbers the code of a model's series reads and writes."""

from __future__ import annotations

from dataclasses import dataclass

from ...model.recurrences import Recurrences


@dataclass(frozen=True)
class Shape:
    """What a jet reads and writes, in numbers of `lanes` doubles.

    Given are the unit of time H, the state, t and the constants. A row of coefficients in that unit has the state, the
    arguments of conditions, and (in row 0 alone) the pivots with the diagonal entries that they are left of.
    """

    recurrences: Recurrences
    lanes: int = 1

    @property
    def width(self) -> int:
        """Of a state."""
        return 2 * self.recurrences.degrees + (self.recurrences.power is not None)

    @property
    def components(self) -> int:
        """Of a row of coefficients."""
        return self.width + len(self.recurrences.conditions) + 2 * len(self.recurrences.pivots)

    @property
    def first_pivot(self) -> int:
        """Where the pivots begin in a row of coefficients."""
        return self.width + len(self.recurrences.conditions)

    @property
    def first_constant(self) -> int:
        """Where the constants begin in what is given."""
        return self.width + 2
