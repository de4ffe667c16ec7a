"""A scene whose equations change along the way, as one smooth model with its modes as parameters.

Between events every sign is fixed, what sticks is held and what rests stays in contact. So each sign in the forces
becomes a parameter σ (|u| = σ u, max(a, b) = (a + b + σ (a − b))/2), and each row w(q, q̇, t) = 0 that may be held has
a flag φ of 0 or 1:

    M q̈ = f + C Φ λ,   φ (A q̈ + γ) + (1 − φ) λ = 0,   A = ∂w/∂q̇,   γ = d/dt of w along the motion, without q̈.

What a reaction holds has C = Aᵀ. A force that jumps with the sign of w, f = f₀ + σ f₁, may hold w = 0 itself, with
that σ between −1 and 1 (Filippov's convex combination, Utkin's equivalent control): then C = −f₁ and λ = −σ.
Where the scene has constraints of its own, their reactions stand in M q̈ = … as well, and M⁻¹ is that part of the
inverse of [M Aᵀ; A 0] which keeps to them.
The reaction λ of a coordinate that sticks is the friction force, that of a contact the normal force along ∂g/∂q.
Sources: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4–6; Filippov, Differential Equations with
Discontinuous Righthand Sides, §4; Utkin, Sliding Modes in Control and Optimization, ch. 2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import combinations

import symengine as se

from ..language.tree import Node
from ..mechanics.contributions import Friction
from ..mechanics.jumps import frictions_of
from ..mechanics.lasting_signs import LastingSigns
from ..mechanics.scene import Scene
from .compiled import Compiled, compile_expressions
from .equations import Equations, equations, guided_into
from .functions import Expr, sign
from .kinetic import ZERO, Vector, dot, velocity
from .model import ByMechanics, Model, build
from .piecewise import Smoothing, by_signs
from .slopes import gradient, slope
from .symbols import Symbols
from .symengine_algebra import to_symengine

ONE = se.Integer(1)
ENDING_STEPS = ("max", "min", "step", "heaviside")  # what only bends ends steps if it is written so


@dataclass(frozen=True)
class Row:
    """What may be held: w (of a contact ġ), with d/dt w = a·q̈ + γ, and the force `along` per λ, which takes `power`."""

    a: tuple[Expr, ...]
    rate: Expr
    bias: Expr
    along: tuple[Expr, ...]
    power: Expr


@dataclass(frozen=True)
class Modes:
    """The smooth model of a scene with events to go on behind, and what its parameters and watched values mean.

    The parameters behind the scene's own are σ of every kink, friction and switch, then φ of every row (frictions,
    switches, contacts), then an offset ε of every watched value. A switch is what changes its sign where a force jumps:
    first those with a rate, w, then those of places alone, s with w = ṡ, of which there are `pins`. Watched are, in
    this order: the scene's other events, kinks (σ s), frictions and switches (σ w or σ s while slipping, F₀ − λ; then
    F₀ + λ, with F₀ = 1 of a switch), contacts (g, or λ at rest), and F and F₀ of frictions, if these might become
    negative, `bounds` being the numbers of the frictions. `facts` gives for each row a, w, γ and the direction
    of its reaction; for each friction and switch F₀; for each contact g, ∂g/∂t, e; the values s of all kinks, then of
    pins; λ of every row; at last for each friction the force R as it is, −σF while slipping, λ while sticking.
    `coupled` are pairs of rows of which a force has a product of signs, so that nothing tells what both hold together.
    """

    scene: Scene
    model: Model
    facts: Compiled
    ending: tuple[int, ...]  # events of the scene that end the motion, by number
    contacts: tuple[int, ...]  # those that bounce
    frictions: tuple[str, ...]  # names of loads
    kinks: tuple[str, ...]  # as the language of scenes has them, as the switches
    switches: tuple[str, ...]
    pins: int
    coupled: frozenset[tuple[int, int]]
    bounds: tuple[int, ...]

    @cached_property
    def bounded(self) -> int:
        """How many rows have reactions with bounds: frictions, then switches."""
        return len(self.frictions) + len(self.switches)

    @cached_property
    def first_pin(self) -> int:
        """The first row of a switch of places alone."""
        return self.bounded - self.pins

    @cached_property
    def rows(self) -> int:
        """How many rows may be held: frictions, switches, then contacts."""
        return self.bounded + len(self.contacts)

    @cached_property
    def watched(self) -> int:
        """How many values are watched."""
        return self.first_bound + len(self.bounds)

    @cached_property
    def first_bound(self) -> int:
        """The first watched value that is a friction force and not negative."""
        return len(self.ending) + len(self.kinks) + 2 * self.bounded + len(self.contacts)

    @cached_property
    def watches_time(self) -> bool:
        """Whether a watched value changes with the time while the motion rests: of a table that is moved, say."""
        eqs = self.model.eqs
        return any(eqs.symbols.time in each.free_symbols for each in eqs.events)

    @cached_property
    def single_facts(self) -> tuple[slice, ...]:
        """Where single numbers stand among `facts`: w, γ, F₀, g, e, s of kinks, s of pins, λ."""
        step, degrees = self.facts_of_row, self.model.layout.degrees
        limits = self.rows * step
        gaps = limits + self.bounded
        kinks = gaps + 3 * len(self.contacts)
        pins = kinks + len(self.kinks)
        reactions = pins + self.pins
        return (
            slice(degrees, limits, step),
            slice(degrees + 1, limits, step),
            slice(limits, gaps),
            slice(gaps, kinks, 3),
            slice(gaps + 2, kinks, 3),
            slice(kinks, pins),
            slice(pins, reactions),
            slice(reactions, reactions + self.rows),
        )

    @cached_property
    def facts_of_row(self) -> int:
        """How many numbers a, w, γ and the direction of its reaction are of a row."""
        return 2 * self.model.layout.degrees + 2

    def name_of(self, row: int) -> str:
        """The name of a friction, or a switch as the language of scenes has it."""
        return (*self.frictions, *self.switches)[row]

    def is_pin(self, index: int) -> bool:
        """Whether a watched value is that of a switch of places alone."""
        place = index - len(self.ending) - len(self.kinks)
        return 2 * self.first_pin <= place < 2 * self.bounded

    def name_of_watched(self, index: int) -> str:
        """The same of a watched value, or a kink; contacts and the scene's other events have none here."""
        place = index - len(self.ending)
        twice = (name for name in (*self.frictions, *self.switches) for _ in range(2))
        return (*self.kinks, *twice)[place]


