"""The variational integrator of the midpoint Lagrangian: the discrete action Σ h L((q₀+q₁)/2, (q₁−q₀)/h) is stationary.

Order 2, one stage. The discrete Euler–Lagrange equations D₂L_d(qₖ₋₁, qₖ) + D₁L_d(qₖ, qₖ₊₁) + F⁺ + F⁻ = 0 carry forces
without potential by their discrete virtual work, F± = h/2 Q at the midpoint. In momenta p₀ = −D₁L_d − F⁻,
p₁ = D₂L_d + F⁺ they are the implicit midpoint rule, as theory says, so the two methods give the same motion.
Stability function R(z) = (1 + z/2)/(1 − z/2), A-stable. It is symplectic and symmetric; it keeps the
momenta of all symmetries (discrete Noether theorem).
Source: J. E. Marsden, M. West, Discrete mechanics and variational integrators, Acta Numerica 10 (2001) 357–514.
"""

from __future__ import annotations

from ..method import Method, discrete_action, row, rows

METHOD = Method(
    "variational-midpoint", order=2, scheme=discrete_action(a=rows("1/2"), b=row("1"), c=row("1/2"))
)  # fmt: skip
