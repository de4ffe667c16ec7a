"""The position is linearized before the energies are formed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from .._trigonometry import waves
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class LinearizedTooEarly(Detour):
    """sin φ ≈ φ and cos φ ≈ 1 are put in at once; the potential needs the second order: its force is lost."""

    id: ClassVar[str] = "linearized-too-early"
    likely: ClassVar[int] = 2

    def position(self, place: str) -> sp.ImmutableMatrix:
        small = {f: f.args[0] if isinstance(f, sp.sin) else sp.Integer(1) for f in waves(super().position(place), self)}
        return super().position(place).xreplace(small)
