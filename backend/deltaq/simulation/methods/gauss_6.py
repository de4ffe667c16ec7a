"""Gauss's method with three stages, in positions and momenta.

Order 6, three stages at the zeros of the Legendre polynomial. Stability function the (3,3) Padé approximation of e^z:
A-stable, |R| = 1 on the imaginary axis. It is symplectic and symmetric; keeps quadratic invariants.
Source: J. Kuntzmann (1961), J. C. Butcher (1964); Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1, VI.4.
"""

from __future__ import annotations

from fractions import Fraction

from ..method import Method, Partitioned, root

F, R = Fraction, root(15)
A = (
    (F(5, 36), F(2, 9) - R / 15, F(5, 36) - R / 30),
    (F(5, 36) + R / 24, F(2, 9), F(5, 36) - R / 24),
    (F(5, 36) + R / 30, F(2, 9) + R / 15, F(5, 36)),
)
B = (F(5, 18), F(4, 9), F(5, 18))
C = (F(1, 2) - R / 10, F(1, 2), F(1, 2) + R / 10)

METHOD = Method("gauss-6", order=6, scheme=Partitioned(a=A, b=B, c=C, momentum_a=A))
