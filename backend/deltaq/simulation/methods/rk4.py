"""The classical Runge–Kutta method.

Order 4, four stages. Stability function R(z) = 1 + z + z²/2 + z³/6 + z⁴/24: stable on the imaginary axis up to
|z| ≤ 2√2, where it damps slightly, and on the real interval [−2.785, 0]. Not symplectic.
Source: W. Kutta, Z. Math. Phys. 46 (1901) 435–453.
"""

from __future__ import annotations

from ..method import Method, Tableau, row, rows

A = """
-
1/2
0 1/2
0 0 1
"""

METHOD = Method("rk4", order=4, scheme=Tableau(a=rows(A), b=row("1/6 1/3 1/3 1/6"), c=row("0 1/2 1/2 1")))
