"""Radau IIA with three stages, with step control: for stiff scenes.

Order 5, three stages, the last one at the end of the step. Stability function the (2,3) Padé approximation of e^z:
A-stable and R(∞) = 0 (L-stable), so stiff parts die out as they should. Embedded estimate of order 3, filtered by
(1 − hγ₀J)⁻¹. Samples from the collocation polynomial, of order 3 inside a step. Not symplectic: it damps.
Source: B. L. Ehle (1969); Hairer, Wanner, Solving Ordinary Differential Equations II, IV.5, IV.8.
"""

from __future__ import annotations

from fractions import Fraction

from ..method import Method, Partitioned, root

F, R = Fraction, root(6)
A = (
    ((88 - 7 * R) / 360, (296 - 169 * R) / 1800, (-2 + 3 * R) / 225),
    ((296 + 169 * R) / 1800, (88 + 7 * R) / 360, (-2 - 3 * R) / 225),
    ((16 - R) / 36, (16 + R) / 36, F(1, 9)),
)
C = ((4 - R) / 10, (4 + R) / 10, F(1))
GAMMA = F("0.27488882959230820")  # the real eigenvalue of A
ERROR = (GAMMA, GAMMA / 3 * (-13 - 7 * R), GAMMA / 3 * (-13 + 7 * R), -GAMMA / 3)

METHOD = Method(
    "radau-5", order=5, scheme=Partitioned(a=A, b=A[2], c=C, momentum_a=A, error=ERROR), error_order=4
)  # fmt: skip
