"""The shortest change of an answer that makes it right: tried by numbers, proved exactly.

Every line of a system and every component of a vector is looked at by itself. A slip is told only if the answer with
the change is right, so what is told of it is true whatever the student thought.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations, islice

import sympy as sp

from ...errors import InputError
from ...language.canonical import display
from ...language.memory import cached_method
from ...language.sympy_algebra import to_sympy
from ...language.tree import Node, Rate, Span, walk
from ...vocabulary import SlipKind
from ..equality import Parts
from ..partwise import part_outcomes
from ..reading import Reading
from ..sampling import Values
from ..task import Task
from ..workbook import Workbook
from .edits import Edit, edits, plain_edits
from .lexicon import Lexicon, arguments, lexicon, near
from .spots import Spot, Valued, put, spots
from .targets import Target, targets
from .written import WrittenPart, written_parts

MOST_PROVED = 4  # changes that fit by numbers and are looked at exactly
MOST_TERMS = 40
MOST_NODES = 240  # of an answer that is looked at
MOST_NODES_TWICE = 80  # of one in which two slips are looked for
MOST_TRIED = 16  # first slips, where one does not explain an answer
PLAIN = ("sign", "function", "half", "double", "power", "missing")  # second slips that are believed
ACCELERATION = 0.18
ACCELERATION_SIGN = 0.5  # nobody gets the sign of the inertia wrong and everything else right


@dataclass(frozen=True)
class Slip:
    """What is wrong with one term: its part, the term as it was written, its place in the text, and by which factor
    the part is compared with the right one.
    """

    kind: SlipKind
    part: int
    term: sp.Expr | None
    place: Span | None
    scale: Values = ()
    node: Node | None = None


@dataclass(frozen=True)
class _Found:
    slip: Slip
    cost: float
    changed: sp.Expr


@dataclass(frozen=True, eq=False)
class SlipSearch:
    """Looks for the slips in answers to one task."""

    workbook: Workbook
    task: Task

    def slips(self, reading: Reading, text: str, *, explained: bool = False) -> tuple[Slip, ...]:
        """One slip for each part that is wrong; none if not all parts can be explained.

        Two slips in one part are looked for only in what is not `explained` otherwise.
        """
        size = sum(1 for _, tree in reading.trees for _ in walk(tree))
        if size > MOST_NODES:
            return ()
        written = written_parts(self.task, reading, text, self.workbook.sampler)
        found = self._of_each_part(reading.parts, written)
        if found and {slip.kind for slip in found} != {"superfluous", "missing"}:
            return found
        found = self._of_the_whole(reading.parts, written) or found
        once = explained or size > MOST_NODES_TWICE
        return found or (() if once else self._of_two_terms(reading.parts, written))

    # --- part by part ------------------------------------------------------------------------------------------------

    def _of_each_part(self, given: Parts, written: tuple[WrittenPart, ...]) -> tuple[Slip, ...]:
        found: list[Slip] = []
        for index, candidates in self._pairs(given):
            slip = next((slip for right in candidates if (slip := self._slip(index, given, right, written))), None)
            if slip is None:
                return ()
            found.append(slip)
        return tuple(found)

    def _pairs(self, given: Parts) -> list[tuple[int, list[sp.Expr]]]:
        """Each part that is wrong with the parts of the right answer that it may be meant for."""
        right = self.workbook.right(self.task)
        if self.task.quantity.form in ("expression", "vector", "equation"):
            return [
                (k, [true, *(parts[k] for parts, _ in self.workbook.alternatives(self.task))])
                for k, (own, true) in enumerate(zip(given, right, strict=False))
                if len(given) == len(right) and not self._same_values(own, true)
            ]
        outcomes = part_outcomes(self.workbook, self.task, given) or ("wrong",) * len(given)
        if len(given) != len(right):
            return [(0, [])]
        order = [[right[k], *(other for other in right if other != right[k])] for k in range(len(right))]
        return [(k, order[k]) for k, outcome in enumerate(outcomes) if outcome != "correct"] or [(0, [])]

    def _same_values(self, own: sp.Expr, true: sp.Expr) -> bool:
        return near(self.workbook.sampler.values(own), self.workbook.sampler.values(true))

    def _slip(self, index: int, given: Parts, right: sp.Expr, written: tuple[WrittenPart, ...]) -> Slip | None:
        found = sorted(self._fitting(index, given[index], right, written[index]), key=lambda one: one.cost)
        return next((one.slip for one in found[:MOST_PROVED] if self._proved(one, given[index], right)), None)

    def _proved(self, found: _Found, given: sp.Expr, right: sp.Expr) -> bool:
        """Whether the change makes the part right, and not by cancelling another term of it."""
        before, after = (len(sp.Add.make_args(sp.expand(part))) for part in (given, found.changed))
        if after < before - 1 and found.slip.kind != "superfluous":
            return False
        return self.task.quantity.equality.same((found.changed,), (right,), self.workbook.solution).equal is True

    def _fitting(self, index: int, given: sp.Expr, right: sp.Expr, written: WrittenPart) -> Iterator[_Found]:
        """The changes that fit by numbers."""
        values = Valued(self.workbook.sampler)
        words = self._lexicon(right, written.tree)
        for target in targets(self.task, given, right, self.workbook.sampler):
            for spot in spots(written.tree, target.values, values):
                if not spot.path:
                    yield from self._missing(index, given, right, spot, target)
                for edit in edits(spot, words, values):
                    found = self._changed(index, written, edit, target)
                    if found:
                        yield found

    def _lexicon(self, right: sp.Expr, tree: Node) -> Lexicon:
        return self._lexicon_with(right, frozenset(arguments((tree,))))

    @cached_method
    def _lexicon_with(self, right: sp.Expr, own: frozenset[Node]) -> Lexicon:
        kind, form = self.task.quantity.kind, self.task.quantity.form
        return lexicon(
            self.workbook.sampler,
            self._shown_again((right,)),
            own,
            virtual=kind.startswith("virtual"),
            moving=form != "set" and kind not in ("position", "virtual-displacement"),
        )

    @cached_method
    def _shown_again(self, parts: Parts) -> Parts:
        return self.workbook.short(parts)

    def _changed(self, index: int, written: WrittenPart, edit: Edit, target: Target) -> _Found | None:
        symbols = self.workbook.solution.symbols
        marked = edit.node if edit.marked is None or written.place(edit.marked) is None else edit.marked
        try:
            changed = to_sympy(put(written.tree, edit.path, edit.after), symbols)
            term = to_sympy(marked, symbols)
        except InputError:
            return None
        slip = Slip(edit.kind, index, term, written.place(marked), target.scale, marked)
        return _Found(slip, edit.cost + target.cost + self._blame(edit) + 0.01 * len(edit.path), changed)

    def _blame(self, edit: Edit) -> float:
        """Mistakes in the inertia of an equation are told last."""
        inertial = self.task.quantity.form in ("equation", "equations") and any(
            isinstance(node, Rate) and node.order == 2 for node in walk(edit.node)
        )
        return (ACCELERATION_SIGN if edit.kind == "sign" else ACCELERATION) if inertial else 0.0

    def _missing(self, index: int, given: sp.Expr, right: sp.Expr, spot: Spot, target: Target) -> Iterator[_Found]:
        """A term of the right answer that is not there, or one of a product multiplied out that should not be."""
        if target.factor is None or given == 0:
            return
        for term, values in self._terms(right):
            for sign in (1, -1):
                wanted = tuple(sign * s * v for s, v in zip(target.scale, values, strict=True))
                if near(spot.difference, wanted):
                    slip = Slip("missing", index, None, None, target.scale)
                    yield _Found(slip, (1.4 if sign > 0 else 1.6) + target.cost, given + sign * target.factor * term)
        for term in sp.Add.make_args(sp.expand(given))[:MOST_TERMS]:
            if near(spot.difference, tuple(-v for v in self.workbook.sampler.values(term))):
                yield _Found(Slip("superfluous", index, term, None, target.scale), 1.4 + target.cost, given - term)

    @cached_method
    def _terms(self, right: sp.Expr) -> tuple[tuple[sp.Expr, Values], ...]:
        """The terms of the right answer, as they are shown and multiplied out."""
        shown = display(right.expand(), self.workbook.solution.symbols)
        terms = dict.fromkeys([*sp.Add.make_args(shown), *sp.Add.make_args(sp.expand(shown))])
        return tuple((term, self.workbook.sampler.values(term)) for term in islice(terms, MOST_TERMS))

    # --- the whole answer --------------------------------------------------------------------------------------------

    def _of_the_whole(self, given: Parts, written: tuple[WrittenPart, ...]) -> tuple[Slip, ...]:
        """Components in each other's place, a term in the wrong one, two names exchanged throughout."""
        if self.task.quantity.form == "vector" and len(given) == len(self.workbook.right(self.task)):
            return self._swapped(given) or self._moved(given, written) or self._renamed(given)
        return self._renamed(given)

    def _of_two_terms(self, given: Parts, written: tuple[WrittenPart, ...]) -> tuple[Slip, ...]:
        """Two plain slips in one part: the first is tried, the second found."""
        pairs = self._pairs(given)
        if len(pairs) != 1:
            return ()
        ((index, candidates),) = pairs
        values = Valued(self.workbook.sampler)
        for right in candidates:
            for edit in islice(plain_edits(written[index].tree, values), MOST_TRIED):
                first = self._changed(index, written[index], edit, Target((), ()))
                if first is None:
                    continue
                rest = replace(written[index], tree=put(written[index].tree, edit.path, edit.after))
                second = self._slip(
                    index, (*given[:index], first.changed, *given[index + 1 :]), right, (rest,) * len(given)
                )
                if second is not None and second.kind in PLAIN:
                    return (replace(first.slip, scale=second.scale), second)
        return ()

    def _swapped(self, given: Parts) -> tuple[Slip, ...]:
        right = self.workbook.right(self.task)
        for a, b in combinations(range(len(given)), 2):
            order = list(given)
            order[a], order[b] = order[b], order[a]
            alike = all(self._same_values(own, true) for own, true in zip(order, right, strict=True))
            if alike and self.task.quantity.equality.same(tuple(order), right, self.workbook.solution).equal:
                return (Slip("components", a, None, None),)
        return ()

    def _moved(self, given: Parts, written: tuple[WrittenPart, ...]) -> tuple[Slip, ...]:
        """A term that stands in one component and should stand in another."""
        right = self.workbook.right(self.task)
        values = Valued(self.workbook.sampler)
        wrong = [k for k, (own, true) in enumerate(zip(given, right, strict=True)) if not self._same_values(own, true)]
        if len(wrong) != 2:
            return ()
        for a, b in (wrong, wrong[::-1]):
            for spot in spots(written[a].tree, self.workbook.sampler.values(right[a]), values):
                if not spot.is_addend:
                    continue
                term = to_sympy(spot.node, self.workbook.solution.symbols)
                moved = {a: given[a] - term, b: given[b] + term}
                if all(self._same_values(moved[k], right[k]) for k in (a, b)):
                    return (Slip("exchanged", a, term, written[a].place(spot.node), node=spot.node),)
        return ()

    def _renamed(self, given: Parts) -> tuple[Slip, ...]:
        """Two coordinates or parameters of one unit, each written for the other: everywhere, or where it is wrong."""
        scene, solution = self.workbook.scene, self.workbook.solution
        groups = [[(p.name, p.unit) for p in scene.parameters], [(c.name, c.unit) for c in scene.free]]
        wrong = {index for index, _ in self._pairs(given)}
        for group in groups:
            for (one, unit), (other, same) in combinations(group, 2):
                for names in self._exchanges(one, other) if unit == same else ():
                    changes = (names if k in wrong else {} for k in range(len(given)))
                    changed = tuple(part.xreplace(each) for part, each in zip(given, changes, strict=True))
                    if self._right(changed) or self._right(tuple(part.xreplace(names) for part in given)):
                        return (Slip("exchanged", min(wrong, default=0), solution.q(one), None),)
        return self._with_other_functions(given)

    def _exchanges(self, one: str, other: str) -> Iterator[dict[sp.Expr, sp.Expr]]:
        solution = self.workbook.solution
        kinds: list[Callable[[str], sp.Expr]] = [solution.q]
        if one in solution.free:
            kinds += [solution.rate, solution.acceleration, solution.variation]
            yield {solution.rate(a): solution.rate(b) for a, b in ((one, other), (other, one))}
        yield {kind(a): kind(b) for kind in kinds for a, b in ((one, other), (other, one))}

    def _with_other_functions(self, given: Parts) -> tuple[Slip, ...]:
        """Sine for cosine of one argument throughout."""
        waves = {wave for part in given for wave in part.atoms(sp.sin, sp.cos)}
        for argument in sorted({wave.args[0] for wave in waves}, key=str):
            names = {w: (sp.cos if isinstance(w, sp.sin) else sp.sin)(argument) for w in waves if w.args[0] == argument}
            if self._right(tuple(part.xreplace(names) for part in given)):
                return (Slip("function", 0, None, None),)
        return ()

    def _right(self, changed: Parts) -> bool:
        equality, sampler = self.task.quantity.equality, self.workbook.sampler
        own, right = equality.fingerprint(changed, sampler), self.workbook.fingerprint(self.task)
        if not own or not right or len(own) != len(right) or not near(own, right):
            return False
        return equality.same(changed, self.workbook.right(self.task), self.workbook.solution).equal is True


@cached_method
def slip_search(workbook: Workbook, task: Task) -> SlipSearch:
    """The search for a task, kept with the workbook."""
    return SlipSearch(workbook, task)
