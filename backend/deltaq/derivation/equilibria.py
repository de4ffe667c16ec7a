"""Equilibria: configurations q₀ in which nothing moves and nothing starts to, f(q₀, 0) = 0.

Equations that share no unknown are solved apart, at the scene's parameter values: one equation that is algebraic in
its unknown, or in its sine and cosine, completely; others by damped Newton's method from fixed starts within the
coordinates' ranges. What is found is then recognized as a closed form where that is quick.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, product

import sympy as sp

from ..language.memory import cached_method
from ..mechanics.coordinate import Coordinate
from .closed_form import Known, Sought, closed_form
from .compiled import compiled_together
from .matrix_form import forces_at_rest, forcing, is_autonomous, mass_matrix
from .newton import root
from .refinement import in_numbers, refined
from .system import System
from .univariate import real_zeros

STARTS = 32
MOST = 8  # equilibria of a scene
NEAR = 1e-6
FAR = 1e3  # times the size of the starts: there a force only fades away


@dataclass(frozen=True)
class Equilibrium:
    """A configuration at rest.

    `values` are closed forms in the parameters (exact), or the numbers at the scene's values of them. Coordinates that
    are not in it may have any value.
    """

    values: Mapping[sp.Symbol, sp.Expr]
    exact: bool


@dataclass(frozen=True)
class _Part:
    """Equations that hang together, and the unknowns in them."""

    equations: tuple[sp.Expr, ...]
    unknowns: tuple[Coordinate, ...]


@cached_method
def equilibria(system: System) -> tuple[Equilibrium, ...] | None:
    """Those that were found; none where forces never vanish. None: there is no such thing, as time is in the laws."""
    if not is_autonomous(system):
        return None
    parts = list(_parts(system))
    if any(not part.unknowns for part in parts):
        return ()
    found = [list(_solutions(system, part)) for part in parts]
    return tuple(_merged(system, each) for each in islice(product(*found), MOST))


def _merged(system: System, parts: tuple[Equilibrium, ...]) -> Equilibrium:
    """All values in the order of the coordinates: closed forms if all are, else numbers."""
    values = {q: value for part in parts for q, value in part.values.items()}
    ordered = {q: values[q] for q in map(system.q, system.free) if q in values}
    exact = all(part.exact for part in parts)
    return Equilibrium(ordered if exact else in_numbers(ordered, system.parameter_values), exact)


def free_coordinates(system: System) -> tuple[str, ...]:
    """Coordinates that no force at rest depends on: they may have any value in an equilibrium."""
    forces = forces_at_rest(system)
    return tuple(q for q in system.free if not forces.has(system.q(q)))


def _parts(system: System) -> Iterator[_Part]:
    """The equations grouped so that groups share no unknown; an equation without unknowns stands alone."""
    groups: list[tuple[list[sp.Expr], set[str]]] = []
    for force in forces_at_rest(system):
        if system.is_zero(force):
            continue
        names = {q for q in system.free if force.has(system.q(q))}
        touching = [group for group in groups if group[1] & names]
        merged = [e for group in touching for e in group[0]], set().union(*(group[1] for group in touching))
        groups = [group for group in groups if group not in touching]
        groups.append(([*merged[0], force], merged[1] | names))
    for equations, names in groups:
        yield _Part(tuple(equations), tuple(c for c in system.scene.free if c.name in names))


def _solutions(system: System, part: _Part) -> Iterator[Equilibrium]:
    """The solutions of one part, each as closed form or as refined numbers; those that fail both are dropped."""
    symbols = [system.q(c.name) for c in part.unknowns]
    parameters = system.parameter_values
    angles = frozenset(q for q in symbols if is_angle(system, q))
    equations = [equation.xreplace(dict(parameters)) for equation in part.equations]
    known = real_zeros(equations[0], symbols[0], is_angle=bool(angles)) if len(symbols) == len(equations) == 1 else None
    if known is not None:
        found, equations = [[value] for value in _by_distance(known.values)[:MOST]], [known.equation]
    else:
        found = _roots(part, symbols, equations, angles)
    for numbers in found:
        sought = dict(zip(symbols, numbers, strict=True))
        values: Known | None = closed_form(Sought(system, part.equations, sought, angles, parameters))
        if values is not None:
            yield Equilibrium(values, exact=True)
            continue
        rounded = refined(equations, sought)
        if rounded is not None:
            yield Equilibrium(rounded, exact=False)
        if known is None and len(found) == MOST:  # so many come from a continuum; one of them stands for all
            return


def _by_distance(values: Sequence[float]) -> list[float]:
    return sorted(values, key=lambda x: (round(abs(x), 6), -x))


def _roots(
    part: _Part, symbols: list[sp.Symbol], equations: list[sp.Expr], angles: frozenset[sp.Symbol]
) -> list[list[float]]:
    """Distinct roots in the order of their distance from the origin."""
    slots = {q: slot for slot, q in enumerate(symbols)}
    field, size = compiled_together(equations, slots), len(symbols)
    flat = compiled_together([equation.diff(q) for equation in equations for q in symbols], slots)
    starts = list(_starts(part, [q in angles for q in symbols]))
    values = [field(start) for start in starts]
    scale = max((math.hypot(*value) for value in values if all(map(math.isfinite, value))), default=1.0)
    far = FAR * (1 + max(math.hypot(*start) for start in starts))

    def slopes(x: Sequence[float]) -> list[list[float]]:
        entries = flat(x)
        return [entries[i : i + size] for i in range(0, len(entries), size)]

    distinct: list[list[float]] = []
    for start in starts:
        found = root(field, slopes, start, scale)
        if found is None or math.hypot(*found) > far:
            continue
        turned = [_within_a_turn(x) if q in angles else x for q, x in zip(symbols, found, strict=True)]
        if not any(_same(turned, other) for other in distinct):
            distinct.append(turned)
        if len(distinct) == MOST:
            break
    return sorted(distinct, key=lambda x: (round(math.hypot(*x), 6), [-round(v, 6) for v in x]))


def _within_a_turn(angle: float) -> float:
    """The angle in (−π, π]."""
    turned = math.remainder(angle, 2 * math.pi)
    return turned + 2 * math.pi if turned < -math.pi + NEAR else turned


def _same(one: list[float], other: list[float]) -> bool:
    return all(abs(a - b) < NEAR * (1 + abs(a)) for a, b in zip(one, other, strict=True))


def _starts(part: _Part, angles: list[bool]) -> Iterator[list[float]]:
    """The same values for every coordinate, then a fixed choice of mixtures."""
    choices = [_values(c, angle=angle) for c, angle in zip(part.unknowns, angles, strict=True)]
    total = math.prod(map(len, choices))
    chosen = range(total) if total <= STARTS else sorted(random.Random(1).sample(range(total), STARTS))
    yield from ([values[min(k, len(values) - 1)] for values in choices] for k in range(4) if total > STARTS)
    for index in chosen:
        start = []
        for values in choices:
            index, k = divmod(index, len(values))  # noqa: PLW2901 - the digits of the index, one for each coordinate
            start.append(values[k])
        yield start


def _values(coordinate: Coordinate, *, angle: bool) -> list[float]:
    if angle:
        return [k * math.pi / 2 + 0.1 for k in (0, 2, 1, -1)]
    low = coordinate.value - 1 if coordinate.min is None else coordinate.min
    high = coordinate.value + 1 if coordinate.max is None else coordinate.max
    return [low + part * (high - low) for part in (0.52, 0.93, 0.08)]


def is_angle(system: System, q: sp.Symbol) -> bool:
    """Whether the equations of motion are the same after a whole turn: q stands only in sines and cosines of n q."""
    waves, outside = _waves(system)
    around = [wave.args[0].diff(q) for wave in waves if wave.has(q)]
    return bool(around) and q not in outside and all(slope.is_Integer for slope in around)


@cached_method
def _waves(system: System) -> tuple[frozenset[sp.Expr], frozenset[sp.Symbol]]:
    """The sines and cosines in the equations of motion, and the symbols that stand outside them."""
    laws = sp.Tuple(*mass_matrix(system), *forcing(system))
    waves = laws.atoms(sp.sin, sp.cos)
    hidden = laws.xreplace({wave: sp.Dummy() for wave in waves})
    return frozenset(waves), frozenset(hidden.free_symbols)
