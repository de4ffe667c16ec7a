from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import Any

import httpx
import numpy as np
import pytest
from fastapi import FastAPI

from deltaq.api.routes import simulations
from deltaq.contract.simulation import SimulationAnswer
from deltaq.mechanics.library import load_scene, scene_ids

pytestmark = pytest.mark.anyio
SIMULATIONS = "/api/v1/simulations"


async def simulated(client: httpx.AsyncClient, **question: Any) -> SimulationAnswer:
    response = await client.post(SIMULATIONS, json=question)
    assert response.status_code == 200, response.text
    return SimulationAnswer.model_validate(response.json())


@pytest.mark.parametrize("identifier", [n for n in scene_ids() if all(e.bounces for e in load_scene(n).events)])
async def test_every_scene_is_simulated(client: httpx.AsyncClient, identifier: str) -> None:
    answer = await simulated(client, scene=identifier, t_end=2.0, samples=21)
    scene = load_scene(identifier)
    assert answer.status == "ok"
    assert answer.reason
    told = list(answer.t)  # those of events stand twice
    regular = [0.1 * number for number in range(21)]
    assert [t for t in told if told.count(t) == 1] == pytest.approx(regular[told.count(0.0) > 1 :])
    assert answer.coordinates is not None
    assert answer.coordinates.keys() == {coordinate.name for coordinate in scene.coordinates}
    assert answer.positions is not None
    assert scene.places.keys() <= answer.positions.keys()
    assert all(len(values) == len(answer.t) for values in answer.coordinates.values())
    assert all(len(place) == scene.dimension for places in answer.positions.values() for place in places)
    assert answer.energy is not None
    assert len(answer.energy.balance) == len(answer.t)


async def test_a_motion_does_not_wait_for_kernels_that_are_being_compiled(
    client: httpx.AsyncClient, app: FastAPI
) -> None:
    """It is computed by what there is, under a key of its own, so that the answer of compiled kernels comes later."""
    question = {"scene": "pendulum", "t_end": 1.25, "samples": 11}
    compiling = app.state.service.kernels._compiled
    compiling["explicit-runge-kutta"] = asyncio.Event()
    try:
        early = await client.post(SIMULATIONS, json=question)
    finally:
        compiling["explicit-runge-kutta"].set()
    later = await client.post(SIMULATIONS, json=question)
    assert (early.status_code, later.status_code) == (200, 200)
    np.testing.assert_allclose(early.json()["coordinates"]["phi"], later.json()["coordinates"]["phi"], atol=1e-9)
    assert early.headers["etag"] != later.headers["etag"]


