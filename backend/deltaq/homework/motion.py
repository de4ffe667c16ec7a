"""The motion that a student's answer describes, as a scene of its own.

Their equations A q̈ + c = 0 hold exactly in the given scene with the additional generalized forces
Q = b − M A⁻¹ c, where M q̈ + b = 0 is right: a wrong term is a force that is not there. The scene with these forces
can be simulated like any other.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast

import sympy as sp

from ..errors import ExpressionError, InputError, Problem
from ..language.canonical import display, is_zero
from ..language.parser import Syntax
from ..language.plain_printer import plain
from ..mechanics.document import read_scene
from ..mechanics.writing import write_scene
from .equality import Parts
from .equality.equations import system_of
from .own import OwnSolution
from .reading import read
from .solution import Solution
from .task import Task
from .workbook import Workbook

MOVING = frozenset(
    {"kinetic-energy", "potential-energy", "lagrangian", "momentum", "generalized-force", "equation", "equations"}
)
MOST_OPERATIONS = 1200
MOST_ELIMINATED = 3


def moved_scene(workbook: Workbook, task: Task, text: str, syntax: Syntax) -> dict[str, object]:
    """The document of the scene that moves as the answer says. Raises ExpressionError where none can be given."""
    if task.quantity.kind not in MOVING:
        raise ExpressionError(Problem("motion-not-asked", "/task", parameters={"task": task.id}))
    given = read(task, workbook.solution, text, syntax).parts
    forces = _forces(workbook, _equations(workbook, task, given))
    document = _with_forces(write_scene(workbook.scene), dict(zip(workbook.solution.free, forces, strict=True)))
    try:
        read_scene(document)
    except InputError:
        raise _unsolvable() from None
    return document


def _unsolvable() -> ExpressionError:
    return ExpressionError(Problem("motion-not-solvable", "/answer/value"))


def _equations(workbook: Workbook, task: Task, given: Parts) -> Parts:
    """All equations of motion that the answer leads to; what it does not say is taken as it is."""
    if task.quantity.form == "equations":
        return given
    own = OwnSolution(workbook.scene, workbook.solution, {task.id: given})
    return tuple(own.equation(q) for q in own.free)


def _forces(workbook: Workbook, own: Parts) -> Parts:
    """Q of every equation, in display form."""
    solution = workbook.solution
    if len(own) != len(solution.free):
        raise _unsolvable()
    mass, rest = system_of(tuple(solution.equation(q) for q in solution.free), solution)
    matrix, own_rest = system_of(own, solution)
    if matrix.free_symbols & {solution.acceleration(q) for q in solution.free}:
        raise _unsolvable()
    factors = [_factor(matrix[i, :], mass[i, :], solution) for i in range(mass.rows)]
    if None not in factors:
        return tuple(_short(b - c / k, solution) for b, c, k in zip(rest, own_rest, factors, strict=True))
    return _by_elimination(mass, rest, matrix, own_rest, solution)


def _factor(row: sp.Matrix, right: sp.Matrix, solution: Solution) -> sp.Expr | None:
    """k where the row is k times the right one: then Q = b − c/k, and no other equation is needed."""
    pivot = next((j for j in range(right.cols) if is_zero(right[j], solution.symbols) is False), None)
    if pivot is None or is_zero(row[pivot], solution.symbols) is not False:
        return None
    if not all(is_zero(row[j] * right[pivot] - right[j] * row[pivot], solution.symbols) for j in range(right.cols)):
        return None
    return display(row[pivot].expand(), solution.symbols) / display(right[pivot].expand(), solution.symbols)


def _by_elimination(
    mass: sp.Matrix, rest: sp.Matrix, matrix: sp.Matrix, own_rest: sp.Matrix, solution: Solution
) -> Parts:
    """Q = b − M A⁻¹ c, by Cramer's rule."""
    size = sum(entry.count_ops() for entry in (*mass, *rest, *matrix, *own_rest))
    if mass.rows > MOST_ELIMINATED or size > MOST_OPERATIONS:
        raise ExpressionError(Problem("motion-too-large", "/answer/value"))
    determinant = _short(matrix.det(method="berkowitz"), solution)
    if is_zero(determinant, solution.symbols) is not False:
        raise _unsolvable()
    above = rest * determinant - mass * matrix.adjugate() * own_rest
    return tuple(_short(entry, solution) / determinant for entry in above)


def _short(value: sp.Expr, solution: Solution) -> sp.Expr:
    return cast("sp.Expr", display(value.expand(), solution.symbols))


def _with_forces(document: dict[str, object], forces: Mapping[str, sp.Expr]) -> dict[str, object]:
    """The document with a moment for every force; without units, for the answer's may be wrong as well."""
    added = [
        {"kind": "moment", "name": f"answer_{q}", "angle": q, "moment": plain(force)}
        for q, force in forces.items()
        if force != 0
    ]
    loads = cast("list[object]", document["loads"])
    bare = {
        key: [_unitless(one) for one in cast("list[object]", document[key])] for key in ("coordinates", "parameters")
    }
    return {**document, **bare, "loads": [*loads, *added]}


def _unitless(thing: object) -> dict[str, object]:
    return {**cast("dict[str, object]", thing), "unit": ""}
