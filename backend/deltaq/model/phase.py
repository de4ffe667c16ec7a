"""Generalized momenta and their rates, for methods that keep the structure of phase space.

Of the kinetic energy E(q, q̇, t) and the generalized forces Q, Lagrange's equations are (Lurie, Analytical Mechanics,
ch. 10; with forces that have no potential on the right as well)

    p = ∂E/∂q̇,   ṗ = ∂E/∂q + Q(q, q̇, t).

Unlike q̇, the momentum p makes the flow of a conservative scene symplectic, also where the mass matrix depends on q.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from random import Random

from .compiled import THOROUGH, Compiled, compile_expressions
from .equations import Equations
from .functions import Expr
from .kinetic import Vector
from .slopes import gradient
from .solved import solved

POINTS, NEGLIGIBLE = 3, 1e-13


@dataclass(frozen=True)
class PhaseSpace:
    """The lower triangle of M (row by row), p and ṗ as machine code, of the inputs of `Model`.

    `is_separable`: M is constant and ṗ depends on q and t alone, so that positions and momenta can be advanced in turn.
    `held`, where constraints are solved for in symbols, has their reactions in ṗ, and then `Solved.signs`.
    """

    function: Compiled
    is_separable: bool
    held: Compiled | None = None


def phase_space(eqs: Equations) -> PhaseSpace:
    """Momenta and their rates, built and compiled."""
    symbols = eqs.symbols
    rates = tuple(symbols.rates[name] for name in symbols.free)
    values = tuple(symbols.values[name] for name in symbols.free)
    triangle = tuple(entry for i, row in enumerate(eqs.mass_matrix) for entry in row[: i + 1])
    momenta, forces = momenta_and_rates(eqs)
    at_rest = tuple(momentum.subs(dict.fromkeys(rates, 0)) for momentum in momenta)
    is_separable = (
        all(vanishes(entry.diff(x)) for entry in (*triangle, *at_rest) for x in (*values, symbols.time))
        and forces == eqs.forces
        and not any(force.free_symbols & set(rates) for force in forces)
    )
    found = PhaseSpace(compile_expressions(symbols.inputs, [*triangle, *momenta, *forces], THOROUGH), is_separable)
    solution = solved(eqs)
    if solution is None:
        return found
    total = (a + b for a, b in zip(forces, solution.reactions, strict=True))
    held = compile_expressions(symbols.inputs, [*triangle, *momenta, *total, *solution.signs], THOROUGH)
    return replace(found, held=held)


def momenta_and_rates(eqs: Equations) -> tuple[Vector, Vector]:
    """p = ∂E/∂q̇ and ṗ = ∂E/∂q + Q, without the first of these where it is zero."""
    symbols = eqs.symbols
    momenta, slopes = (
        gradient(eqs.kinetic, [of[name] for name in symbols.free]) for of in (symbols.rates, symbols.values)
    )
    if all(vanishes(slope) for slope in slopes):
        return momenta, eqs.forces
    return momenta, tuple(a + b for a, b in zip(slopes, eqs.forces, strict=True))


def vanishes(expression: Expr) -> bool:
    """Whether an analytic expression is zero, also where only sin² + cos² = 1 makes it so: by values at random."""
    return expression == 0 or all(_size_at(expression, Random(seed)) < NEGLIGIBLE for seed in range(POINTS))


def _size_at(expression: Expr, random: Random) -> float:
    symbols = sorted(expression.free_symbols, key=str)
    try:
        return float(abs(expression.subs({symbol: random.uniform(0.3, 1.3) for symbol in symbols}).n()))
    except (RuntimeError, TypeError, ValueError):  # no real value there
        return math.inf
