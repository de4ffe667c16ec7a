"""Families of scenes: one scene for each value of a whole number. One family, one file.

A family is a frozen dataclass with an `id`, the `parameter` that counts, its bounds and default, and the `document`
of each member.
"""

from __future__ import annotations

from typing import ClassVar, Protocol


class Family(Protocol):
    """What every family has."""

    id: ClassVar[str]
    parameter: ClassVar[str]
    least: ClassVar[int]
    most: ClassVar[int]
    default: ClassVar[int]

    def document(self, size: int, /) -> dict[str, object]:
        """The scene document of the member of this size."""
