"""The blocks of an ordering: the steps that lead to a goal, which of them rest on which, and a wrong one among them.

A block rests on another one if the derivation says so, be it by way of steps that are no blocks. The letters and the
order in which blocks are shown are drawn from the seed, and so is the wrong block.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from string import ascii_lowercase
from types import MappingProxyType

import sympy as sp

from ...derivation.engine import USUAL, chapters, chapters_of_equations
from ...derivation.formula import Equation, Explicit, Formula, Plus, Term
from ...derivation.step import Relation, Step
from ...errors import InputError
from ...language.memory import cached_method
from ..equality import Equality, expression, lagrangian
from ..faulty_solution import FaultySolution, misconceptions, mistaken, premises
from ..solution import Solution

LAGRANGIAN, EQUATION = "lagrangian", "equation"
MOST = 8  # blocks that belong
# Of a scene: what is longer cannot be compared at a glance, nor derived while somebody waits for a list of tasks.
MOST_FREEDOMS = 4
MOST_OPERATIONS = 500  # in E and all Qᵢ
MOST_LINES = 7  # of a block
MOST_TRIED = 24
ENERGY = ("kinetic-energy", "kinetic-energy-of-particle", "kinetic-energy-of-rigid-body", "kinetic-energy-of-continuum")

# For each goal the rules whose steps are always blocks, then those that come besides as long as there is room.
NEEDED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        LAGRANGIAN: ("generalized-forces", "decomposition", LAGRANGIAN),
        EQUATION: ("decomposition", LAGRANGIAN, "momentum", "momentum-rate", "lagrangian-slope", EQUATION),
    }
)
BESIDES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        LAGRANGIAN: ("guided-position", "position", "velocity", "virtual-work", "virtual-displacement", "potential"),
        EQUATION: ("generalized-forces", "velocity", "virtual-work", "guided-position", "position"),
    }
)


@dataclass(frozen=True)
class Block:
    """A step under its letter. `mistake` is the way on which a wrong one comes out, None for a step that belongs."""

    id: str
    step: Step
    mistake: FaultySolution | None = None


@dataclass(frozen=True)
class Blocks:
    """Blocks as they are shown. `before` has for each that belongs all those which must stand before it."""

    shown: tuple[Block, ...]
    before: Mapping[str, frozenset[str]]
    model: tuple[str, ...]

    def block(self, identifier: str) -> Block | None:
        """The block of this letter."""
        return next((each for each in self.shown if each.id == identifier), None)

    def holds(self, order: Sequence[str]) -> bool:
        """Whether each block stands after all those that it rests on."""
        return all(self.before[each] <= {*order[:place]} for place, each in enumerate(order))


@cached_method
def is_short(solution: Solution) -> bool:
    """Whether the formulas of a scene can be compared at a glance, so that its steps are put in order."""
    if len(solution.free) > MOST_FREEDOMS:
        return False
    stated = (solution.kinetic_energy, *map(solution.generalized_force, solution.free))
    return sum(int(value.count_ops()) for value in stated) <= MOST_OPERATIONS


@cached_method
def blocks_of(solution: Solution, goal: str, subject: str) -> Blocks:
    """The blocks that lead to L, or to the equation of a coordinate; five to eight of them belong."""
    ordered = _chosen(_derived(solution), goal, subject)
    source = random.Random(f"{solution.scene.id}/{goal}:{subject}/{solution.seed}")
    return shuffled(ordered, _distractor(solution, ordered.steps, subject, source), source)


# --- which steps -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class OrderedSteps:
    """Steps in an order in which they can be read, and by its id all those among them that each rests on."""

    steps: tuple[Step, ...]
    rests: Mapping[str, frozenset[str]]


@cached_method
def _derived(solution: Solution) -> OrderedSteps:
    """All steps up to the equations of motion."""
    found = islice(chapters(solution.model), chapters_of_equations(USUAL))
    steps = tuple(one for chapter in found for step in chapter.steps for one in _inside_out(step))
    rests: dict[str, frozenset[str]] = {}
    for step in steps:
        rests[step.id] = frozenset(step.premises).union(*(rests[premise] for premise in step.premises))
    return OrderedSteps(steps, rests)


def _inside_out(step: Step) -> Iterator[Step]:
    for substep in step.substeps:
        yield from _inside_out(substep)
    yield step


def _chosen(ordered: OrderedSteps, goal: str, subject: str) -> OrderedSteps:
    """The steps that become blocks."""
    end = f"{goal}:{subject}" if subject else goal
    leading = [step for step in ordered.steps if step.id in ordered.rests[end] or step.id == end]
    chosen = [step for step in leading if step.rule in NEEDED[goal]] + _energy(leading)
    for rule in BESIDES[goal]:
        alike = [step for step in leading if step.rule == rule]
        chosen += alike if len(chosen) + len(alike) <= MOST else []
    ids = {step.id for step in chosen}
    return OrderedSteps(
        tuple(step for step in leading if step.id in ids), {one: ordered.rests[one] & ids for one in ids}
    )


def _energy(leading: Sequence[Step]) -> list[Step]:
    """The step that says what E is: the last one about a kinetic energy."""
    return [step for step in leading if step.rule in ENERGY][-1:]


# --- a step that does not belong -------------------------------------------------------------------------------------


def _whole(value: sp.Expr, _solution: Solution) -> tuple[sp.Expr, ...]:
    return (value,)


def _energies(value: sp.Expr, solution: Solution) -> tuple[sp.Expr, ...]:
    """E and −V stay apart in L, as they do where it is right."""
    rates = {solution.rate(q) for q in solution.free}
    moving = sp.Add(*(term for term in sp.Add.make_args(value) if term.free_symbols & rates))
    return moving, value - moving


@dataclass(frozen=True)
class _Law:
    """What a step states: its value by a solution, when two values are the same, which members it is made of, and the
    parts that it is written in.
    """

    value: Callable[[Solution, str], sp.Expr]
    equality: Equality
    members: tuple[str, ...]
    parts: Callable[[sp.Expr, Solution], tuple[sp.Expr, ...]] = _whole


def _slope(solution: Solution, coordinate: str) -> sp.Expr:
    """∂L/∂q"""
    return solution.energy_slope(coordinate) - solution.potential_slope(coordinate)


_ENERGY = _Law(lambda solution, _: solution.kinetic_energy, expression, ("kinetic_energy",))
LAWS: Mapping[str, _Law] = MappingProxyType(
    {
        **dict.fromkeys(ENERGY, _ENERGY),
        LAGRANGIAN: _Law(lambda solution, _: solution.lagrangian, lagrangian, ("lagrangian",), _energies),
        "momentum": _Law(lambda solution, q: solution.momentum(q), expression, ("momentum",)),
        "momentum-rate": _Law(lambda solution, q: solution.momentum_rate(q), expression, ("momentum_rate",)),
        "lagrangian-slope": _Law(_slope, expression, ("energy_slope", "potential_slope")),
    }
)


def _distractor(
    solution: Solution, steps: Sequence[Step], subject: str, source: random.Random
) -> tuple[Step, FaultySolution] | None:
    """One of the steps as it comes out with a misconception, the likely ones first; None where none shows."""
    stated = [(step, kind) for step in steps if step.rule in LAWS for kind in misconceptions()]
    touched = [(step, kind) for step, kind in stated if _touches(kind, LAWS[step.rule])]
    source.shuffle(touched)
    likely = sorted(touched, key=lambda pair: pair[1].likely > 1)
    ways = ((step, way) for step, kind in likely for way in kind.variants(solution))
    wrong = (_wrong(step, way, solution, subject) for step, way in islice(ways, MOST_TRIED))
    return next((found for found in wrong if found), None)


def _touches(kind: type[FaultySolution], law: _Law) -> bool:
    uses = frozenset(law.members).union(*map(premises, law.members))
    return bool(mistaken(kind) & uses)


def _wrong(step: Step, way: FaultySolution, solution: Solution, subject: str) -> tuple[Step, FaultySolution] | None:
    """The step with what the wrong way leads to, if that is something, and certainly something else."""
    law = LAWS[step.rule]
    try:
        value, right = law.value(way, subject).expand(), law.value(solution, subject)
        terms = tuple(
            Term(Explicit(part)) for part in map(solution.model.display, law.parts(value, solution)) if part != 0
        )
    except (InputError, ValueError, ZeroDivisionError):
        return None
    if not terms or law.equality.same((value,), (right,), solution).equal is not False:
        return None
    *others, relation = step.relations
    return replace(step, relations=(*others, Relation((relation.before, Plus(terms)))), substeps=(), lines=()), way


# --- as they are shown -----------------------------------------------------------------------------------------------


def shuffled(ordered: OrderedSteps, distractor: tuple[Step, FaultySolution] | None, source: random.Random) -> Blocks:
    """The blocks in an order in which they do not stand right, with letters in that order."""
    drawn: list[tuple[Step, FaultySolution | None]] = [(step, None) for step in ordered.steps]
    drawn += [distractor] if distractor else []
    while True:
        source.shuffle(drawn)
        named = tuple(Block(letter, *one) for letter, one in zip(ascii_lowercase, drawn, strict=False))
        found = _blocks(named, ordered)
        if not found.holds([block.id for block in named if block.mistake is None]):
            return found


def _blocks(shown: tuple[Block, ...], ordered: OrderedSteps) -> Blocks:
    letters = {block.step.id: block.id for block in shown if block.mistake is None}
    before = {letters[one]: frozenset(letters[other] for other in rests) for one, rests in ordered.rests.items()}
    return Blocks(shown, before, tuple(letters[step.id] for step in ordered.steps))


def shown_relations(step: Step) -> tuple[Relation, ...]:
    """What a step says, without the way there: the first and the last member of each line.

    Of many lines the first half: of a decomposition V and the forces, without those that have no potential.
    """
    lines = step.relations
    return tuple(map(_short, lines if len(lines) <= MOST_LINES else lines[: (len(lines) + 1) // 2]))


def _short(relation: Relation) -> Relation:
    after = _uncoloured(relation.after)
    if relation.sign != "=":
        return Relation((after,), relation.sign)
    return Relation((relation.before, after)) if len(relation.members) > 1 else relation


def _uncoloured(formula: Formula) -> Formula:
    """Without what tells where terms come from: it would tell a wrong block, too."""
    match formula:
        case Plus(terms):
            return Plus(tuple(Term(term.formula, (), term.sign) for term in terms))
        case Equation(left, right):
            return Equation(_uncoloured(left), _uncoloured(right))
    return formula
