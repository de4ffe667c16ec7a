"""Bogacki–Shampine 3(2): for low accuracy.

Order 3 with an embedded order 2 for the step size, three stages and the slope at the end, which the next step reuses.
Stability function R(z) = 1 + z + z²/2 + z³/6: stable on the imaginary axis up to |z| ≤ √3, real interval
[−2.513, 0]. Continuous extension: cubic Hermite. Not symplectic.
Source: P. Bogacki, L. F. Shampine, Appl. Math. Lett. 2 (1989) 321–325.
"""

from __future__ import annotations

from ..method import Method, Tableau, row, rows

A = """
-
1/2
0 3/4
"""

METHOD = Method(
    "bogacki-shampine-32",
    order=3,
    scheme=Tableau(
        a=rows(A),
        b=row("2/9 1/3 4/9"),
        c=row("0 1/2 3/4"),
        error=rows("-5/72 1/12 1/9 -1/8"),
    ),
    error_order=3,
    memory=0.04,
)
