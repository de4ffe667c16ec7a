"""A motion in general: r(P, t, q₁ … q_f), forces and a potential, of which nothing is known but what they depend on.

The proof is carried out for f = 2 and two components; nothing in it uses these numbers. One material coordinate P
stands for all, since only the linearity of the integral is used. `arbitrary()` takes undefined SymPy functions, for the
computer algebra; `sample()` takes concrete ones, at which the same lines are evaluated as numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import sympy as sp

from ..language.memory import cached_method
from ..language.spelling import spell_rate
from .calculus import column
from .formula import Bounds, Each, Formula, Summed, Value

FREEDOM = 2
COMPONENTS = 2
VARIABLES = 3
# Plain functions are x(t), with directions v(t); the vector argument of a function of several variables is x_1 … x_3.
MOVING = ("q_1", "q_2", "x", "v", "x_1", "x_2", "x_3", "v_1", "v_2", "v_3")

Make = Callable[[str, tuple[sp.Expr, ...]], sp.Expr]


def symbol(name: str) -> sp.Symbol:
    """A real symbol; letters of the proof are no coordinates of a scene."""
    return sp.Symbol(name, real=True)


P, T, H, T0 = symbol("P"), symbol("t"), symbol("h"), symbol("t_0")
BODY = Bounds(P, sp.Integer(0), sp.Integer(1))


def q(index: str) -> sp.Symbol:
    """qᵢ"""
    return symbol(f"q_{index}")


def rate(index: str) -> sp.Symbol:
    """q̇ᵢ"""
    return symbol(spell_rate(f"q_{index}", 1))


def variation(index: str) -> sp.Symbol:
    """δqᵢ"""
    return symbol(f"delta(q_{index})")


def summed(term: Callable[[str], Formula], index: str = "k", count: int = FREEDOM) -> Summed:
    """The sum over a repeated index."""
    return Summed(term(index), tuple(term(str(n)) for n in range(1, count + 1)))


def each(formula: Callable[[str], Formula], count: int = FREEDOM) -> Each:
    """The formula for every value of the free index i."""
    return Each(formula("i"), tuple(formula(str(n)) for n in range(1, count + 1)))


@dataclass(frozen=True)
class AbstractMotion:
    """What the proof speaks of. `make` gives the function of a name and arguments."""

    make: Make

    @property
    def position(self) -> sp.ImmutableMatrix:
        """r(P, t, q)"""
        return column(self.make(f"r{k}", (P, T, *_coordinates())) for k in range(1, COMPONENTS + 1))

    @property
    @cached_method
    def velocity(self) -> sp.ImmutableMatrix:
        """v = dr/dt"""
        return total_rate(self.position)

    @property
    @cached_method
    def acceleration(self) -> sp.ImmutableMatrix:
        """a = dv/dt"""
        return total_rate(self.velocity)

    @property
    def density(self) -> sp.Expr:
        """dm = ρ dP"""
        return self.make("rho", (P,))

    def force_density(self, region: str) -> sp.ImmutableMatrix:
        """f_S, f_V: forces that depend on place, motion and time."""
        arguments = (P, T, *_coordinates(), *_rates())
        return column(self.make(f"f{region}{k}", arguments) for k in range(1, COMPONENTS + 1))

    @property
    def potential(self) -> sp.Expr:
        """V(q)"""
        return self.make("V", _coordinates())

    def dissipative(self, index: str) -> sp.Expr:
        """Qᵢᵈ; with the index i any of them, which is never evaluated."""
        return self.make(f"D{index}", (T, *_coordinates(), *_rates()))

    def force(self, index: str) -> sp.Expr:
        """Qᵢ = −∂V/∂qᵢ + Qᵢᵈ, an arbitrary function all the same."""
        return self.dissipative(index) - self.potential.diff(q(index))

    def function(self, *arguments: sp.Expr) -> sp.Expr:
        """f of one or several variables."""
        return self.make(f"f{len(arguments)}", arguments)


def _coordinates() -> tuple[sp.Symbol, ...]:
    return tuple(q(str(n)) for n in range(1, FREEDOM + 1))


def _rates() -> tuple[sp.Symbol, ...]:
    return tuple(rate(str(n)) for n in range(1, FREEDOM + 1))


def total_rate(value: Value) -> Value:
    """d/dt along the motion, by the chain rule; also of undefined functions."""
    present = value.free_symbols
    chain = [(symbol(spell_rate(x, n)), symbol(spell_rate(x, n + 1))) for x in MOVING for n in range(2)]
    return sum((value.diff(x) * speed for x, speed in chain if x in present), value.diff(T))


def arbitrary() -> AbstractMotion:
    """Nothing is known of the functions."""
    return AbstractMotion(lambda name, arguments: sp.Function(name, real=True)(*arguments))


def sample() -> AbstractMotion:
    """Waves and products of the arguments, different for every name."""

    def make(name: str, arguments: tuple[sp.Expr, ...]) -> sp.Expr:
        seed = sum(ord(letter) * (place + 3) for place, letter in enumerate(name))
        phase = sum(((seed + 5 * n) % 7 + 1) * argument / 4 for n, argument in enumerate(arguments))
        squares = sum(((seed + 3 * n) % 5 - 2) * argument**2 for n, argument in enumerate(arguments))
        return sp.sin(phase) + squares / 8 + sp.Mul(*arguments) / 16 + 2

    return AbstractMotion(make)
