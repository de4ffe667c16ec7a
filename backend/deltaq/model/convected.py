"""What of d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ is left without accelerations.

For E = ½ Mⱼₖ(q) q̇ⱼ q̇ₖ over all that moves, the clock included (Lurie, Analytical Mechanics, ch. 4), it is

    bᵢ = Γᵢⱼₖ q̇ⱼ q̇ₖ,   Γᵢⱼₖ = ½ (∂Mᵢⱼ/∂qₖ + ∂Mᵢₖ/∂qⱼ − ∂Mⱼₖ/∂qᵢ)   (Christoffel's symbols of the first kind).

Written with these symbols, parts that cancel do so as expressions, and never reach the machine code.
"""

from __future__ import annotations

from collections.abc import Sequence

import symengine as se

from .functions import Expr
from .kinetic import ZERO, Vector
from .slopes import gradient


def convected(mass: Sequence[Vector], values: Vector, rates: Vector) -> Vector:
    """bᵢ for each coordinate, of the mass matrix of all that moves."""
    places = range(len(values))
    of_mass = [[gradient(mass[i][j], values) for j in range(i + 1)] for i in places]

    def slope(i: int, j: int, k: int) -> Expr:
        return of_mass[max(i, j)][min(i, j)][k]

    def square(i: int, j: int) -> Expr:
        """Γᵢⱼⱼ"""
        return slope(i, i, i) / 2 if i == j else slope(i, j, j) - slope(j, j, i) / 2

    def product(i: int, j: int, k: int) -> Expr:
        """2 Γᵢⱼₖ; where i is j or k, two of its parts are the same."""
        if i in (j, k):
            return slope(i, i, k if i == j else j)
        return slope(i, j, k) + slope(i, k, j) - slope(j, k, i)

    def along(i: int, j: int) -> Expr:
        """The factor of q̇ⱼ in bᵢ; products with later coordinates stand here twice, with earlier ones not at all."""
        return se.Add(square(i, j) * rates[j], *(product(i, j, k) * rates[k] for k in places[j + 1 :]))

    return tuple(se.Add(ZERO, *(rates[j] * along(i, j) for j in places)) for i in places)
