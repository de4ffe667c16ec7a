"""The numeric model of a scene, ready to run."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TypeVar, cast

import symengine as se

from ..mechanics.mechanics import Mechanics
from ..mechanics.scene import Scene
from .compiled import QUICK, THOROUGH, Compiled, Floats, compile_expressions
from .constraints import ConstraintEquations
from .disturbance import disturbed
from .equations import Equations, equations
from .functions import Expr
from .kicks import compiled_kicks
from .layout import Layout
from .linear_system import LinearSystem, linear_system
from .parts import parts
from .phase import PhaseSpace, phase_space
from .pushes import Pushes, compiled_pushes
from .recurrence_writer import recurrences_of
from .recurrences import Recurrences
from .solved import CompiledSolution, compiled_solution
from .symbols import Symbols
from .tape import Tape, shared_tape_of, tape_of

T = TypeVar("T")
DISTURBANCE = 2.0**-42  # 2¹⁰ units in the last place


@dataclass(frozen=True)
class Observation:
    """What can be seen of a motion at its samples.

    `kinetic` and `potential` have shape (samples,). By name, `values` and `rates` of guided coordinates have shape
    (samples,), `positions` and `arrows` (force vectors) shape (samples, dimension).
    """

    kinetic: Floats
    potential: Floats
    values: Mapping[str, Floats]  # of guided coordinates
    rates: Mapping[str, Floats]
    positions: Mapping[str, Floats]  # shape (samples, dimension)
    arrows: Mapping[str, Floats]


@dataclass
class Usage:
    """How many right-hand sides have run in code that was compiled quickly."""

    evaluations: int = 0


@dataclass(frozen=True)
class Model:
    """M(q, t) q̈ = f(q, q̇, t) as machine code; parameters are inputs, so new values need no new model.

    `motion` gives the lower triangle of M (row by row), f and, where power is fed in, P₀ and p₁ of P = P₀ + p₁·q̈; where
    there are constraints A (row by row), γ and b follow, and M q̈ = f + Aᵀλ, A q̈ = γ. `gaps` gives how far a state is
    from keeping them: g of the holonomic ones, then w = A q̇ + b of all.
    `observed` gives E, V, values and rates of guided coordinates, positions and force vectors; `events`, of scenes that
    have any, what is positive as long as none has happened; `switches`, of those with dry friction, what changes its
    sign where a force jumps with a rate. `eqs` are what all of it was made of.
    """

    layout: Layout
    motion: Compiled
    events: Compiled | None
    switches: Compiled | None
    gaps: Compiled | None
    eqs: Equations = field(repr=False, compare=False)
    scene: Scene = field(repr=False, compare=False)
    of: Callable[[Scene], Equations] = field(default=equations, repr=False, compare=False)
    usage: Usage = field(default_factory=Usage, init=False, repr=False, compare=False)
    _made: dict[Hashable, object] = field(default_factory=dict, init=False, repr=False, compare=False)
    _latest: dict[Hashable, tuple[Hashable, object]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def __getstate__(self) -> dict[str, object]:
        """All but what was made along the way: code for series has addresses of this process."""
        return {**self.__dict__, "_made": {}, "_latest": {}}

    @cached_property
    def observed(self) -> Compiled:
        """E, V and what is drawn; made when first asked for, as all that follows. Raises SceneError as `build` does."""
        eqs = self.eqs
        vectors = [*eqs.positions.values(), *eqs.arrows.values()]
        seen = [eqs.kinetic, eqs.potential, *_guided(eqs), *(x for vector in vectors for x in vector)]
        return compile_expressions(eqs.symbols.inputs, seen)

    def system(self, inputs: Floats) -> LinearSystem:
        """M q̈ = f + Aᵀλ, A q̈ = γ at states whose inputs are given: shape (states, inputs)."""
        return linear_system(self.layout, self.motion.table(inputs))

    def system_at(self, row: Floats) -> LinearSystem:
        """The same at one state, without an axis of states, from its inputs as a row of shape (inputs,)."""
        return linear_system(self.layout, self.motion.at(row))

    @cached_property
    def tape(self) -> Tape:
        """The operations of M and f, of the values of guided coordinates and of their rates, of A and γ."""
        return tape_of(self.eqs.symbols.inputs, _of_tape(self.eqs))

    @cached_property
    def audited(self) -> Tape:
        """The same, and behind them the values of events, which are to be seen as well as forces."""
        values = [self.eqs.events[index] for index in self.seen_events]
        return tape_of(self.eqs.symbols.inputs, [*_of_tape(self.eqs), *values]) if values else self.tape

    @cached_property
    def seen_events(self) -> tuple[int, ...]:
        """The events that end its motions, by number, or (in modes) its stretches: all that are watched."""
        if self.is_in_modes:
            return tuple(range(len(self.eqs.events)))
        return tuple(i for i, each in enumerate(self.scene.events) if not each.bounces)

    @cached_property
    def thorough(self) -> Compiled:
        """The same as `motion`, in machine code whose compilation pays in long runs."""
        return compile_expressions(self.eqs.symbols.inputs, of_motion(self.eqs), THOROUGH)

    @cached_property
    def thorough_gaps(self) -> Compiled | None:
        """The same as `gaps`, in code for long runs."""
        return _missed(self.eqs, THOROUGH)

    def solution(self, *, is_long: bool) -> CompiledSolution | None:
        """Where there are constraints, the motion solved for in symbols, in code as `motion` or as `thorough`."""
        return self._thorough_solution if is_long else self._quick_solution

    @cached_property
    def _quick_solution(self) -> CompiledSolution | None:
        return compiled_solution(self.eqs, QUICK)

    @cached_property
    def _thorough_solution(self) -> CompiledSolution | None:
        return compiled_solution(self.eqs, THOROUGH)

    @cached_property
    def pushes(self) -> Pushes | None:
        """What keeps kicks and drifts on constraints, for long runs; compiled when a method first asks for it."""
        return compiled_pushes(self.eqs)

    @cached_property
    def kicks(self) -> Compiled | None:
        """What corrects a stage and the kick that keeps constraints, for long runs; compiled as `pushes` are."""
        return compiled_kicks(self.eqs)

    @cached_property
    def disturbed(self) -> Model:
        """The same with every entry of M and f disturbed by about a thousand times its rounding error."""
        return build(disturbed(self.eqs, DISTURBANCE), self.scene, self.of)

    @property
    def is_in_modes(self) -> bool:
        """Whether its last parameters are modes, in which runs go on behind events (`modes`)."""
        return self.of is not equations

    def kept(self, key: Hashable, make: Callable[[], T]) -> T:
        """What was made of this model before under a key, made now if it was not."""
        if key not in self._made:
            self._made[key] = make()
        return cast("T", self._made[key])

    def latest(self, key: Hashable, of: Hashable, make: Callable[[], T]) -> T:
        """What was made under a key, if it was last made of the same; else made now, and kept instead."""
        known = self._latest.get(key)
        if known is None or known[0] != of:
            known = self._latest[key] = of, make()  # one assignment: others may ask at the same time
        return cast("T", known[1])

    def has(self, key: Hashable) -> bool:
        """Whether something is kept under a key."""
        return key in self._made

    def settle(self) -> None:
        """From now on all runs are in the same, thorough code: for those who compare times."""
        _ = self.thorough

    @property
    def is_thorough(self) -> bool:
        """Whether `thorough` is there already."""
        return "thorough" in self.__dict__

    @cached_property
    def recurrences(self) -> Recurrences:
        """The model for Taylor series; made when a method first asks for them."""
        eqs = self.eqs
        inputs = eqs.symbols.inputs
        tape = shared_tape_of(inputs, of_motion(eqs), inputs[2 * self.layout.degrees + 1 :])
        return recurrences_of(tape, self.layout.degrees, is_powered=eqs.is_powered)

    @cached_property
    def phase(self) -> PhaseSpace:
        """Momenta and their rates; compiled when a method first asks for them."""
        return phase_space(self.eqs)

    def observe(self, inputs: Floats) -> Observation:
        """What is seen at each row of inputs, shape (samples, inputs)."""
        layout, table = self.layout, self.observed.table(inputs)
        guided, size = len(layout.guided), layout.dimension
        first_place = 2 + 2 * guided
        first_arrow = first_place + size * len(layout.places)
        return Observation(
            table[:, 0],
            table[:, 1],
            {name: table[:, 2 + i] for i, name in enumerate(layout.guided)},
            {name: table[:, 2 + guided + i] for i, name in enumerate(layout.guided)},
            _vectors(table, first_place, size, layout.places),
            _vectors(table, first_arrow, size, layout.arrows),
        )


def _vectors(table: Floats, first: int, size: int, names: tuple[str, ...]) -> dict[str, Floats]:
    return {name: table[:, first + size * i : first + size * (i + 1)] for i, name in enumerate(names)}


def compile_model(scene: Scene) -> Model:
    """The model of a scene, built and compiled; it is kept as long as the process lives.

    Scenes that differ only in numbers, titles and drawing share theirs. None is kept on disk: what would be worth it is
    machine code, which whoever can write it can run, and compiling takes but 4 ms (22 ms for twelve links).
    """
    return _compiled_once(ByMechanics.of(scene))


@dataclass(frozen=True)
class ByMechanics:
    """A scene, equal to all others with the same mechanics."""

    mechanics: Mechanics
    scene: Scene = field(compare=False)

    @classmethod
    def of(cls, scene: Scene) -> ByMechanics:
        """A scene by its mechanics."""
        return cls(scene.mechanics, scene)


@lru_cache(maxsize=64)
def _compiled_once(found: ByMechanics) -> Model:
    return build(equations(found.scene), found.scene)


def build(eqs: Equations, scene: Scene, of: Callable[[Scene], Equations] = equations) -> Model:
    """The model of a scene whose equations are at hand, compiled quickly; `of` tells how they are made of the scene.

    Raises SceneError if one of them has no real value whatever the inputs.
    """
    symbols = eqs.symbols
    switches = _switches(eqs)
    layout = Layout(
        symbols.free,
        symbols.guided,
        symbols.parameters,
        tuple(eqs.positions),
        tuple(eqs.arrows),
        scene.dimension,
        eqs.is_powered,
        tuple(_movers(switch, symbols) for switch in switches),
        eqs.constraints.names,
        len(eqs.constraints.gaps),
        eqs.constraints.places,
    )
    model = Model(
        layout,
        compile_expressions(symbols.inputs, of_motion(eqs)),
        compile_expressions(symbols.inputs, eqs.events) if eqs.events else None,
        compile_expressions(symbols.inputs, switches) if switches else None,
        _missed(eqs, QUICK),
        eqs,
        scene,
        of,
    )
    if eqs.guided:  # what a guide prescribes may stand nowhere else, and have no value
        _ = model.observed
    return model


def _missed(eqs: Equations, effort: int) -> Compiled | None:
    """What `Model.gaps` computes."""
    held = eqs.constraints
    return compile_expressions(eqs.symbols.inputs, [*held.gaps, *held.slips], effort) if held.slips else None


def _of_tape(eqs: Equations) -> list[Expr]:
    """M and f, values of guided coordinates and their rates, A and γ."""
    held = eqs.constraints
    return [*_triangle(eqs), *eqs.forcing, *_guided(eqs), *_rows(held), *held.accelerations]


def of_motion(eqs: Equations) -> list[Expr]:
    """What `Model.motion` computes."""
    power, held = [eqs.power, *eqs.acceleration_power] if eqs.is_powered else [], eqs.constraints
    return [*_triangle(eqs), *eqs.forcing, *power, *_rows(held), *held.accelerations, *held.drives]


def _rows(held: ConstraintEquations) -> list[Expr]:
    """A by rows."""
    return [entry for row in held.jacobian for entry in row]


def _guided(eqs: Equations) -> list[Expr]:
    """Values of guided coordinates, then their rates."""
    return [value for value, _ in eqs.guided.values()] + [rate for _, rate in eqs.guided.values()]


def _triangle(eqs: Equations) -> list[Expr]:
    """The lower triangle of M by rows."""
    return [entry for i, row in enumerate(eqs.mass_matrix) for entry in row[: i + 1]]


def _switches(eqs: Equations) -> list[Expr]:
    """The differences of rates (and what else) on whose sign the forces depend."""
    rates = {eqs.symbols.rates[name] for name in eqs.symbols.free}
    conditions = {condition for choice in parts(eqs.forcing, se.Piecewise) for condition in choice.args[1::2]}
    found = {condition.args[1] - condition.args[0] for condition in conditions if condition.args}
    distinct: list[Expr] = []
    for each in sorted((each for each in found if each.free_symbols & rates), key=str):
        if -each not in distinct:
            distinct.append(each)
    return distinct


def _movers(switch: Expr, symbols: Symbols) -> str:
    """The names of the coordinates whose rates stand in a switching function."""
    return ", ".join(name for name in symbols.free if symbols.rates[name] in switch.free_symbols)
