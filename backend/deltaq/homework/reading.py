"""What a student wrote → the parts of an answer: a leading `T =` dropped, equations brought to one side."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ..errors import ExpressionError, InputError, Problem
from ..language.names import Names, Symbol
from ..language.parser import Syntax, parse
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..language.tree import Node, Rate, walk
from .equality import Parts
from .solution import Solution
from .task import Task

LABEL = re.compile(r"[^=+*/^≠<>]{1,48}=(?!=)")
CONSTANT = re.compile(r"=\s*(\\(text|mathrm|operatorname)\s*\{\s*)?const(ant|\.)?\.?\s*\}?\s*\.?\s*$", re.IGNORECASE)
ADDED = re.compile(r"\+\s*(C|(\\text\s*\{)?\s*const\.?\s*\}?)\s*$")
DECORATION = re.compile(r"\\(vec|mathbf|boldsymbol|bm|mathrm|text|underline|left|right|,|;|!|quad)|[\s{}\\]")
SEPARATOR = re.compile(r";|\n")
MAX_EQUATIONS = 12
HIGHEST_RATE = 2
GREEK = {"δ": "delta"}


@dataclass(frozen=True)
class Reading:
    """An answer as understood: its parts, the expression to show, and the trees with the text they were read from."""

    parts: Parts
    shown: Any
    trees: tuple[tuple[str, Node], ...]


def read(task: Task, solution: Solution, text: str, syntax: Syntax) -> Reading:
    """The answer to a task. Raises ExpressionError with the offset in the text."""
    names = _names(task, solution)
    pieces = list(_pieces(task, text, names, syntax))
    values = [(piece, *_parsed(text, piece, names, syntax)) for piece in pieces]
    trees = tuple((source, tree) for _, source, tree, _ in values)
    shown = values[0][3] if len(values) == 1 else _together([value for *_, value in values])
    found = tuple(part for _, _, _, value in values for part in _parts(task, solution, value))
    _check_count(task, solution, found)
    return Reading(found, shown, trees)


def _together(values: list[Any]) -> Any:
    return sp.Tuple(*(value if isinstance(value, sp.Eq) else sp.Eq(value, 0, evaluate=False) for value in values))


def _names(task: Task, solution: Solution) -> Names:
    """The scene's names; ω, ω₁ … besides where frequencies are asked for."""
    own = solution.scene.names.symbols[:-2]
    if task.quantity.form != "set":
        return solution.scene.names
    wanted = ("omega", *(f"omega_{n}" for n in range(1, len(solution.free) + 1)))
    taken = {symbol.name for symbol in own}
    return Names((*own, *(Symbol(name, "parameter", positive=True) for name in wanted if name not in taken)))


def _pieces(task: Task, text: str, names: Names, syntax: Syntax) -> Iterator[tuple[int, int]]:
    """Where in the text the expressions stand."""
    start, end = 0, len(text)
    if task.quantity.form in ("expression", "vector"):
        constant = _constant(task, text, names)
        end = constant.start() if constant else end
        start = _after_label(task, text[:end], names, syntax)
    if task.quantity.form not in ("equations", "set"):
        yield start, end
        return
    cuts = [*SEPARATOR.finditer(text)][:MAX_EQUATIONS]
    starts = [0, *(cut.end() for cut in cuts)]
    ends = [*(cut.start() for cut in cuts), len(text)]
    found = [(a, b) for a, b in zip(starts, ends, strict=True) if text[a:b].strip(" ,")]
    yield from found or [(0, len(text))]


def _constant(task: Task, text: str, names: Names) -> re.Match[str] | None:
    """`= const` after a conserved quantity, `+ C` after what is known up to a constant."""
    if task.quantity.kind == "conserved" and (found := CONSTANT.search(text)):
        return found
    return ADDED.search(text) if task.quantity.up_to_constant and names.get("C") is None else None


