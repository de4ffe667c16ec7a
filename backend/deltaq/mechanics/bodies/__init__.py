"""Bodies: material with a position field. One kind, one file.

A kind is a frozen dataclass with a `kind`, a way to `read` it from its table, the `kinetics` that its kinetic energy
comes down to, and its `weight` in a field of gravity.
"""

from __future__ import annotations

from typing import ClassVar, Protocol, Self

from ...language.expression import Expression
from ..contributions import DistributedForce, PointForce
from ..kinetics import Kinetics
from ..material import Material
from ..reader import Reader


class Body(Protocol):
    """What every kind of body has. Without material coordinates its position is a place (the centre of mass)."""

    kind: ClassVar[str]

    @classmethod
    def read(cls, table: Reader, /) -> Self:
        """The body in a table of a scene document; the reader collects what is wrong."""

    @property
    def name(self) -> str:
        """The name that loads and drawings refer to."""

    @property
    def position(self) -> tuple[Expression, ...]:
        """r(q, t), of a continuum also of its material coordinates."""

    @property
    def material(self) -> tuple[Material, ...]:
        """The material coordinates of a continuum; none of others."""

    @property
    def kinetics(self) -> tuple[Kinetics, ...]:
        """What the kinetic energy is made of."""

    def weight(self, source: str, acceleration: tuple[Expression, ...], /) -> PointForce | DistributedForce:
        """The force of gravity on the body, with the load `source` that it belongs to."""
