"""M q̈ = f + Aᵀλ, A q̈ = γ solved in symbols: what is zero in M and A costs nothing in machine code made of that.

M = L D Lᵀ, then S = AM⁻¹Aᵀ in the same way, both without pivoting, for they are positive definite wherever M has an
inverse and no constraint depends on the others. Whether that is so is told by their pivots.
Sources: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.1; Golub, Van Loan, Matrix
Computations, 4th ed., §4.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import symengine as se

from .compiled import Compiled, compile_expressions
from .constraints import ConstraintEquations
from .equations import Equations
from .functions import Expr
from .kinetic import ZERO, Vector

Table = tuple[Vector, ...]
ONE = se.Integer(1)
SMALL = 3  # rows of a matrix whose determinant is written out
MOST_PRODUCTS = 2000  # of numbers; a model that needs more is solved by loops, whose code is no longer for it


@dataclass(frozen=True)
class Factors:
    """L D Lᵀ of a symmetric matrix: `lower` is L below its diagonal of ones, `pivots` D, `diagonal` its own.

    Where two rows are coupled, there are no more, and their `entry` beside the diagonal solves with a single division:
    one waits for another one in the factors. Both are as good (Higham, Accuracy and Stability of Numerical Algorithms,
    2nd ed., §1.10.1).
    """

    lower: tuple[Vector, ...]
    pivots: Vector
    diagonal: Vector
    entry: Expr = ZERO

    @classmethod
    def of(cls, matrix: Sequence[Sequence[Expr]]) -> Factors:
        """The factors of a matrix given by its rows, of which only the lower triangle is read."""
        lower: list[list[Expr]] = []
        pivots: list[Expr] = []
        for i, entries in enumerate(matrix):
            scaled: list[Expr] = []  # L times D
            for j in range(i):
                scaled.append(entries[j] - dot(scaled, lower[j]))
            row = [part / pivot for part, pivot in zip(scaled, pivots, strict=True)]
            pivots.append(entries[i] - dot(scaled, row))
            lower.append(row)
        diagonal = tuple(row[i] for i, row in enumerate(matrix))
        return cls(tuple(map(tuple, lower)), tuple(pivots), diagonal, matrix[1][0] if len(matrix) == 2 else ZERO)

    def solve(self, right: Sequence[Expr]) -> Vector:
        """The solution for a right side that has as many entries as there are rows, or as the first of them."""
        if self.entry != 0 and len(right) == 2:
            a, b, c = self.diagonal[0], self.entry, self.diagonal[1]
            inverse = ONE / self.determinant
            return (c * right[0] - b * right[1]) * inverse, (a * right[1] - b * right[0]) * inverse
        found: list[Expr] = []
        for row, entry in zip(self.lower, right, strict=False):
            found.append(entry - dot(row, found))
        found = [entry / pivot for entry, pivot in zip(found, self.pivots, strict=False)]
        for i in reversed(range(len(found))):
            found[i] = found[i] - dot([self.lower[k][i] for k in range(i + 1, len(found))], found[i + 1 :])
        return tuple(found)

    @property
    def determinant(self) -> Expr:
        """That of two coupled rows."""
        return self.diagonal[0] * self.diagonal[1] - self.entry * self.entry

    def inverse(self) -> list[Expr]:
        """The lower triangle of the inverse, by rows."""
        size = len(self.pivots)
        columns = [self.solve([ONE if i == k else ZERO for i in range(size)]) for k in range(size)]
        return [columns[k][i] for i in range(size) for k in range(i + 1)]

    @cached_property
    def smallest(self) -> Expr:
        """The smallest pivot relative to the diagonal entry that it is left of; 1 where none has lost anything."""
        if self.entry != 0:
            return _least([ONE, self.determinant / (self.diagonal[0] * self.diagonal[1])])
        parts = [pivot / own for pivot, own in zip(self.pivots, self.diagonal, strict=True) if pivot != own]
        return _least([ONE, *parts])


@dataclass(frozen=True)
class Solved:
    """What a model with constraints does, solved for; `mass` are the factors of M, `schur` those of S.

    `responses` are the rows of AM⁻¹, `free` is q̈ without reactions.
    """

    eqs: Equations
    mass: Factors
    schur: Factors
    responses: tuple[Vector, ...]
    free: Vector
    multipliers: Vector
    accelerations: Vector

    @property
    def _held(self) -> ConstraintEquations:
        return self.eqs.constraints

    @cached_property
    def signs(self) -> Vector:
        """What tells whether all this is so: the smallest relative pivots of M and S, and the smallest of M itself."""
        return (self.mass.smallest, self.schur.smallest, _least(self.mass.pivots))

    @property
    def motion(self) -> list[Expr]:
        """What a model without constraints would say that moves alike, M = 1, f = q̈ and P, then `signs`."""
        n = len(self.accelerations)
        power = [self.power, *[ZERO] * n] if self.eqs.is_powered else []
        identity = [ONE if j == i else ZERO for i in range(n) for j in range(i + 1)]
        return [*identity, *self.accelerations, *power, *self.signs]

    def projected(self, before: Table) -> list[Expr]:
        """q and q̇ less what they are off by in g and w, in the metric of M, A by rows, how it turned, then `signs`.

        The latter with A `before` a step: above zero, the constraints did not lose their independence on the way.
        """
        symbols, held = self.eqs.symbols, self._held
        shares = (self.schur.solve(missed) for missed in (held.gaps, held.slips))
        off = (along(self.responses, share) for share in shares)
        state = [of[name] for of in (symbols.values, symbols.rates) for name in symbols.free]
        moved = (number - change for number, change in zip(state, (part for each in off for part in each), strict=True))
        return [*moved, *self._told(before)]

    @property
    def placed(self) -> list[Expr]:
        """What q is off by in g, then how much per unit of each g, by columns: Δq = M⁻¹Aᵀ(AM⁻¹Aᵀ)⁻¹g.

        With the latter a kernel takes g anew where q has moved, and corrects it once more by the same A and M: of a
        correction of the size δ it leaves about δ³.
        """
        first = along(self.responses, self.schur.solve(self._held.gaps))
        count = len(self._held.gaps)
        columns = (self.schur.solve([ONE if i == k else ZERO for i in range(count)]) for k in range(count))
        return [*first, *(part for column in columns for part in along(self.responses, column))]

    def landed(self, before: Table) -> list[Expr]:
        """What q̇ is off by in w, q̈ without that, then as `projected`, P, and the squares of the rows of A.

        All of it by the factors of one M and one A, with q on the constraints.
        """
        symbols, held = self.eqs.symbols, self._held
        rates = [symbols.rates[name] for name in symbols.free]
        off = along(self.responses, self.schur.solve(held.slips))
        kept = {rate: rate - change for rate, change in zip(rates, off, strict=True)}
        accelerations = [each.subs(kept) for each in self.accelerations]
        power = self.power.subs(kept) if self.eqs.is_powered else ZERO
        squares = (dot(row, row) for row in self._held.jacobian)
        return [*off, *accelerations, *self._told(before), power, *squares]

    def _told(self, before: Table) -> list[Expr]:
        """A by rows, how it turned since `before`, then `signs`."""
        rows = (entry for row in self._held.jacobian for entry in row)
        crossed = tuple(tuple(dot(row, each) for each in self.responses) for row in before)
        return [*rows, turned(crossed), *self.signs]

    @property
    def power(self) -> Expr:
        """P, with the power of the reactions."""
        own = self.eqs.power + dot(self.eqs.acceleration_power, self.accelerations)
        return own - dot(self.multipliers, self._held.drives)

    @property
    def reactions(self) -> Vector:
        """Aᵀλ."""
        columns = zip(*self._held.jacobian, strict=True)
        return tuple(dot(column, self.multipliers) for column in columns)


@dataclass(frozen=True)
class CompiledSolution:
    """What is solved for, as machine code, each part compiled when a method first asks for it.

    A `before` a step stands behind the inputs of `projected` and `landed`.
    """

    found: Solved
    effort: int

    @cached_property
    def motion(self) -> Compiled:
        """`Solved.motion`."""
        return compile_expressions(self._inputs, self.found.motion, self.effort)

    @cached_property
    def projected(self) -> Compiled:
        """`Solved.projected`."""
        return compile_expressions([*self._inputs, *self._before], self.found.projected(self._rows), self.effort)

    @cached_property
    def placed(self) -> Compiled | None:
        """`Solved.placed`; None where no constraint is holonomic."""
        held = self.found.eqs.constraints
        if not held.gaps:
            return None
        return compile_expressions(self._inputs, self.found.placed, self.effort)

    @cached_property
    def landed(self) -> Compiled:
        """`Solved.landed`."""
        return compile_expressions([*self._inputs, *self._before], self.found.landed(self._rows), self.effort)

    @property
    def _inputs(self) -> Sequence[Expr]:
        return self.found.eqs.symbols.inputs

    @property
    def _before(self) -> Vector:
        eqs = self.found.eqs
        return tuple(se.Symbol(f"before {k}") for k in range(len(eqs.constraints.slips) * len(eqs.forcing)))

    @property
    def _rows(self) -> Table:
        before, n = self._before, len(self.found.eqs.forcing)
        return tuple(before[k : k + n] for k in range(0, len(before), n))


def solved(eqs: Equations) -> Solved | None:
    """The solution of a model with constraints; None where it would be too long, or a mass is always zero."""
    held, matrix = eqs.constraints, eqs.mass_matrix
    if not held.slips or _products(matrix, len(held.slips)) > MOST_PRODUCTS:
        return None
    mass = Factors.of(matrix)
    if any(pivot == 0 for pivot in mass.pivots):
        return None
    responses, free = tuple(mass.solve(row) for row in held.jacobian), mass.solve(eqs.forcing)
    schur = Factors.of([[dot(row, each) for each in responses] for row in held.jacobian])
    if any(pivot == 0 for pivot in schur.pivots):
        return None
    wanted = [gamma - dot(row, free) for gamma, row in zip(held.accelerations, held.jacobian, strict=True)]
    multipliers = schur.solve(wanted)
    added = (dot(multipliers, column) for column in zip(*responses, strict=True))
    accelerations = tuple(a + b for a, b in zip(free, added, strict=True))
    return Solved(eqs, mass, schur, responses, free, multipliers, accelerations)


def compiled_solution(eqs: Equations, effort: int) -> CompiledSolution | None:
    """The solution as machine code, where there is one."""
    found = solved(eqs)
    return None if found is None else CompiledSolution(found, effort)


def _products(matrix: Sequence[Vector], m: int) -> float:
    """About how many products the solution takes; few where M is diagonal."""
    n = len(matrix)
    is_coupled = any(entry != 0 for i, row in enumerate(matrix) for entry in row[:i])
    return (n**3 / 6 + m * n**2 if is_coupled else m * n) + m**2 * n / 2 + m**3 / 6


def _least(values: Sequence[Expr]) -> Expr:
    distinct = list(dict.fromkeys(values))
    return distinct[0] if len(distinct) == 1 else se.Min(*distinct)


def along(rows: Table, multiples: Sequence[Expr]) -> Vector:
    """So many of the first rows, summed up."""
    return tuple(dot(multiples, column) for column in zip(*rows, strict=True))


def determinant(table: Table) -> Expr:
    """The determinant of a small matrix, by its first row."""
    if not table:
        return ONE
    minors = (determinant(tuple(row[:k] + row[k + 1 :] for row in table[1:])) for k in range(len(table)))
    return sum(((-1) ** k * entry * minor for k, (entry, minor) in enumerate(zip(table[0], minors, strict=True))), ZERO)


def turned(table: Table) -> Expr:
    """A number above zero only where the determinant is: of a small matrix the determinant, else its smallest pivot."""
    if len(table) <= SMALL:
        return determinant(table)
    rows, pivots = [list(row) for row in table], []
    for k, row in enumerate(rows):
        pivots.append(row[k])
        for other in rows[k + 1 :]:
            part = other[k] / row[k]
            for j in range(k + 1, len(row)):
                other[j] -= part * row[j]
    return _least(pivots)


def dot(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    """The sum over as many as both have."""
    return sum((x * y for x, y in zip(a, b, strict=False) if x != 0 and y != 0), ZERO)
