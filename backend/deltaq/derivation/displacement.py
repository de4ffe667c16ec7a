"""What a symmetry does in space: which rigid motion of which bodies it is, as far as it is one.

δr = a is a translation, δr = ω × r a rotation about an axis through the origin, δr = a + ω × r one about another axis
or, with a · ω ≠ 0, a screw. It is recognized in floats at random points, for what it is called; nothing rests on it.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import sympy as sp

from ..language.derivatives import diff
from ..mechanics.kinetics import Rotation
from .compiled import compiled
from .elimination import Row, kernel
from .generator import Generator
from .space import motions
from .system import System

POINTS = 4
NEAR = 1e-7
AXES = "xyz"


@dataclass(frozen=True)
class Meaning:
    """The word for it (`rotation`, `translation-x`), and the bodies that move where not all do."""

    word: str
    bodies: tuple[str, ...] = ()


def meaning(system: System, generator: Generator) -> Meaning:
    """What the generator is called."""
    if generator.time != 0:
        return Meaning(_with_time(system, generator))
    for whole, shifts in motions(system).items():
        if any(dict(generator.shifts) == {q: sign * shift for q, shift in shifts.items()} for sign in (1, -1)):
            return Meaning(whole.word, (whole.alone,) if whole.alone and len(system.scene.bodies) > 1 else ())
    shifts = {q: shift / system.t for q, shift in generator.shifts.items()}
    is_boost = all(not shift.has(system.t) for shift in shifts.values())
    motion = _rigid(system, shifts if is_boost else dict(generator.shifts))
    if motion is None or (is_boost and not motion.word.startswith("translation")):
        return Meaning("boost" if is_boost else "shift")
    return Meaning(motion.word.replace("translation", "boost"), motion.bodies) if is_boost else motion


def _with_time(system: System, generator: Generator) -> str:
    if generator.time.has(system.t):
        return "scaling"
    return "time-and-shift" if generator.shifts else "time"


def _rigid(system: System, shifts: dict[str, sp.Expr]) -> Meaning | None:
    """The one rigid motion that all bodies make which move at all."""
    samples = {body.name: list(_samples(system, body.name, shifts)) for body in system.scene.bodies}
    turns = {body.name: list(_turns(system, body.name, shifts)) for body in system.scene.bodies}
    moving = [name for name in samples if _moves(samples[name]) or any(abs(t) > NEAR for t in turns[name])]
    pairs = [pair for name in moving for pair in samples[name]]
    if not pairs:
        return None
    word, speed = _word(pairs, len(system.scene.bodies[0].position))
    if not word or any(abs(abs(turn) - speed) > NEAR * (1 + speed) for name in moving for turn in turns[name]):
        return None
    return Meaning(word, tuple(moving) if len(moving) < len(samples) else ())


def _moves(samples: list[tuple[Row, Row]]) -> bool:
    return any(math.hypot(*change) > NEAR for _, change in samples)


def _samples(system: System, body: str, shifts: dict[str, sp.Expr]) -> Iterator[tuple[Row, Row]]:
    """r and δr at random points, the parameters the same at all."""
    position = list(system.position(body))
    change = [sp.Add(*(diff(x, system.q(q)) * shift for q, shift in shifts.items())) for x in position]
    values = _numbers(system, [*position, *change])
    for row in values:
        yield row[: len(position)], row[len(position) :]


def _turns(system: System, body: str, shifts: dict[str, sp.Expr]) -> Iterator[float]:
    """How fast a rigid body turns when the coordinates change like the shifts."""
    still = system.zero_rates
    moved = {system.rate(q): shifts.get(q, system.zero) for q in system.free}
    (found,) = (each for each in system.scene.bodies if each.name == body)
    for part in found.kinetics:
        if isinstance(part, Rotation):
            omega = [w.xreplace(moved) - w.xreplace(still) for w in system.angular_velocity(part)]
            yield from (math.hypot(*row) for row in _numbers(system, omega))


def _numbers(system: System, expressions: Sequence[sp.Expr]) -> Iterator[Row]:
    symbols = sorted(frozenset[sp.Symbol]().union(*(e.free_symbols for e in expressions)), key=str)
    source = random.Random(3)
    fixed = {symbol: source.uniform(0.5, 1.5) for symbol in symbols}
    functions = [compiled(e, {symbol: slot for slot, symbol in enumerate(symbols)}) for e in expressions]
    for _ in range(POINTS):
        known = system.parameter_values
        values = [fixed[symbol] if symbol in known else source.uniform(0.3, 1.7) for symbol in symbols]
        yield [function(values) for function in functions]


def _word(pairs: list[tuple[Row, Row]], dimension: int) -> tuple[str, float]:
    """The name of the rigid motion with these places and displacements, and its rate of turning; "" if it is none."""
    first = pairs[0][1]
    if all(_alike(change, first) for _, change in pairs):
        return _along("translation", first), 0.0
    for through_origin in (True, False):
        found = _fitted(pairs, dimension, through_origin=through_origin)
        if found is not None:
            shift, omega = found
            return _turned(shift, omega, through_origin=through_origin), math.hypot(*omega)
    return "", 0.0


def _turned(shift: Row, omega: Row, *, through_origin: bool) -> str:
    if len(omega) == 1:
        return "rotation-origin" if through_origin else "rotation-point"
    axis = _along("rotation", omega)
    if through_origin:
        return axis
    along = sum(a * w for a, w in zip(shift, omega, strict=True))
    return axis.replace("rotation", "screw") if abs(along) > NEAR else f"{axis}-elsewhere"


def _along(word: str, direction: Row) -> str:
    """With the axis, where it is one of the frame."""
    largest = max(range(len(direction)), key=lambda k: abs(direction[k]))
    rest = [entry for k, entry in enumerate(direction) if k != largest]
    return f"{word}-{AXES[largest]}" if all(abs(entry) < NEAR for entry in rest) else word


def _alike(one: Row, other: Row) -> bool:
    return all(abs(a - b) < NEAR for a, b in zip(one, other, strict=True))


def _fitted(pairs: list[tuple[Row, Row]], dimension: int, *, through_origin: bool) -> tuple[Row, Row] | None:
    """a and ω with δr = a + ω × r for all pairs: the solution of a + ω × r − s δr = 0 with s = 1."""
    rows = [row for place, change in pairs for row in _equations(place, change, dimension)]
    if through_origin:
        rows = [[0.0] * dimension + row[dimension:] for row in rows]
    vectors = kernel(rows, [1.0] * len(rows[0]))
    vector = next((v for v in vectors if abs(v[-1]) > NEAR), None)
    if vector is None:
        return None
    values = [entry / vector[-1] for entry in vector]
    return ([0.0] * dimension if through_origin else values[:dimension]), values[dimension:-1]


def _equations(place: Row, change: Row, dimension: int) -> Iterator[Row]:
    """For a, ω (one number in the plane) and s."""
    unit = [[float(i == k) for k in range(dimension)] for i in range(dimension)]
    if dimension == 2:
        x, y = place
        cross = [[-y], [x]]
    else:
        x, y, z = place
        cross = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
    for i in range(dimension):
        yield [*unit[i], *cross[i], -change[i]]
