"""How a holonomic constraint can be solved for coordinates, as expressions; each way with what it gives up.

linear       a q + b = 0, a constant                        q = −b/a
circle       k₁(x − x₀)² + k₂(y − y₀)² = R, R constant      x = x₀ + √(R/k₁) sin φ,  y = y₀ ± √(R/k₂) cos φ
sphere       the same of three coordinates                  two angles, away from their poles
loop         two conditions linear in sin ψ and cos ψ       ψ = atan2, and sin² + cos² = 1 remains to be kept
wave         α cos ψ + β sin ψ + γ = 0                      ψ = atan2(β, α) ± acos(−γ/√(α² + β²))
root         k q² + a q + b = 0, k constant                 q = (−a ± √(a² − 4kb))/(2k)
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import combinations

import symengine as se

from .functions import Expr
from .phase import vanishes
from .trigonometry import shortened
from .turned import Waves

HALF = se.Rational(1, 2)
COSINE, SINE = se.Symbol("cosine"), se.Symbol("sine")


@dataclass(frozen=True)
class Unsolved:
    """Conditions g = 0 in the symbols of `free` coordinates, of parameters and of the time.

    `lengths` are the parameters that are positive. `is_down`: the second of two axes points downwards.
    """

    conditions: tuple[Expr, ...]
    free: Mapping[str, Expr]
    lengths: tuple[Expr, ...]
    dimension: int
    is_down: bool

    def is_still(self, value: Expr) -> bool:
        """Whether it depends on no coordinate."""
        return not set(value.free_symbols) & set(self.free.values())

    def root(self, square: Expr) -> Expr:
        """√ of a positive square, a parameter if it is that of one."""
        return next((each for each in self.lengths if vanishes(square - each**2)), se.sqrt(square))


@dataclass(frozen=True)
class Way:
    """The `values` of coordinates given up, and the numbers of the conditions `solved` by that.

    `inverses` are the new coordinates, by symbols that stand for them in the values; `instead` are conditions that
    take the place of those solved. Where one of `guards` vanishes, the way has a pole or a fold. `waves` are sine and
    cosine of angles that are given up.
    """

    values: Mapping[str, Expr]
    solved: frozenset[int]
    inverses: Mapping[Expr, Expr] = field(default_factory=dict)
    instead: tuple[Expr, ...] = ()
    guards: tuple[Expr, ...] = ()
    waves: Mapping[str, Waves] = field(default_factory=dict)


def ways(unsolved: Unsolved) -> Iterator[Way]:
    """All of them, the simplest first."""
    flat = tuple(shortened(se.expand(_squared(each))) for each in unsolved.conditions)
    for kind in (_linear, _spheres, _circles, _loops, _waves, _roots):
        yield from kind(unsolved, flat)


def _squared(value: Expr) -> Expr:
    """a ± √D as a² − D, which is zero where that is."""
    parts = value.args if isinstance(value, se.Add) else (value,)
    roots = [part for part in parts if _is_root(part)]
    return (value - roots[0]) ** 2 - roots[0] ** 2 if len(roots) == 1 else value


def _is_root(part: Expr) -> bool:
    """Whether it is ±√D."""
    bare = -part if isinstance(part, se.Mul) and part.args[0] == -1 else part
    return isinstance(bare, se.Pow) and bare.args[1] == HALF


def _linear(unsolved: Unsolved, flat: tuple[Expr, ...]) -> Iterator[Way]:
    for number, value in enumerate(flat):
        for name, symbol in reversed(tuple(unsolved.free.items())):
            slope = value.diff(symbol)
            if not vanishes(slope) and unsolved.is_still(slope):
                rest = se.expand(value - slope * symbol)
                yield Way({name: se.expand(-rest / slope)}, frozenset({number}))


@dataclass(frozen=True)
class _Quadric:
    """Σ kᵢ (xᵢ − cᵢ)² = R of some coordinates, as centre cᵢ and radii √(R/kᵢ)."""

    centre: tuple[Expr, ...]
    radii: tuple[Expr, ...]

    @classmethod
    def of(cls, unsolved: Unsolved, value: Expr, names: tuple[str, ...]) -> _Quadric | None:
        symbols = tuple(unsolved.free[name] for name in names)
        curvatures = tuple(value.diff(symbol).diff(symbol) / 2 for symbol in symbols)
        if not all(unsolved.is_still(curvature) and not vanishes(curvature) for curvature in curvatures):
            return None
        if not all(vanishes(value.diff(one).diff(other)) for one, other in combinations(symbols, 2)):
            return None
        origin = dict.fromkeys(symbols, se.Integer(0))
        slopes = tuple(value.diff(symbol).subs(origin) for symbol in symbols)
        squares = (slope**2 / (4 * curvature) for slope, curvature in zip(slopes, curvatures, strict=True))
        size = shortened(se.expand(sum(squares, -value.subs(origin))))
        if not unsolved.is_still(size):
            return None
        centre = tuple(se.expand(-slope / (2 * curvature)) for slope, curvature in zip(slopes, curvatures, strict=True))
        return cls(centre, tuple(unsolved.root(se.expand(size / curvature)) for curvature in curvatures))


def _circles(unsolved: Unsolved, flat: tuple[Expr, ...]) -> Iterator[Way]:
    """The angle is zero where the point hangs below the centre, and grows towards the first axis."""
    angle, sign = se.Symbol("angle"), 1 if unsolved.is_down else -1
    for number, value in enumerate(flat):
        for names in combinations(unsolved.free, 2):
            found = _Quadric.of(unsolved, value, names)
            if found is None:
                continue
            across, down = found.radii[0] * se.sin(angle), sign * found.radii[1] * se.cos(angle)
            values = {names[0]: found.centre[0] + across, names[1]: found.centre[1] + down}
            x, y = _scaled(unsolved, found, names)
            yield Way(values, frozenset({number}), {angle: se.atan2(x, sign * y)})


def _spheres(unsolved: Unsolved, flat: tuple[Expr, ...]) -> Iterator[Way]:
    """Polar angle and azimuth; the polar axis is the third, which hangs down, or another one."""
    polar, azimuth = se.Symbol("polar"), se.Symbol("azimuth")
    sign = 1 if unsolved.is_down else -1
    parts = (se.sin(polar) * se.cos(azimuth), se.sin(polar) * se.sin(azimuth), sign * se.cos(polar))
    for number, value in enumerate(flat) if unsolved.dimension == 3 else ():
        for one, two, three in combinations(unsolved.free, 3):
            for names in ((one, two, three), (two, three, one), (three, one, two)):
                found = _Quadric.of(unsolved, value, names)
                if found is None:
                    break
                each = zip(names, found.centre, found.radii, parts, strict=True)
                values = {name: centre + radius * part for name, centre, radius, part in each}
                x, y, z = _scaled(unsolved, found, names)
                inverses = {polar: se.atan2(se.sqrt(x**2 + y**2), sign * z), azimuth: se.atan2(y, x)}
                yield Way(values, frozenset({number}), inverses, guards=(x**2 + y**2,))


def _scaled(unsolved: Unsolved, found: _Quadric, names: tuple[str, ...]) -> tuple[Expr, ...]:
    """(xᵢ − cᵢ)/√(R/kᵢ)"""
    parts = zip(names, found.centre, found.radii, strict=True)
    return tuple((unsolved.free[name] - centre) / radius for name, centre, radius in parts)


@dataclass(frozen=True)
class _Wave:
    """α cos ψ + β sin ψ + γ"""

    cosine: Expr
    sine: Expr
    rest: Expr

    @classmethod
    def of(cls, value: Expr, angle: Expr) -> _Wave | None:
        """None where the angle stands in it in another way."""
        put = {}
        for wave in value.atoms(se.sin, se.cos):
            turned = wave.args[0].diff(angle)
            if turned in (1, -1):
                rest = se.expand(wave.args[0] - turned * angle)
                parts = (se.sin(rest) * COSINE, turned * se.cos(rest) * SINE)
                turns = (se.cos(rest) * COSINE, -turned * se.sin(rest) * SINE)
                put[wave] = sum(parts) if isinstance(wave, se.sin) else sum(turns)
        found = se.expand(value.subs(put)) if put else value
        found = shortened(se.expand(found.subs({SINE**2: 1 - COSINE**2})))
        wave = cls(found.diff(COSINE), found.diff(SINE), found.subs({COSINE: 0, SINE: 0}))
        own = {angle, COSINE, SINE}
        is_plain = not any(set(each.free_symbols) & own for each in (wave.cosine, wave.sine, wave.rest))
        return wave if is_plain and not (vanishes(wave.cosine) and vanishes(wave.sine)) else None


def _loops(unsolved: Unsolved, flat: tuple[Expr, ...]) -> Iterator[Way]:
    for name, angle in reversed(tuple(unsolved.free.items())):
        found = {number: wave for number, value in enumerate(flat) if (wave := _Wave.of(value, angle)) is not None}
        for (i, one), (j, other) in combinations(found.items(), 2):
            base = shortened(se.expand(one.cosine * other.sine - other.cosine * one.sine))
            if vanishes(base):
                continue
            across = se.expand(other.rest * one.sine - one.rest * other.sine)
            along = se.expand(one.rest * other.cosine - other.rest * one.cosine)
            sine, cosine = se.expand(along / base), se.expand(across / base)
            kept = _primitive(shortened(se.expand(across**2 + along**2 - base**2)), unsolved)
            waves = {name: (sine, cosine)}
            yield Way({name: se.atan2(sine, cosine)}, frozenset({i, j}), instead=(kept,), waves=waves)


def _primitive(total: Expr, unsolved: Unsolved) -> Expr:
    """A sum without the positive parameters that all of its terms have as factors."""
    terms = total.args if isinstance(total, se.Add) else (total,)
    for length in unsolved.lengths:
        power = min(_power(term, length) for term in terms)
        terms = tuple(term / length**power for term in terms)
    return se.Add(*terms)


def _power(term: Expr, base: Expr) -> int:
    """How often a term has a factor, as it stands."""
    parts = term.args if isinstance(term, se.Mul) else (term,)
    found = (
        1 if part == base else int(part.args[1])
        for part in parts
        if base in (part, *part.args[:1]) and _counts(part, base)
    )
    return sum(found)


def _counts(part: Expr, base: Expr) -> bool:
    return part == base or (isinstance(part, se.Pow) and bool(part.args[1].is_Integer))


def _waves(unsolved: Unsolved, flat: tuple[Expr, ...]) -> Iterator[Way]:
    for number, value in enumerate(flat):
        for name, angle in reversed(tuple(unsolved.free.items())):
            found = _Wave.of(value, angle)
            if found is not None:
                yield from (replace(way, solved=frozenset({number})) for way in _angles(name, found))


def _angles(name: str, wave: _Wave) -> Iterator[Way]:
    """The two solutions within a turn."""
    pairs: tuple[tuple[Expr, Waves], ...]
    if vanishes(wave.cosine):
        share = se.expand(-wave.rest / wave.sine)
        other, angle = se.sqrt(1 - share**2), se.asin(share)
        pairs = ((angle, (share, other)), (se.pi - angle, (share, -other)))
    elif vanishes(wave.sine):
        share = se.expand(-wave.rest / wave.cosine)
        other, angle = se.sqrt(1 - share**2), se.acos(share)
        pairs = ((angle, (other, share)), (-angle, (-other, share)))
    else:
        size = shortened(se.expand(wave.cosine**2 + wave.sine**2))
        share, across = -wave.rest / se.sqrt(size), se.sqrt(se.expand(size - wave.rest**2))
        turns = (
            (sign * wave.cosine * across - wave.sine * wave.rest, -wave.cosine * wave.rest - sign * wave.sine * across)
            for sign in (1, -1)
        )
        pairs = tuple((se.atan2(sine, cosine), (sine / size, cosine / size)) for sine, cosine in turns)
    for value, waves in pairs:
        yield Way({name: value}, frozenset(), guards=(1 - share**2,), waves={name: waves})


def _roots(unsolved: Unsolved, flat: tuple[Expr, ...]) -> Iterator[Way]:
    for number, value in enumerate(flat):
        for name, symbol in reversed(tuple(unsolved.free.items())):
            curvature = value.diff(symbol).diff(symbol) / 2
            if vanishes(curvature) or not unsolved.is_still(curvature):
                continue
            slope, rest = (each.subs({symbol: 0}) for each in (value.diff(symbol), value))
            square = shortened(se.expand(slope**2 - 4 * curvature * rest))
            guard = square / (square + slope**2)
            for sign in (1, -1):
                found = (sign * se.sqrt(square) - slope) / (2 * curvature)
                yield Way({name: found}, frozenset({number}), guards=(guard,))
