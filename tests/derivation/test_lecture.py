"""The lecture's results, literally."""

from __future__ import annotations

from functools import cache

import pytest

from deltaq.narration.derive import derive_request


@cache
def answer(scene: str) -> dict:
    return derive_request({"scene": scene, "lang": "en"})


def steps(scene: str) -> dict[str, dict]:
    found: dict[str, dict] = {}

    def collect(step: dict) -> None:
        found[step["id"]] = step
        for substep in step["substeps"]:
            collect(substep)

    for chapter in answer(scene)["chapters"]:
        for step in chapter["steps"]:
            collect(step)
    return found


LINES = [
    pytest.param(
        "base-pendulum",
        "position:bob",
        r"\mathbf{r}(q_1, q_2) &= \begin{bmatrix} \ell \sin q_2 \\ q_1 + \ell \cos q_2 \end{bmatrix}",
        id="r_el(q1, q2)",
    ),
    pytest.param(
        "base-pendulum",
        "virtual-displacement:bob",
        r"\delta\mathbf{r} &= \frac{\partial \mathbf{r}}{\partial q_1}\,\delta q_1"
        r" + \frac{\partial \mathbf{r}}{\partial q_2}\,\delta q_2",
        id="chain rule of δr",
    ),
    pytest.param(
        "base-pendulum",
        "virtual-displacement:bob",
        r"\begin{bmatrix} 0 \\ 1 \end{bmatrix}\,\delta q_1"
        r" + \begin{bmatrix} \ell \cos q_2 \\ -\ell \sin q_2 \end{bmatrix}\,\delta q_2",
        id="δr by its tangents",
    ),
    pytest.param(
        "base-pendulum",
        "virtual-displacement:bob",
        r"\begin{bmatrix} \ell \cos q_2 \, \delta q_2 \\ \delta q_1 - \ell \sin q_2 \, \delta q_2 \end{bmatrix}",
        id="δr_el",
    ),
    pytest.param("guided-pendulum", "guide:y", r"q_1 &= y_0 \sin(\omega t)", id="the guide"),
    pytest.param(
        "guided-pendulum",
        "virtual-displacement:bob",
        r"\begin{bmatrix} \ell \cos q_2 \\ -\ell \sin q_2 \end{bmatrix}\,\delta q_2",
        id="δr_gef has no term of time",
    ),
    pytest.param(
        "guided-pendulum",
        "total-differential:bob",
        r"\frac{\partial \mathbf{r}}{\partial q_2}\,\mathrm{d}q_2"
        r" + \frac{\partial \mathbf{r}}{\partial t}\,\mathrm{d}t",
        id="dr_gef has one",
    ),
    pytest.param(
        "guided-pendulum",
        "total-differential:bob",
        r"\begin{bmatrix} 0 \\ y_0 \omega \cos(\omega t) \end{bmatrix}\,\mathrm{d}t",
        id="the term of time written out",
    ),
    pytest.param(
        "elastic-pendulum",
        "work-of-force:drive",
        r"\begin{bmatrix} F_0 \cos q_2 \\ -F_0 \sin q_2 \end{bmatrix} \cdot "
        r"\begin{bmatrix} \ell \cos q_2 \, \delta q_2 \\ \delta q_1 - \ell \sin q_2 \, \delta q_2 \end{bmatrix}",
        id="F · δr",
    ),
    pytest.param(
        "elastic-pendulum",
        "work-of-force:drive",
        r"-F_0 \sin q_2 \, \delta q_1 + F_0 \ell \, \delta q_2",
        id="δW of the external force",
    ),
]


@pytest.mark.parametrize(("scene", "step", "line"), LINES)
def test_line(scene: str, step: str, line: str) -> None:
    assert line in steps(scene)[step]["latex"]


def test_generalized_forces_of_the_external_force() -> None:
    forces = answer("elastic-pendulum")["result"]["generalized_forces"]["nonconservative"]
    assert {force["coordinate"]: force["latex"] for force in forces} == {"y": r"-F_0 \sin q_2", "phi": r"F_0 \ell"}


def test_the_variation_of_the_guided_position_leaves_time_alone() -> None:
    result = answer("guided-pendulum")["result"]
    assert result["virtual_displacements"]["bob"]["plain"] == ["l*cos(phi)*delta(phi)", "-l*sin(phi)*delta(phi)"]
    assert "omega" not in "".join(result["virtual_displacements"]["bob"]["plain"])


def test_terms_know_their_sources() -> None:
    equation = steps("elastic-pendulum")["equation:y"]
    assert sorted(equation["sources"]) == ["body:bob", "load:drive", "load:suspension", "load:weight"]
    assert r"\htmlClass{load-suspension}" in equation["marked"]
    assert r"\htmlClass" not in equation["latex"]


def test_the_term_of_time_is_marked() -> None:
    assert r"\htmlClass{time-term}" in steps("guided-pendulum")["total-differential:bob"]["marked"]
    assert r"time-term" not in steps("base-pendulum")["total-differential:bob"]["marked"]
