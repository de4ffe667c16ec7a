"""What an experiment is made on."""

from __future__ import annotations

from typing import Any

import pytest
from tests.simulation.scenes import document

from deltaq.contract.experiment import ExperimentRequest
from deltaq.errors import Problem, RequestError
from deltaq.lab.library import experiment_ids, get_experiment
from deltaq.lab.sliding import require_no_sliding
from deltaq.lab.subject import methods_of, subject_of
from deltaq.mechanics.document import read_scene
from deltaq.narration.problems import described
from deltaq.simulation.library import method_ids
from deltaq.simulation.service import problem_of


def test_experiments_follow_the_equations_as_if_no_event_ended_them() -> None:
    subject = subject_of(ExperimentRequest(scene="string-pendulum", t_end=5.0))
    assert subject.scene.events == ()
    assert subject.problem.model.events is None
    *_, last = get_experiment("convergence").run({"scene": "string-pendulum", "t_end": 5.0, "methods": ["rk4"]})
    assert {point["status"] for point in last.result["points"]} == {"ok"}  # type: ignore[union-attr, index]
    assert last.result["events"] is False


WALL: dict[str, Any] = {"events": [{"name": "wall", "value": "2 - x", "then": "bounce", "restitution": "0.5"}]}
RUBBING: dict[str, Any] = {"loads": [{"name": "rubbing", "kind": "friction", "coordinate": "x", "force": "m"}]}
TOLD = {"impacts": ("wall", ("impact", "Stöße")), "friction": ("rubbing", ("dry friction", "trockene Reibung"))}
JUMPS: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "an impact": (WALL, ("impacts",)),
    "dry friction": (RUBBING, ("friction",)),
    "both": (WALL | RUBBING, ("impacts", "friction")),
}


RANGE = {"parameter": "m", "from": 1.0, "to": 2.0, "count": 8}
# see test_hybrid_orbits, test_hybrid_bifurcations, test_measurement
BEHIND_EVENTS = {"poincare-section", "bifurcation", "work-precision", "convergence"}
ASKED = {"stability-map": {"x": RANGE, "y": RANGE}, "bifurcation": {"sweep": RANGE}}


@pytest.mark.parametrize("jump", JUMPS)
@pytest.mark.parametrize("experiment", sorted({*experiment_ids()} - BEHIND_EVENTS))
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
    (more, kinds), asked = JUMPS[jump], ASKED.get(experiment, {})
    with pytest.raises(RequestError) as caught:
        list(get_experiment(experiment).run({"scene": line | more, "t_end": 5.0} | asked))
    problems = caught.value.problems
    assert problems == tuple(Problem(f"lab-{kind}", "/scene", parameters={"names": TOLD[kind][0]}) for kind in kinds)
    for place, language in enumerate(("en", "de")):
        told = " ".join(each["message"] for each in described(problems, language))
        for kind, (name, words) in TOLD.items():
            assert [name in told, words[place] in told] == [kind in kinds] * 2, told


FOLLOWING = ["poincare-section", "basins", "bifurcation", "chaos", "stability-map"]


@pytest.mark.parametrize("experiment", FOLLOWING)
def test_what_slides_is_refused_with_its_coordinate_and_what_has_a_kink_in_a_rate_is_not(experiment: str) -> None:
    """c sign(ẋ) holds what is at rest; drag c |ẋ| ẋ, whose formula also changes where ẋ = 0, holds nothing."""
    asked: dict[str, Any] = {"t_end": 40.0} | ASKED.get(experiment, {})
    rubbing, drag = (driven(f"-m*x + m*cos(t) - 0.3*{each}") for each in ("sign(dot(x))", "abs(dot(x))*dot(x)"))
    with pytest.raises(RequestError) as caught:
        list(get_experiment(experiment).run({"scene": rubbing} | asked))
    assert caught.value.problems == (Problem("lab-sliding", "/scene", parameters={"names": "x"}),)
    require_no_sliding(problem_of(read_scene(drag), 1.0))
    sides = problem_of(read_scene(driven("-m*x - step(x - 1) + m*cos(t) - 0.3*dot(x)")), 1.0)
    assert sides.model.switches is None
    require_no_sliding(sides)
    slides = problem_of(read_scene(driven("-m*x - sign(x + 2*dot(x))")), 1.0)  # on the line x + 2 ẋ = 0
    with pytest.raises(RequestError):
        require_no_sliding(slides)


def driven(force: str) -> dict[str, Any]:
    """A particle on a line, pushed."""
    push = {"kind": "force", "name": "push", "at": "p", "force": [force, "0"]}
    return document({"x": (1.0, 0.0)}, {"m": 1.0}, {"p": ("m", ["x", "0"])}, [push])


def test_methods_that_cannot_keep_constraints_are_left_out_or_refused_by_name() -> None:
    problem = subject_of(ExperimentRequest(scene="cartesian-pendulum", t_end=1.0)).problem
    assert [each.id for each in methods_of(problem, ())] == [name for name in method_ids() if name != "taylor"]
    with pytest.raises(RequestError) as caught:
        methods_of(problem, ["rk4", "taylor"])
    parameters = {"name": "taylor", "other": "dop853"}
    assert caught.value.problems == (Problem("method-constraints", "/methods/1", parameters=parameters),)
