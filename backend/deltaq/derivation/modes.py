"""Eigenfrequencies and mode shapes in the parameters, where they are short: of one and two degrees of freedom.

det(K − ω²M) = 0 is a quadratic in ω² for two degrees of freedom.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from .linearization import Linearization
from .spectrum import Spectrum
from .system import System

LONGEST = 24  # operations in ω²
MOST_SYMBOLS = 4  # in coupled equations: with more of them the root of the quadratic is never short


@dataclass(frozen=True)
class SymbolicModes:
    """ω² of each mode, ascending at the scene's values, and its shape."""

    squares: tuple[sp.Expr, ...]
    shapes: tuple[sp.ImmutableMatrix, ...]


def symbolic_modes(system: System, linear: Linearization) -> SymbolicModes | None:
    """The modes as expressions, if the equilibrium is exact, nothing depends on rates, and they are short."""
    if not linear.equilibrium.exact or linear.is_damped or linear.spectrum is None or not linear.spectrum.modes:
        return None
    squares = _squares(system, linear, linear.spectrum)
    if squares is None:
        return None
    shapes = [shape for square in squares if (shape := _shape(system, linear, square)) is not None]
    return SymbolicModes(squares, tuple(shapes)) if len(shapes) == len(squares) else None


def damped_root(system: System, linear: Linearization) -> tuple[sp.Expr, sp.Expr] | None:
    """δ and ω² of λ = −δ ± iω for one degree of freedom: δ = D/2M, ω² = K/M − δ²."""
    if not linear.is_scalar or not linear.equilibrium.exact:
        return None
    M, D, K = linear.mass[0, 0], linear.damping[0, 0], linear.stiffness[0, 0]
    decay = system.display(D / (2 * M))
    return decay, system.display(K / M - decay**2)


def _squares(system: System, linear: Linearization, spectrum: Spectrum) -> tuple[sp.Expr, ...] | None:
    """ω² in the order of the modes; None where they are not short, or not those: of frequencies some 10²⁰ times apart
    the smaller ones are zero in numbers.
    """
    M, K = linear.mass, linear.stiffness
    if M.shape == (1, 1):
        return (system.display(K[0, 0] / M[0, 0]),)
    if M.shape != (2, 2):
        return None
    values = system.parameter_values
    found = _roots(system, M, K)
    if not found or any(square.count_ops() > LONGEST for square in found):
        return None
    numbers = [sp.N(square.xreplace(values), 30) for square in found]
    if not all(number.is_Float or number.is_Integer for number in numbers):
        return None
    ordered = sorted(zip(numbers, found, strict=True), key=lambda pair: pair[0])
    if any(sp.sign(number) != sp.sign(mode.square) for (number, _), mode in zip(ordered, spectrum.modes, strict=True)):
        return None
    by_chance = any(mode.square == 0 != square for (_, square), mode in zip(ordered, spectrum.modes, strict=True))
    # What is zero at these values only has a real root on one side of them.
    return None if by_chance else tuple(square for _, square in ordered)


def _roots(system: System, M: sp.ImmutableMatrix, K: sp.ImmutableMatrix) -> list[sp.Expr]:
    """The two roots of a x² + b x + c = det(K − x M); none if they would not be short."""
    if M[0, 1] == M[1, 0] == K[0, 1] == K[1, 0] == 0:
        return [system.display(K[i, i] / M[i, i]) for i in range(2)]
    has_roots = any(not power.exp.is_Integer for power in M.atoms(sp.Pow) | K.atoms(sp.Pow))
    if has_roots or len(M.free_symbols | K.free_symbols) > MOST_SYMBOLS:
        return []
    a = system.display(M.det())
    b = system.display(M[0, 1] * K[1, 0] + M[1, 0] * K[0, 1] - M[0, 0] * K[1, 1] - M[1, 1] * K[0, 0])
    half, rest = system.display(-b / (2 * a)), system.display(K.det() / a)
    root = sp.sqrt(sp.factor_terms(system.display(half**2 - rest)))
    return [sp.factor_terms(half - root), sp.factor_terms(half + root)]


def _shape(system: System, linear: Linearization, square: sp.Expr) -> sp.ImmutableMatrix | None:
    """The solution of (K − ω²M) a = 0 whose first part is 1, or the other one if there is none."""
    M, K = linear.mass, linear.stiffness
    if M.shape == (1, 1):
        return sp.ImmutableMatrix([[1]])
    rows = [[K[i, k] - square * M[i, k] for k in range(2)] for i in range(2)]
    for own, other in rows:
        if own == 0 and other == 0:
            continue
        if other == 0:
            return sp.ImmutableMatrix([[0], [1]]) if not system.is_zero(own) else None
        if not system.is_zero(other):
            ratio = system.display(-own / other)
            return sp.ImmutableMatrix([[1], [ratio if ratio.free_symbols else sp.radsimp(ratio)]])
    return None
