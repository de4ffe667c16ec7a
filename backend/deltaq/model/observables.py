"""Functions of the state that somebody asks for, with their derivatives, at given values of the parameters.

The energy here is Jacobi's, h = q̇ · ∂L/∂q̇ − L: it is kept wherever nothing depends on the time explicitly and nothing
takes energy, also in a frame that turns; elsewhere it is E + V.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.7.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import symengine as se

from ..language.expression import Expression
from ..mechanics.scene import Scene
from .compiled import Compiled, compile_expressions
from .equations import Equations, equations, guided_into
from .functions import Expr
from .symbols import Symbols
from .symengine_algebra import to_symengine


@dataclass(frozen=True)
class Observable:
    """A function of q, q̇ and t, by what it depends on: places among (q, q̇), and whether on t.

    `jet` has its value and then its derivatives by q, q̇ and t; `turning` are the free coordinates in which it is linear
    with a factor of 1 or −1, so that where they are angles it means the same after a turn.
    """

    jet: Compiled
    places: tuple[int, ...]
    depends_on_time: bool
    turning: tuple[int, ...]

    @property
    def is_constant(self) -> bool:
        """Whether it has the same value in all states at all times."""
        return not self.places and not self.depends_on_time


@dataclass(frozen=True)
class Observables:
    """What can be asked of the states of a scene whose parameters have their values.

    Those of `kept` have none: they are inputs, behind q, q̇ and t.
    """

    scene: Scene
    kept: tuple[str, ...] = ()

    @cached_property
    def _equations(self) -> Equations:
        return equations(self.scene)

    @cached_property
    def _symbols(self) -> Symbols:
        return self._equations.symbols

    @cached_property
    def _numbers(self) -> Mapping[Expr, Expr]:
        """The values of the parameters."""
        values, fixed = self._symbols.values, [one for one in self.scene.parameters if one.name not in self.kept]
        return {values[one.name]: se.RealDouble(one.value) for one in fixed}

    @property
    def _inputs(self) -> tuple[Expr, ...]:
        return (*self._state, self._symbols.time, *(self._symbols.values[name] for name in self.kept))

    @property
    def _state(self) -> tuple[Expr, ...]:
        return self._symbols.inputs[: 2 * len(self._symbols.free)]

    @cached_property
    def depends_on_time(self) -> bool:
        """Whether the time stands in the equations of motion, or in what happens at impacts."""
        eqs, time = self._equations, self._symbols.time
        parts = (*(entry for row in eqs.mass_matrix for entry in row), *eqs.forcing, *self._impacts)
        return any(time in se.sympify(part).free_symbols for part in parts)

    def depends_at_impacts(self, name: str) -> bool:
        """Whether a parameter that is kept stands in what happens at impacts."""
        return any(self._symbols.values[name] in se.sympify(part).free_symbols for part in self._impacts)

    @property
    def _impacts(self) -> tuple[Expr, ...]:
        """The gaps of contacts, and their restitution."""
        laws = ((event.value, event.restitution) for event in self.scene.events if event.bounces)
        return tuple(self._written(each) for pair in laws for each in pair if each is not None)

    def _written(self, asked: Expression) -> Expr:
        found = guided_into(self.scene, to_symengine(asked.tree, self._symbols))
        return se.sympify(found).subs(self._numbers)

    def observable(self, asked: Expression) -> Observable:
        """One function. Raises SceneError where it has no real value whatever the state."""
        symbols, state, found = self._symbols, self._state, self._written(asked)
        used = found.free_symbols
        variables = (*state, symbols.time)
        slopes = [found.diff(each) for each in variables]
        return Observable(
            compile_expressions(self._inputs, [found, *slopes]),
            tuple(place for place, symbol in enumerate(state) if symbol in used),
            symbols.time in used,
            tuple(place for place in range(len(symbols.free)) if slopes[place] in (1, -1)),
        )

    def seen(self, asked: Sequence[Expression]) -> Compiled:
        """Several functions together, and the energy behind them; of q, q̇ and t."""
        outputs = [*(self._written(each) for each in asked), self._energy]
        return compile_expressions(self._inputs, outputs)

    @property
    def _energy(self) -> Expr:
        eqs = self._equations
        lagrangian = eqs.kinetic - eqs.potential
        rates = [self._symbols.rates[name] for name in self._symbols.free]
        found = sum((rate * lagrangian.diff(rate) for rate in rates), -lagrangian)
        return se.sympify(found).subs(self._numbers)
