"""Störmer–Verlet: half a kick, a drift, half a kick.

Order 2, two stages (Lobatto IIIA–IIIB); explicit where M is constant and forces depend on positions and time alone,
else the generalized scheme, implicit in the velocities. On the oscillator stable for ωh < 2, with stability matrix of
determinant 1 and trace 2 − (ωh)². It is symplectic and symmetric: energy stays within O(h²) for very long times.
Source: C. Störmer (1907), L. Verlet, Phys. Rev. 159 (1967) 98; Hairer, Lubich, Wanner, Acta Numerica 12 (2003) 399.
"""

from __future__ import annotations

from dataclasses import replace

from ..method import Method, discrete_action, row, rows

A = """
0 0
1/2 1/2
"""

SCHEME = replace(
    discrete_action(a=rows(A), b=row("1/2 1/2"), c=row("0 1")), kicks=row("1/2 1/2"), drifts=row("1 0")
)  # fmt: skip

METHOD = Method("stormer-verlet", order=2, scheme=SCHEME)
