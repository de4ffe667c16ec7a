"""Integrators of others in the same harness, where they are installed.

SciPy's run over the same compiled right-hand side, heyoka's over code of its own, made of the same equations.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from time import perf_counter
from typing import Any

import numpy as np

from ..mechanics.jumps import frictions_of, impacts_of
from ..simulation.problem import Floats, Problem
from ..simulation.reference import Reference
from . import heyoka
from .measurement import REPEATS, Point, Setting, error_of, repeated
from .sweep import TOLERANCES, Track

SCIPY = ("RK45", "DOP853", "Radau", "BDF", "LSODA")
PEERS = (*(f"scipy-{name}" for name in SCIPY), heyoka.NAME)
OF_SERIES = tuple(10.0**-k for k in (3, 6, 9, 12, 15))  # each is compiled for
FINEST = 1e-12  # solve_ivp raises smaller relative tolerances by itself


def peer_tracks(problem: Problem, reference: Reference) -> list[Track]:
    """One track for each integrator of others that is there and can do the problem."""
    if not can_follow(problem):
        return []
    return [*_scipy_tracks(problem, reference), *_heyoka_tracks(problem, reference)]


def can_follow(problem: Problem) -> bool:
    """Whether integrators of others follow the same motion: none of them goes on behind an impact, or sticks."""
    return not (impacts_of(problem.model.scene) or frictions_of(problem.model.scene))


def title_of(peer: str) -> str:
    """What it calls itself."""
    return f"SciPy {peer.removeprefix('scipy-')}" if peer.startswith("scipy-") else peer


def _heyoka_tracks(problem: Problem, reference: Reference) -> list[Track]:
    if not heyoka.can_do(problem):
        return []
    settings = [Setting("tolerance", tolerance) for tolerance in OF_SERIES]
    return [Track(heyoka.NAME, settings, partial(_measured_series, problem, reference))]


def _measured_series(problem: Problem, reference: Reference, setting: Setting) -> Point:
    """Compiling does not count to the time of a run, and is told by itself; an order counts as an evaluation."""
    start = perf_counter()
    solver = heyoka.solver(problem, setting.value)
    prepared, state = perf_counter() - start, problem.state[: 2 * problem.degrees]

    def once() -> tuple[float, Any]:
        solver.time, solver.state[:] = 0.0, state
        start = perf_counter()
        found = solver.propagate_grid(reference.times)
        return perf_counter() - start, found

    first, (outcome, _, _, steps, *_, states) = once()
    if outcome != import_module(heyoka.NAME).taylor_outcome.time_limit:
        return Point(heyoka.NAME, setting, "diverged", None, preparation=prepared)
    seconds = repeated(lambda: once()[0], first, REPEATS)
    error = error_of(states[:, : problem.degrees], reference)
    work = int(steps) * int(solver.order)
    return Point(heyoka.NAME, setting, "ok", error, work, int(steps), seconds, prepared)


def _scipy_tracks(problem: Problem, reference: Reference) -> list[Track]:
    if find_spec("scipy") is None:
        return []
    import_module("scipy.integrate")  # now, so that no run that is measured has to
    settings = [Setting("tolerance", tolerance) for tolerance in TOLERANCES if tolerance >= FINEST]
    return [Track(f"scipy-{name}", settings, partial(_measured, problem, reference, name)) for name in SCIPY]


def _measured(problem: Problem, reference: Reference, name: str, setting: Setting) -> Point:
    def once() -> tuple[float, Any]:
        start = perf_counter()
        found = _solved(problem, reference.times, name, setting.value)
        return perf_counter() - start, found

    identifier = f"scipy-{name}"
    try:
        first, found = once()
    except (ArithmeticError, ValueError):  # where M has no inverse, or numbers are no longer finite
        return Point(identifier, setting, "diverged", None)
    if not found.success:
        return Point(identifier, setting, "diverged", None, int(found.nfev), 0, (first,))
    seconds = repeated(lambda: once()[0], first, 3)
    error = error_of(found.y.T[:, : problem.degrees], reference)
    return Point(identifier, setting, "ok", error, int(found.nfev), 0, seconds)


def _solved(problem: Problem, times: Floats, name: str, tolerance: float) -> Any:
    solve_ivp = import_module("scipy.integrate").solve_ivp
    start = problem.state[: 2 * problem.degrees]
    options = {"t_eval": times, "rtol": max(tolerance, 1e-13), "atol": tolerance}
    with np.errstate(all="ignore"):
        return solve_ivp(_rhs(problem), (0.0, float(times[-1])), start, method=name, **options)


def _rhs(problem: Problem) -> Callable[[float, Floats], Floats]:
    """ẏ = (q̇, M⁻¹ f) with as little around the compiled functions as Python allows."""
    n, motion = problem.degrees, problem.model.motion
    lower, half = np.tril_indices(n), n * (n + 1) // 2
    row, mass = np.zeros((1, motion.inputs)), np.zeros((n, n))
    row[0, 2 * n + 1 :] = problem.parameters

    def rhs(t: float, state: Floats) -> Floats:
        row[0, : 2 * n], row[0, 2 * n] = state, t
        out = motion.table(row)[0]
        mass[lower] = mass.T[lower] = out[:half]
        return np.concatenate([state[n:], np.linalg.solve(mass, out[half : half + n])])

    return rhs
