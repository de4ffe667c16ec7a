"""A scene whose equations change along the way, as one smooth model with its modes as parameters.

Between events every sign is fixed, what sticks is held and what rests stays in contact. So each sign in the forces
becomes a parameter σ (|u| = σ u, max(a, b) = (a + b + σ (a − b))/2), and each row a(q)·q̇ + b(q, t) = 0 that may be held
by a reaction has a flag φ of 0 or 1:

    M q̈ = f + Aᵀ Φ λ,   φ (A q̈ + γ) + (1 − φ) λ = 0,   γ = d/dt of (a, b) along the motion, without q̈.

Where the scene has constraints of its own, their reactions stand in M q̈ = … as well, and M⁻¹ is that part of the
inverse of [M Aᵀ; A 0] which keeps to them.
The reaction λ of a coordinate that sticks is the friction force, that of a contact the normal force along ∂g/∂q.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4–6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import symengine as se

from ..mechanics.contributions import Friction
from ..mechanics.jumps import frictions_of
from ..mechanics.scene import Scene
from .compiled import Compiled, compile_expressions
from .equations import Equations, equations, guided_into
from .functions import Expr, sign
from .kinetic import ZERO, velocity
from .model import Mechanics, Model, build
from .symbols import Symbols
from .symengine_algebra import to_symengine

ONE, HALF = se.Integer(1), se.Rational(1, 2)


@dataclass(frozen=True)
class Row:
    """What a reaction may hold: w = a·q̇ + b (of a contact ġ), with d/dt w = a·q̈ + γ."""

    a: tuple[Expr, ...]
    rate: Expr
    bias: Expr


@dataclass(frozen=True)
class Modes:
    """The smooth model of a scene with events to go on behind, and what its parameters and watched values mean.

    The parameters behind the scene's own are σ of every kink and every friction, then φ of every row (frictions, then
    contacts), then an offset ε of every watched value. Watched are, in this order: the scene's other events, kinks
    (σ s), frictions (σ w while slipping, F₀ − λ; then F₀ + λ), contacts (g, or λ at rest). `facts` gives for each row
    a, w, γ; for each friction F₀; for each contact g, ∂g/∂t, e; the values s of all kinks; λ of every row; at last for
    each friction the force R as it is, −σF while slipping and λ while sticking.
    """

    scene: Scene
    model: Model
    facts: Compiled
    ending: tuple[int, ...]  # events of the scene that end the motion, by number
    contacts: tuple[int, ...]  # those that bounce
    frictions: tuple[str, ...]  # names of loads
    kinks: int

    @property
    def rows(self) -> int:
        """How many rows may be held: frictions, then contacts."""
        return len(self.frictions) + len(self.contacts)

    @property
    def watched(self) -> int:
        """How many values are watched."""
        return len(self.ending) + self.kinks + 2 * len(self.frictions) + len(self.contacts)


def modes_of(scene: Scene) -> Modes | None:
    """The modes of a scene whose motions go on behind events: impacts, dry friction, kinks; None if it has none.

    Built and compiled once, like its model.
    """
    return _made_once(Mechanics.of(scene))


@lru_cache(maxsize=64)
def _made_once(mechanics: Mechanics) -> Modes | None:
    scene = mechanics.scene
    bounces = any(event.bounces for event in scene.events)
    frictions = frictions_of(scene)
    if not (bounces or frictions or has_switches(scene)):
        return None
    found = _Assembly(scene)
    if not (bounces or frictions or found.kinks):
        return None
    equations_in_modes = found.equations
    return Modes(
        scene,
        build(equations_in_modes, scene, of=_in_modes),
        compile_expressions(equations_in_modes.symbols.inputs, found.facts),
        found.ending,
        found.contacts,
        tuple(part.source for part in found.frictions),
        len(found.kinks),
    )


def _in_modes(scene: Scene) -> Equations:
    return _Assembly(scene).equations


def has_switches(scene: Scene) -> bool:
    """Whether max, min or step stands in a load of the scene."""
    texts = (part for load in scene.loads for part in vars(load).values())
    words = ("max", "min", "step", "heaviside")
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
        self.kinks: list[Expr] = []
        self._made = 0
        self.sigmas_of_friction = [self._parameter() for _ in self.frictions]
        self.sigmas: list[Expr] = []
        self._forcing = [self._smooth(self._without_friction(each)) for each in self.plain.forcing]
        self._forces = [self._smooth(self._without_friction(each)) for each in self.plain.forces]
        self._power = self._smooth(self._without_friction(self.plain.power))
        self.limits = [self._smooth(guided_into(scene, to_symengine(part.static, symbols))) for part in self.frictions]
        self.flags = [self._parameter() for _ in (*self.frictions, *self.contacts)]
        watched = len(self.ending) + len(self.kinks) + 2 * len(self.frictions) + len(self.contacts)
        self.offsets = [self._parameter() for _ in range(watched)]
        ordered = (*self.sigmas, *self.sigmas_of_friction, *self.flags, *self.offsets)
        names = tuple(str(each) for each in ordered)
        self.symbols = _Extended(symbols.free, symbols.guided, (*symbols.parameters, *names), modes=ordered)
        self.rows = tuple(self._rows())
        self.reactions = self._reactions()

    def _parameter(self) -> Expr:
        self._made += 1
        return se.Symbol(f"mode{self._made}")

    def _slip(self, part: Friction, symbols: Symbols) -> Expr:
        c = (to_symengine(part.coordinate, symbols),)
        return guided_into(self.scene, velocity(c, symbols)[0] - to_symengine(part.surface_rate, symbols))

    def _without_friction(self, expression: Expr) -> Expr:
        """Signs of slipping as parameters, and nothing where it sticks."""
        replaced = {sign(w): sigma for w, sigma in zip(self.slips, self.sigmas_of_friction, strict=True)}
        return se.sympify(expression).subs(replaced) if replaced else expression

    def _smooth(self, expression: Expr) -> Expr:
        """The expression with every kink of the state replaced by its sign, innermost first."""
        count = len(self.plain.symbols.free)
        states, rates = (set(self.plain.symbols.inputs[first : 2 * count]) for first in (0, count))
        while True:
            found = [
                piece
                for piece in sorted(expression.atoms(se.Piecewise), key=str)
                if not any(part.atoms(se.Piecewise) for part in _branches(piece)) and _is_choice(piece)
            ]
            chosen = next((p for p in found if _is_switched(p, states, rates)), None)
            if chosen is None:
                return expression
            expression = expression.subs({chosen: self._by_sign(chosen)})

    def _by_sign(self, piece: Expr) -> Expr:
        margin = _margin(piece)
        above, below = _branches(piece)[:2]
        slips = dict(zip(self.slips, self.sigmas_of_friction, strict=True))
        if margin in slips or -margin in slips:
            sigma = slips[margin] if margin in slips else -slips[-margin]
        elif margin in self.kinks:
            sigma = self.sigmas[self.kinks.index(margin)]
        elif -margin in self.kinks:
            sigma = -self.sigmas[self.kinks.index(-margin)]
        else:
            self.kinks.append(margin)
            self.sigmas.append(self._parameter())
            sigma = self.sigmas[-1]
        return HALF * (above + below) + sigma * HALF * (above - below)

    def _rows(self) -> Iterator[Row]:
        for w in self.slips:
            yield self._row(w)
        for index in self.contacts:
            yield self._row(self._change(self.plain.events[index]))

    def _change(self, g: Expr) -> Expr:
        """ġ = ∂g/∂q q̇ + ∂g/∂t"""
        symbols = self.plain.symbols
        moved = (g.diff(symbols.values[name]) * symbols.rates[name] for name in symbols.free)
        return sum(moved, g.diff(symbols.time))

    def _row(self, w: Expr) -> Row:
        symbols = self.plain.symbols
        a = tuple(w.diff(symbols.rates[name]) for name in symbols.free)
        bias = sum((w.diff(symbols.values[name]) * symbols.rates[name] for name in symbols.free), w.diff(symbols.time))
        return Row(a, w, bias)

    def _held(self, expression: Expr) -> Expr:
        """Without the friction of what sticks."""
        flagged = zip(self.sigmas_of_friction, self.flags, strict=False)
        return expression.subs({sigma: sigma * (ONE - flag) for sigma, flag in flagged})

    def _with_reactions(self, forces: Sequence[Expr]) -> tuple[Expr, ...]:
        """f + Aᵀ Φ λ"""
        found = [self._held(force) for force in forces]
        for row, flag, reaction in zip(self.rows, self.flags, self.reactions, strict=True):
            found = [each + a * flag * reaction for each, a in zip(found, row.a, strict=True)]
        return tuple(found)

    def _reactions(self) -> tuple[Expr, ...]:
        """λ of every row, 0 where its flag is."""
        if not self.rows:
            return ()
        forcing = [self._held(force) for force in self._forcing]
        m, kept = len(self.rows), self.plain.constraints
        none = [ZERO] * len(kept.names)
        columns = [*([*row.a, *none] for row in self.rows), [*forcing, *kept.accelerations]]
        solved = [each[: len(forcing)] for each in _solve(self._augmented, columns)]
        flexibility = [[_dot(row.a, solved[j]) for j in range(m)] for row in self.rows]
        load = [-(_dot(row.a, solved[m]) + row.bias) for row in self.rows]
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
    def _augmented(self) -> tuple[tuple[Expr, ...], ...]:
        """[M Aᵀ; A 0], of q̈ and −λ of the constraints: what a reaction moves keeps to them."""
        kept = self.plain.constraints.jacobian
        upper = ((*row, *(each[i] for each in kept)) for i, row in enumerate(self.plain.mass_matrix))
        return (*upper, *((*each, *([ZERO] * len(kept))) for each in kept))

    @property
    def equations(self) -> Equations:
        """M q̈ = f + Aᵀ Φ λ, with the power of the reactions, and what is watched as the events."""
        power, rates = self._held(self._power), [self.plain.symbols.rates[name] for name in self.plain.symbols.free]
        for row, flag, reaction in zip(self.rows, self.flags, self.reactions, strict=True):
            power = power + flag * reaction * _dot(row.a, rates)
        return replace(
            self.plain,
            symbols=self.symbols,
            forcing=self._with_reactions(self._forcing),
            forces=self._with_reactions(self._forces),
            power=power,
            events=tuple(self._watched()),
        )

    def _watched(self) -> Iterator[Expr]:
        offsets = iter(self.offsets)
        for index in self.ending:
            yield self.plain.events[index] + next(offsets)
        for sigma, kink in zip(self.sigmas, self.kinks, strict=True):
            yield sigma * kink + next(offsets)
        for k, w in enumerate(self.slips):
            flag, reaction, limit = self.flags[k], self.reactions[k], self.limits[k]
            slipping = self.sigmas_of_friction[k] * w + next(offsets)
            yield (ONE - flag) * slipping + flag * (limit - reaction)
            yield (ONE - flag) + flag * (limit + reaction) + next(offsets)
        for j, index in enumerate(self.contacts, len(self.frictions)):
            flag = self.flags[j]
            yield (ONE - flag) * (self.plain.events[index] + next(offsets)) + flag * self.reactions[j]

    @property
    def facts(self) -> list[Expr]:
        """See `Modes.facts`."""
        found: list[Expr] = []
        for row in self.rows:
            found += [*row.a, row.rate, row.bias]
        found += [self.limits[k] for k in range(len(self.frictions))]
        for index in self.contacts:
            event, restitution = self.plain.events[index], self.scene.events[index].restitution
            coefficient = ZERO if restitution is None else to_symengine(restitution.tree, self.plain.symbols)
            found += [event, event.diff(self.plain.symbols.time), coefficient]
        return [*found, *self.kinks, *self.reactions, *self._friction_forces()]

    def _friction_forces(self) -> Iterator[Expr]:
        """R = φ λ − (1 − φ) σ F"""
        for k, part in enumerate(self.frictions):
            force = self._smooth(guided_into(self.scene, to_symengine(part.force, self.plain.symbols)))
            flag = self.flags[k]
            yield flag * self.reactions[k] - (ONE - flag) * self.sigmas_of_friction[k] * force


@dataclass(frozen=True)
class _Extended(Symbols):
    """Symbols of a scene with the modes behind its parameters."""

    modes: tuple[Expr, ...] = ()

    @property
    def inputs(self) -> tuple[Expr, ...]:
        own = Symbols(self.free, self.guided, self.parameters[: len(self.parameters) - len(self.modes)])
        return (*own.inputs, *self.modes)


def _branches(piece: Expr) -> tuple[Expr, ...]:
    return tuple(piece.args[::2])


def _is_choice(piece: Expr) -> bool:
    """Whether its condition compares two numbers."""
    return len(piece.args[1].args) == 2


def _margin(piece: Expr) -> Expr:
    """What is positive where the first branch holds."""
    smaller, larger = piece.args[1].args
    return larger - smaller


def _is_switched(piece: Expr, states: set[Expr], rates: set[Expr]) -> bool:
    """Whether a choice depends on the state; one that jumps with a rate may hold the motion and is left as it is."""
    margin = _margin(piece)
    if not margin.free_symbols & states:
        return False
    above, below = _branches(piece)[:2]
    bend = se.expand(above - below)
    return not margin.free_symbols & rates or bend in (se.expand(margin), se.expand(-margin), se.expand(2 * margin))


def _solve(matrix: Sequence[Sequence[Expr]], columns: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
    """Solutions of a symmetric system for several right-hand sides, by elimination; M comes first in it."""
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


def _dot(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)
