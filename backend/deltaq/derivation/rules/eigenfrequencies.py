"""Eigenfrequencies: x = a cos ωt solves M₀ ẍ + K₀ x = 0 if det(K₀ − ω²M₀) = 0; with D₀ or without symmetry,
x = a e^λt solves M₀ ẍ + D₀ ẋ + K₀ x = 0 if det(λ²M₀ + λD₀ + K₀) = 0, and λ = −δ ± iω.

Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.2; Meirovitch, Methods of Analytical Dynamics, §6.6.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import sympy as sp

from ..formula import (
    Determinant,
    Explicit,
    Formula,
    Inserted,
    MatrixTimes,
    Named,
    Plus,
    Quantity,
    Rounded,
    Term,
    Times,
    minus,
)
from ..linearization import Linearization
from ..modes import SymbolicModes, damped_root, symbolic_modes
from ..spectrum import Spectrum
from ..step import Relation, Step
from ..system import System
from . import complex_mode_shapes
from ._roots import roots_of
from ._shape import matrices, numbers, plain_value, premises, zero

RULE = "eigenfrequencies"
SHAPES = "mode-shapes"

Values = dict[sp.Symbol, sp.Expr]

NEAR = sp.Rational(1, 2**60)


def apply(system: System, linear: Linearization, spectrum: Spectrum, number: int) -> Step:
    """The characteristic equation by its roots, and what they are in numbers."""
    if not spectrum.modes:
        lines = tuple(_damped(system, linear, spectrum))
        damped = Step(RULE, str(number), lines, (), _about("damped", number), premises=premises(linear, number))
        shapes = () if linear.is_scalar else (complex_mode_shapes.apply(system, linear, spectrum, number),)
        return damped.with_substeps(*shapes)
    squares = tuple(mode.square for mode in spectrum.modes)
    found = symbolic_modes(system, linear)
    symbols = [_root_symbol(system, linear, square, index) for index, square in enumerate(squares, 1)]
    known = dict(zip(symbols, map(_root, squares), strict=True))
    written = dict(zip(symbols, map(_root_of, squares, found.squares), strict=True)) if found else known
    shown = [_characteristic(system, linear, written, squares, exact=found is not None)]
    for symbol in symbols:
        name = Explicit(symbol)
        if found:
            shown.append(Relation((Inserted(name, written), Explicit(written[symbol]))))
        number_of = Inserted(Inserted(name, written), numbers(system))
        shown.append(Relation((number_of, Rounded(known[symbol], _unit(symbol))), "≈"))
    about = _about(_outcome(squares), number)
    step = Step(RULE, str(number), tuple(shown), (), about, premises=premises(linear, number))
    return step if linear.is_scalar else step.with_substeps(_shapes(system, linear, spectrum, found, number))


def _about(outcome: str, number: int) -> dict[str, str]:
    return {"outcome": outcome, "number": str(number)}


def _outcome(squares: tuple[sp.Rational, ...]) -> str:
    return "grows" if any(square < 0 for square in squares) else "text"


def _root(square: sp.Rational) -> sp.Expr:
    """|ω²|^½ to more digits than the verification asks for."""
    return sp.Rational(math.isqrt(int(abs(square) * 4**500)), 2**500)


def _root_of(number: sp.Rational, square: sp.Expr) -> sp.Expr:
    return sp.sqrt(square if number >= 0 else sp.factor_terms(-square))


def _root_symbol(system: System, linear: Linearization, square: sp.Rational, index: int) -> sp.Symbol:
    """ωₖ for an oscillation, κₖ for what grows and fades as e^±κt."""
    letters = (system.omega.name,) if square >= 0 else ("kappa", "sigma", "alpha")
    number = 0 if linear.is_scalar else index
    return system.fresh(*(f"{letter}_{number}" for letter in letters), f"{letters[0]}_{number}_0")


def _unit(symbol: sp.Symbol) -> str:
    return "1/s" if symbol.name.startswith(("kappa", "sigma", "alpha", "delta", "lambda")) else "rad/s"


def _characteristic(
    system: System, linear: Linearization, known: Values, squares: tuple[sp.Rational, ...], *, exact: bool
) -> Relation:
    """det(K₀ − ω²M₀) = det M₀ · Π (ωₖ² − ω²)"""
    mass, _, stiffness = matrices(linear)
    omega = system.omega
    law = Plus((Term(stiffness), minus(Times((Explicit(omega**2), mass)))))
    roots = [symbol**2 if square >= 0 else -(symbol**2) for symbol, square in zip(known, squares, strict=True)]
    product = Times((_determinant(linear, mass), *(Explicit(root - omega**2) for root in roots)))
    return _compared(system, _determinant(linear, law), product, known, exact=exact)


def _compared(system: System, law: Formula, product: Formula, known: Values, *, exact: bool) -> Relation:
    """The law and the product by its roots, as expressions or at the scene's values."""
    split = Inserted(product, known)
    if exact:
        return Relation((law, split))
    return Relation((Inserted(law, numbers(system)), Inserted(split, numbers(system))))


