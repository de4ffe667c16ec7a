"""Symplectic Euler: the new momenta from the old positions, then the new positions from the new momenta.

Order 1, one stage; explicit where M is constant and forces depend on positions and time alone, else implicit in the
velocities. On the oscillator stable for ωh < 2, with stability matrix of determinant 1. It is symplectic (the
variational integrator of L_d = h L(q₀, (q₁ − q₀)/h)), not symmetric: energy stays within O(h) for very long times.
Source: R. de Vogelaere (1956); Hairer, Lubich, Wanner, Geometric Numerical Integration, I.1.2, VI.3.
"""

from __future__ import annotations

from dataclasses import replace

from ..method import Method, discrete_action, row, rows

SCHEME = replace(discrete_action(a=rows("0"), b=row("1"), c=row("0")), kicks=row("1"), drifts=row("1"))

METHOD = Method("symplectic-euler", order=1, scheme=SCHEME)
