"""What symmetries are made of: monomials of a generator, the generator, and Noether's condition for each in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Literal

import sympy as sp

from ..language.memory import cached_method
from .compiled import Function, compiled
from .elimination import Row
from .space import Motion, displacements
from .system import System

MOST_MIXED = 90  # coefficients of coordinates in one another's shifts: beyond it only shifts are tried

Kind = Literal["shift", "linear", "space", "boost", "time", "scaling"]


@dataclass(frozen=True)
class Monomial:
    """One unknown coefficient of a generator.

    `shift` is ξᵢ = 1, `linear` ξᵢ = qₖ, `boost` ξᵢ = t; `time` is τ = 1, `scaling` τ = t. `space` is ξ of space moved
    as a whole, as in `displacements`.
    """

    kind: Kind
    moved: str = ""
    by: str = ""
    motion: Motion | None = None


@dataclass(frozen=True)
class Generator:
    """q → q + ε ξ, t → t + ε τ. `shifts` holds the ξᵢ that are not zero, by coordinate."""

    shifts: Mapping[str, sp.Expr]
    time: sp.Expr

    def characteristic(self, system: System) -> dict[str, sp.Expr]:
        """ξᵢ − τ q̇ᵢ, the change at a fixed time, where it is not zero."""
        moved = system.free if self.time != 0 else tuple(self.shifts)
        changes = {q: self.shifts.get(q, system.zero) - self.time * system.rate(q) for q in moved}
        return {q: change for q, change in changes.items() if change != 0}


@dataclass(frozen=True)
class Symmetry:
    """A generator, the gauge function F and the integral I; `conditions` are what must be zero of the parameters."""

    generator: Generator
    gauge: sp.Expr
    value: sp.Expr
    conditions: tuple[sp.Expr, ...] = ()

    def gauge_at_fixed_time(self, system: System) -> sp.Expr:
        """F − τ L, of which the change at a fixed time is the derivative."""
        return self.gauge - self.generator.time * system.lagrangian


@cached_method
def monomials(system: System) -> tuple[Monomial, ...]:
    """Coordinates mix only where both have one unit and neither is an angle in a sine or cosine."""
    laws = sp.Tuple(system.lagrangian, *forces(system).values())
    in_waves = frozenset[sp.Symbol]().union(*(wave.free_symbols for wave in laws.atoms(sp.sin, sp.cos)))
    straight = [q for q in system.free if system.q(q) not in in_waves]
    units = {coordinate.name: coordinate.unit for coordinate in system.scene.coordinates}
    pairs = [(a, b) for a, b in product(straight, repeat=2) if units[a] == units[b]]
    shifts = [Monomial("shift", q) for q in system.free]
    mixed = [Monomial("linear", a, b) for a, b in pairs] if len(pairs) <= MOST_MIXED else []
    boosts = [Monomial("boost", q) for q in system.free]
    moved = [Monomial("space", motion=motion) for motion in displacements(system)]
    return (*shifts, *mixed, *moved, *boosts, Monomial("time"), Monomial("scaling"))


@cached_method
def forces(system: System) -> dict[str, sp.Expr]:
    """∂L/∂qᵢ + Qᵢᵈ"""
    slopes = {q: system.slope(system.lagrangian, system.q(q)) for q in system.free}
    return {q: slope + system.nonconservative_force(q) for q, slope in slopes.items()}


@cached_method
def clock(system: System) -> sp.Expr:
    """∂L/∂t − Σ Qᵢᵈ q̇ᵢ"""
    power = sp.Add(*(system.nonconservative_force(q) * system.rate(q) for q in system.free))
    return system.slope(system.lagrangian, system.t) - power


@cached_method
def numeric(system: System) -> Numeric:
    """Noether's condition compiled for floats: t, the free q, their rates and the parameters, in this order."""
    moving = [system.t, *map(system.q, system.free), *map(system.rate, system.free)]
    slots = {symbol: slot for slot, symbol in enumerate((*moving, *system.parameter_values))}
    momenta = [system.momentum(q) for q in system.free]
    parts = [*forces(system).values(), *momenta, clock(system), system.lagrangian]
    moved = {
        motion: {
            q: (compiled(shift, slots), compiled(system.time_derivative(shift), slots)) for q, shift in shifts.items()
        }
        for motion, shifts in displacements(system).items()
    }
    return Numeric(monomials(system), system.free, tuple(compiled(part, slots) for part in parts), moved)


@dataclass(frozen=True)
class Numeric:
    """Noether's condition in floats: what each monomial changes at a point."""

    monomials: tuple[Monomial, ...]
    free: tuple[str, ...]
    functions: tuple[Function, ...]
    displaced: Mapping[Motion, Mapping[str, tuple[Function, Function]]]  # ξᵢ and ξ̇ᵢ of space moved as a whole

    def row(self, values: Row) -> Row:
        """One number for each monomial."""
        n = len(self.free)
        found = [function(values) for function in self.functions]
        force, momentum = dict(zip(self.free, found, strict=False)), dict(zip(self.free, found[n:], strict=False))
        place, speed = (
            dict(zip(self.free, values[1:], strict=False)),
            dict(zip(self.free, values[n + 1 :], strict=False)),
        )
        t, clock, lagrangian = values[0], found[2 * n], found[2 * n + 1]
        work = sum(momentum[q] * speed[q] for q in self.free)

        def change(monomial: Monomial) -> float:
            q, by = monomial.moved, monomial.by
            match monomial.kind:
                case "shift":
                    return force[q]
                case "linear":
                    return place[by] * force[q] + speed[by] * momentum[q]
                case "space":
                    return sum(self._moved(monomial, values, force, momentum))
                case "boost":
                    return t * force[q] + momentum[q]
                case "time":
                    return clock
                case "scaling":
                    return t * clock + lagrangian - work

        return [change(monomial) for monomial in self.monomials]

    def sizes(self, values: Row) -> Row:
        """The same without what cancels: where space is moved, all of it may."""
        found = self.row(values)
        laws = [function(values) for function in self.functions]
        force, momentum = (dict(zip(self.free, laws[k:], strict=False)) for k in (0, len(self.free)))
        return [
            sum(map(abs, self._moved(monomial, values, force, momentum))) if monomial.kind == "space" else abs(change)
            for monomial, change in zip(self.monomials, found, strict=True)
        ]

    def _moved(
        self, monomial: Monomial, values: Row, force: Mapping[str, float], momentum: Mapping[str, float]
    ) -> Iterator[float]:
        """Term by term ξᵢ Fᵢ + ξ̇ᵢ pᵢ."""
        parts = self.displaced[monomial.motion] if monomial.motion else {}
        for q, (shift, rate) in parts.items():
            yield from (shift(values) * force[q], rate(values) * momentum[q])


def solved(conditions: Sequence[sp.Expr], system: System) -> dict[sp.Symbol, sp.Expr]:
    """Parameters by the others, one for each condition: as it is linear in one, else by the scene's own value."""
    found: dict[sp.Symbol, sp.Expr] = {}
    for condition in conditions:
        left = condition.xreplace(found)
        symbols = sorted(left.free_symbols, key=str)
        linear = [s for s in symbols if left.diff(s) != 0 and not left.diff(s).has(s)]
        if linear:
            found[linear[-1]] = sp.cancel(linear[-1] - left / left.diff(linear[-1]))
        else:
            found |= {symbol: system.parameter_values[symbol] for symbol in symbols}
    return found