def _determinant(linear: Linearization, of: Formula) -> Formula:
    return of if linear.is_scalar else Determinant(of)


def _damped(system: System, linear: Linearization, spectrum: Spectrum) -> Iterator[Relation]:
    """The roots of det(λ²M₀ + λD₀ + K₀): −δ ± iω in pairs, or real."""
    mass, damping, stiffness = matrices(linear)
    exponent = system.exponent
    drag = (Term(Times((Explicit(exponent), damping))),) if linear.is_damped else ()
    law = Plus((Term(Times((Explicit(exponent**2), mass))), *drag, Term(stiffness)))
    roots = roots_of(system, spectrum)
    known = {symbol: number for root in roots for symbol, number in root.known.items()}
    factors = [_determinant(linear, mass), *(Explicit(root.factor(exponent)) for root in roots)]
    written = _written(system, linear, known)
    exact = written is not None
    yield _compared(system, _determinant(linear, law), Times(tuple(factors)), written or known, exact=exact)
    for symbol, root in known.items():
        name = Inserted(Explicit(symbol), written or known)
        if written:
            yield Relation((name, Explicit(written[symbol])))
        yield Relation((Inserted(name, numbers(system)), Rounded(root, _unit(symbol))), "≈")


def _written(system: System, linear: Linearization, known: Values) -> Values | None:
    """The same in the parameters, for one degree of freedom."""
    found = damped_root(system, linear)
    if found is None:
        return None
    decay, square = found
    first, second = known
    if abs(known[first] - known[second]) < NEAR * abs(known[first]):  # the root of their difference may round to i·0
        return None
    if known[second] > 0 and second.name.startswith((system.omega.name, "nu", "omega")):
        return {first: decay, second: sp.sqrt(square)}
    return {first: -decay - sp.sqrt(system.display(-square)), second: -decay + sp.sqrt(system.display(-square))}


def _shapes(
    system: System, linear: Linearization, spectrum: Spectrum, found: SymbolicModes | None, number: int
) -> Step:
    """(K₀ − ωₖ²M₀) aₖ = 0 and aₖ."""
    mass, _, stiffness = matrices(linear)
    lines: list[Relation] = []
    for index, mode in enumerate(spectrum.modes, 1):
        symbol = _root_symbol(system, linear, mode.square, index)
        shape = found.shapes[index - 1] if found else sp.ImmutableMatrix([[part] for part in mode.shape])
        root = _root_of(mode.square, found.squares[index - 1]) if found else _root(mode.square)
        name = Named(Quantity("mode", str(index)), plain_value(shape))
        square = Explicit(symbol**2)
        moved = Term(Times((square, mass)), (), -1 if mode.square >= 0 else 1)
        law = Inserted(MatrixTimes(Plus((Term(stiffness), moved)), name), {symbol: root})
        lines.append(Relation((law if found else Inserted(law, numbers(system)), zero(linear.mass.rows))))
        lines.append(Relation((name, Explicit(shape) if found else Rounded(shape)), "=" if found else "≈"))
    about = {"number": str(number)}
    return Step(SHAPES, str(number), tuple(lines), (), about, premises=premises(linear, number))
