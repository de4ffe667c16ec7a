"""Equations with their numbers disturbed far above rounding, to see what rounding does to a motion.

Every entry of M and f is computed with a relative error of about ε. Where M is ill-conditioned, or where a motion
multiplies errors, that may be far more in q. With each entry multiplied by 1 ± δ, δ ≫ ε, signs at random, the motion
moves by about δ/ε times as much.
Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.7 and ch. 10.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from random import Random

import symengine as se

from .equations import Equations
from .functions import Expr

SEED = 1


def disturbed(eqs: Equations, size: float) -> Equations:
    """The equations with every entry of M, f and Q times 1 ± size; E agrees with the new M."""
    factors = _factors(size)
    count = len(eqs.forcing)
    mass = [[se.Integer(0)] * count for _ in range(count)]
    kinetic = eqs.kinetic
    rates = [eqs.symbols.rates[name] for name in eqs.symbols.free]
    for i in range(count):
        for j in range(i + 1):
            change = next(factors) * eqs.mass_matrix[i][j]
            mass[i][j] = mass[j][i] = eqs.mass_matrix[i][j] + change
            kinetic += change * rates[i] * rates[j] / (2 if i == j else 1)
    return replace(
        eqs,
        mass_matrix=tuple(tuple(row) for row in mass),
        forcing=tuple(force + next(factors) * force for force in eqs.forcing),
        forces=tuple(force + next(factors) * force for force in eqs.forces),
        kinetic=kinetic,
    )


def _factors(size: float) -> Iterator[Expr]:
    source = Random(SEED)
    while True:
        yield se.RealDouble(source.choice((-size, size)))
