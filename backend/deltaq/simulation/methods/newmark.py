"""Newmark's method with average acceleration (β = 1/4, γ = 1/2): the usual choice in structural dynamics.

Order 2, one stage, implicit in the accelerations at the end of the step; q and q̇ by the trapezoidal rule, which is
generalized-α without numerical damping (ρ∞ = 1). Stability function R(z) = (1 + z/2)/(1 − z/2): A-stable, no damping of
vibrations. Symmetric. Not symplectic, but conjugate to the implicit midpoint rule where M is constant.
Source: N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67–94; Hughes, The Finite Element Method, ch. 9.
"""

from __future__ import annotations

from fractions import Fraction

from ..method import Method, Newmark

METHOD = Method("newmark", order=2, scheme=Newmark(beta=Fraction(1, 4), gamma=Fraction(1, 2)))
