"""A step of RATTLE in symbols: what pushes along the constraints do to positions, and what rates lose at its end.

M is constant and forces depend on q and t alone. With R = A M⁻¹ and S = A M⁻¹Aᵀ where a drift begins, a correction of
positions behind it is q − Rᵀμ, μ = S⁻¹g(q); with those where it ends the rates v become v + κa − RᵀS⁻¹(A(v + κa) + b),
where a = M⁻¹f, and κ is how many seconds the kick there lasts.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., VII.1.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import symengine as se

from .compiled import THOROUGH, Compiled, compile_expressions
from .equations import Equations
from .functions import Expr
from .kinetic import ZERO, Vector
from .solved import ONE, Factors, Solved, dot, solved

MOST = 3  # constraints; more are left to loops
Table = tuple[Vector, ...]


@dataclass(frozen=True)
class Places:
    """Where numbers stand behind the inputs of a model, with n coordinates and m constraints.

    κ and A at the start of a step, then what `Pushes.ends` says, which begins with what `Pushes.shifts` reads: `size`
    numbers in all.
    """

    n: int
    m: int

    @property
    def factors(self) -> int:
        """How many numbers L and 1/D of S take."""
        return self.m * (self.m + 1) // 2

    @property
    def told(self) -> int:
        """Where `Pushes.ends` begins to write."""
        return 1 + self.m * self.n

    @property
    def size(self) -> int:
        """How many numbers all that is."""
        return self.told + 2 * self.m * self.n + self.factors + 2 * self.n + 3


@dataclass(frozen=True)
class Pushes:
    """Both as machine code, of the model's inputs and what `Places` has behind them.

    `ends` says R by rows, L below its diagonal and 1/D of S = L D Lᵀ, then a, the change of the rates, A by rows,
    det(A₀Rᵀ) with A₀ from the start of the step, and the smallest pivots of M and of S relative to their diagonals.
    `shifts` says μ + μ′ of two corrections, then Rᵀμ and Rᵀμ′.
    """

    shifts: Compiled
    ends: Compiled


def compiled_pushes(eqs: Equations) -> Pushes | None:
    """Both for a model with holonomic constraints; None where there are many, or no solution in symbols."""
    found, m = solved(eqs), len(eqs.constraints.slips)
    if found is None or not 0 < m <= MOST or len(eqs.constraints.gaps) != m:
        return None
    n = len(eqs.forcing)
    places = Places(n, m)
    extra = [se.Symbol(f"pushes {k}") for k in range(places.told + m * n + places.factors)]
    inputs = [*eqs.symbols.inputs, *extra]
    ends = compile_expressions(inputs, _ends(found, extra[0], _rows(extra[1:], m, n)), THOROUGH)
    known = extra[places.told :]
    shifts = compile_expressions(inputs, _shifts(eqs, _rows(known, m, n), _factors(known[m * n :], m)), THOROUGH)
    return Pushes(shifts, ends)


def _ends(found: Solved, impulse: Expr, before: Table) -> list[Expr]:
    """What `Pushes.ends` says."""
    eqs, m = found.eqs, len(before)
    kicked = tuple(impulse * part for part in found.free)
    rates = [eqs.symbols.rates[name] for name in eqs.symbols.free]
    slips = [slip.subs(dict(zip(rates, map(_sum, rates, kicked), strict=True))) for slip in eqs.constraints.slips]
    lost = along(found.responses, found.share.solve(slips))
    crossed = tuple(tuple(dot(row, each) for each in found.responses) for row in before)
    return [
        *_flat(found.responses),
        *(found.share.lower[k][j] for k in range(m) for j in range(k)),
        *(ONE / pivot for pivot in found.share.pivots),
        *found.free,
        *(kick - part for kick, part in zip(kicked, lost, strict=True)),
        *_flat(eqs.constraints.jacobian),
        determinant(crossed),
        *found.signs[:2],
    ]


def _shifts(eqs: Equations, responses: Table, factors: Factors) -> list[Expr]:
    """What `Pushes.shifts` says."""
    values = [eqs.symbols.values[name] for name in eqs.symbols.free]
    first = factors.solve(eqs.constraints.gaps)
    moved = along(responses, first)
    there = {value: value - change for value, change in zip(values, moved, strict=True)}
    second = factors.solve([gap.subs(there) for gap in eqs.constraints.gaps])
    return [*map(_sum, first, second), *moved, *along(responses, second)]


def _factors(numbers: Sequence[Expr], m: int) -> Factors:
    """L D Lᵀ with L and 1/D among the inputs."""
    source = iter(numbers)
    lower = tuple(tuple(next(source) for _ in range(k)) for k in range(m))
    pivots = tuple(ONE / next(source) for _ in range(m))
    return Factors(lower, pivots, pivots)


def along(rows: Table, multiples: Vector) -> Vector:
    """So many of the rows, summed up."""
    return tuple(dot(multiples, column) for column in zip(*rows, strict=True))


def determinant(table: Table) -> Expr:
    """The determinant of a small matrix, by its first row."""
    if not table:
        return ONE
    minors = (determinant(tuple(row[:k] + row[k + 1 :] for row in table[1:])) for k in range(len(table)))
    return sum(((-1) ** k * entry * minor for k, (entry, minor) in enumerate(zip(table[0], minors, strict=True))), ZERO)


def _rows(numbers: Sequence[Expr], m: int, n: int) -> Table:
    return tuple(tuple(numbers[k * n : (k + 1) * n]) for k in range(m))


def _flat(table: Table) -> Vector:
    return tuple(entry for row in table for entry in row)


def _sum(a: Expr, b: Expr) -> Expr:
    return a + b
