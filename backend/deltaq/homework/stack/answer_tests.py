"""How STACK decides whether two answers are equal: Maxima expressions that are zero exactly then.

Trigonometric identities are decided by trigsimp(trigexpand(…)); what STACK cannot see stays wrong there, while the
checker of δq decides it.
"""

from __future__ import annotations

import sympy as sp

from ..solution import Solution
from ..task import Task
from .maxima import maxima, maxima_name

ANSWER = "ans1"
RESIDUALS = "sres"


def preparation(task: Task) -> str:
    """Feedback variables: equations become residuals."""
    residual = "if equationp(ex) then lhs(ex)-rhs(ex) else ex"
    if task.quantity.form == "equation":
        return f"{RESIDUALS}: block([ex: {ANSWER}], [{residual}]);"
    if task.quantity.form == "equations":
        return f"{RESIDUALS}: map(lambda([ex], {residual}), {ANSWER});"
    return ""


def value(task: Task, parts: tuple[sp.Expr, ...]) -> str:
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


def difference(task: Task, parts: tuple[sp.Expr, ...], solution: Solution) -> tuple[str, str]:
    """What is compared with what by the test AlgEquiv."""
    texts = [maxima(part) for part in parts]
    match task.quantity.form:
        case "set":
            return ANSWER, "{" + ",".join(texts) + "}"
        case "equation":
            return _zero(_cross(parts[0], solution)), "0"
        case "equations":
            return _zero(_inserted(texts, solution)), _zeros(len(texts))
        case _:
            given = ANSWER if task.quantity.form == "expression" else f"({ANSWER})"
            right = texts[0] if task.quantity.form == "expression" else f"[{','.join(texts)}]"
            return _of_expression(task, f"{given}-({right})", solution), _target(task, solution, len(parts))


def _of_expression(task: Task, text: str, solution: Solution) -> str:
    """The difference, or for potentials and Lagrange functions its derivatives, so that a constant does not count."""
    if task.quantity.kind not in ("potential-energy", "lagrangian"):
        return _zero(text)
    moving = [maxima_name(s.name) for q in solution.free for s in (solution.q(q), solution.rate(q))]
    return _zero("[" + ",".join(f"diff({text},{name})" for name in moving) + "]")


def _target(task: Task, solution: Solution, size: int) -> str:
    if task.quantity.kind in ("potential-energy", "lagrangian"):
        return _zeros(2 * len(solution.free))
    return _zeros(size) if task.quantity.form == "vector" else "0"


def _zeros(size: int) -> str:
    return "[" + ",".join(["0"] * size) + "]"


def _zero(text: str) -> str:
    return f"trigsimp(trigexpand({text}))"


def _cross(right: sp.Expr, solution: Solution) -> str:
    """g ∂r/∂q̈ − r ∂g/∂q̈: zero if the equations g = 0 and r = 0 differ by a factor."""
    by = next((solution.acceleration(q) for q in solution.free if right.diff(solution.acceleration(q)) != 0), None)
    if by is None:
        return f"{RESIDUALS}[1]-({maxima(right)})"
    name = maxima_name(by.name)
    return f"{RESIDUALS}[1]*({maxima(right.diff(by))})-({maxima(right)})*diff({RESIDUALS}[1],{name})"


def _inserted(texts: list[str], solution: Solution) -> str:
    """The residuals with the accelerations of the right equations put in."""
    accelerations = ",".join(maxima_name(solution.acceleration(q).name) for q in solution.free)
    return f"subst(linsolve([{','.join(texts)}],[{accelerations}]),{RESIDUALS})"


def degenerate(task: Task, solution: Solution) -> tuple[str, str] | None:
    """What is zero if equations do not determine the accelerations; None for other tasks."""
    accelerations = [maxima_name(solution.acceleration(q).name) for q in solution.free]
    if task.quantity.form == "equations":
        rows = ",".join(f"map(lambda([ex], diff(ex,{a})), {RESIDUALS})" for a in accelerations)
        return _zero(f"determinant(matrix({rows}))"), "0"
    if task.quantity.form == "equation":
        return _zero("+".join(f"diff({RESIDUALS}[1],{a})^2" for a in accelerations)), "0"
    return None
