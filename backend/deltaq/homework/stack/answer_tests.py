"""What a question for STACK computes of an answer: whether it is readable, right, a known mistake, or right in part.

All is decided in Maxima by values at fixed states, as the checker does before it proves anything: values are not at the
mercy of how a computer algebra happens to simplify. The functions stand in `grading.mac`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

import sympy as sp

from ...language.latex_printer import Typography
from ..equality import Parts, conserved, lagrangian, up_to_constant
from ..task import Task
from ..workbook import Workbook
from .maxima import maxima, maxima_name
from .states import States

ANSWER = "ans1"
OWN = "dq_own"
READABLE, EMPTY, RIGHT, SHARE = "dq_is_readable", "dq_is_empty", "dq_is_right", "dq_share"


def value(task: Task, parts: Iterable[sp.Expr]) -> str:
    """An answer as it is typed: an expression, a list, an equation `… = 0`, or a set of values."""
    texts = [maxima(part) for part in parts]
    match task.quantity.form:
        case "vector":
            return f"[{','.join(texts)}]"
        case "equation":
            return f"{texts[0]} = 0"
        case "equations":
            return "[" + ",".join(f"{text} = 0" for text in texts) + "]"
        case "set":
            return "{" + ",".join(texts) + "}"
        case _:
            return texts[0]


# --- the variables of a question --------------------------------------------------------------------------------------


def question_variables(workbook: Workbook, task: Task) -> str:
    """The right answer, the states, the functions, and how symbols are typeset."""
    return "\n".join(
        (
            f"ta1: {value(task, workbook.shown(task))};",
            *_typeset(workbook, task),
            *_states(workbook, task),
            _functions(),
        )
    )


def _typeset(workbook: Workbook, task: Task) -> Iterable[str]:
    typography = Typography(workbook.scene.names)
    for symbol in States(workbook, task).symbols:
        shown = typography.symbol(symbol.name).replace("\\", "\\\\").replace('"', "")
        yield f'texput({maxima_name(symbol.name)}, "{shown}");'


def _states(workbook: Workbook, task: Task) -> Iterable[str]:
    states, solution = States(workbook, task), workbook.solution
    jets = (solution.q, solution.rate, solution.acceleration)
    yield f"dq_names: {_listed(maxima_name(s.name) for s in states.symbols)};"
    groups = (_listed(_listed(f"{x:g}" for x in point) for point in group) for group in states.groups)
    yield f"dq_values: {_listed(groups)};"
    yield f"dq_scene: {_listed(f'{name} = {number!r}' for name, number in states.scene_values)};"
    for name, coordinates in (("dq_free", solution.free), ("dq_all", solution.coordinates)):
        yield f"{name}: {_listed(_listed(maxima_name(kind(q).name) for kind in jets) for q in coordinates)};"
    yield f"dq_special: {_listed(f'{maxima_name(s.name)} = {number!r}' for s, number in states.special)};"


@cache
def _functions() -> str:
    return files(__package__).joinpath("grading.mac").read_text(encoding="utf-8").strip()


def _listed(texts: Iterable[str]) -> str:
    return f"[{','.join(texts)}]"


def _list_of(parts: Parts) -> str:
    return _listed(map(maxima, parts))


# --- when answers are equal -------------------------------------------------------------------------------------------


def same(task: Task, parts: Parts) -> str:
    """Whether the answer equals this one, in the sense of its quantity."""
    right = _list_of(parts)
    match task.quantity.form:
        case "equation" | "equations":
            return f"dq_combined({OWN},{right})"
        case "set":
            return f"dq_frequencies({OWN},{right})"
        case _:
            shared = _shared(task)
            return f"dq_near({shared}({OWN}),{shared}({right}))"


def _shared(task: Task) -> str:
    named = {up_to_constant: "dq_differences_of", lagrangian: "dq_motions_of", conserved: "dq_ratios_of"}
    return next((f for module, f in named.items() if task.quantity.equality is module), "dq_values_of")


def right(workbook: Workbook, task: Task) -> str:
    """Whether the answer is right in any of the ways in which one can be."""
    exact = same(task, workbook.shown(task))
    if task.quantity.form in ("equation", "equations"):
        columns = _listed(map(str, _columns(workbook, task)))
        undivided = f"dq_undivided({OWN},{_list_of(workbook.shown(task))},{columns})"
        return f"if {exact} then {undivided} else {_solved(workbook, task)}"
    return " or ".join((exact, *_alternatives(workbook, task)))


def _columns(workbook: Workbook, task: Task) -> list[int]:
    """The numbers of the accelerations by which the equations are told apart."""
    accelerations = [workbook.solution.acceleration(q) for q in workbook.solution.free]
    parts = workbook.right(task)
    if len(parts) == len(accelerations):
        return list(range(1, len(parts) + 1))
    return [next(k for k, a in enumerate(accelerations, 1) if sp.expand(parts[0]).has(a))]


def _alternatives(workbook: Workbook, task: Task) -> Iterable[str]:
    """Answers that keep a constant force out of the potential, and so do not speak of it."""
    for parts, _ in workbook.alternatives(task):
        unspoken = workbook.right(task)[0].free_symbols - parts[0].free_symbols
        names = "".join(f"{maxima_name(symbol.name)}," for symbol in sorted(unspoken, key=str))
        yield f"(freeof({names}{OWN}) and {same(task, workbook.short(parts))})"


def _solved(workbook: Workbook, task: Task) -> str:
    """An equation solved for its own acceleration is a combination of all of them."""
    solution = workbook.solution
    if task.quantity.kind != "equation" or len(solution.free) < 2:
        return "false"
    others = ",".join(maxima_name(solution.acceleration(q).name) for q in solution.free if q != task.subject)
    whole = _list_of(workbook.short(tuple(map(solution.equation, solution.free))))
    return f"freeof({others},{OWN}) and dq_implied({OWN}[1],{whole})"


# --- the variables of the feedback ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Form:
    """How an answer of a form is taken apart, how many parts it has (None: any number), and what is empty."""

    read: str
    size: Callable[[Workbook, Task], int | None]
    empty: Callable[[Task], str]
    share: Callable[[Workbook, Task], str]


def feedback_variables(workbook: Workbook, task: Task) -> str:
    """What the nodes ask for. What cannot be read is not evaluated."""
    form = FORMS[task.quantity.form]
    size = form.size(workbook, task)
    counted = f"is(length({OWN}) > 0)" if size is None else f"is(length({OWN}) = {size})"
    lines = (
        f"{OWN}: map({form.read}, dq_parts({ANSWER}));",
        f"{READABLE}: {counted} and dq_readable({OWN});",
        f"{EMPTY}: {READABLE} and {form.empty(task)};",
        f"{RIGHT}: {READABLE} and not {EMPTY} and ({right(workbook, task)});",
        f"{SHARE}: if {READABLE} then {form.share(workbook, task)} else 0;",
    )
    return "\n".join(lines)


def _none(_workbook: Workbook, _task: Task) -> str:
    return "0"


def _components(workbook: Workbook, task: Task) -> str:
    """Of the components other than zero; one that should be zero and is not takes one away."""
    parts = workbook.shown(task)
    near = [f"dq_near(dq_all_points({OWN}[{k}]),dq_all_points({maxima(part)}))" for k, part in enumerate(parts, 1)]
    is_asked = [any(workbook.sampler.values(part)) for part in parts]
    asked = [test for test, counts in zip(near, is_asked, strict=True) if counts]
    zero = [f"not {test}" for test, counts in zip(near, is_asked, strict=True) if not counts]
    return f"max(0,dq_count({_listed(asked)})-dq_count({_listed(zero)}))/{max(1, len(asked))}"


def _equations(workbook: Workbook, task: Task) -> str:
    """Independent ones of the set; one too many that is wrong takes one away."""
    parts = workbook.shown(task)
    return f"dq_share_of_equations({OWN},{_list_of(parts)})"


def _frequencies(workbook: Workbook, task: Task) -> str:
    return f"dq_share_of_frequencies({OWN},{_list_of(workbook.shown(task))})"


def _steady(task: Task) -> str:
    return f"is(dq_ratios_of({OWN}) = [])" if task.quantity.kind == "conserved" else "false"


FORMS: Mapping[str, Form] = MappingProxyType(
    {
        "expression": Form("dq_named", lambda _w, _t: 1, _steady, _none),
        "vector": Form("dq_named", lambda workbook, task: len(workbook.right(task)), lambda _: "false", _components),
        "equation": Form("dq_residual", lambda _w, _t: 1, lambda _: f"dq_dependent({OWN})", _none),
        "equations": Form("dq_residual", lambda _w, _t: None, lambda _: f"dq_dependent({OWN})", _equations),
        "set": Form("dq_named", lambda _w, _t: None, lambda _: "false", _frequencies),
    }
)
