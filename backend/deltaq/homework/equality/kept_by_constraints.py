"""Reactions of constraints: equal wherever the constraints are kept, as a force may be written in many ways there.

x² + y² is l² on a circle: m (ẋ² + ẏ² + g y)/l and the same with √(x² + y²) are one force, and no identity. Both are
evaluated at states that keep the constraints and their rates: random ones, moved there by Newton's method.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from itertools import cycle, islice

import sympy as sp

from ...derivation.accelerations import accelerations
from ...derivation.compiled import compiled_together
from ...language.memory import cached_method
from ..sampling import DISTINCT, Sampler, close, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts

STATES = 5
ATTEMPTS = 40
ITERATIONS = 60
REACH = 0.15  # from the initial values, relative where these are large
EXACT = 1e-13
LEAST = 1e-13  # of the squares of slopes that depend on one another

Row = list[float]


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values at the states; None where one is not defined."""
    values = tuple(value for part in parts for value in _values(part, sampler.solution))
    return values if values and defined(values) else None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether both have the same values at all states: seen there, not proved."""
    pairs = list(zip(given, right, strict=True)) if len(given) == len(right) else []
    values = [(_values(a, solution), _values(b, solution)) for a, b in pairs]
    if not values or not all(defined(b) and b for _, b in values):
        return Match(equal=None)
    if not all(defined(a) for a, _ in values) or not all(close(a, b, DISTINCT) for a, b in values):
        return Match(equal=False)
    return Match(True if all(close(a, b) for a, b in values) else None)


def proportional(given: Parts, right: Parts, solution: Solution) -> bool:
    """Whether each equation is a multiple of the right one at all states, with a factor that depends on the state.

    Both are linear in accelerations and multipliers, so that their coefficients are compared.
    """
    if len(given) != len(right) or not any(condition.is_holonomic for condition in solution.conditions):
        return False
    return all(_is_multiple(a, b, solution) for a, b in zip(given, right, strict=True))


def _is_multiple(given: sp.Expr, right: sp.Expr, solution: Solution) -> bool:
    unknown = [*map(solution.acceleration, solution.free), *solution.multipliers]
    columns = [_coefficients(each, unknown, solution) for each in (given, right)]
    if not columns[0] or not all(defined(row) for rows in columns for row in rows):
        return False
    return all(_is_parallel(own, true) for own, true in zip(*columns, strict=True))


def _is_parallel(own: tuple[float, ...], true: tuple[float, ...]) -> bool:
    place = max(range(len(true)), key=lambda k: abs(true[k]))
    factor = own[place] / true[place] if true[place] else 0.0
    return abs(factor) > EXACT and close(own, [factor * entry for entry in true])


def _coefficients(value: sp.Expr, unknown: list[sp.Symbol], solution: Solution) -> list[tuple[float, ...]]:
    """At each state, what stands before each of the unknown, and the rest; nothing where the value is not linear."""
    slopes = [value.diff(symbol) for symbol in unknown]
    if any(slope.free_symbols & set(unknown) for slope in slopes):
        return []
    rest = value.xreplace(dict.fromkeys(unknown, solution.zero))
    return list(zip(*(_values(part, solution) for part in (*slopes, rest)), strict=True))


def states_of(solution: Solution) -> Iterator[dict[str, float]]:
    """The states by names."""
    symbols, states = _states(solution)
    names = [symbol.name for symbol in symbols]
    yield from (dict(zip(names, state, strict=True)) for state in states)


def _values(value: sp.Expr, solution: Solution) -> tuple[float, ...]:
    """At each state; what holds a symbol that no state has a value for is NaN."""
    symbols, states = _states(solution)
    if not value.free_symbols <= symbols.keys():
        return (math.nan,) * len(states)
    function = compiled_together([value], symbols)
    return tuple(function(state)[0] for state in states)


@cached_method
def _states(solution: Solution) -> tuple[dict[sp.Symbol, int], tuple[Row, ...]]:
    """Places of the symbols, and states of position, rate and acceleration that keep the constraints."""
    model = solution.model
    free, source = model.free, random.Random(5)
    known = [*map(model.q, free), *map(model.rate, free), model.t, *map(model.q, _parameters(solution))]
    symbols = {symbol: place for place, symbol in enumerate(known)}
    positions = [model.condition(each) for each in model.conditions if each.is_holonomic]
    rates = [model.condition_rate(each) for each in model.conditions]
    found = accelerations(model) or {}
    moving = [found[model.acceleration(q)] for q in free if model.acceleration(q) in found]
    further = compiled_together(moving, symbols)
    places = {model.acceleration(q): len(known) + i for i, q in enumerate(free[: len(moving)])}

    def moved(reach: float) -> Iterator[Row]:
        for _, sense in zip(range(ATTEMPTS), cycle((1.0, -1.0)), strict=False):
            start, least = _start(solution, source, sense, reach), LEAST if model.scene.is_redundant else 0.0
            bent = _moved(start, positions, known[: len(free)], symbols, least)
            kept = bent and _moved(bent, rates, known[len(free) : 2 * len(free)], symbols, least)
            if kept:
                yield [*kept, *further(kept)]

    # Rods too many may fit with the scene's own parameters only.
    found_states = tuple(islice(moved(REACH / 3), STATES)) or tuple(islice(moved(0.0), STATES))
    return {**symbols, **places}, found_states


def _parameters(solution: Solution) -> list[str]:
    return [parameter.name for parameter in solution.scene.parameters]


def _start(solution: Solution, source: random.Random, sense: float, reach: float) -> Row:
    """Near the scene's own initial values and parameters: elsewhere a linkage may not close.

    Rates are near its own or, for `sense` −1, near those of the way back: |ṙ| and √(ẋ² + ẏ²) are no rates.
    """
    scene = solution.scene
    positions = [c.value + REACH * (1 + abs(c.value)) * source.uniform(-1, 1) for c in scene.free]
    rates = [sense * c.rate + source.uniform(-1, 1) for c in scene.free]
    parameters = [p.value * (1 + reach * source.uniform(-1, 1)) for p in scene.parameters]
    return [*positions, *rates, source.uniform(0, 1), *parameters]


def _moved(
    state: Row, conditions: Sequence[sp.Expr], by: Sequence[sp.Symbol], symbols: dict[sp.Symbol, int], least: float
) -> Row | None:
    """The state with these symbols changed, each time by the least change, until the conditions are zero.

    Where some of them follow from others the changes are damped, by `least` of the slopes at least (Levenberg and
    Marquardt).
    """
    if not conditions:
        return state
    slopes = [condition.diff(symbol) for condition in conditions for symbol in by]
    function = compiled_together([*conditions, *slopes], symbols)
    count, kept = len(conditions), list(state)
    for _ in range(ITERATIONS):
        values = function(kept)
        if not all(map(math.isfinite, values)):
            return None
        if max(map(abs, values[:count])) < EXACT:
            return kept
        matrix = sp.Matrix(count, len(by), values[count:])
        off = sum(value * value for value in values[:count])
        damping = max(off, least * float((matrix * matrix.T).trace())) if least else 0.0
        normal = matrix * matrix.T + damping * sp.eye(count)
        if not least and abs(normal.det()) < EXACT:
            return None
        change = matrix.T * normal.LUsolve(sp.Matrix(values[:count]))
        for symbol, step in zip(by, change, strict=True):
            kept[symbols[symbol]] -= float(step)
    return None
