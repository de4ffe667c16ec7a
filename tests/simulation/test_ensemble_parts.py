"""Parts of an ensemble: whoever works them out and whenever they are done, put together they are the whole."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from threading import enumerate as threads_now
from time import monotonic
from typing import Any

import numpy as np
import pytest
from tests.simulation.scenes import oscillator
from tests.simulation.test_ensemble import cloud

from deltaq.mechanics.library import load_scene
from deltaq.simulation import ensemble_parts as engine
from deltaq.simulation.ensemble import Ensemble, EnsembleMotion, run_ensemble
from deltaq.simulation.ensemble_parts import Part, in_parts, joined
from deltaq.simulation.service import problem_of

ARRAYS = ("times", "values", "rates", "errors", "worst", "steps", "blind")


def runaways() -> Ensemble:
    """x″ = x³ runs away where it begins far out, early or late; others come to the end."""
    problem = problem_of(oscillator("m*x^3", x=0.1, u=0.0), 3.0, 11)
    states = np.column_stack([np.linspace(0.0, 3.0, 200), np.zeros(200)])
    return Ensemble(problem, states, np.repeat([problem.parameters], 200, axis=0))


def chaotic() -> Ensemble:
    """Some miss their tolerance and are run again, some lose all digits."""
    return cloud(problem_of(load_scene("double-pendulum"), 15.0, 5), 150)


def jumping() -> Ensemble:
    """Each is run by itself."""
    problem = problem_of(oscillator("-m*sign(x)", x=0.5, u=0.0), 4.0, 5)
    states = np.column_stack([np.linspace(0.5, 2.0, 20), np.zeros(20)])
    return Ensemble(problem, states, np.repeat([problem.parameters], 20, axis=0))


def pulsed() -> Ensemble:
    """Some are blind to a hill that is thinner than their steps, and are run again alone."""
    problem = problem_of(oscillator("m*x/(4*0.005^2)*exp(-(x/0.005)^2)", x=-1.0, u=1.0), 10.0, 11)
    states = np.column_stack([np.linspace(-1.4, 5.0, 90), np.ones(90)])
    return Ensemble(problem, states, np.repeat([problem.parameters], 90, axis=0))


def same(parts: EnsembleMotion, whole: EnsembleMotion) -> None:
    assert parts.outcomes == whole.outcomes
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name))


@pytest.mark.parametrize("made", [runaways, chaotic, jumping, pulsed])
def test_parts_put_together_are_the_whole(made: Callable[[], Ensemble]) -> None:
    ensemble = made()
    parts = list(in_parts(ensemble, 1e-9))
    assert len(parts) > 1
    assert sorted(n for part in parts for n in range(part.first, part.first + len(part))) == list(range(len(ensemble)))
    same(joined(parts).motion, run_ensemble(ensemble, 1e-9))


def test_parts_on_other_processes_give_the_same_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is sent to a cluster is pickled there and back."""
    monkeypatch.setattr(engine, "OF_CLUSTER", 8)
    ensemble = cloud(problem_of(load_scene("double-pendulum"), 2.0, 5), 20)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as cluster:
        parts = list(in_parts(ensemble, 1e-9, cluster))
    assert [(part.first, len(part)) for part in parts] == [(0, 8), (8, 8), (16, 4)]
    same(joined(parts).motion, run_ensemble(ensemble, 1e-9))


def test_where_a_part_fails_the_others_come_before_its_error(monkeypatch: pytest.MonkeyPatch) -> None:
    run_some = engine.run_some

    def failing(ensemble: Ensemble, *given: Any, **named: Any) -> EnsembleMotion:
        if ensemble.states[0, 0] == 0.0:
            raise ArithmeticError("of the first part")
        return run_some(ensemble, *given, **named)

    monkeypatch.setattr(engine, "run_some", failing)
    found = list[Part]()
    with pytest.raises(ArithmeticError, match="of the first part"):
        found.extend(in_parts(runaways(), 1e-9))
    assert sorted(part.first for part in found) == [64, 128, 192]


def test_what_is_under_way_ends_with_the_iterator() -> None:
    """Ten thousand of these would take a minute."""
    problem = problem_of(load_scene("double-pendulum"), 500.0, 5)
    parts = in_parts(cloud(problem, 10_000), 1e-6)
    next(parts)
    begin, before = monotonic(), {one.name for one in threads_now()}
    parts.close()  # type: ignore[attr-defined]  # it is a generator
    assert monotonic() - begin < 5.0
    assert {one.name for one in threads_now()} < before
