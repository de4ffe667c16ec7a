"""Eigenvalues and mode shapes of M ẍ + D ẋ + K x = 0, in numbers.

Without D the squares ω² are the eigenvalues of M⁻¹K, and the shapes span the kernels of K − ω²M. With D the λ are the
eigenvalues of the companion matrix of λ²M + λD + K, and the complex shapes span the kernels of that.
Source: Meirovitch, Methods of Analytical Dynamics, §6.4 and §6.6; Tisseur, Meerbergen, SIAM Review 43 (2001), 235.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TypeVar

import sympy as sp
from flint import acb, acb_mat, arb, arb_mat

from .refinement import rational

ZERO = arb(2) ** -140  # of the largest: below it a number of 512 bits is taken as zero
N = TypeVar("N", arb, acb)


@dataclass(frozen=True)
class Eigenvalue:
    """λ = real + i imaginary, in 1/s."""

    real: sp.Rational
    imaginary: sp.Rational

    @property
    def size(self) -> float:
        """|λ| in 1/s."""
        return abs(complex(float(self.real), float(self.imaginary)))


@dataclass(frozen=True)
class Mode:
    """An oscillation x = a cos ωt with ω² = `square`; negative, it grows. The largest part of the shape a is 1."""

    square: sp.Rational
    shape: tuple[sp.Rational, ...]


@dataclass(frozen=True)
class ComplexMode:
    """A motion x = Re(a e^λt) with Im λ ≥ 0 and a = real + i imaginary, whose largest part is 1.

    The coordinates do not pass through zero at the same time: with λ = −δ + iω, x = e^−δt (real cos ωt − imaginary
    sin ωt).
    """

    eigenvalue: Eigenvalue
    real: tuple[sp.Rational, ...]
    imaginary: tuple[sp.Rational, ...]


@dataclass(frozen=True)
class Spectrum:
    """All eigenvalues, those with the smallest imaginary part first.

    Real modes where nothing depends on rates and M, K are symmetric; complex ones elsewhere.
    """

    eigenvalues: tuple[Eigenvalue, ...]
    modes: tuple[Mode, ...] = ()
    complex_modes: tuple[ComplexMode, ...] = ()

    @property
    def frequencies(self) -> tuple[sp.Rational, ...]:
        """Circular frequencies Im λ > 0 in rad/s."""
        return tuple(value.imaginary for value in self.eigenvalues if value.imaginary > 0)

    @property
    def is_representable(self) -> bool:
        """Whether all numbers of it are doubles: λ = 10²⁰⁰/s is one, and its square is not."""
        parts = [part for value in self.eigenvalues for part in (value.real, value.imaginary)]
        return all(math.isfinite(float(part)) for part in (*parts, *(mode.square for mode in self.modes)))


def spectrum(mass: list[arb], damping: list[arb], stiffness: list[arb], size: int) -> Spectrum | None:
    """The spectrum for matrices given row by row; None where M is singular."""
    M, D, K = (arb_mat(size, size, matrix) for matrix in (mass, damping, stiffness))
    try:
        flexible, dragged = M.solve(K), M.solve(D)
    except ZeroDivisionError:
        return None
    if all(part == 0 for part in damping):
        found = _undamped(M, K, flexible, size)
        return found if found.modes else replace(found, complex_modes=_complex_modes(M, D, K, found.eigenvalues))
    companion = acb_mat(2 * size, 2 * size)
    for i in range(size):
        companion[i, size + i] = 1
        for k in range(size):
            companion[size + i, k], companion[size + i, size + k] = -flexible[i, k], -dragged[i, k]
    eigenvalues = _ordered(_cleaned(companion.eig(algorithm="approx")))
    return Spectrum(eigenvalues, (), _complex_modes(M, D, K, eigenvalues))


def _complex_modes(M: arb_mat, D: arb_mat, K: arb_mat, eigenvalues: tuple[Eigenvalue, ...]) -> tuple[ComplexMode, ...]:
    """The kernels of λ²M + λD + K, of each pair of conjugate λ for the upper one."""
    modes: list[ComplexMode] = []
    size = M.nrows()
    for value in dict.fromkeys(value for value in eigenvalues if value.imaginary >= 0):
        root = acb(arb(value.real.p) / value.real.q, arb(value.imaginary.p) / value.imaginary.q)
        if any(_is_near(value, mode.eigenvalue) for mode in modes):
            continue
        law = acb_mat(M) * (root * root) + acb_mat(D) * root + acb_mat(K)
        rows = [[law[i, k].mid() for k in range(size)] for i in range(size)]
        for shape in kernel(rows, _largest(M) * abs(root) ** 2 + _largest(D) * abs(root) + _largest(K)):
            real, imaginary = ([part.real for part in shape], [part.imag for part in shape])
            modes.append(ComplexMode(value, tuple(map(rational, real)), tuple(map(rational, imaginary))))
    return tuple(modes)


def _is_near(one: Eigenvalue, other: Eigenvalue) -> bool:
    """Whether two are the same but for rounding: a double root is found to half the digits."""
    gap = complex(float(one.real - other.real), float(one.imaginary - other.imaginary))
    return abs(gap) <= 1e-30 * (one.size + other.size)


def _undamped(M: arb_mat, K: arb_mat, flexible: arb_mat, size: int) -> Spectrum:
    squares = _cleaned(acb_mat(flexible).eig(algorithm="approx"))
    roots = [(-square).sqrt() for square in squares]
    eigenvalues = _ordered(_cleaned([value for root in roots for value in (root, -root)]))
    modes: list[Mode] = []
    for square in _distinct([square.real for square in squares if square.imag == 0]):
        rows = [[(K[i, k] - square * M[i, k]).mid() for k in range(size)] for i in range(size)]
        shapes = kernel(rows, _largest(K) + abs(square) * _largest(M))
        modes += [Mode(rational(square), tuple(map(rational, shape))) for shape in shapes]
    return Spectrum(eigenvalues, tuple(modes) if len(modes) == size else ())


def _cleaned(values: list[acb]) -> list[acb]:
    """The middles, with parts that are zero but for rounding set to zero."""
    largest = max((abs(value).mid() for value in values), default=arb(0))
    parts = [[arb(0) if abs(part.mid()) <= ZERO * largest else part.mid() for part in (v.real, v.imag)] for v in values]
    return [acb(*each) for each in parts]


def _ordered(values: list[acb]) -> tuple[Eigenvalue, ...]:
    ordered = sorted(values, key=lambda v: (abs(float(v.imag)), float(v.real), -float(v.imag)))
    return tuple(Eigenvalue(rational(value.real), rational(value.imag)) for value in ordered)


def _distinct(values: list[arb]) -> list[arb]:
    """Ascending, each once."""
    found: list[arb] = []
    for value in sorted(values, key=float):
        if not found or abs(value - found[-1]) > ZERO * (abs(value) + abs(found[-1])):
            found.append(value)
    return found


def _largest(matrix: arb_mat) -> arb:
    """The size of the largest entry."""
    return max((abs(entry).mid() for entry in matrix.entries()), default=arb(0))


def kernel(rows: list[list[N]], scale: arb) -> list[list[N]]:
    """A basis of the solutions of A x = 0, real or complex, in echelon form, its largest part scaled to 1.

    `scale` is the size of what A is the difference of: what is left of K − ω²M may be rounding alone.
    """
    rows, size = [list(row) for row in rows], len(rows)
    limit = ZERO * scale
    pivots: list[int] = []
    for k in range(size):
        best = max(range(len(pivots), size), key=lambda r: abs(rows[r][k]), default=None)
        if best is None or abs(rows[best][k]) <= limit:
            continue
        at = len(pivots)
        rows[at], rows[best] = rows[best], rows[at]
        rows[at] = [(entry / rows[at][k]).mid() for entry in rows[at]]
        for r in range(size):
            if r != at:
                rows[r] = [(a - rows[r][k] * b).mid() for a, b in zip(rows[r], rows[at], strict=True)]
        pivots.append(k)
    return [_scaled(_solution(rows, pivots, k)) for k in range(size) if k not in pivots]


def _solution(rows: list[list[N]], pivots: list[int], free: int) -> list[N]:
    x = [type(rows[0][0])(0)] * len(rows)
    x[free] = type(rows[0][0])(1)
    for row, pivot in zip(rows, pivots, strict=False):
        x[pivot] = -row[free]
    return x


def _scaled(x: list[N]) -> list[N]:
    largest = max(x, key=lambda part: float(abs(part)))
    return [(part / largest).mid() for part in x]
