"""Explicit Euler: the tangent, followed for one step.

Order 1, one stage. Stability function R(z) = 1 + z, stable for |1 + z| ≤ 1: never on the imaginary axis, so every
undamped oscillation grows, by the factor √(1 + (ωh)²) per step. Not symplectic.
Source: L. Euler, Institutionum calculi integralis I (1768), §650; Hairer, Nørsett, Wanner I, I.7.
"""

from __future__ import annotations

from ..method import Method, Tableau, row, rows

METHOD = Method("explicit-euler", order=1, scheme=Tableau(a=rows("-"), b=row("1"), c=row("0")))
