"""Whether forces jump where a rate changes its sign, as dry friction does, so that they may hold a motion."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..errors import Problem as Mistake
from ..errors import RequestError
from ..simulation.derivatives import accelerations
from ..simulation.problem import Floats, Problem

LOOKED_AT = 24  # states around the start, in all directions
NEAR, JUMP = 1e-7, 1e-4  # of the rates on either side; of the accelerations, over their size, and over what is smooth


def require_no_sliding(problem: Problem) -> None:
    """Raises RequestError, with the names of the coordinates, where q̈ jumps with a rate.

    Forces that only have a kink there, |q̇| q̇ say, hold nothing. Looked at are states around the start.
    """
    sliding = dict.fromkeys(_sliding(problem)) if problem.model.switches is not None else {}
    if sliding:
        raise RequestError(Mistake("lab-sliding", "/scene", parameters={"names": ", ".join(sliding)[:80]}))


def _sliding(problem: Problem) -> Iterator[str]:
    """The coordinates whose rates stand in a switching function across which q̈ jumps."""
    rows = _around(problem)
    for index, names in enumerate(problem.model.layout.switches):
        below, above, farther = (_beside(problem, rows, index, side * NEAR) for side in (-1.0, 1.0, 3.0))
        jump, smooth = np.abs(above - below), np.abs(farther - above)
        if (jump > JUMP * np.abs(above) + 10.0 * smooth).any():
            yield names


def _around(problem: Problem) -> Floats:
    """Rows (q, q̇, t) in all directions around the start."""
    begin = np.append(problem.state[: 2 * problem.degrees], 0.0)
    number = np.arange(LOOKED_AT)[:, None] + np.sqrt(2.0) * np.arange(len(begin))
    return np.asarray(begin + np.cos(number) * np.maximum(1.0, np.abs(begin)))


def _beside(problem: Problem, rows: Floats, index: int, side: float) -> Floats:
    """q̈ a little on one side of where a switching function is zero: the rates are moved along its gradient."""
    n, moved = problem.degrees, rows.copy()
    for aim in (0.0, side):  # the first one comes close, and functions are linear in rates nearly always
        value, slopes = _switch(problem, moved, index), np.empty((len(rows), n))
        for d in range(n):
            nudged = moved.copy()
            nudged[:, n + d] += NEAR
            slopes[:, d] = (_switch(problem, nudged, index) - value) / NEAR
        size = np.maximum((slopes**2).sum(axis=1), 1e-300)
        moved[:, n : 2 * n] += ((aim - value) / size)[:, None] * slopes
    return accelerations(problem, moved[:, -1], moved)


def _switch(problem: Problem, rows: Floats, index: int) -> Floats:
    """The value of a switching function at rows (q, q̇, t)."""
    function = problem.model.switches
    if function is None:
        raise LookupError("there is no switching function")
    return function.table(problem.inputs(rows[:, -1], rows[:, :-1]))[:, index]
