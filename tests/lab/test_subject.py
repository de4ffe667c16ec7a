"""What an experiment is made on."""

from __future__ import annotations

from deltaq.contract.experiment import ExperimentRequest
from deltaq.lab.library import get_experiment
from deltaq.lab.subject import subject_of


def test_experiments_follow_the_equations_as_if_no_event_ended_them() -> None:
    subject = subject_of(ExperimentRequest(scene="string-pendulum", t_end=5.0))
    assert subject.scene.events == ()
    assert subject.problem.model.events is None
    *_, last = get_experiment("convergence").run({"scene": "string-pendulum", "t_end": 5.0, "methods": ["rk4"]})
    assert "event" not in str(last.result)
