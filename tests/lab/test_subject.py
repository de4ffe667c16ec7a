"""What an experiment is made on."""

from __future__ import annotations

from typing import Any

import pytest

from deltaq.contract.experiment import ExperimentRequest
from deltaq.errors import Problem, RequestError
from deltaq.lab.library import experiment_ids, get_experiment
from deltaq.lab.subject import methods_of, subject_of
from deltaq.simulation.library import method_ids


def test_experiments_follow_the_equations_as_if_no_event_ended_them() -> None:
    subject = subject_of(ExperimentRequest(scene="string-pendulum", t_end=5.0))
    assert subject.scene.events == ()
    assert subject.problem.model.events is None
    *_, last = get_experiment("convergence").run({"scene": "string-pendulum", "t_end": 5.0, "methods": ["rk4"]})
    assert "event" not in str(last.result)


JUMPS: dict[str, dict[str, Any]] = {
    "an impact": {"events": [{"name": "wall", "value": "2 - x", "then": "bounce", "restitution": "0.5"}]},
    "dry friction": {"loads": [{"name": "rubbing", "kind": "friction", "coordinate": "x", "force": "m"}]},
}


RANGE = {"parameter": "m", "from": 1.0, "to": 2.0, "count": 8}
ASKED = {"stability-map": {"x": RANGE, "y": RANGE}, "bifurcation": {"sweep": RANGE}}


@pytest.mark.parametrize("jump", JUMPS)
@pytest.mark.parametrize("experiment", experiment_ids())
def test_no_experiment_follows_one_set_of_equations_where_there_are_several(experiment: str, jump: str) -> None:
    line = {
        "format": 1,
        "id": "line",
        "title": "line",
        "dimension": 2,
        "coordinates": [{"name": "x", "rate": 1.0}],
        "parameters": [{"name": "m"}],
        "bodies": [{"name": "p", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
    }
    asked = ASKED.get(experiment, {})
    with pytest.raises(RequestError) as caught:
        list(get_experiment(experiment).run({"scene": line | JUMPS[jump], "t_end": 5.0} | asked))
    assert caught.value.problems == (Problem("lab-jumps", "/scene"),)


def test_methods_that_cannot_keep_constraints_are_left_out_or_refused_by_name() -> None:
    problem = subject_of(ExperimentRequest(scene="cartesian-pendulum", t_end=1.0)).problem
    assert [each.id for each in methods_of(problem, ())] == [name for name in method_ids() if name != "taylor"]
    with pytest.raises(RequestError) as caught:
        methods_of(problem, ["rk4", "taylor"])
    parameters = {"name": "taylor", "other": "dop853"}
    assert caught.value.problems == (Problem("method-constraints", "/methods/1", parameters=parameters),)
