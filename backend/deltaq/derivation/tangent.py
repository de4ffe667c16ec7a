"""Small motions that keep the constraints: x = N y with A₀ N = 0, and Nᵀ(M₀ N ÿ + D₀ N ẏ + K₀ N y) = 0.

M₀ and D₀ = −∂f/∂q̇ are those without constraints. K₀ = −∂(f + Aᵀλ₀)/∂q holds λ₀: constraints are curved, and the force
that keeps them turns with them. The columns of N span the tangent space; y are the deviations of coordinates that may
be chosen, the others follow from them.
Source: Nocedal, Wright, Numerical Optimization, 2nd ed., §12.5 (projected Hessian); Bremer, Elastic Multibody Dynamics,
ch. 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp
from flint import arb, arb_mat, ctx

from ..language.derivatives import diff
from ..language.memory import cached_method
from .bound_equilibria import balance, matrix_at, numbers_at
from .conservation import is_passive
from .dissipation import dissipative_loads, remaining_loads
from .equilibria import BITS, Equilibrium
from .matrix_form import mass_matrix
from .refinement import rational
from .stability import Verdict, signature, skew
from .system import System


@dataclass(frozen=True)
class Tangent:
    """The tangent space at an equilibrium, and the laws there before they are projected.

    `rows` is A₀, `basis` N, `independent` are the coordinates whose deviations are y. In the parameters where the
    equilibrium is exact, else in numbers; `spread` is N in numbers.
    """

    independent: tuple[str, ...]
    rows: sp.ImmutableMatrix
    basis: sp.ImmutableMatrix
    mass: sp.ImmutableMatrix
    damping: sp.ImmutableMatrix
    stiffness: sp.ImmutableMatrix
    spread: sp.ImmutableMatrix


@dataclass(frozen=True)
class Projected:
    """A tangent space, M, D and K on it as they are shown, and in numbers."""

    tangent: Tangent
    shown: tuple[sp.ImmutableMatrix, sp.ImmutableMatrix, sp.ImmutableMatrix]
    numbers: tuple[list[arb], list[arb], list[arb]]


@cached_method
def bound_stiffness(system: System) -> sp.ImmutableMatrix:
    """−∂(f + Aᵀλ)/∂q at rest, as a function of q and λ."""
    laws = balance(system)
    return sp.ImmutableMatrix([[-diff(law, system.q(q)) for q in system.free] for law in laws])


def projected(system: System, equilibrium: Equilibrium, damping: sp.ImmutableMatrix) -> Projected:
    """The laws of small motions that keep the constraints."""
    raw = (mass_matrix(system), damping, bound_stiffness(system), system.constraint_matrix())
    with ctx.workprec(BITS):
        point = numbers_at(system, equilibrium)
        numbers = [matrix_at(matrix, point) for matrix in raw]
        chosen = independent_of(numbers[3])
        spread = _basis_in_numbers(numbers[3], chosen)
        reduced = [spread.transpose() * matrix * spread for matrix in numbers[:3]]
        exact = [_in_sympy(matrix) for matrix in numbers]
        wide = _in_sympy(spread)
    if equilibrium.exact:
        there = {**equilibrium.values, **equilibrium.reactions}
        exact = [system.display(matrix.xreplace(there)) for matrix in raw]
    basis = _basis(system, exact[3], chosen) if equilibrium.exact else wide
    shown = [sp.ImmutableMatrix(basis.T * matrix * basis) for matrix in exact[:3]]
    mass, drag, stiffness = map(system.display, shown) if equilibrium.exact else shown
    names = tuple(system.free[i] for i in chosen)
    tangent = Tangent(names, exact[3], basis, exact[0], exact[1], exact[2], wide)
    first, second, third = (list(matrix.entries()) for matrix in reduced)
    return Projected(tangent, (mass, drag, stiffness), (first, second, third))


def independent_of(rows: arb_mat) -> tuple[int, ...]:
    """The columns that elimination with the largest pivots does not need: those coordinates may be chosen."""
    left = [[rows[i, k].mid() for k in range(rows.ncols())] for i in range(rows.nrows())]
    dependent: list[int] = []
    while left:
        sizes = [(abs(row[k]), -r, k) for r, row in enumerate(left) for k in range(len(row)) if k not in dependent]
        size, r, k = max(sizes, key=lambda each: (float(each[0]), each[1], each[2]))
        if not bool(size > 0):
            break
        pivot = left.pop(-r)
        left = [[(a - row[k] / pivot[k] * b).mid() for a, b in zip(row, pivot, strict=True)] for row in left]
        dependent.append(k)
    return tuple(k for k in range(rows.ncols()) if k not in dependent)


def _basis(system: System, rows: sp.ImmutableMatrix, chosen: Sequence[int]) -> sp.ImmutableMatrix:
    """N: the identity for what may be chosen, −A_d⁻¹ A_i for what depends on it."""
    others = [k for k in range(rows.cols) if k not in chosen]
    square, rest = rows.extract(list(range(rows.rows)), others), rows.extract(list(range(rows.rows)), list(chosen))
    follows = -(square.adjugate() * rest) / square.det(method="berkowitz")
    lines = {k: sp.eye(len(chosen)).row(place) for place, k in enumerate(chosen)}
    lines |= {k: follows.row(place) for place, k in enumerate(others)}
    return system.display(sp.ImmutableMatrix(sp.Matrix.vstack(*(lines[k] for k in range(rows.cols)))))


def _basis_in_numbers(rows: arb_mat, chosen: Sequence[int]) -> arb_mat:
    others = [k for k in range(rows.ncols()) if k not in chosen]
    count = rows.nrows()
    square = arb_mat(count, count, [rows[i, k] for i in range(count) for k in others])
    rest = arb_mat(count, len(chosen), [-rows[i, k] for i in range(count) for k in chosen])
    follows = square.solve(rest)
    place = {k: i for i, k in enumerate(others)}
    entries = [
        follows[place[k], j] if k in place else arb(int(k == own))
        for k in range(rows.ncols())
        for j, own in enumerate(chosen)
    ]
    return arb_mat(rows.ncols(), len(chosen), entries)


def _in_sympy(matrix: arb_mat) -> sp.ImmutableMatrix:
    """The middles, exactly; NaN where a force has no slope."""
    entries = [rational(entry) if entry.is_finite() else sp.nan for entry in matrix.entries()]
    return sp.ImmutableMatrix(matrix.nrows(), matrix.ncols(), entries)


def bound_verdict(system: System, equilibrium: Equilibrium, law: Projected, grows: int) -> Verdict:
    """The stability by the small motions that keep the constraints; `grows` is the sign of the fastest one.

    Holonomic constraints at rest in time do no work, so that the potential on them decides as it does without them
    (Lagrange, Dirichlet).
    """
    if grows:
        return Verdict("unstable" if grows > 0 else "stable")
    size, (_, damping, stiffness) = len(law.tangent.independent), law.numbers
    dissipative = bool(dissipative_loads(system)) and not remaining_loads(system)
    if not is_passive(system) and not (dissipative and _feeds_nothing(damping, size)):
        return Verdict("undecided")
    signs = signature([stiffness[i * size : (i + 1) * size] for i in range(size)])
    if signs is None or signs.positive == size:
        return Verdict("undecided" if signs is None else "stable")
    if not signs.negative and signs.zero == len(equilibrium.free) > 0:
        return Verdict("stable", kind="family")
    if signs.negative:
        return Verdict("undecided", kind="gyroscopic" if skew(damping, size) else "")
    return Verdict("undecided", kind="family" if equilibrium.free else "degenerate")


def _feeds_nothing(damping: list[arb], size: int) -> bool:
    symmetric = [[damping[i * size + k] + damping[k * size + i] for k in range(size)] for i in range(size)]
    signs = signature(symmetric)
    return signs is not None and not signs.negative
