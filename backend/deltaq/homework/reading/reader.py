"""A reader of one answer: the members of its statements with their names resolved, and what a reading is."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from ...errors import ExpressionError, Problem
from ...language.choices import Choices
from ...language.parser import Syntax, parse
from ...language.symbols import Symbols
from ...language.sympy_algebra import to_sympy
from ...language.tree import Differential, Name, Node, Rate, Variation, walk
from ..equality import Parts
from ..solution import Solution
from ..task import Task
from .glossary import Glossary
from .layout import Layout, Range
from .substitution import substituted

HIGHEST_RATE = 2


@dataclass(frozen=True)
class Claim:
    """A member of a chain that is not the answer itself: what the answer would be by it, and where it stands."""

    parts: Parts
    place: Range
    shown: Any


@dataclass(frozen=True)
class Reading:
    """An answer as understood: its parts, the expression to show, and the trees with the text they were read from.

    `claims` are what else the answer says and must hold as well; `measured` are the trees whose dimensions tell whether
    the reading makes sense.
    """

    parts: Parts
    shown: Any
    trees: tuple[tuple[str, Node], ...]
    claims: tuple[Claim, ...] = ()
    measured: tuple[Node, ...] = ()


@dataclass(frozen=True)
class Member:
    """One side of a statement: its tree as typed, its tree and value with all names replaced."""

    place: Range
    typed: Node
    tree: Node
    value: Any
    explicit: bool


def refuse(code: str, **parameters: str | int) -> ExpressionError:
    """What is wrong with an answer as a whole."""
    return ExpressionError(Problem(code, parameters=parameters))


@dataclass(frozen=True)
class Reader:
    """What a reading needs: the task, the text by its statements, and the choices made where usage is divided."""

    task: Task
    solution: Solution
    layout: Layout
    syntax: Syntax
    choices: Choices
    glossary: Glossary

    def text(self, place: Range) -> str:
        """What stands at a place."""
        return self.layout.slice(place)

    def parsed(self, place: Range) -> Node:
        """The tree of a member. Blanks stand before it, so that its places are those of the answer."""
        start, end = place
        source = " " * start + without_ending(self.layout.text[start:end])
        tree = parse(source, self.glossary.names, self.syntax, self.choices).tree
        check_orders(tree)
        return tree

    def member(self, place: Range) -> Member:
        """A member with its value."""
        typed = self.parsed(place)
        try:
            tree = substituted(typed, self.glossary.trees, self.solution.scene.names.coordinates)
            value = to_sympy(tree, Symbols(self.glossary.names))
        except ExpressionError as error:
            raise ExpressionError(*(placed(problem, place) for problem in error.problems)) from None
        used = {node.name for node in walk(typed) if isinstance(node, Name | Rate | Variation | Differential)}
        return Member(place, typed, tree, value, explicit=not used & self.glossary.true)


def check_orders(tree: Node) -> None:
    """No equation of motion has a higher derivative than the second."""
    high = next((node for node in walk(tree) if isinstance(node, Rate) and node.order > HIGHEST_RATE), None)
    if high is not None:
        raise ExpressionError(Problem("answer-order", "", high.span.offset, high.span.length))


def without_ending(source: str) -> str:
    """Without the stop or comma of a sentence; the dot of \\right. is a bracket that is not drawn."""
    cut = re.sub(r"(?:[ ,.\t]|\\[,;!:](?![A-Za-z]))+$", "", source)
    return cut + "." * (cut.endswith("\\right") and source.startswith(".", len(cut)))


def placed(problem: Problem, place: Range) -> Problem:
    """A problem of a value that has no place of its own stands where its member does."""
    if problem.offset:
        return problem
    return replace(problem, offset=place[0], length=place[1] - place[0])


def scalar(value: Any) -> sp.Expr:
    """A single expression. Raises ExpressionError for anything else."""
    if isinstance(value, (sp.Eq, sp.Tuple)):
        raise refuse("answer-not-expression")
    if isinstance(value, sp.MatrixBase):
        raise refuse("answer-not-scalar")
    return value


def typed(reader: Reader, member: Member) -> tuple[tuple[str, Node], ...]:
    """The tree of a member with its text, where no name in it stands for something else."""
    return ((reader.layout.typed, member.typed),) if member.typed is member.tree else ()
