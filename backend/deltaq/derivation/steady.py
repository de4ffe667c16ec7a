"""Relative equilibria: motions in which the cyclic coordinates run evenly and everything else rests.

With constant momenta p of the cyclic coordinates, Routh's function is a Lagrange function of the others. At rest of
these it is −U(q, p), and its equilibria are the steady motions: ∂U/∂q = 0, which is ∂L/∂q = 0 at q̇ = 0. Here one
coordinate is left, which rests where the scene starts; the condition, of second degree in a cyclic rate, is solved for
that. The motion is stable for given momenta if ∂²U/∂q² > 0, and unstable if it is negative.
Source: Routh, Stability of a Given State of Motion (1877); Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §3.3
(circular orbits), §5.7 (regular precession); Merkin, Introduction to the Theory of Stability, §3.5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from ..language.derivatives import beside_jumps, diff
from ..language.memory import cached_method
from ..vocabulary import Stability
from .compiled import compiled
from .conservation import Reduction, reduction
from .matrix_form import is_autonomous
from .system import System

NOTHING = 1e-9  # of ∂²U/∂q², relative to its terms


@dataclass(frozen=True)
class SteadyMotion:
    """`coordinate` rests anywhere, `turning` has the `rate` that this asks for; `square` is Ω² where that is simpler.

    Numbers are those where the scene starts.
    """

    system: System = field(compare=False)
    reduction: Reduction
    coordinate: str
    turning: str
    rate: sp.Expr
    square: sp.Expr | None

    @cached_property
    def potential(self) -> sp.Expr:
        """U(q, p) = −R at q̇ = 0"""
        system = self.system
        return system.display(-self.reduction.function.xreplace({system.rate(self.coordinate): system.zero}))

    @cached_property
    def momenta(self) -> dict[sp.Symbol, sp.Expr]:
        """The constant momenta of this motion, with the rate put in or, where that is longer, by its symbol."""
        given = self.steady if self.square is not None else {self.system.rate(self.coordinate): self.system.zero}
        return {p: self.system.momentum(q).xreplace(given) for q, p in self.reduction.momenta.items()}

    @cached_property
    def steady(self) -> dict[sp.Symbol, sp.Expr]:
        """The rates that are given."""
        system = self.system
        return {system.rate(self.coordinate): system.zero, system.rate(self.turning): self.rate}

    @cached_property
    def curvature(self) -> sp.Expr:
        """∂²U/∂q² at fixed momenta in this motion, or in the same rates −L_qq + L_qΩ A⁻¹ L_Ωq with A = L_ΩΩ."""
        system, q = self.system, self.system.q(self.coordinate)
        if self.square is not None:
            return system.display(_curvature(self.potential, q).xreplace(self.momenta))
        lagrangian = system.lagrangian.xreplace({system.rate(self.coordinate): system.zero})
        rates = [system.rate(turning) for turning in self.reduction.momenta]
        slopes = [system.slope(lagrangian, q).diff(rate) for rate in rates]
        inertia = [[lagrangian.diff(a, b) for a in rates] for b in rates]
        return sp.Add(system.display(-_curvature(lagrangian, q)), *_squares(system, inertia, slopes))

    @cached_property
    def numbers(self) -> Mapping[sp.Symbol, float]:
        """Where the scene starts, with the rate of this motion; other cyclic rates are as they are there."""
        start = numbers_at_start(self.system)
        return {**start, self.system.rate(self.turning): value_of(self.rate, start)}

    @property
    def number(self) -> float:
        """The rate where the scene starts."""
        return self.numbers[self.system.rate(self.turning)]

    @cached_property
    def stability(self) -> Stability:
        """By the sign of ∂²U/∂q² where the scene starts."""
        terms = [value_of(term, self.numbers) for term in sp.Add.make_args(self.curvature)]
        total, size = math.fsum(terms), math.fsum(map(abs, terms))
        if not math.isfinite(total) or abs(total) <= NOTHING * size:
            return "undecided"
        return "stable" if total > 0 else "unstable"

    @cached_property
    def frequency(self) -> float | None:
        """ω in rad/s of the small oscillations about a stable one."""
        inertia = self.reduction.function.diff(self.system.rate(self.coordinate), 2)
        mass, stiffness = (value_of(part, self.numbers) for part in (inertia, self.curvature))
        return math.sqrt(stiffness / mass) if self.stability == "stable" and mass > 0 else None

    @property
    def initial(self) -> dict[str, tuple[float, float]]:
        """Value and rate of every free coordinate at the start of this motion."""
        rates = {self.coordinate: 0.0, self.turning: self.number}
        start = self.system.scene.free
        return {c.name: (float(c.value), rates.get(c.name, float(c.rate))) for c in start}


def _curvature(value: sp.Expr, q: sp.Symbol) -> sp.Expr:
    """∂²value/∂q², where no slope jumps."""
    return beside_jumps(diff(diff(value, q), q))


@cached_method
def steady_motions(system: System) -> tuple[SteadyMotion, ...]:
    """Those at the position where the scene starts. None where something else moves than one coordinate, where forces
    have no potential, or where time is in the laws; none where no cyclic rate can hold the coordinate there.
    """
    reduced = reduction(system)
    passive = all(system.is_zero(system.nonconservative_force(q)) for q in system.free)
    if reduced is None or not passive or len(system.free) - len(reduced.momenta) != 1 or not is_autonomous(system):
        return ()
    (coordinate,) = (q for q in system.free if q not in reduced.momenta)
    still = {system.rate(coordinate): system.zero}
    condition = system.slope(system.lagrangian, system.q(coordinate)).xreplace(still)
    found = ((turning, list(_rates(system, condition, turning))) for turning in reduced.momenta)
    turning, rates = next(((turning, rates) for turning, rates in found if rates), ("", []))
    motions = (SteadyMotion(system, reduced, coordinate, turning, *rate) for rate in rates)
    return tuple(motion for motion in motions if math.isfinite(motion.number))


def _rates(system: System, condition: sp.Expr, turning: str) -> Iterator[tuple[sp.Expr, sp.Expr | None]]:
    """The roots of a Ω² + b Ω + c = 0, with Ω² where b = 0; of two that differ by sign alone, the positive one."""
    rate = system.rate(turning)
    parts = (condition.diff(rate, 2) / 2, condition.diff(rate), condition)
    if parts[0].has(rate):
        return
    a, b, c = _without_common_factor([system.display(part.xreplace({rate: system.zero})) for part in parts])
    if c == 0 or (a == 0 and b == 0):
        return
    if b == 0:
        square = system.display(sp.cancel(-c / a))
        yield sp.sqrt(square), square
    elif a == 0:
        yield system.display(sp.cancel(-c / b)), None
    else:
        root = sp.sqrt(system.display(b**2 - 4 * a * c))
        yield from (((-b + sign * root) / (2 * a), None) for sign in (1, -1))


def _squares(system: System, matrix: list[list[sp.Expr]], vector: list[sp.Expr]) -> Iterator[sp.Expr]:
    """The summands of vᵀ A⁻¹ v, completed to squares one by one; A is symmetric and positive."""
    if not vector:
        return
    *rows, last = matrix
    pivot, entry = system.display(last[-1]), system.display(vector[-1])
    yield entry**2 / pivot
    ratios = [system.display(sp.cancel(row[-1] / pivot)) for row in rows]
    rest = [[row[k] - ratio * last[k] for k in range(len(rows))] for row, ratio in zip(rows, ratios, strict=True)]
    shorter = [v - ratio * entry for v, ratio in zip(vector, ratios, strict=False)]
    yield from _squares(system, [list(map(system.display, row)) for row in rest], shorter)


def _without_common_factor(parts: list[sp.Expr]) -> list[sp.Expr]:
    """Divided by the factors that all have which are not zero."""
    factors = [set(sp.Mul.make_args(part)) for part in parts if part != 0]
    common = sp.Mul(*set.intersection(*factors)) if factors else sp.Integer(1)
    return [part / common for part in parts]


@cached_method
def numbers_at_start(system: System) -> Mapping[sp.Symbol, float]:
    """Parameters, coordinates and rates as the scene states them."""
    found = {symbol: float(value) for symbol, value in system.parameter_values.items()}
    found |= {system.q(c.name): float(c.value) for c in system.scene.free}
    return found | {system.rate(c.name): float(c.rate) for c in system.scene.free}


def value_of(expression: sp.Expr, numbers: Mapping[sp.Symbol, float]) -> float:
    """The expression in floats, NaN where it is not defined."""
    slots = {symbol: slot for slot, symbol in enumerate(numbers)}
    return compiled(expression, slots)(list(numbers.values()))
