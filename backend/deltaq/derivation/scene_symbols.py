"""The symbols of a scene: its own, and those that its derivation needs besides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..language.names import Names
from ..language.symbols import Symbols
from ..mechanics.scene import Scene

SMALL = ("h", "epsilon", "eta", "lambda")  # what the number may be called that a definition differentiates by


def fresh(names: Names, *candidates: str) -> sp.Symbol:
    """A symbol under the first of the candidates that names nothing else."""
    taken = {symbol.name for symbol in names.symbols}
    return sp.Symbol(next(name for name in candidates if name not in taken), real=True)


@dataclass(frozen=True, eq=False)
class SceneSymbols:
    """Coordinates, rates, accelerations and variations are plain symbols: `phi`, `dot(phi)`, `ddot(phi)`, `delta(phi)`.

    `free` are the coordinates that no guide prescribes.
    """

    scene: Scene

    @cached_property
    def symbols(self) -> Symbols:
        """The SymPy symbols of the scene's names."""
        return Symbols(self.scene.names)

    @cached_property
    def free(self) -> tuple[str, ...]:
        """Names of the coordinates that no guide prescribes."""
        return tuple(coordinate.name for coordinate in self.scene.free)

    @cached_property
    def coordinates(self) -> tuple[str, ...]:
        """Names of all coordinates, guided ones included."""
        return tuple(coordinate.name for coordinate in self.scene.coordinates)

    def q(self, name: str) -> sp.Symbol:
        """qᵢ, or any other name of the scene."""
        return self.symbols.name(name)

    def rate(self, name: str) -> sp.Symbol:
        """q̇ᵢ"""
        return self.symbols.rate(name, 1)

    def acceleration(self, name: str) -> sp.Symbol:
        """q̈ᵢ"""
        return self.symbols.rate(name, 2)

    def variation(self, name: str) -> sp.Symbol:
        """δqᵢ"""
        return self.symbols.variation(name)

    @property
    def t(self) -> sp.Symbol:
        return self.symbols.time

    @property
    def zero(self) -> sp.Expr:
        return sp.Integer(0)

    @property
    def zero_rates(self) -> dict[sp.Symbol, sp.Expr]:
        """q̇ᵢ = 0 of all free coordinates, to be put into what is asked for at rest."""
        return {self.rate(q): self.zero for q in self.free}

    def fresh(self, *candidates: str) -> sp.Symbol:
        """A symbol under the first of the candidates that the scene does not have."""
        return fresh(self.scene.names, *candidates)

    @cached_property
    def h(self) -> sp.Symbol:
        """The number that the definition of the first variation differentiates by."""
        return self.fresh(*SMALL)

    @cached_property
    def omega(self) -> sp.Symbol:
        """The circular frequency that an oscillation is sought with."""
        return self.fresh("omega", "nu", "Omega", "varpi", "w")

    @cached_property
    def exponent(self) -> sp.Symbol:
        """The number λ that a motion e^λt is sought with."""
        return self.fresh("lambda", "mu", "s", "sigma")

    @cached_property
    def ends(self) -> tuple[sp.Symbol, sp.Symbol]:
        """The instants between which the action is taken."""
        return self.fresh("t_0", "t_a", "tau_0"), self.fresh("t_1", "t_b", "tau_1")

    @cached_property
    def parameter_values(self) -> Mapping[sp.Symbol, sp.Rational]:
        """The scene's values of its parameters, as the decimals that the scene states."""
        return {self.q(p.name): sp.Rational(repr(float(p.value))) for p in self.scene.parameters}

    @cached_property
    def variations(self) -> Mapping[sp.Symbol, sp.Symbol]:
        """δq of every free coordinate q."""
        return {self.q(name): self.variation(name) for name in self.free}