def modes_of(scene: Scene) -> Modes | None:
    """The modes of a scene whose motions go on behind events: impacts, dry friction, kinks; None if it has none.

    Built and compiled once, like its model.
    """
    return _made_once(ByMechanics.of(scene))


def modes_of_model(model: Model) -> Modes | None:
    """The same of a model's scene, without a look at the scene."""
    return model.kept("modes", lambda: modes_of(model.scene))


@lru_cache(maxsize=64)
def _made_once(found_by: ByMechanics) -> Modes | None:
    scene = found_by.scene
    if not (any(event.bounces for event in scene.events) or frictions_of(scene) or has_switches(scene)):
        return None
    found = _Assembly(scene)
    if not found.has_modes:
        return None
    equations_in_modes = found.equations
    return Modes(
        scene,
        build(equations_in_modes, scene, of=_in_modes),
        compile_expressions(equations_in_modes.symbols.inputs, found.facts),
        found.ending,
        found.contacts,
        tuple(part.source for part in found.frictions),
        tuple(map(found.signs.spelt, found.kinks)),
        tuple(map(found.signs.spelt, found.switches)),
        found.pins,
        frozenset(found.coupled()),
        tuple(k for k, _ in found.of_bounds),
    )


def _in_modes(scene: Scene) -> Equations:
    return _Assembly(scene).equations


@dataclass(frozen=True)
class InModes:
    """What a scene's model in modes reads, λ of every row, and in terms of them the forces of what rubs and touches.

    `frictions` are R of each, −σF while slipping and λ while sticking; `contacts` λ of each by the number of its event,
    0 while open. `in_motion` is an expression along the motion, without friction: with the signs that it has, or holds.
    A kink in it that the motion does not meet is one of the state as it stands.
    """

    inputs: tuple[Expr, ...]
    reactions: tuple[Expr, ...]
    frictions: tuple[Expr, ...]
    contacts: Mapping[int, Expr]
    in_motion: Callable[[Expr], Expr]


def in_modes(scene: Scene) -> InModes:
    """The forces of a scene in its modes."""
    found = _WithLetters(scene)
    forces = tuple(found.friction_forces()), found.contact_forces()
    return InModes(found.symbols.inputs, found.reactions, *forces, found.in_motion)


