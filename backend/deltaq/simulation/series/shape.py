"""Which numbers the code of a model's series reads and writes."""

from __future__ import annotations

from dataclasses import dataclass

from ...model.recurrences import Recurrences


@dataclass(frozen=True)
class Shape:
    """What a jet reads and writes, in numbers of `lanes` doubles; models of one shape take their steps by one code.

    Given are the unit of time H, the state, t and the constants. A row of coefficients in that unit has the state, the
    arguments of conditions, and (in row 0 alone) the pivots with the diagonal entries that they are left of.
    """

    degrees: int
    width: int  # of a state
    conditions: int
    pivots: int
    constants: int
    lanes: int = 1

    @classmethod
    def of(cls, recurrences: Recurrences, lanes: int = 1) -> Shape:
        """That of some recurrences."""
        width = 2 * recurrences.degrees + (recurrences.power is not None)
        conditions, pivots = len(recurrences.conditions), len(recurrences.pivots)
        return cls(recurrences.degrees, width, conditions, pivots, len(recurrences.kept), lanes)

    @property
    def components(self) -> int:
        """Of a row of coefficients."""
        return self.first_pivot + 2 * self.pivots

    @property
    def first_pivot(self) -> int:
        """Where the pivots begin in a row of coefficients."""
        return self.width + self.conditions

    @property
    def first_constant(self) -> int:
        """Where the constants begin in what is given."""
        return self.width + 2
