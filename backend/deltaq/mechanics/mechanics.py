"""What the equations of a scene depend on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Mechanics:
    """All of a scene that its equations depend on: the same of scenes that differ in numbers and titles alone.

    Numbers count as far as they tell which parameters are positive, and which constraints follow from others.
    """

    content: tuple[object, ...]

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """Once, for the many expressions take long."""
        return hash(self.content)

    def __getstate__(self) -> dict[str, object]:
        """Without the hash, for that of a name is another one in each process."""
        return {"content": self.content}
