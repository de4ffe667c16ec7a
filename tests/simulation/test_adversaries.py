"""Motions made to fool a simulation: their truths begin as their scenes do, and the judge tells right from wrong."""

from __future__ import annotations

from dataclasses import replace
from random import Random
from typing import cast

import numpy as np
import pytest
from tests.simulation.adversaries import Draw, driven_oscillator
from tests.simulation.adversaries_of_state import KINDS, chain_of_springs
from tests.simulation.judging import Row, Trial, Verdict, draw_motions, judge, verdict

from deltaq.simulation.service import run

SOON = 1e-7


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_truth_begins_where_the_scene_does(kind: Draw) -> None:
    for motion, _ in draw_motions(kind, "begin", 4):
        rows = {str(row["name"]): row for row in cast("list[Row]", motion.scene["coordinates"])}
        values, rates = ([rows[name][part] for name in motion.names] for part in ("value", "rate"))
        first, second = motion.truth(np.array([0.0, SOON]))
        np.testing.assert_allclose(np.float64(first), values, atol=1e-12, rtol=1e-12)
        np.testing.assert_allclose(np.float64(second - first) / SOON, rates, atol=2e-3)


def test_draws_are_the_same_each_time() -> None:
    (one, _), (two, _) = (next(draw_motions(driven_oscillator, "again", 1)) for _ in range(2))
    assert one.scene == two.scene
    assert next(draw_motions(driven_oscillator, "other", 1))[0].scene != one.scene


@pytest.fixture(scope="module")
def trial() -> Trial:
    """Two masses that nothing is hard about."""
    return Trial(chain_of_springs(Random("judge"), [1.0, 2.0], 3.0, "two masses"), "rk4", ("tolerance", 1e-6), 51)


@pytest.fixture(scope="module")
def answer(trial: Trial) -> dict[str, object]:
    return run(trial.request)


def with_error(trial: Trial, size: float) -> Trial:
    """The same with a truth that lies elsewhere."""
    exact = trial.motion.truth
    return replace(trial, motion=replace(trial.motion, truth=lambda times: exact(times) + size * times[:, None]))


def test_right_answer_is_honest(trial: Trial) -> None:
    found = judge(trial)
    assert (found.status, found.is_met, found.is_silently_wrong(), found.is_false_alarm) == ("ok", True, False, False)
    assert 1.0 < found.excess < 1000.0
    assert found.effort > 1.0


def test_error_above_estimate_and_tolerance_is_silently_wrong(trial: Trial, answer: dict[str, object]) -> None:
    off = verdict(with_error(trial, 1e-3), answer)
    assert off.is_silently_wrong(100.0)
    assert off.worst == pytest.approx(3e-3, rel=0.5)
    within = verdict(with_error(trial, 2e-7), answer)
    assert not within.is_silently_wrong()
    assert within.uncovered > 1.0


def test_with_a_step_the_estimate_is_all_that_is_promised(trial: Trial) -> None:
    by_step = replace(trial, accuracy=("step", 0.01), method="rk4")
    answer = run(by_step.request)
    assert not verdict(by_step, answer).is_silently_wrong()
    assert verdict(with_error(by_step, 1e-4), answer).is_silently_wrong()


@pytest.mark.parametrize("status", ["horizon_reached", "unresolved"])
def test_warning_beside_a_good_curve_is_a_false_alarm(trial: Trial, answer: dict[str, object], status: str) -> None:
    def judged(size: float) -> Verdict:
        return verdict(with_error(trial, size), {**answer, "status": status})

    assert judged(0.0).is_false_alarm
    assert not judged(1e-3).is_false_alarm
    assert not judged(1e-3).is_silently_wrong()


def test_refusing_a_sound_scene_is_a_false_alarm(trial: Trial, answer: dict[str, object]) -> None:
    assert verdict(trial, {**answer, "status": "singular_mass_matrix", "t_reached": 0.0}).is_false_alarm
    unsound = replace(trial, motion=replace(trial.motion, scene={**trial.motion.scene, "bodies": []}))
    refused = judge(unsound)
    assert refused.status.startswith("refused: ")
    assert refused.is_false_alarm


def test_too_careful_counts_apart(trial: Trial, answer: dict[str, object]) -> None:
    found = verdict(trial, {**answer, "status": "tolerance_missed"})
    assert (found.is_too_careful, found.is_false_alarm) == (True, False)


def test_what_moves_on_has_not_stopped(trial: Trial, answer: dict[str, object]) -> None:
    assert verdict(trial, _cut({**answer, "status": "stopped"}, 20)).is_silently_wrong()
    assert not verdict(trial, _cut({**answer, "status": "diverged", "t_reached": 1.0}, 20)).is_silently_wrong()
    assert verdict(trial, _cut(answer, 20) | {"t_reached": 1.0}).is_silently_wrong()


def _cut(answer: dict[str, object], count: int) -> dict[str, object]:
    coordinates, error = (cast("dict[str, list[float]]", answer[part]) for part in ("coordinates", "error"))
    shorter = {name: values[:count] for name, values in coordinates.items()}
    told = {**error, "estimate": error["estimate"][:count]}
    return {**answer, "t": cast("list[float]", answer["t"])[:count], "coordinates": shorter, "error": told}
