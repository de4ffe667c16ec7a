"""Work–precision and convergence: known orders, kept failures, and the cheapest run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from importlib.util import find_spec

import numpy as np
import pytest

from deltaq.errors import RequestError, UnknownNameError
from deltaq.lab import heyoka
from deltaq.lab.experiments.convergence import EXPERIMENT as CONVERGENCE
from deltaq.lab.experiments.work_precision import EXPERIMENT as WORK_PRECISION
from deltaq.lab.experiments.work_precision import cheapest
from deltaq.lab.measurement import Point, Setting, error_of, order_of
from deltaq.lab.report import Document, Report
from deltaq.lab.sweep import Track, sweep
from deltaq.mechanics.library import load_scene
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.reference import Reference
from deltaq.simulation.service import problem_of


def last(reports: Iterator[Report]) -> Document:
    return list(reports)[-1].result


def points_of(result: Mapping[str, object], method: str) -> list[Document]:
    points = result["points"]
    assert isinstance(points, list)
    return [point for point in points if point["method"] == method]


@pytest.fixture(scope="module")
def converged() -> Document:
    return last(CONVERGENCE.run({"scene": "elastic-pendulum", "t_end": 4.0}))


@pytest.mark.one_in(3)
@pytest.mark.parametrize("method", method_ids())
def test_the_slope_is_the_order(converged: Document, method: str) -> None:
    orders = converged["orders"]
    assert isinstance(orders, dict)
    assert orders[method]["theory"] == get_method(method).order
    assert orders[method]["measured"] == pytest.approx(get_method(method).order, rel=0.12)


def test_the_reference_states_its_own_error(converged: Document) -> None:
    reference = converged["reference"]
    assert isinstance(reference, dict)
    assert reference["methods"] == ["dop853", "gauss-6"]
    assert 0.0 < reference["error"] < 1e-11
    assert reference["complete"]


def test_a_step_too_large_is_kept_with_its_reason() -> None:
    """A stiff spring: explicit methods diverge with the steps that implicit ones take."""
    stiff = {"scene": "elastic-pendulum", "t_end": 4.0, "parameters": {"k": 5e4}, "methods": ["rk4", "radau-5"]}
    found = last(CONVERGENCE.run(stiff))
    failed = [point for point in points_of(found, "rk4") if point["error"] is None]
    assert {point["status"] for point in failed} <= {"diverged", "too_slow", "step_limit"}
    reports = list(CONVERGENCE.run({**stiff, "parameters": {"k": 5e6}}))
    statuses = {str(point["status"]) for point in points_of(reports[-1].result, "rk4")}
    assert statuses - {"ok"}


def test_every_report_says_how_far_it_is_and_keeps_what_was_found() -> None:
    reports = list(WORK_PRECISION.run({"scene": "pendulum", "t_end": 2.0, "methods": ["heun", "dop853"]}))
    done = [report.done for report in reports]
    assert done == sorted(done)
    assert done[-1] == reports[-1].total
    counts = [len(report.result["points"]) for report in reports]  # type: ignore[arg-type]
    assert counts == sorted(counts)
    assert {point["method"] for point in reports[-1].result["points"]} == {"heun", "dop853"}  # type: ignore[union-attr]


def test_the_cheapest_run_meets_the_tolerance_and_none_that_meets_it_is_cheaper() -> None:
    found = last(WORK_PRECISION.run({"scene": "double-pendulum", "t_end": 2.0, "methods": ["rk4", "dop853", "heun"]}))
    points, best = found["points"], found["cheapest"]
    assert isinstance(points, list)
    assert isinstance(best, list)
    assert best
    for one in best:
        assert one["error"] <= one["wanted"] * 1.001
        good = [p["time"] for p in points if p["error"] is not None and p["error"] <= one["wanted"]]
        assert one["time"] <= min(good) * 1.001


def test_peers_go_through_the_same_harness() -> None:
    found = last(WORK_PRECISION.run({"scene": "pendulum", "t_end": 1.0, "methods": ["dop853"], "peers": True}))
    names = {point["method"] for point in found["points"]}  # type: ignore[union-attr]
    assert {"scipy-DOP853", "scipy-Radau", "scipy-LSODA", "scipy-RK45", "scipy-BDF"} <= names
    errors = [point["error"] for point in points_of(found, "scipy-DOP853")]
    assert min(error for error in errors if isinstance(error, float)) < 1e-9


@pytest.mark.skipif(find_spec("heyoka") is None, reason="needs heyoka, of the extra bench")
@pytest.mark.parametrize("scene", ["double-pendulum", "kapitza", "spherical-pendulum"])
def test_heyoka_integrates_the_same_equations(scene: str) -> None:
    """M, f and the guides by its own functions: else its errors would not be those of its tolerances."""
    found = last(WORK_PRECISION.run({"scene": scene, "t_end": 1.0, "methods": ["taylor"], "peers": True}))
    points = points_of(found, "heyoka")
    assert [point["status"] for point in points] == ["ok"] * len(points)
    assert min(float(point["error"]) for point in points) < 1e-12
    assert all(point["preparation"] > 0.0 and point["evaluations"] >= point["steps"] > 0 for point in points)


def test_heyoka_takes_part_where_it_can(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not heyoka.can_do(problem_of(load_scene("four-bar"), 1.0))
    assert not heyoka.can_do(problem_of(load_scene("bouncing-ball"), 1.0))
    monkeypatch.setattr(heyoka, "find_spec", lambda _name: None)
    assert not heyoka.can_do(problem_of(load_scene("pendulum"), 1.0))


@pytest.mark.parametrize(
    ("request_", "kind", "code", "pointer"),
    [
        pytest.param({"methods": ["rk4", "rk5"]}, UnknownNameError, "unknown-method", "/methods/1", id="method"),
        pytest.param({"t_end": 1e6}, RequestError, "request-outside", "/t_end", id="span"),
        pytest.param({"peers": 1}, RequestError, "request-not-flag", "/peers", id="flag"),
        pytest.param({"speed": 1}, RequestError, "unknown-field", "/speed", id="unknown field"),
    ],
)
def test_bad_input_is_told_at_its_place(
    request_: dict[str, object], kind: type[RequestError], code: str, pointer: str
) -> None:
    with pytest.raises(kind) as caught:
        next(WORK_PRECISION.run({"scene": "pendulum", **request_}))
    assert [(problem.code, problem.pointer) for problem in caught.value.problems] == [(code, pointer)]


def test_a_slope_is_fitted_where_errors_are_neither_coarse_nor_rounding() -> None:
    def point(h: float, error: float) -> Point:
        return Point("x", Setting("step", h), "ok", error)

    points = [point(1.0, 1.0), *(point(h, h**3) for h in (0.1, 0.05, 0.025, 0.0125)), point(1e-5, 1e-14)]
    assert order_of(points, lambda p: 1.0 / p.setting.value, 1e-14) == pytest.approx(3.0)
    assert order_of(points[:2], lambda p: 1.0 / p.setting.value, 1e-14) is None


def test_a_slope_leaves_out_a_methods_own_rounding() -> None:
    """Of a method whose rounding lies far above that of the reference: those points are no part of its order."""
    errors = [1e-3 * 2.0 ** (-4 * k) for k in range(5)] + [3e-8, 2.5e-8, 4e-8]
    points = [Point("x", Setting("step", 2.0**-k), "ok", error) for k, error in enumerate(errors)]
    assert order_of(points, lambda p: 1.0 / p.setting.value, 1e-15) == pytest.approx(4.0, abs=0.1)


def test_no_run_is_more_accurate_than_the_reference() -> None:
    """Its own methods give back its own errors: zero, if they take the same steps."""
    times, values = np.array([0.0, 1.0]), np.array([[0.1], [0.2]])
    assert error_of(values, Reference(times, values, np.array([0.0, 3e-12]), ("a", "b"))) == 3e-12
    found = last(WORK_PRECISION.run({"scene": "double-pendulum", "t_end": 5.0, "methods": ["dop853", "gauss-6"]}))
    reference, points = found["reference"], found["points"]
    assert isinstance(reference, dict)
    assert isinstance(points, list)
    assert min(point["error"] for point in points if point["error"] is not None) >= reference["error"]


def test_an_error_is_absolute_below_one_and_relative_above() -> None:
    times = np.array([0.0, 1.0])
    trusted = Reference(times, np.array([[0.1], [100.0]]), np.zeros(2), ("a", "b"))
    assert error_of(np.array([[0.2], [100.0]]), trusted) == pytest.approx(0.1)
    assert error_of(np.array([[0.1], [101.0]]), trusted) == pytest.approx(0.01)
    assert error_of(np.array([[0.1]]), trusted) is None


def test_what_takes_too_long_is_said_once_and_not_tried() -> None:
    slow = Point("x", Setting("step", 1.0), "ok", 1e-3, seconds=(9.0,))
    settings = [Setting("step", 2.0**-k) for k in range(5)]
    track = Track("x", settings, lambda setting: replace(slow, setting=setting))
    trusted = Reference(np.zeros(1), np.zeros((1, 1)), np.full(1, 1e-14), ("a", "b"))
    assert list(sweep([track], trusted))[-1] == (5, 5)
    assert [point.status for point in track.points] == ["ok", "too_slow"]


@pytest.mark.parametrize("method", ["dop853", "dormand-prince-54", "radau-5"])
def test_settings_that_take_the_same_steps_do_not_end_a_track(method: str) -> None:
    """On a short span one step between two samples is enough for several tolerances: finer ones still gain."""
    found = last(WORK_PRECISION.run({"scene": "pendulum", "t_end": 1.0, "methods": [method]}))
    errors = [point["error"] for point in points_of(found, method)]
    assert min(error for error in errors if isinstance(error, float)) < 1e-12


def test_nothing_is_cheapest_where_nothing_is_accurate() -> None:
    assert cheapest([Point("x", Setting("step", 1.0), "diverged", None)], 1e-3) is None
