"""Bodies: material with a position field. One kind, one file."""

from __future__ import annotations

from typing import ClassVar, Protocol, Self

from ...language.expression import Expression
from ..reader import Reader


class Body(Protocol):
    """What every kind of body has. `position` is the place that loads act at (the centre of mass)."""

    kind: ClassVar[str]

    @classmethod
    def read(cls, table: Reader, /) -> Self: ...

    @property
    def name(self) -> str: ...
    @property
    def mass(self) -> Expression: ...
    @property
    def position(self) -> tuple[Expression, ...]: ...
