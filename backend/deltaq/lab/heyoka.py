"""heyoka's Taylor integrator over the equations of a model, if heyoka is installed.

It is given δq's own operations, M q̈ = f eliminated in expressions, and numbers in the place of parameters; it compiles
code for each set of equations and each tolerance.
Source: F. Biscani, D. Izzo, Revisiting high-order Taylor methods for astrodynamics and celestial mechanics, Monthly
Notices of the Royal Astronomical Society 504 (2021) 2614–2628.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from ..model import tape as t
from ..model.tape import Tape
from ..simulation.problem import Problem

NAME = "heyoka"
Expression = Any  # heyoka's own type, where it is installed


def can_do(problem: Problem) -> bool:
    """Whether heyoka is there, and the problem is smooth, without constraints and without events."""
    model = problem.model
    is_plain = not (problem.is_constrained or model.tape.has_choices)
    return find_spec(NAME) is not None and is_plain and model.events is None and model.switches is None


def solver(problem: Problem, tolerance: float, parameters: Sequence[float] | None = None) -> Any:
    """heyoka's integrator, at the initial state; `parameters` in the place of the problem's own."""
    return import_module(NAME).taylor_adaptive(
        _system(problem, parameters or problem.parameters), list(problem.state[: 2 * problem.degrees]), tol=tolerance
    )


def batch_solver(problem: Problem, tolerance: float) -> Any:
    """heyoka's integrator for as many motions side by side as it recommends, all at the initial state."""
    hy = import_module(NAME)
    start = np.repeat(problem.state[: 2 * problem.degrees, None], hy.recommended_simd_size(), axis=1)
    return hy.taylor_adaptive_batch(_system(problem, problem.parameters), start, tol=tolerance)


def _system(problem: Problem, parameters: Sequence[float]) -> list[tuple[Expression, Expression]]:
    """The derivative of each variable."""
    hy, n = import_module(NAME), problem.degrees
    variables = hy.make_vars(*(f"x{i}" for i in range(2 * n)))
    numbers = [hy.expression(float(value)) for value in parameters]
    values = _values(problem.model.tape, [*variables, hy.time, *numbers])
    outputs = [values[place] for place in problem.model.tape.outputs]
    mass = [[outputs[max(i, j) * (max(i, j) + 1) // 2 + min(i, j)] for j in range(n)] for i in range(n)]
    first = n * (n + 1) // 2
    accelerations = eliminated(mass, outputs[first : first + n])
    return [*zip(variables[:n], variables[n:], strict=True), *zip(variables[n:], accelerations, strict=True)]


def _values(tape: Tape, inputs: Sequence[Expression]) -> list[Expression]:
    """The value of each operation on a tape, as an expression."""
    hy, values = import_module(NAME), list[Expression]()
    for code, a, b, constant in zip(tape.codes, tape.a, tape.b, tape.constants, strict=True):
        if code == t.INPUT:
            values.append(inputs[a])
        elif code == t.CONSTANT:
            values.append(hy.expression(float(constant)))
        else:
            values.append(_value(int(code), values[a], values[b], float(constant)))
    return values


def _value(code: int, a: Expression, b: Expression, constant: float) -> Expression:
    simple: Mapping[int, Callable[[], Expression]] = {
        t.ADD: lambda: a + b,
        t.MULTIPLY: lambda: a * b,
        t.POWER: lambda: a**constant,
    }
    if code in simple:
        return simple[code]()
    operands = (a, b) if code == t.ARCTANGENT_2 else (a,)
    return getattr(import_module(NAME), t.NAMES[code])(*operands)


def eliminated(m: list[list[Expression]], f: list[Expression]) -> list[Expression]:
    """x of M x = f by Gauss's elimination, in expressions; `m` and `f` are given up."""
    n = len(f)
    for k in range(n):
        for i in range(k + 1, n):
            factor = m[i][k] / m[k][k]
            m[i] = [m[i][j] - factor * m[k][j] if j >= k else m[i][j] for j in range(n)]
            f[i] = f[i] - factor * f[k]
    x = list(f)
    for i in range(n - 1, -1, -1):
        rest = f[i]
        for j in range(i + 1, n):
            rest = rest - m[i][j] * x[j]
        x[i] = rest / m[i][i]
    return x
