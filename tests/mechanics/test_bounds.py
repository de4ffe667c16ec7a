"""Values that no scene may have, whoever gives them: itself, a request, what varies in an ensemble, a sweep."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping

import pytest

from deltaq.contract.base import SceneWithChanges, SceneWithInitialValues
from deltaq.contract.experiments.bifurcation import BifurcationRequest
from deltaq.contract.reading import read
from deltaq.errors import InputError
from deltaq.handout.service import export_request
from deltaq.lab.prepared import prepared
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.requests import begun_scene, changed_scene
from deltaq.simulation import ensemble_answer, service

Document = Mapping[str, object]


def block(
    force: str = "mu*m*g", *, static: str | None = None, e: str | None = None, mass: str = "m"
) -> dict[str, object]:
    """A block that slides with friction, or falls on to a floor."""
    numbers = {"m": 1.0, "g": 9.81, "mu": 0.3, "mu_s": 0.4, "c": 0.0, "e": 0.5}
    friction = {"kind": "friction", "name": "R", "coordinate": "x", "force": force}
    floor = {"name": "floor", "value": "2 - x", "then": "bounce", "restitution": e}
    return copy.deepcopy(
        {
            "id": "block",
            "coordinates": [{"name": "x", "rate": 1.0}],
            "parameters": [{"name": name, "value": value, "positive": False} for name, value in numbers.items()],
            "bodies": [{"name": "block", "kind": "particle", "mass": mass, "position": ["x", "0"]}],
            "loads": [friction | ({} if static is None else {"static": static})],
            "events": [floor] if e else [],
        }
    )


# the scene, what is asked of it, the code, and where in the scene it stands
ASKED = [
    (block(), {"parameters": {"mu": -0.3}}, "friction-negative", "/loads/0/force"),
    (block(static="mu_s*m*g"), {"parameters": {"mu": 0.0, "mu_s": -0.1}}, "friction-negative", "/loads/0/static"),
    (block(static="mu_s*m*g"), {"parameters": {"mu": 0.5}}, "static-below-kinetic", "/loads/0/static"),
    (block("mu*m*g*(1 + dot(x)^2)", static="mu_s*m*g"), {"parameters": {"mu_s": 0.2}}, "static-below-kinetic", None),
    (block(mass="m - c"), {"parameters": {"c": 2.0}}, "mass-not-positive", "/bodies/0/mass"),
]
OF_STARTS = [
    (block("mu*(m*g - 10*x)"), {"initial": {"x": {"value": 1.0}}}, "friction-negative", "/loads/0/force"),
    (block("mu*m*g*dot(x)"), {"initial": {"x": {"rate": -1.0}}}, "friction-negative", "/loads/0/force"),
]


def derived(asked: Document) -> object:
    return changed_scene(read(SceneWithChanges, asked))


def begun(asked: Document) -> object:
    return begun_scene(read(SceneWithInitialValues, asked))


def simulated(asked: Document) -> object:
    return service.run({**asked, "t_end": 1.0})


def exported(asked: Document) -> object:
    return export_request({**asked, "form": "python", "t_end": 1.0})


def varied(asked: Document) -> object:
    return ensemble_answer.meant_by({**asked, "t_end": 1.0, "vary": {"parameters.g": [9.81, 1.6]}})


def refused(entry: Callable[[Document], object], asked: Document) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        entry(asked)
    return [(problem.code, problem.pointer) for problem in caught.value.problems]


@pytest.mark.parametrize("entry", [derived, begun, simulated, exported, varied])
@pytest.mark.parametrize(("scene", "asked", "code", "place"), ASKED)
def test_values_of_requests_are_bound_as_those_of_scenes(
    entry: Callable[[Document], object], scene: Document, asked: Document, code: str, place: str | None
) -> None:
    read_scene(scene)  # as it stands nothing is wrong
    assert refused(entry, {"scene": scene, **asked}) == [(code, f"/scene{place or '/loads/0/static'}")]


@pytest.mark.parametrize("entry", [begun, simulated, exported, varied])
@pytest.mark.parametrize(("scene", "asked", "code", "place"), OF_STARTS)
def test_friction_is_bound_where_the_motion_begins(
    entry: Callable[[Document], object], scene: Document, asked: Document, code: str, place: str
) -> None:
    read_scene(scene)
    assert refused(entry, {"scene": scene, **asked}) == [(code, f"/scene{place}")]


VARIED = [
    (block(), {"parameters.mu": [0.3, 0.0, -0.1]}, "friction-negative", "parameters.mu/2"),
    (block(), {"parameters.mu": {"from": 0.3, "to": -0.3, "count": 7}}, "friction-negative", "parameters.mu/to"),
    (block(), {"parameters.mu": {"from": -0.3, "to": 0.3, "count": 7}}, "friction-negative", "parameters.mu/from"),
    (
        block(),
        {"parameters.mu": {"normal": [0.0, 1.0], "count": 20, "seed": 1}},
        "friction-negative",
        "parameters.mu/normal",
    ),
    (block("mu*(m*g - 10*x)"), {"initial.x.value": [0.0, 1.5]}, "friction-negative", "initial.x.value/1"),
    (block(static="mu_s*m*g"), {"parameters.mu": [0.3, 0.5]}, "static-below-kinetic", "parameters.mu/1"),
    (block(e="e"), {"parameters.e": [1.0, 1.2]}, "restitution-outside", "parameters.e/1"),
    (block(e="e"), {"parameters.e": [0.0, -0.2]}, "restitution-outside", "parameters.e/1"),
    (block(mass="m - c"), {"parameters.c": [0.5, 1.5]}, "mass-not-positive", "parameters.c/1"),
]


@pytest.mark.parametrize(("scene", "vary", "code", "place"), VARIED)
def test_values_of_ensembles_are_bound_where_they_stand(scene: Document, vary: Document, code: str, place: str) -> None:
    assert refused(ensemble_answer.meant_by, {"scene": scene, "t_end": 1.0, "vary": vary}) == [(code, f"/vary/{place}")]


def test_what_several_varied_values_break_together_points_to_all_of_them() -> None:
    asked = {"scene": block(static="mu_s*m*g"), "t_end": 1.0, "combine": "together"}
    fine = {"parameters.mu": [0.3, 0.4], "parameters.mu_s": [0.6, 0.4]}
    assert len(ensemble_answer.meant_by({**asked, "vary": fine}).varied.ensemble) == 2
    broken = {"parameters.mu": [0.3, 0.5], "parameters.mu_s": [0.6, 0.4]}
    assert refused(ensemble_answer.meant_by, {**asked, "vary": broken}) == [("static-below-kinetic", "/vary")]


@pytest.mark.parametrize(
    ("scene", "name", "sweep", "code", "place"),
    [
        (block(), "mu", (-0.3, 0.3), "friction-negative", "from"),
        (block(static="mu_s*m*g"), "mu", (0.1, 0.5), "static-below-kinetic", "to"),
        (block(e="e"), "e", (0.5, 1.5), "restitution-outside", "to"),
    ],
)
def test_values_of_sweeps_are_bound(
    scene: Document, name: str, sweep: tuple[float, float], code: str, place: str
) -> None:
    asked = {"scene": scene, "sweep": {"parameter": name, "from": sweep[0], "to": sweep[1], "count": 10}}
    assert refused(lambda given: prepared(read(BifurcationRequest, given)), asked) == [(code, f"/sweep/{place}")]


@pytest.mark.parametrize("mu", [0.0, 0.3])
def test_friction_of_nothing_and_equal_friction_are_fine(mu: float) -> None:
    scene = block(static="mu_s*m*g")
    assert begun({"scene": scene, "parameters": {"mu": mu, "mu_s": mu}})
