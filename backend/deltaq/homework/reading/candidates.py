"""Candidate readings of an answer: the conventional one first, then those that dimensions or tight writing speak for.

Where usage is divided, a reading survives that makes sense by its dimensions. A reading that only loose writing allows
(`p^2/2 m`) survives only where the conventional one makes no sense. The number tried is bounded.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from ...errors import ExpressionError, InputError
from ...language.bounds import MAX_CHARACTERS
from ...language.choices import Choices
from ...language.parser import Syntax, parse
from ...language.plain_printer import plain
from ...language.tokens import fail
from ...language.tree import Equation, Node, Span, Sum, Vector
from ...mechanics.homogeneity import DimensionCheck
from ...mechanics.reaction_units import units_of
from ...mechanics.units import Dimension
from ..equality import Parts
from ..solution import Solution
from ..task import Task
from .answer import read_once
from .layout import Layout, laid_out
from .reader import Reading

MOST_TRIED = 24
MOST_KEPT = 4
HEADED = frozenset({"T", "V", "U", "L", "K", "E"})


@dataclass(frozen=True)
class Candidate:
    """A reading; `loose` if only loose writing allows it somewhere, `sensible` if its dimensions fit together.

    A human takes a reading that `survives` without asking back; any other has to be asked for.
    """

    reading: Reading
    loose: bool = False
    sensible: bool = True
    survives: bool = True


def candidates(
    task: Task, solution: Solution, text: str, syntax: Syntax, *, decimal_comma: bool = False
) -> tuple[Candidate, ...]:
    """The readings that make sense, those that survive first, the conventional one first among them; at least one.

    Raises ExpressionError, for the conventional reading, where there is none.
    """
    if len(text) > MAX_CHARACTERS:
        fail("too-long", Span(MAX_CHARACTERS, len(text) - MAX_CHARACTERS), length=len(text), limit=MAX_CHARACTERS)
    found: list[Candidate] = []
    first: ExpressionError | None = None
    for layout in _layouts(solution, text, decimal_comma=decimal_comma):
        try:
            found += _of_layout(task, solution, layout, syntax)
        except ExpressionError as error:
            first = first or error
    if not found:
        raise first or ExpressionError()
    return _ranked(found)


def _layouts(solution: Solution, text: str, *, decimal_comma: bool) -> Iterator[Layout]:
    """With and without decimal commas, the usual one of the language first."""
    usual = laid_out(text, solution.scene.names, HEADED, decimal_comma=decimal_comma)
    other = laid_out(text, solution.scene.names, HEADED, decimal_comma=not decimal_comma)
    yield usual
    if other != usual:
        yield other


def _of_layout(task: Task, solution: Solution, layout: Layout, syntax: Syntax) -> list[Candidate]:
    """The conventional reading, then those that differ from it in one place, in two … as far as the bound goes."""
    met: dict[int, tuple[int, int]] = {}
    queue: list[Mapping[int, int]] = [{}]
    found: list[Candidate] = []
    first: ExpressionError | None = None
    for taken in queue:
        choices = Choices(taken)
        try:
            reading = read_once(task, solution, layout, syntax, choices)
        except ExpressionError as error:
            first = first or error
        else:
            loose = any(number >= choices.met.get(place, (0, 0))[1] for place, number in taken.items())
            sensible = not choices.met or _makes_sense(task, solution, reading)
            found.append(Candidate(reading, loose, sensible))
        met |= choices.met
        queue += list(_further(taken, choices.met))[: MOST_TRIED - len(queue)]
    if not found:
        raise first or ExpressionError()
    return found


def _further(taken: Mapping[int, int], met: Mapping[int, tuple[int, int]]) -> Iterator[Mapping[int, int]]:
    """One more place read otherwise, each set of places once: those after the last one already changed."""
    for place, (readings, _) in sorted(met.items()):
        if place > max(taken, default=-1):
            for number in range(1, readings):
                yield {**taken, place: number}


def _ranked(found: list[Candidate]) -> tuple[Candidate, ...]:
    """What makes sense and was written tightly survives; what was written loosely only where nothing else does."""
    sensible = [one for one in found if one.sensible]
    if not sensible:
        return (found[0],)
    tight = [one for one in sensible if not one.loose] or sensible
    ranked = [*tight, *(replace(one, survives=False) for one in sensible if one not in tight)]
    return tuple(_distinct(ranked))[:MOST_KEPT]


def _distinct(ranked: list[Candidate]) -> Iterator[Candidate]:
    seen: list[Parts] = []
    for one in ranked:
        if one.reading.parts not in seen:
            seen.append(one.reading.parts)
            yield one


# --- dimensions ------------------------------------------------------------------------------------------------------


def _makes_sense(task: Task, solution: Solution, reading: Reading) -> bool:
    """Whether all terms fit together, and into what is asked for."""
    check = DimensionCheck(units_of(solution.scene), "", [])
    wanted = _wanted(task, solution)
    for tree in reading.measured:
        for part in sums(tree):
            found = check.of(part)
            if check.problems or (wanted and isinstance(found, Dimension) and not found.fits(wanted)):
                return False
    return True


def _wanted(task: Task, solution: Solution) -> Dimension | None:
    """The dimension of the right answer, where it has one."""
    if task.quantity.form not in ("expression", "vector", "set") or task.quantity.up_to_factor:
        return None
    check = DimensionCheck(units_of(solution.scene), "", [])
    try:
        known = [check.of(parse(plain(part), solution.scene.names).tree) for part in task.value(solution)]
    except InputError:
        return None
    return next((one for one in known if isinstance(one, Dimension)), None)


def sums(tree: Node) -> list[Node]:
    """Each component by itself; the terms on both sides of an equation belong together."""
    match tree:
        case Vector(components=components):
            return [part for component in components for part in sums(component)]
        case Equation(left=left, right=right):
            return [Sum((*_terms(left), *_terms(right)), span=tree.span)]
        case _:
            return [tree]


def _terms(side: Node) -> tuple[Node, ...]:
    return side.terms if isinstance(side, Sum) else (side,)