def _after_label(task: Task, text: str, names: Names, syntax: Syntax) -> int:
    """Where the expression begins after `T =`, `\\delta W =` or another name for what is asked."""
    label = LABEL.match(text)
    if label is None:
        return 0
    name = label.group()[:-1]
    plain = DECORATION.sub("", name)
    for letter, word in GREEK.items():
        plain = plain.replace(letter, word)
    bare = re.sub(r"[()]|_.*", "", plain)
    if bare in {re.sub(r"_.*", "", each).replace("δ", "delta") for each in task.quantity.labels}:
        return label.end()
    try:
        parse(name, names, syntax)
    except InputError:
        return label.end() if re.fullmatch(r"[A-Za-z_0-9()']{1,16}", plain) else 0
    return 0


def _parsed(text: str, piece: tuple[int, int], names: Names, syntax: Syntax) -> tuple[str, Node, Any]:
    start, end = piece
    source = _without_ending(text[start:end])
    try:
        tree = parse(source, names, syntax).tree
        _check_orders(tree)
        return source, tree, to_sympy(tree, Symbols(names))
    except ExpressionError as error:
        raise ExpressionError(*(_moved(problem, start) for problem in error.problems)) from None


def _check_orders(tree: Node) -> None:
    """No equation of motion has a higher derivative than the second."""
    high = next((node for node in walk(tree) if isinstance(node, Rate) and node.order > HIGHEST_RATE), None)
    if high is not None:
        raise ExpressionError(Problem("answer-order", "", high.span.offset, high.span.length))


def _without_ending(text: str) -> str:
    """Without the stop or comma of a sentence; the dot of \\right. is a bracket that is not drawn."""
    source = text.rstrip(" ,.")
    return source + "." * (source.endswith("\\right") and text.startswith(".", len(source)))


def _moved(problem: Problem, start: int) -> Problem:
    offset = None if problem.offset is None else problem.offset + start
    return Problem(problem.code, problem.pointer, offset, problem.length, problem.parameters, problem.severity)


def _parts(task: Task, solution: Solution, value: Any) -> Iterator[sp.Expr]:
    match task.quantity.form:
        case "vector":
            if not isinstance(value, sp.MatrixBase):
                raise ExpressionError(Problem("answer-not-vector", parameters={"count": solution.scene.dimension}))
            yield from value
        case "expression":
            yield _scalar(value)
        case "equation" | "equations":
            yield from map(_residual, _listed(value))
        case "set":
            yield from map(_frequency, _listed(value))


def _scalar(value: Any) -> sp.Expr:
    if isinstance(value, (sp.Eq, sp.Tuple)):
        raise ExpressionError(Problem("answer-not-expression"))
    if isinstance(value, sp.MatrixBase):
        raise ExpressionError(Problem("answer-not-scalar"))
    return value


def _listed(value: Any) -> list[Any]:
    """The members of a list, a column or a system."""
    if isinstance(value, sp.Eq) and isinstance(value.lhs, sp.MatrixBase):
        if value.lhs.shape != value.rhs.shape:
            raise ExpressionError(Problem("answer-not-scalar"))
        return [sp.Eq(a, b, evaluate=False) for a, b in zip(value.lhs, value.rhs, strict=True)]
    return list(value) if isinstance(value, (sp.Tuple, sp.MatrixBase)) else [value]


def _residual(value: Any) -> sp.Expr:
    return value.lhs - value.rhs if isinstance(value, sp.Eq) else _scalar(value)


def _frequency(value: Any) -> sp.Expr:
    """The right side of ω = …, its root of ω² = …, or the expression itself."""
    if not isinstance(value, sp.Eq):
        return _scalar(value)
    left = value.lhs
    if left.is_Symbol:
        return value.rhs
    if left.is_Pow and left.base.is_Symbol and left.exp == 2:
        return sp.sqrt(value.rhs)
    raise ExpressionError(Problem("answer-not-frequency"))


def _check_count(task: Task, solution: Solution, parts: Parts) -> None:
    expected = {"vector": solution.scene.dimension, "equation": 1}.get(task.quantity.form)
    if expected is not None and len(parts) != expected:
        code = "answer-components" if task.quantity.form == "vector" else "answer-one-equation"
        raise ExpressionError(Problem(code, parameters={"count": expected, "found": len(parts)}))
