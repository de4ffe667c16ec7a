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
from .kinetic import Vector
from .solved import Solved, Table, along, determinant, dot, solved

MOST = 3  # constraints; more are left to loops


@dataclass(frozen=True)
class Places:
    """Where numbers stand behind the inputs of a model, with n coordinates and m constraints.

    κ and A at the start of a step, then what `Pushes.ends` says, which begins with what `Pushes.shifts` reads: `size`
    numbers in all.
    """

    n: int
    m: int

    @property
    def inverse(self) -> int:
        """How many numbers S⁻¹ takes."""
        return self.m * (self.m + 1) // 2

    @property
    def told(self) -> int:
        """Where `Pushes.ends` begins to write."""
        return 1 + self.m * self.n

    @property
    def size(self) -> int:
        """How many numbers all that is."""
        return self.told + 2 * self.m * self.n + self.inverse + 2 * self.n + 3


@dataclass(frozen=True)
class Pushes:
    """Both as machine code, of the model's inputs and what `Places` has behind them.

    `ends` says R by rows, the lower triangle of S⁻¹, then a, the change of the rates, A by rows,
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
    extra = [se.Symbol(f"pushes {k}") for k in range(places.told + m * n + places.inverse)]
    inputs = [*eqs.symbols.inputs, *extra]
    ends = compile_expressions(inputs, _ends(found, extra[0], _rows(extra[1:], m, n)), THOROUGH)
    known = extra[places.told :]
    shifts = compile_expressions(inputs, _shifts(eqs, _rows(known, m, n), _symmetric(known[m * n :], m)), THOROUGH)
    return Pushes(shifts, ends)


def _ends(found: Solved, impulse: Expr, before: Table) -> list[Expr]:
    """What `Pushes.ends` says."""
    eqs = found.eqs
    kicked = tuple(impulse * part for part in found.free)
    rates = [eqs.symbols.rates[name] for name in eqs.symbols.free]
    slips = [slip.subs(dict(zip(rates, map(_sum, rates, kicked), strict=True))) for slip in eqs.constraints.slips]
    lost = along(found.responses, found.schur.solve(slips))
    crossed = tuple(tuple(dot(row, each) for each in found.responses) for row in before)
    return [
        *_flat(found.responses),
        *found.schur.inverse(),
        *found.free,
        *(kick - part for kick, part in zip(kicked, lost, strict=True)),
        *_flat(eqs.constraints.jacobian),
        determinant(crossed),
        *found.signs[:2],
    ]


def _shifts(eqs: Equations, responses: Table, inverse: Table) -> list[Expr]:
    """What `Pushes.shifts` says."""
    values = [eqs.symbols.values[name] for name in eqs.symbols.free]
    first = along(inverse, eqs.constraints.gaps)
    moved = along(responses, first)
    there = {value: value - change for value, change in zip(values, moved, strict=True)}
    second = along(inverse, tuple(gap.subs(there) for gap in eqs.constraints.gaps))
    return [*map(_sum, first, second), *moved, *along(responses, second)]


def _symmetric(triangle: Sequence[Expr], m: int) -> Table:
    """The matrix whose lower triangle that is."""
    return tuple(tuple(triangle[max(i, k) * (max(i, k) + 1) // 2 + min(i, k)] for k in range(m)) for i in range(m))


def _rows(numbers: Sequence[Expr], m: int, n: int) -> Table:
    return tuple(tuple(numbers[k * n : (k + 1) * n]) for k in range(m))


def _flat(table: Table) -> Vector:
    return tuple(entry for row in table for entry in row)


def _sum(a: Expr, b: Expr) -> Expr:
    return a + b
