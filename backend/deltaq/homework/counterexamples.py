"""A state at which a wrong answer has another value than the right one, in the scene's values."""

from __future__ import annotations

import math
from collections.abc import Iterator

import sympy as sp

from ..derivation.compiled import compiled
from .equality import Parts, kept_by_constraints, where_kept
from .sampling import Sampler, echelon
from .solution import Solution
from .task import Task
from .verdict import Counterexample

SHIFTS = (0.3, 0.5, 0.8)
RELATIVE = 1e-6


def counterexample(task: Task, given: Parts, right: Parts, solution: Solution) -> Counterexample | None:
    """A state at which the answer and the right answer have different values; None where none is found.

    `given` and `right` are the components or residuals of the two; the values are in the units of the scene.
    """
    kept = bool(solution.conditions) and task.quantity.equality in (kept_by_constraints, where_kept)
    for state in _kept(solution) if kept else _states(solution):
        reference, gap = _reference(task, given, right, state, solution)
        for of, yours, value in _values(task, given, right, solution, state):
            true = value + gap
            finite = math.isfinite(yours) and math.isfinite(true)
            if finite and abs(yours - true) > RELATIVE * max(abs(yours), abs(true), 1e-3):
                unknown = _unknown(task, of, solution)
                shown, agreeing = (_shown(values, (*given, *right), unknown) for values in (state, reference))
                return Counterexample(shown, _rounded(yours), _rounded(true), of, agreeing)
    return None


def _reference(
    task: Task, given: Parts, right: Parts, state: dict[str, float], solution: Solution
) -> tuple[dict[str, float], float]:
    """Where a constant makes both answers agree, and the constant: at rest at zero, or where the scene starts."""
    if not task.quantity.up_to_constant:
        return {}, 0.0
    still = {name: 0.0 for name in state if name not in {p.name for p in solution.scene.parameters}}
    starts = {c.name: c.value for c in solution.scene.coordinates}
    for reference in (still, still | starts):
        gap = _at(given[0], state | reference) - _at(right[0], state | reference)
        if math.isfinite(gap):
            return reference, gap
    return {}, math.nan


def _states(solution: Solution) -> Iterator[dict[str, float]]:
    """Parameters as the scene states them; coordinates near where it starts, with rates of their own."""
    stated = solution.scene.parameter_values
    # A parameter that is 1 hides its power: the last states have other values.
    other = {p.name: round(p.value * (1.3 + 0.1 * k), 3) for k, p in enumerate(solution.scene.parameters)}
    sampler = Sampler(solution)
    for values, shift in ((v, s) for v in (stated, other) for s in SHIFTS):
        moving = [name.name for name in sampler.slots if name.name not in values]
        state = {name: round(shift + 0.1 * index, 2) for index, name in enumerate(moving)}
        starts = {c.name: round(c.value + shift, 2) for c in solution.scene.coordinates}
        yield values | state | starts


def _kept(solution: Solution) -> Iterator[dict[str, float]]:
    """States that keep the constraints: elsewhere neither answer says anything."""
    for state in kept_by_constraints.states_of(solution):
        yield {name: float(f"{value:.6g}") for name, value in state.items()}


def _values(
    task: Task, given: Parts, right: Parts, solution: Solution, state: dict[str, float]
) -> Iterator[tuple[str, float, float]]:
    if task.quantity.form in ("equation", "equations"):
        yield from _accelerations(given, right, solution, state)
        return
    numbered = task.quantity.form == "vector"
    for index, (a, b) in enumerate(zip(given, right, strict=False), 1):
        yield str(index) if numbered else "", _at(a, state), _at(b, state)


def _accelerations(
    given: Parts, right: Parts, solution: Solution, state: dict[str, float]
) -> Iterator[tuple[str, float, float]]:
    """Solved for the accelerations: one equation for its first one, the others given."""
    slots = [f"ddot({q})" for q in solution.free]
    left, other = (echelon([_row(part, slots, state) for part in parts]) for parts in (given, right))
    for index, q in enumerate(solution.free):
        if index < len(left) and index < len(other):
            yield f"ddot({q})", _solved(left[index], slots, state), _solved(other[index], slots, state)


def _solved(row: tuple[float, ...], slots: list[str], state: dict[str, float]) -> float:
    """The pivot's acceleration, from a row whose first entry other than 0 is 1."""
    pivot = next((k for k, entry in enumerate(row) if entry), 0)
    return -row[-1] - sum(row[k] * state[slot] for k, slot in enumerate(slots) if k > pivot)


def _row(part: sp.Expr, slots: list[str], state: dict[str, float]) -> list[float]:
    still = state | dict.fromkeys(slots, 0.0)
    rest = _at(part, still)
    return [*(_at(part, still | {slot: 1.0}) - rest for slot in slots), rest]


def _at(part: sp.Expr, state: dict[str, float]) -> float:
    symbols = {s: k for k, s in enumerate(part.free_symbols)}
    values = [state.get(s.name, math.nan) for s in symbols]
    try:
        return compiled(part, symbols)(values)
    except (TypeError, KeyError):
        return math.nan


def _unknown(task: Task, of: str, solution: Solution) -> set[str]:
    """What is solved for, and so not given: one acceleration, or all of a whole set."""
    return {f"ddot({q})" for q in solution.free} if task.quantity.form == "equations" else {of}


def _shown(state: dict[str, float], parts: Parts, unknown: set[str]) -> dict[str, float]:
    """Only what the two answers depend on."""
    used = {symbol.name for part in parts for symbol in part.free_symbols} - unknown
    return {name: value for name, value in state.items() if name in used}


def _rounded(value: float) -> float:
    return float(f"{value:.6g}") + 0.0  # no negative zero
