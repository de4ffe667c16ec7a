"""One reading of an answer, by the choices made where usage is divided."""

from __future__ import annotations

import re
from dataclasses import replace

from ...errors import ExpressionError, Problem
from ...language.choices import Choices
from ...language.parser import Syntax
from ..solution import Solution
from ..task import Task
from .definitions import defined
from .forms import FORMS
from .glossary import glossary_of
from .layout import MAX_MEMBERS, MAX_STATEMENTS, Layout
from .reader import Reader, Reading, refuse

CONSTANT = re.compile(
    r"=?\s*(\\(text|mathrm|operatorname)\s*\{\s*)?[ck]onst(ant|\.)?\.?\s*\}?\s*\.?\s*$", re.IGNORECASE
)
ADDED = re.compile(r"\+\s*(C|(\\text\s*\{)?\s*[ck]onst\.?\s*\}?)\s*$")


def read_once(task: Task, solution: Solution, layout: Layout, syntax: Syntax, choices: Choices) -> Reading:
    """The reading of an answer by these choices. Raises ExpressionError with the offset in the text."""
    if not layout.statements:
        raise ExpressionError(Problem("empty", "", 0, 0))
    if len(layout.statements) > MAX_STATEMENTS or any(len(one.members) > MAX_MEMBERS for one in layout.statements):
        raise refuse("answer-statements", limit=MAX_STATEMENTS)
    layout = _without_constant(task, solution, layout)
    reader = Reader(task, solution, layout, syntax, choices, glossary_of(task, solution, layout.text))
    statements, reader = defined(reader)
    return FORMS[task.quantity.form](reader, statements)


def _without_constant(task: Task, solution: Solution, layout: Layout) -> Layout:
    """`= const` after a conserved quantity and `+ C` after what is known up to a constant are dropped."""
    if not task.quantity.up_to_constant:
        return layout
    start, end = layout.statements[-1].members[-1]
    last = layout.slice((start, end))
    if task.quantity.up_to_factor and CONSTANT.fullmatch(last.strip()) and len(layout.statements[-1].members) > 1:
        shorter = replace(layout.statements[-1], members=layout.statements[-1].members[:-1])
        return replace(layout, statements=(*layout.statements[:-1], shorter))
    added = ADDED.search(last) if solution.scene.names.get("C") is None else None
    if added is None:
        return layout
    members = (*layout.statements[-1].members[:-1], (start, start + added.start()))
    return replace(layout, statements=(*layout.statements[:-1], replace(layout.statements[-1], members=members)))
