"""How much arithmetic a right-hand side is, counted in the expressions that become its machine code."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import symengine as se

from ..mechanics.scene import Scene
from .equations import equations
from .functions import Expr


@dataclass(frozen=True)
class Operations:
    """Additions, multiplications and divisions (powers too), calls of functions; `solving` of M q̈ = f comes to it.

    Solving takes n³/6 + 3n²/2 + n/3 multiplications and divisions and n³/6 + n² − 7n/6 additions (Cholesky's
    factors and two triangular systems; Golub, Van Loan, Matrix Computations, 4th ed., §4.2). Constraints ask for their
    responses M⁻¹Aᵀ, for AM⁻¹Aᵀ and its right-hand side, for λ and for what λ adds to q̈.
    """

    additions: int
    multiplications: int
    functions: int
    solving: int

    @property
    def total(self) -> int:
        """All operations of one right-hand side, solving included."""
        return self.additions + self.multiplications + self.functions + self.solving


def operations(scene: Scene) -> Operations:
    """The operations of one right-hand side, each common subexpression counted once."""
    eqs = equations(scene)
    triangle = [entry for i, row in enumerate(eqs.mass_matrix) for entry in row[: i + 1]]
    held = eqs.constraints
    rows = [entry for row in held.jacobian for entry in row]
    shared, rest = se.cse([*triangle, *eqs.forcing, *rows, *held.accelerations])
    kinds = [kind for each in (*(value for _, value in shared), *rest) for kind in _walk(se.sympify(each))]
    return Operations(
        kinds.count("+"),
        kinds.count("*"),
        kinds.count("f"),
        _solving(len(eqs.forcing)) + _keeping(len(eqs.forcing), len(held.names)),
    )


def _walk(expression: Expr) -> Iterator[str]:
    """One letter for each operation: a sum of n terms is n − 1 additions, a power counts as one multiplication."""
    parts = expression.args
    if expression.is_Add or expression.is_Mul:
        yield from ("+" if expression.is_Add else "*" for _ in parts[1:])
    elif expression.is_Pow:
        yield "*"
    elif parts:
        yield "f"
    for part in parts:
        yield from _walk(part)


def _solving(n: int) -> int:
    return (n**3 + 9 * n**2 + 2 * n) // 6 + (n**3 + 6 * n**2 - 7 * n) // 6


def _keeping(n: int, m: int) -> int:
    """m responses at 2n² − n each, m(m + 1)/2 + m inner products at 2n − 1 each, a system of m, and 2mn for q̈."""
    products = m * (m + 1) // 2 + m
    return m * (2 * n**2 - n) + products * (2 * n - 1) + _solving(m) + 2 * m * n
