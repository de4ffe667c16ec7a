"""Roots that recur have a letter: s for √((x₂ − x₁)² + (y₂ − y₁)²), with a line that says so.

The values of a step stay as they are; only how they are written and said changes. A root has the same letter in all
steps of a derivation. Whether a step uses it is decided by length: the operations saved against the line that says it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import sympy as sp

from ..derivation.formula import Explicit, Formula, Given, Substituted, Value
from ..derivation.premises import parts
from ..derivation.step import Chapter, Step
from ..language.names import Names
from ..language.operations import operations
from ..language.spelling import latex_of
from .aligned import aligned
from .notation import Notation

HALF = sp.Rational(1, 2)
LETTERS = ("s", "rho", "sigma", "eta")
MARKER = "namedroot"  # stands for a root while it is counted
DEFINITION = 2  # what the line that says it costs besides the root: "with", and the sign
LONG = 6  # operations of roots that are written by their letters wherever they stand, once they have some


@dataclass(frozen=True)
class Roots:
    """The letters of roots by what stands under the root, and which of them each step uses, by its id."""

    letters: Mapping[sp.Expr, str] = field(default_factory=dict)
    used: Mapping[str, tuple[sp.Expr, ...]] = field(default_factory=dict)

    def of(self, step: Step) -> dict[sp.Expr, str]:
        """The letters that the lines of a step have, in the order in which they are explained."""
        return {base: self.letters[base] for base in self.used.get(step.id, ())}


def with_roots(notation: Notation, letters: Mapping[sp.Expr, str]) -> Notation:
    """The notation that writes these letters."""
    return replace(notation, typography=replace(notation.typography, roots=letters)) if letters else notation


def named_roots(
    chapters: tuple[Chapter, ...], notation: Notation, known: Mapping[sp.Expr, str] = MappingProxyType({})
) -> Roots:
    """Letters for the roots that recur in a step; those that are known from chapters before keep theirs."""
    walked = (one for chapter in chapters for step in chapter.steps for one in step.walk())
    steps = _counted({step.id: step for step in walked}, notation)
    called = {_content(base): letter for base, letter in known.items()}
    recurring = dict.fromkeys(_content(base) for found in steps.values() for base in found if _recurs(found, base))
    new = [content for content in recurring if content not in called]
    names = _letters(len(new), notation.typography.names, notation, frozenset(known.values()))
    called |= dict(zip(new, names, strict=False))
    written = dict.fromkeys(base for found in steps.values() for base in found if _content(base) in called)
    letters = {**known, **{base: called[_content(base)] for base in written}}
    return Roots(letters, {name: tuple(_used(found, letters)) for name, found in steps.items()})


def _used(times: Mapping[sp.Expr, int], letters: Mapping[sp.Expr, str]) -> Iterator[sp.Expr]:
    """The roots that a step writes by their letters: what is shorter with them, or has long roots."""
    named = [base for base in letters if base in times]
    is_long = sum(_length(base) * times[base] for base in named) >= LONG
    return (base for base in named if is_long or _recurs(times, base))


def _recurs(times: Mapping[sp.Expr, int], base: sp.Expr) -> bool:
    """Whether a step is shorter with a letter and the line that says what it is."""
    count = sum(number for other, number in times.items() if _content(other) == _content(base))
    return (count - 1) * _length(base) > DEFINITION


def _content(base: sp.Expr) -> sp.Expr:
    """What two ways to write a root share: (x₁ − x₂)² and (x₂ − x₁)² are one."""
    return base.expand()


def _counted(steps: Mapping[str, Step], notation: Notation) -> dict[str, dict[sp.Expr, int]]:
    """How often each step writes each root of a sum, in the order in which they are written.

    All are marked at once; but a root within another, which would hide it, is marked by itself.
    """
    bases = {name: tuple(_bases(step)) for name, step in steps.items()}
    every = dict.fromkeys(base for found in bases.values() for base in found)
    inside = {part for base in every for part in base.atoms(sp.Add) if part != base}
    together = {base: f"{MARKER}_{number}" for number, base in enumerate(every) if base not in inside}
    marked = with_roots(notation, together)
    found = {}
    for name, step in steps.items():
        hidden = [base for base in bases[name] if base in inside]
        places = _places(step, marked, {base: together[base] for base in bases[name] if base in together})
        for base in hidden:
            places |= _places(step, with_roots(notation, {base: MARKER}), {base: MARKER})
        found[name] = {base: times for base, (_, times) in sorted(places.items(), key=lambda pair: pair[1])}
    return {name: times for name, times in found.items() if times}


def _places(step: Step, notation: Notation, marks: Mapping[sp.Expr, str]) -> dict[sp.Expr, tuple[int, int]]:
    """Where each mark stands first in the lines of the step, and how often it does; none that is not there."""
    text = aligned(step.relations, notation.formula) if marks else ""
    written = ((base, latex_of(mark)) for base, mark in marks.items())
    return {base: (text.index(mark), text.count(mark)) for base, mark in written if mark in text}


def _bases(step: Step) -> Iterable[sp.Expr]:
    """What stands under the square roots of the step, if it is a sum."""
    values = (value for relation in step.relations for value in _values(relation.members))
    powers = (power for value in values for power in sorted(value.atoms(sp.Pow), key=sp.default_sort_key))
    return dict.fromkeys(p.base for p in powers if p.base.is_Add and (p.exp - HALF).is_Integer)


def _length(base: sp.Expr) -> int:
    return operations(sp.sqrt(base))


def _values(formulas: Iterable[Formula]) -> Iterator[Value]:
    """The expressions that are written out in formulas."""
    for formula in formulas:
        if isinstance(formula, Given | Explicit):
            yield formula.value
        elif isinstance(formula, Substituted):
            yield from formula.values.values()
        yield from _values(parts(formula))


def _letters(count: int, names: Names, notation: Notation, known: frozenset[str]) -> tuple[str, ...]:
    """A free letter, with numbers if several roots have one; none if all are taken."""
    taken = {symbol.typeset for symbol in names.symbols} | {notation.value(notation.h)}
    heads = {name.partition("_")[0] for name in known}
    for letter in (letter for letter in LETTERS if letter not in heads):
        own = (letter,) if count == 1 else tuple(f"{letter}_{number}" for number in range(1, count + 1))
        if not taken & {latex_of(name) for name in (letter, *own)}:
            return own
    return ()


def explained(letters: Mapping[sp.Expr, str]) -> Iterator[tuple[sp.Symbol, sp.Expr]]:
    """Each letter as a symbol, and the root that it stands for, as it is written first."""
    first = {letter: base for base, letter in list(letters.items())[::-1]}
    return ((sp.Symbol(letter, real=True), sp.sqrt(first[letter])) for letter in dict.fromkeys(letters.values()))