async def test_a_motion_that_is_too_long_for_the_interpreter_waits_for_kernels(
    client: httpx.AsyncClient, app: FastAPI, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The interpreter gives up, twice; the answer is that of compiled kernels, once they are there, and no other."""
    question = {"scene": "double-pendulum", "t_end": 61.0, "samples": 11}
    kernels, are_there = app.state.service.kernels, asyncio.Event()
    jobs = {
        "SIMULATE_AT_ONCE": "simulate_on_new_machine",
        "SIMULATE_MEANWHILE": "simulate_longer_on_new_machine",
    }
    for name, target in jobs.items():
        on_new_machine = replace(getattr(simulations, name), target=f"tests.api.workers.jobs:{target}")
        monkeypatch.setattr(simulations, name, on_new_machine)
    monkeypatch.setitem(kernels._compiled, "explicit-runge-kutta", are_there)
    kernels._wanted.clear()
    early = asyncio.create_task(client.post(SIMULATIONS, json=question))
    try:
        async with asyncio.timeout(60.0):
            while "explicit-runge-kutta" not in kernels._wanted:
                await asyncio.sleep(0.05)
        await asyncio.sleep(0.1)
        assert not early.done()
    finally:
        are_there.set()
    found, later = await early, await client.post(SIMULATIONS, json=question)
    assert found.status_code == 200
    assert found.json()["status"] in {"ok", "horizon_reached"}
    assert (found.content, found.headers["etag"]) == (later.content, later.headers["etag"])


@pytest.mark.parametrize(
    ("language", "word"), [pytest.param("en", "The", id="English"), pytest.param("de", "Di", id="German")]
)
async def test_run_that_fails_is_an_answer_with_reason_and_remedy(
    client: httpx.AsyncClient, language: str, word: str
) -> None:
    answer = await simulated(
        client, scene="elastic-pendulum", t_end=200.0, samples=201, method="explicit-euler", step=0.5, lang=language
    )
    assert answer.status == "diverged"
    assert len(answer.t) < 201
    assert word in answer.reason
    assert answer.remedy
    assert "{" not in answer.reason + answer.remedy


@pytest.mark.parametrize(
    ("language", "title", "word", "time"),
    [
        pytest.param("en", "the string goes slack", "happened", "0.707723", id="English"),
        pytest.param("de", "Der Faden wird schlaff", "geschah", "0,707723", id="German"),
    ],
)
async def test_an_event_is_told_with_its_time(
    client: httpx.AsyncClient, language: str, title: str, word: str, time: str
) -> None:
    answer = await simulated(client, scene="string-pendulum", t_end=5.0, tolerance=1e-9, lang=language)
    assert answer.status == "event"
    assert answer.event is not None
    assert (answer.event.name, answer.event.title) == ("slack", title)
    assert answer.event.t == pytest.approx(0.7077229914537, abs=1e-9)
    assert answer.event.error is not None
    assert 0 < answer.event.error < 1e-8
    assert answer.t[-1] == pytest.approx(answer.event.t, abs=1e-9)
    assert all(part in answer.reason for part in (title, word, time))
    assert "{" not in answer.reason + answer.remedy


async def test_an_event_that_has_happened_at_the_start_is_a_problem_with_its_place(client: httpx.AsyncClient) -> None:
    question = {"scene": "string-pendulum", "t_end": 1.0, "initial": {"phi": {"value": 3.0, "rate": 0.0}}}
    response = await client.post(SIMULATIONS, json=question)
    assert response.status_code == 422
    (problem,) = response.json()["problems"]
    assert (problem["code"], problem["pointer"]) == ("event-at-start", "/scene/events/0/value")
    assert "-9.71" in problem["message"]


async def test_same_question_is_answered_from_memory(client: httpx.AsyncClient) -> None:
    question = {"scene": "pendulum", "t_end": 1.5, "samples": 16}
    first, second = [await client.post(SIMULATIONS, json=question) for _ in range(2)]
    assert first.content == second.content  # the wall time in it, too
    assert first.headers["etag"] == second.headers["etag"]


@pytest.mark.parametrize(
    ("question", "status", "pointer", "code"),
    [
        pytest.param({"scene": "nothing"}, 404, "/scene", "unknown-scene", id="unknown scene"),
        pytest.param({"method": "newton"}, 404, "/method", "unknown-method", id="unknown method"),
        pytest.param({"initial": {"x": {"value": 1}}}, 404, "/initial/x", "unknown-coordinate", id="coordinate"),
        pytest.param({"parameters": {"q": 1}}, 404, "/parameters/q", "unknown-parameter", id="parameter"),
        pytest.param({"include": ["all"]}, 422, "/include/0", "request-not-one-of", id="unknown part"),
        pytest.param({"scene": {"format": 1}}, 422, "/scene/bodies", "no-body", id="scene without bodies"),
        pytest.param({"step": 2.0}, 422, "/step", "request-outside", id="step longer than the run"),
        pytest.param({"tolerance": 1e-30}, 422, "/tolerance", "request-too-small", id="tolerance below rounding"),
    ],
)
async def test_wrong_question(
    client: httpx.AsyncClient, question: dict[str, Any], status: int, pointer: str, code: str
) -> None:
    response = await client.post(SIMULATIONS, json={"scene": "pendulum", "t_end": 1.0} | question)
    answer = response.json()
    assert response.headers["content-type"] == "application/problem+json"
    assert (response.status_code, answer["status"]) == (status, status)
    assert (pointer, code) in [(one["pointer"], one["code"]) for one in answer["problems"]]
    assert all(one["message"] != one["code"] for one in answer["problems"])


async def test_examples_of_the_documentation_work(client: httpx.AsyncClient) -> None:
    schema = (await client.get("/api/v1/openapi.json")).json()["components"]["schemas"]["SimulationRequest"]
    assert schema["examples"]
    for example in schema["examples"]:
        assert (await simulated(client, **example)).status == "ok"
