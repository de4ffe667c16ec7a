"""Heun: the mean of the slopes at both ends of the step.

Order 2, two stages. Stability function R(z) = 1 + z + z²/2: on the imaginary axis |R(iy)|² = 1 + y⁴/4 > 1, so an
undamped oscillation grows, but slowly. Real interval of stability [−2, 0]. Not symplectic.
Source: K. Heun, Z. Math. Phys. 45 (1900) 23–38.
"""

from __future__ import annotations

from ..method import Method, Tableau, row, rows

A = """
-
1
"""

METHOD = Method("heun", order=2, scheme=Tableau(a=rows(A), b=row("1/2 1/2"), c=row("0 1")))