def enumerated_bounds(scene: Scene, frictions: Sequence[Friction]) -> Iterator[tuple[int, Node]]:
    """F and F₀ of frictions that might become negative, with the numbers of the frictions."""
    moving = {coordinate.name for coordinate in scene.coordinates} | {"t"}
    signs = LastingSigns(moving, {one.name for one in scene.parameters if one.positive} | {"t", "pi"})
    for k, part in enumerate(frictions):
        for tree in dict.fromkeys((part.force, part.static)):
            if not signs.keeps(tree):
                yield k, tree


def has_switches(scene: Scene) -> bool:
    """Whether max, min, step, sign or a modulus stands in a load of the scene."""
    return _has_words(scene, ("max", "min", "step", "heaviside", "sign", "abs"))


def _has_words(scene: Scene, words: tuple[str, ...]) -> bool:
    texts = (part for load in scene.loads for part in vars(load).values())
    return any(word in getattr(part, "text", str(part)) for part in texts for word in words)


class _Assembly:
    """The equations of a scene with its signs and flags as parameters."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.plain = equations(scene)
        symbols = self.plain.symbols
        self.frictions = frictions_of(scene)
        self.contacts = tuple(i for i, event in enumerate(scene.events) if event.bounces)
        self.ending = tuple(i for i, event in enumerate(scene.events) if not event.bounces)
        self.slips = tuple(self._slip(part, symbols) for part in self.frictions)
        self._made = 0
        self._sigmas_of_friction = [self._parameter() for _ in self.frictions]
        known = dict(zip(self.slips, self._sigmas_of_friction, strict=True))
        self.signs = Smoothing(symbols, known, self._parameter)
        forcing, forces = (
            [self._smooth(each) for each in several] for several in (self.plain.forcing, self.plain.forces)
        )
        power = self._smooth(self.plain.power)
        self.arrows = {name: tuple(map(self._smooth, each)) for name, each in self.plain.arrows.items()}
        limits = [self._of_friction(part.static) for part in self.frictions]
        self.of_bounds = [(k, self._of_friction(tree)) for k, tree in enumerated_bounds(scene, self.frictions)]
        of_rates, of_places = self.signs.jumping(forcing)
        self.switches, self.pins = [*of_rates, *of_places], len(of_places)
        self.kinks = [i for i in range(len(self.signs.sigmas)) if i not in self.switches]
        own = [self.signs.sigmas[i] for i in self.switches]
        self._forcing, self._forces = ([by_signs(each, own) for each in several] for several in (forcing, forces))
        self._power = by_signs(power, own)
        self.limits = [*limits, *([ONE] * len(self.switches))]
        self.bounded = [*self._sigmas_of_friction, *own]
        self.flags = [self._parameter() for _ in (*self.bounded, *self.contacts)]
        watched = len(self.ending) + len(self.kinks) + 2 * len(self.bounded) + len(self.contacts)
        watched += len(self.of_bounds)
        self.offsets = [self._parameter() for _ in range(watched)]
        ordered = (*(self.signs.sigmas[i] for i in self.kinks), *self.bounded, *self.flags, *self.offsets)
        names = tuple(str(each) for each in ordered)
        self.symbols = _Extended(symbols.free, symbols.guided, (*symbols.parameters, *names), modes=ordered)
        self.rows = tuple(self._rows())
        self.reactions = self._reactions()

    @property
    def has_modes(self) -> bool:
        """Whether motions follow more than one set of equations, and steps have to end where those change."""
        is_kinked = self.kinks and _has_words(self.scene, ENDING_STEPS)
        return bool(self.contacts or self.frictions or self.switches or is_kinked)

    def _parameter(self) -> Expr:
        self._made += 1
        return se.Symbol(f"mode{self._made}")

    def _of_friction(self, tree: Node) -> Expr:
        """F or F₀, with signs as parameters."""
        return self.signs.smooth(guided_into(self.scene, to_symengine(tree, self.plain.symbols)))

    def _slip(self, part: Friction, symbols: Symbols) -> Expr:
        c = (to_symengine(part.coordinate, symbols),)
        return guided_into(self.scene, velocity(c, symbols)[0] - to_symengine(part.surface_rate, symbols))

    def _smooth(self, expression: Expr) -> Expr:
        """The expression with signs of slipping, and then all others, as parameters."""
        replaced = {sign(w): sigma for w, sigma in zip(self.slips, self._sigmas_of_friction, strict=True)}
        return self.signs.smooth(se.sympify(expression).subs(replaced))

    def in_motion(self, expression: Expr) -> Expr:
        """An expression along the motion, without friction: its signs as parameters, what is held between them."""
        own = self.bounded[len(self.frictions) :]
        return self._between(by_signs(self.signs.by_known(expression), own))

    def _rows(self) -> Iterator[Row]:
        for w in self.slips:
            yield self._row(w)
        for index in self.switches:
            yield self._row_of_switch(index)
        for index in self.contacts:
            yield self._row(self._change(self.plain.events[index]))

    def _row_of_switch(self, index: int) -> Row:
        """−f₁, and what it takes."""
        sigma, value = self.signs.sigmas[index], self.signs.values[index]
        row = self._row(self._change(value) if index in self.switches[len(self.switches) - self.pins :] else value)
        return replace(row, along=tuple(-f.diff(sigma) for f in self._forcing), power=-self._power.diff(sigma))

    def _change(self, g: Expr) -> Expr:
        """ġ = ∂g/∂q q̇ + ∂g/∂t"""
        symbols = self.plain.symbols
        *slopes, by_time = gradient(g, [*(symbols.values[name] for name in symbols.free), symbols.time])
        return by_time + dot(slopes, [symbols.rates[name] for name in symbols.free])

    def coupled(self) -> Iterator[tuple[int, int]]:
        """See `Modes.coupled`."""
        for i, j in combinations(range(len(self.bounded)), 2):
            if any(force.diff(self.bounded[i]).diff(self.bounded[j]) != 0 for force in self._forcing):
                yield i, j

    def _row(self, w: Expr) -> Row:
        symbols = self.plain.symbols
        a = gradient(w, [symbols.rates[name] for name in symbols.free])
        bias = self._change(w)
        power = dot(a, [symbols.rates[name] for name in symbols.free])
        return Row(a, w, bias, a, power)

    def _held(self, expression: Expr) -> Expr:
        """Without the sign of what is held."""
        flagged = zip(self.bounded, self.flags, strict=False)
        return expression.subs({sigma: sigma * (ONE - flag) for sigma, flag in flagged})

    def _between(self, expression: Expr) -> Expr:
        """With the σ between its bounds of switches that are held."""
        first = len(self.frictions)
        held = zip(self.bounded[first:], self.flags[first:], self.reactions[first:], strict=False)
        return expression.subs({sigma: sigma * (ONE - flag) - flag * reaction for sigma, flag, reaction in held})

    def _with_reactions(self, forces: Sequence[Expr]) -> tuple[Expr, ...]:
        """f + C Φ λ"""
        found = [self._held(force) for force in forces]
        for row, flag, reaction in zip(self.rows, self.flags, self.reactions, strict=True):
            found = [each + c * flag * reaction for each, c in zip(found, row.along, strict=True)]
        return tuple(found)

    def _reactions(self) -> tuple[Expr, ...]:
        """λ of every row, 0 where its flag is."""
        if not self.rows:
            return ()
        forcing = [self._held(force) for force in self._forcing]
        m, (_, gamma) = len(self.rows), self._kept
        none = [ZERO] * len(gamma)
        columns = [*([*row.along, *none] for row in self.rows), [*forcing, *gamma]]
        solved = [each[: len(forcing)] for each in _solve(self._augmented, columns)]
        flexibility = [[dot(row.a, solved[j]) for j in range(m)] for row in self.rows]
        load = [-(dot(row.a, solved[m]) + row.bias) for row in self.rows]
        matrix = [
            [
                self.flags[i] * self.flags[j] * flexibility[i][j] + (ONE - self.flags[i] if i == j else ZERO)
                for j in range(m)
            ]
            for i in range(m)
        ]
        right = [self.flags[i] * load[i] for i in range(m)]
        return tuple(_solve(tuple(map(tuple, matrix)), [right])[0])

    @property
    def _kept(self) -> tuple[list[Vector], list[Expr]]:
        """Rows of A and γ of the constraints that others follow from, which have no pivot of their own."""
        held = self.plain.constraints
        chosen = [k for k, place in enumerate(held.places) if place in self.scene.independence.chosen]
        return [held.jacobian[k] for k in chosen], [held.accelerations[k] for k in chosen]

    @property
    def _augmented(self) -> tuple[tuple[Expr, ...], ...]:
        """[M Aᵀ; A 0], of q̈ and −λ of the constraints: what a reaction moves keeps to them."""
        kept, _ = self._kept
        upper = ((*row, *(each[i] for each in kept)) for i, row in enumerate(self.plain.mass_matrix))
        return (*upper, *((*each, *([ZERO] * len(kept))) for each in kept))

    @property
    def equations(self) -> Equations:
        """M q̈ = f + C Φ λ, with the power of the reactions, and what is watched as the events."""
        power = self._held(self._power)
        for row, flag, reaction in zip(self.rows, self.flags, self.reactions, strict=True):
            power = power + flag * reaction * row.power
        return replace(
            self.plain,
            symbols=self.symbols,
            forcing=self._with_reactions(self._forcing),
            forces=self._with_reactions(self._forces),
            power=power,
            arrows={name: tuple(map(self._between, each)) for name, each in self.arrows.items()},
            events=tuple(self._watched()),
            has_impacts=bool(self.contacts),
        )

    def _watched(self) -> Iterator[Expr]:
        offsets = iter(self.offsets)
        for index in self.ending:
            yield self.plain.events[index] + next(offsets)
        for index in self.kinks:
            yield self.signs.sigmas[index] * self.signs.values[index] + next(offsets)
        for k, row in enumerate(self.rows[: len(self.bounded)]):
            flag, reaction, limit = self.flags[k], self.reactions[k], self._between(self.limits[k])
            slipping = self.bounded[k] * self._level(k, row)
            yield (ONE - flag) * slipping + flag * (limit - reaction) + next(offsets)
            yield (ONE - flag) + flag * (limit + reaction) + next(offsets)
        for j, index in enumerate(self.contacts, len(self.bounded)):
            flag = self.flags[j]
            yield (ONE - flag) * self.plain.events[index] + flag * self.reactions[j] + next(offsets)
        for _, force in self.of_bounds:
            yield self._between(force) + next(offsets)

    def _level(self, k: int, row: Row) -> Expr:
        """What changes its sign where a friction or a switch turns."""
        first = len(self.bounded) - self.pins
        return row.rate if k < first else self.signs.values[self.switches[k - len(self.frictions)]]

    @property
    def facts(self) -> list[Expr]:
        """See `Modes.facts`."""
        found: list[Expr] = []
        for row in self.rows:
            found += [*row.a, row.rate, row.bias, *row.along]
        found += map(self._between, self.limits)
        for index in self.contacts:
            event, restitution = self.plain.events[index], self.scene.events[index].restitution
            coefficient = ZERO if restitution is None else to_symengine(restitution.tree, self.plain.symbols)
            found += [event, slope(event, self.plain.symbols.time), coefficient]
        pins = self.switches[len(self.switches) - self.pins :]
        values = (self.signs.values[i] for i in (*self.kinks, *pins))
        return [*found, *values, *self.reactions, *self.friction_forces()]

    def contact_forces(self) -> Mapping[int, Expr]:
        """φ λ of each contact, by the number of its event."""
        held = zip(self.flags[len(self.bounded) :], self.reactions[len(self.bounded) :], strict=True)
        return {index: flag * reaction for index, (flag, reaction) in zip(self.contacts, held, strict=True)}

    def friction_forces(self) -> Iterator[Expr]:
        """R = φ λ − (1 − φ) σ F"""
        for k, part in enumerate(self.frictions):
            flag, force = self.flags[k], self._of_friction(part.force)
            yield flag * self.reactions[k] - (ONE - flag) * self.bounded[k] * self._between(force)


class _WithLetters(_Assembly):
    """The same with a letter for λ of each row, of which the forces are linear functions then."""

    def _reactions(self) -> tuple[Expr, ...]:
        return tuple(se.Symbol(f"held{k}") for k in range(len(self.rows)))


@dataclass(frozen=True)
class _Extended(Symbols):
    """Symbols of a scene with the modes behind its parameters."""

    modes: tuple[Expr, ...] = ()

    @property
    def inputs(self) -> tuple[Expr, ...]:
        own = Symbols(self.free, self.guided, self.parameters[: len(self.parameters) - len(self.modes)])
        return (*own.inputs, *self.modes)


def _solve(matrix: Sequence[Sequence[Expr]], columns: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
    """Solutions of a system for several right-hand sides, by elimination; M comes first in it."""
    n = len(matrix)
    rows = [[*row] for row in matrix]
    rights = [[*column] for column in columns]
    for k in range(n):
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            if factor == 0:
                continue
            for j in range(k + 1, n):
                rows[i][j] = rows[i][j] - factor * rows[k][j]
            for right in rights:
                right[i] = right[i] - factor * right[k]
    for right in rights:
        for i in reversed(range(n)):
            known = sum((rows[i][j] * right[j] for j in range(i + 1, n)), ZERO)
            right[i] = (right[i] - known) / rows[i][i]
    return rights
