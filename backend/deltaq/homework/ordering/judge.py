"""Judges orders of blocks: every order is right in which each block stands after all those that it rests on.

`c; a; b`, with any signs between the letters, or none. What is wrong is told by the first block that does not belong or
stands before something it needs; as all blocks before it stand right, it lacks a block that it uses itself.

A wrong order earns its share by the fewest edits that mend it: taking a block out and putting one in are an edit each.
The most blocks that can stay are a largest set no two of which are the wrong way around. That relation is a partial
order, so the set is an antichain of it, and its size follows from a maximum matching (Dilworth, Fulkerson).
Source: Poulsen, Kulkarni, Herman, West, Efficient partial credit grading of Proof Blocks problems, AIED 2023.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from ...language.parser import Syntax
from ..equality import Parts
from ..model_questions import Understood, Written
from ..model_questions.wording import Piece, blanked, refuse
from ..solution import Solution
from ..verdict import BlockTold, Verdict
from .blocks import Block, Blocks, blocks_of

SPACED = re.compile(
    r"\\(?:begin|end)\s*\{[a-z*]+\}|\\(?:text|mathrm|mathit|textrm|operatorname)(?![A-Za-z])"
    r"|\\(?:to|rightarrow|Rightarrow|longrightarrow|mapsto|quad|qquad|left|right|cdot)(?![A-Za-z])"
    r"|\\[\\,;:!> ]|->|=>"
)
WORD = re.compile(r"[^\W_]+")
Order = tuple[str, ...]


@dataclass(frozen=True)
class Ordering:
    """Judges orders of the blocks that lead to one goal."""

    goal: str

    def read(self, solution: Solution, subject: str, text: str, syntax: Syntax) -> Understood[Order]:
        """The letters in the order given. Raises ExpressionError for what is no block, or comes twice."""
        known = blocks_of(solution, self.goal, subject)
        order = _letters(text if syntax == "plain" else blanked(SPACED, text), known)
        return Understood(_numbers(order, known), "; ".join(order), _typeset(order), order)

    def verdict(self, solution: Solution, subject: str, given: Understood[Order]) -> Verdict:
        """What is told is the first mistake; the share counts all."""
        known, order = blocks_of(solution, self.goal, subject), given.content
        found = _first_mistake(known, order)
        if found is None:
            return Verdict("correct")
        remark, blocks = found
        told = tuple(BlockTold(block.id, block.step.rule, block.step.about) for block in blocks)
        way = blocks[0].mistake
        named = (way.id,) if way is not None else ()
        about = way.about if way is not None else ""
        share = max(0.0, 1 - fewest_edits(known, order) / len(known.model))
        return Verdict("wrong", remark=remark, misconceptions=named, about=about, partial=share, blocks=told)

    def written(self, solution: Solution, subject: str, _language: str) -> Written:
        """The order of the derivation."""
        model = blocks_of(solution, self.goal, subject).model
        return Written(model, tuple(map(_letter, model)))


def value(solution: Solution, goal: str, subject: str) -> Parts:
    """The order of the derivation, as the numbers of the blocks."""
    known = blocks_of(solution, goal, subject)
    return _numbers(known.model, known)


# --- reading ---------------------------------------------------------------------------------------------------------


def _letters(text: str, known: Blocks) -> Order:
    letters = [block.id for block in known.shown]
    words = [Piece(found[0], found.start()) for found in WORD.finditer(text)]
    pieces = [one for word in words for one in _apart(word, letters)]
    if not pieces:
        raise refuse("empty")
    found: list[str] = []
    for piece in pieces:
        letter = piece.text.lower()
        if letter not in letters:
            raise refuse("answer-block-unknown", piece, name=piece.text[:20])
        if letter in found:
            raise refuse("answer-block-twice", piece, name=letter)
        found.append(letter)
    return tuple(found)


def _apart(word: Piece, letters: Sequence[str]) -> list[Piece]:
    """`cab` says three letters; any other word is one piece."""
    if set(word.text.lower()) <= set(letters):
        return [word.cut(place, place + 1) for place in range(len(word.text))]
    return [word]


def _numbers(order: Sequence[str], known: Blocks) -> Parts:
    place = {block.id: number for number, block in enumerate(known.shown, 1)}
    return tuple(sp.Integer(place[each]) for each in order)


def _letter(letter: str) -> str:
    return rf"\mathrm{{{letter}}}"


def _typeset(order: Order) -> str:
    return r" \to ".join(map(_letter, order))


# --- what is wrong ---------------------------------------------------------------------------------------------------


def _first_mistake(known: Blocks, order: Order) -> tuple[str, tuple[Block, ...]] | None:
    """The remark, and the blocks that it speaks of: the one that is wrong, then the one that it needs."""
    by_letter = {block.id: block for block in known.shown}
    for place, letter in enumerate(order):
        block = by_letter[letter]
        if block.mistake is not None:
            return "order-wrong-block", (block,)
        lacking = known.before[letter] - {*order[:place]}
        if lacking:
            needed = _nearest(lacking, known)
            return "order-needs" if needed in order else "order-needs-left-out", (block, by_letter[needed])
    left = [letter for letter in known.model if letter not in order]
    return ("order-left-out", (by_letter[left[-1]],)) if left else None


def _nearest(lacking: frozenset[str], known: Blocks) -> str:
    """The one that no other of them needs, and among several the first of the derivation."""
    own = lacking - frozenset().union(*(known.before[each] for each in lacking))
    return next(letter for letter in known.model if letter in own)


def fewest_edits(known: Blocks, order: Order) -> int:
    """How many blocks must be taken out or put in until the order is right."""
    belonging = [letter for letter in order if letter in known.before]
    kept = len(belonging) - _matching(_inverted(belonging, known.before))
    return (len(order) - kept) + (len(known.model) - kept)


def _inverted(order: Sequence[str], before: Mapping[str, frozenset[str]]) -> dict[str, list[str]]:
    """For each block those that stand behind it and ought to stand before it."""
    return {each: [other for other in order[place + 1 :] if other in before[each]] for place, each in enumerate(order)}


def _matching(pairs: Mapping[str, Sequence[str]]) -> int:
    """The size of a maximum matching, by augmenting paths (Kuhn)."""
    partner: dict[str, str] = {}

    def joined(one: str, seen: set[str]) -> bool:
        for other in pairs[one]:
            if other not in seen:
                seen.add(other)
                if other not in partner or joined(partner[other], seen):
                    partner[other] = one
                    return True
        return False

    return sum(joined(one, set()) for one in pairs)
