"""The implicit midpoint rule in positions and momenta: Gauss's method with one stage.

Order 2, one stage. Stability function R(z) = (1 + z/2)/(1 − z/2): A-stable, |R| = 1 on the imaginary axis, and
R → −1 for very stiff parts, which ring instead of dying out. It is symplectic and symmetric, and
keeps quadratic invariants.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1, VI.4.
"""

from __future__ import annotations

from ..method import Method, Partitioned, row, rows

HALF = rows("1/2")

METHOD = Method("implicit-midpoint", order=2, scheme=Partitioned(a=HALF, b=row("1"), c=row("1/2"), momentum_a=HALF))
