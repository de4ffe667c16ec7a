"""What the numbers of a model's inputs and outputs are."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Layout:
    """What the numbers of a model's inputs and outputs are.

    Inputs of both functions: q, q̇ (of the free coordinates), t, parameters.
    """

    free: tuple[str, ...]
    guided: tuple[str, ...]
    parameters: tuple[str, ...]
    places: tuple[str, ...]
    arrows: tuple[str, ...]
    dimension: int
    is_powered: bool
    switches: tuple[str, ...] = ()  # whose rates the switching functions are made of, by function
    multipliers: tuple[str, ...] = ()  # by constraint, the holonomic ones first
    holonomic: int = 0  # how many of the constraints are
    constraints: tuple[int, ...] = ()  # their places in the scene

    @property
    def degrees(self) -> int:
        """The number of free coordinates n; where there are constraints, fewer of them are independent."""
        return len(self.free)

    @property
    def is_holonomic(self) -> bool:
        """Whether all constraints are equations between positions; so it is without any."""
        return self.holonomic == len(self.multipliers)
