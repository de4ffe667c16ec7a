"""Loads: what does work on a system. One kind, one file.

A kind is a frozen dataclass with a `kind`, a way to `read` it from its table and the `contributions` it comes down to.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Protocol, Self

from ...language.expression import Expression
from ..bodies import Body
from ..contributions import Contribution
from ..reader import Reader

Places = Mapping[str, tuple[Expression, ...]]


class Load(Protocol):
    """What every kind of load has."""

    kind: ClassVar[str]

    @classmethod
    def read(cls, table: Reader, /) -> Self:
        """The load in a table of a scene document; the reader collects what is wrong."""

    @property
    def name(self) -> str:
        """The name that drawings and arrows refer to."""

    def contributions(self, places: Places, bodies: tuple[Body, ...], /) -> tuple[Contribution, ...]:
        """What the load adds to virtual work: forces, moments, potentials, dissipation functions."""
