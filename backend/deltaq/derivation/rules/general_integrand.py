"""The integrand as kinetic energy: ∂r/∂qᵢ · dv/dt = d/dt ∂/∂q̇ᵢ (v · v/2) − ∂/∂qᵢ (v · v/2).

The three rules before, put together; then ∂/∂q̇ (v · v/2) = ∂v/∂q̇ · v, and likewise for q.
Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4.
"""

from __future__ import annotations

from ..abstract_motion import AbstractMotion, q, rate
from ..formula import Dot, Formula, Partial, Plus, Rate, Term, minus
from ..step import Step
from ._general import acceleration, for_each, half_square, lagrange_expression, lever, velocity

RULE = "general-integrand"


def apply(motion: AbstractMotion) -> Step:
    line = for_each(
        lambda i: Dot(lever(motion, i), acceleration(motion)),
        lambda i: _by_velocities(motion, i),
        lambda i: lagrange_expression(half_square(motion), i),
    )
    return Step(RULE, "", (line,))


def _by_velocities(motion: AbstractMotion, index: str) -> Formula:
    """d/dt (∂v/∂q̇ᵢ · v) − ∂v/∂qᵢ · v"""
    v = velocity(motion)
    first = Rate(Dot(Partial(v, rate(index)), v))
    return Plus((Term(first), minus(Dot(Partial(v, q(index)), v))))
