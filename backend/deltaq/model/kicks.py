"""A correction of the stage of an implicit method on constraints, in symbols.

A method of one stage seeks the velocities V and the kick ν at the start of a step from q₀ with momenta p₀, such that

    p(Q, V) = p₀ − A(q₀)ᵀν + hâ r(Q, V),   Q = q₀ + ha V,   g(q₀ + hV) = 0.

With the inverse of Newton's matrix, W⁻¹, a correction solves for both: δV = W⁻¹(ρ − A(q₀)ᵀδν) with the residual ρ, and
δν such that g(q₁) + hA(q₁)δV = 0.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., VII.1.4.
"""

from __future__ import annotations

from dataclasses import dataclass

import symengine as se

from .compiled import THOROUGH, Compiled, compile_expressions
from .equations import Equations
from .functions import Expr
from .kinetic import ZERO, Vector
from .phase import momenta_and_rates
from .solved import SMALL, Table, along, determinant, dot

MOST = 10  # coordinates; the numbers of W⁻¹ grow with their square


@dataclass(frozen=True)
class KickPlaces:
    """Where numbers stand behind the inputs q₀, V, t + hc and the parameters, with n coordinates and m constraints.

    h, ha, hâ and t + h, then p₀, A(q₀) by rows and W⁻¹ by rows: `size` numbers in all. What is told is δV, p₀ with the
    kick, Q and r, and, to say whether δν has a value, a determinant and what it is small beside: `told` numbers.
    """

    n: int
    m: int

    @property
    def momenta(self) -> int:
        """Where p₀ begins."""
        return 4

    @property
    def before(self) -> int:
        """Where A(q₀) begins."""
        return self.momenta + self.n

    @property
    def inverse(self) -> int:
        """Where W⁻¹ begins."""
        return self.before + self.m * self.n

    @property
    def size(self) -> int:
        return self.inverse + self.n * self.n

    @property
    def told(self) -> int:
        return 4 * self.n + 2


def compiled_kicks(eqs: Equations) -> Compiled | None:
    """A correction as machine code for a model with holonomic constraints; None where that would be long."""
    n, m = len(eqs.forcing), len(eqs.constraints.slips)
    if not 0 < m <= SMALL or len(eqs.constraints.gaps) != m or n > MOST:
        return None
    places = KickPlaces(n, m)
    extra = [se.Symbol(f"kicks {k}") for k in range(places.size)]
    return compile_expressions([*eqs.symbols.inputs, *extra], correction(eqs, places, extra), THOROUGH)


def correction(eqs: Equations, places: KickPlaces, extra: list[Expr]) -> list[Expr]:
    """What `compiled_kicks` says."""
    n, m, symbols, held = places.n, places.m, eqs.symbols, eqs.constraints
    h, reach, of_rates, end = extra[: places.momenta]
    before = _rows(extra[places.before :], m, n)
    inverse = _rows(extra[places.inverse :], n, n)
    values = [symbols.values[name] for name in symbols.free]
    rates = [symbols.rates[name] for name in symbols.free]
    stage = dict(zip(values, _moved(values, reach, rates), strict=True))
    momenta, forces = (tuple(part.subs(stage) for part in parts) for parts in momenta_and_rates(eqs))
    residual = [
        start - own + of_rates * force
        for start, own, force in zip(extra[places.momenta : places.before], momenta, forces, strict=True)
    ]
    there = {**dict(zip(values, _moved(values, h, rates), strict=True)), symbols.time: end}
    rows = tuple(tuple(entry.subs(there) for entry in row) for row in held.jacobian)
    free = tuple(dot(row, residual) for row in inverse)
    responses = tuple(tuple(dot(row, push) for row in inverse) for push in before)
    crossed = tuple(tuple(dot(row, each) for each in responses) for row in rows)
    missed = tuple(gap.subs(there) / h + dot(row, free) for gap, row in zip(held.gaps, rows, strict=True))
    kick = cramer(crossed, missed)
    pushed = along(before, kick)
    size = ZERO + 1
    for k in range(m):
        size *= crossed[k][k]
    return [
        *(a - b for a, b in zip(free, along(responses, kick), strict=True)),
        *(a - b for a, b in zip(extra[places.momenta : places.before], pushed, strict=True)),
        *stage.values(),
        *forces,
        determinant(crossed),
        size,
    ]


def cramer(table: Table, right: Vector) -> Vector:
    """The solution of a small linear system by determinants: one division, for which nothing waits."""
    inverse = 1 / determinant(table)
    exchanged = (
        tuple((*row[:k], part, *row[k + 1 :]) for row, part in zip(table, right, strict=True))
        for k in range(len(table))
    )
    return tuple(determinant(each) * inverse for each in exchanged)


def _moved(values: list[Expr], seconds: Expr, rates: list[Expr]) -> Vector:
    return tuple(value + seconds * rate for value, rate in zip(values, rates, strict=True))


def _rows(numbers: list[Expr], count: int, n: int) -> Table:
    return tuple(tuple(numbers[k * n : (k + 1) * n]) for k in range(count))
