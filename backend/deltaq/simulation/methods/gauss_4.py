"""Gauss's method with two stages, in positions and momenta.

Order 4, two stages at the zeros of the Legendre polynomial. Stability function the (2,2) Padé approximation of e^z:
A-stable, |R| = 1 on the imaginary axis. It is symplectic and symmetric; keeps quadratic invariants.
Source: P. C. Hammer, J. W. Hollingsworth (1955); Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1, VI.4.
"""

from __future__ import annotations

from fractions import Fraction

from ..method import Method, Partitioned, root

Q, S = Fraction(1, 4), root(3) / 6
HALF = Fraction(1, 2)
A = ((Q, Q - S), (Q + S, Q))

METHOD = Method("gauss-4", order=4, scheme=Partitioned(a=A, b=(HALF, HALF), c=(HALF - S, HALF + S), momentum_a=A))
