"""The linearized equation is given where the full one is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...language.canonical import display
from .._trigonometry import waves
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class EquationLinearized(Detour):
    """The small-angle form is the one remembered from school."""

    id: ClassVar[str] = "equation-linearized"
    likely: ClassVar[int] = 2

    def equation(self, coordinate: str) -> sp.Expr:
        right = display(super().equation(coordinate), self.symbols)
        return right.xreplace({f: f.args[0] if isinstance(f, sp.sin) else sp.Integer(1) for f in waves(right, self)})

    def linear_equation(self, coordinate: str) -> sp.Expr:
        return self.true.linear_equation(coordinate)
