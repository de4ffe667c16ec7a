"""Experiments over HTTP: as one answer, as a stream, as files; refused, and given up."""

from __future__ import annotations

import asyncio
import csv
import io
import json
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from pydantic import BaseModel

from deltaq.api.kernels import Kernels
from deltaq.contract.experiment import ExperimentAnswer, request_of
from deltaq.lab.library import experiment_ids, get_experiment
from deltaq.narration.catalog import keys, text
from deltaq.packages import classes_of
from deltaq.simulation.library import ENSEMBLES, kernel_groups

pytestmark = [pytest.mark.anyio, pytest.mark.usefixtures("laboratory")]

AXES = {
    "x": {"parameter": "omega", "from": 20.0, "to": 80.0, "count": 8},
    "y": {"parameter": "y0", "from": 0.02, "to": 0.1, "count": 8},
}
# Questions that take little time; an experiment that is not named is asked for the motion of a pendulum.
SMALL: dict[str, dict[str, Any]] = {key: {"scene": "pendulum", "t_end": 1.0} for key in experiment_ids()} | {
    "work-precision": {"scene": "pendulum", "t_end": 1.0, "methods": ["rk4", "dop853"]},
    "convergence": {"scene": "pendulum", "t_end": 1.0, "methods": ["heun"]},
    "energy-drift": {"scene": "pendulum", "steps": 1000, "methods": ["rk4", "stormer-verlet"]},
    "stability": {"scene": "two-mass-oscillator", "t_end": 1.0, "methods": ["rk4", "radau-5"]},
    "stability-map": {"scene": "kapitza", **AXES},
    "chaos": {"scene": "double-pendulum", "t_end": 3.0, "map": True, "count": 16},
    "fidelity": {"scene": "elastic-pendulum", "t_end": 2.0},
    "bifurcation": {
        "scene": "driven-pendulum",
        "sweep": {"parameter": "gamma", "from": 1.06, "to": 1.07, "count": 8},
        "crossings": 6,
        "skip": 20,
        "folds": 1,
    },
    "poincare-section": {"scene": "coupled-pendulums", "t_end": 6.0, "count": 2, "crossings": 5},
    "uncertainty": {"scene": "coupled-pendulums", "t_end": 3.0, "runs": 40},
    "basins": {"scene": "damped-pendulum", "count": 8, "pairs": 0, "t_end": 40.0},
}


def address(name: str) -> str:
    return f"/api/v1/experiments/{name}"


async def test_every_experiment_has_a_call_and_every_call_an_experiment(client: httpx.AsyncClient) -> None:
    paths = (await client.get("/api/v1/openapi.json")).json()["paths"]
    calls = {path.removeprefix(address("")) for path in paths if path.startswith(address(""))}
    assert calls == set(experiment_ids())


def test_every_experiment_has_its_contract_and_every_contract_an_experiment() -> None:
    assert classes_of("deltaq.contract.experiments", "experiment").keys() == set(experiment_ids())
    for name in experiment_ids():
        experiment = get_experiment(name)
        assert (experiment.id, experiment.request) == (name, request_of(name))
        assert request_of(name).answer is not ExperimentAnswer


def undeclared(found: object, where: str = "") -> Iterator[str]:
    """Where an answer has members that its declaration does not name."""
    if isinstance(found, BaseModel):
        yield from (f"{where}/{name}" for name in found.model_extra or ())
        found = {name: getattr(found, name) for name in type(found).model_fields}
        if "scene" in found and isinstance(found["scene"], dict):
            del found["scene"]  # a document, which another declaration describes
    if isinstance(found, dict):
        for name, member in found.items():
            yield from undeclared(member, f"{where}/{name}")
    elif isinstance(found, tuple):
        for entry in found:
            yield from undeclared(entry, where)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", SMALL)
async def test_an_answer_has_its_charts_with_words_in_the_language_asked_for(
    client: httpx.AsyncClient, name: str
) -> None:
    for lang in ("en", "de"):
        response = await client.post(address(name), json={**SMALL[name], "lang": lang})
        assert response.status_code == 200, response.text
        answer = response.json()
        assert answer["experiment"] == name
        assert answer["scene"] == SMALL[name]["scene"]
        assert answer["charts"]
        declared = request_of(name).answer.model_validate_json(response.content)
        assert list(undeclared(declared)) == []
        assert declared.model_dump(mode="json", exclude_unset=True) == answer
        for chart in answer["charts"]:
            assert chart["title"]
            assert "{" not in chart["caption"] + chart["title"]
            assert chart["data"]
            assert " = " in chart["subject"]
            titles = [chart["layout"][axis]["title"]["text"] for axis in ("xaxis", "yaxis")]
            assert all(titles)
            assert not any(title.startswith("labs.") for title in titles)


async def events_of(response: httpx.Response) -> AsyncIterator[tuple[str, Any]]:
    """The events of a stream, as they come."""
    kind = ""
    async for line in response.aiter_lines():
        if line.startswith("event: "):
            kind = line.removeprefix("event: ")
        elif line.startswith("data: "):
            yield kind, json.loads(line.removeprefix("data: "))


async def test_a_stream_has_growing_parts_and_ends_with_the_result(client: httpx.AsyncClient) -> None:
    methods = ["heun", "rk4", "dop853", "gauss-6"]  # all of them are measured by the README's command
    question = {"scene": "elastic-pendulum", "t_end": 3.0, "methods": methods, "lang": "en"}
    headers = {"Accept": "text/event-stream"}
    async with client.stream("POST", address("work-precision"), json=question, headers=headers) as response:
        assert response.headers["content-type"].startswith("text/event-stream")
        assert response.headers["cache-control"] == "no-store"
        events = [event async for event in events_of(response)]
    found = [event for number, event in enumerate(events) if event[0] != "waiting" or "part" in dict(events[:number])]
    kinds = [kind for kind, _ in found]  # it may have waited for a worker before its first part, not after
    assert kinds == ["part"] * (len(kinds) - 1) + ["result"]
    parts = [data for kind, data in found if kind == "part"]
    assert parts
    assert all(0 < part["done"] <= part["total"] for part in parts)
    assert [part["done"] for part in parts] == sorted(part["done"] for part in parts)
    result = found[-1][1]
    again = (await client.post(address("work-precision"), json=question)).json()
    assert again == result  # from the cache: times would differ


async def streamed(app: FastAPI, address_of_client: str, question: dict[str, Any]) -> list[tuple[str, Any]]:
    """All events of an experiment that a client at this address asks for."""
    transport = httpx.ASGITransport(app=app, client=(address_of_client, 1))
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test", timeout=150) as one:
        response = await one.post(address("convergence"), json=question, headers={"Accept": "text/event-stream"})
        return [event async for event in events_of(response)]


async def test_different_experiments_of_a_class_wait_for_each_other_and_all_finish(app: FastAPI) -> None:
    questions = [SMALL["convergence"] | {"t_end": 1.0 + number / 64} for number in range(30)]
    found = await asyncio.gather(*(streamed(app, f"192.0.2.{n}", question) for n, question in enumerate(questions, 1)))
    assert [events[-1][0] for events in found] == ["result"] * 30
    assert len({events[-1][1]["t_end"] for events in found}) == 30
    waiting = [[told for kind, told in events if kind == "waiting"] for events in found]
    assert {places[0]["place"] for places in waiting if places} >= set(range(1, 20))  # as they stood at first
    for places in waiting:
        numbers = [told["place"] for told in places]
        assert numbers == sorted(numbers, reverse=True)
        assert all(told.keys() == {"place", "seconds"} and told["seconds"] >= 0.0 for told in places)


async def test_a_stream_that_is_refused_says_why(client: httpx.AsyncClient) -> None:
    question = {"scene": "pendulum", "x": {**AXES["x"], "parameter": "l"}, "y": {**AXES["y"], "parameter": "g"}}
    headers = {"Accept": "text/event-stream"}
    async with client.stream("POST", address("stability-map"), json=question, headers=headers) as response:
        told = [event async for event in events_of(response)]
    ((kind, problem),) = [event for event in told if event[0] != "waiting"]  # for a worker that has only begun
    assert (kind, problem["status"]) == ("problem", 422)
    assert [one["code"] for one in problem["problems"]] == ["no-period"]


REFUSED = [
    pytest.param("work-precision", {"methods": ["rk5"]}, 404, "/methods/0", "unknown-method", id="method"),
    pytest.param("work-precision", {"t_end": 5000.0}, 422, "/t_end", "request-too-large", id="span"),
    pytest.param("convergence", {"t_end": 5e-324}, 422, "/t_end", "request-too-small", id="no time at all"),
    pytest.param("chaos", {"t_end": 5e-324}, 422, "/t_end", "request-too-small", id="no time for chaos"),
    pytest.param("energy-drift", {"steps": 10**8}, 422, "/steps", "request-too-large", id="steps"),
    pytest.param("stability", {"at": "noon"}, 422, "/at", "request-not-one-of", id="place"),
    pytest.param("stability", {"stiffness": "q"}, 404, "/stiffness", "unknown-parameter", id="stiffness"),
    pytest.param("stability-map", {}, 422, "/x", "missing-field", id="no axes"),
    pytest.param(
        "stability-map", {**AXES, "x": {**AXES["x"], "count": 4000}}, 422, "/x/count", "request-too-large", id="grid"
    ),
    pytest.param(
        "stability-map", {**AXES, "y": AXES["x"]}, 422, "/y/parameter", "request-same-parameter", id="one parameter"
    ),
    pytest.param("stability-map", {**AXES, "x": {**AXES["x"], "to": 1.0}}, 422, "/x/to", "request-outside", id="range"),
    pytest.param(
        "stability-map",
        {"scene": "kapitza", **AXES, "x": {**AXES["x"], "from": 0.0}},
        422,
        "/x/from",
        "map-no-period",
        id="a frequency of zero",
    ),
    pytest.param("chaos", {"count": 5000}, 422, "/count", "request-too-large", id="map"),
    pytest.param("fidelity", {"tolerance": -1.0}, 422, "/tolerance", "request-too-small", id="tolerance"),
    pytest.param("fidelity", {"scene": {}}, 422, "/scene/bodies", "no-body", id="empty scene"),
    pytest.param("chaos", {"speed": 1}, 422, "/speed", "unknown-field", id="unknown field"),
]


@pytest.mark.parametrize(("name", "change", "status", "pointer", "code"), REFUSED)
async def test_what_is_out_of_bounds_is_refused_at_its_place(
    client: httpx.AsyncClient, name: str, change: dict[str, Any], status: int, pointer: str, code: str
) -> None:
    scene = "kapitza" if name == "stability-map" else "pendulum"
    response = await client.post(address(name), json={"scene": scene, **change})
    assert response.status_code == status
    assert (pointer, code) in [(one["pointer"], one["code"]) for one in response.json()["problems"]]


async def test_charts_as_a_table(client: httpx.AsyncClient) -> None:
    response = await client.post(address("convergence"), json=SMALL["convergence"], headers={"Accept": "text/csv"})
    assert response.headers["content-disposition"] == 'attachment; filename="convergence-pendulum.csv"'
    rows = list(csv.DictReader(io.StringIO(response.text)))
    assert list(rows[0]) == ["chart", "curve", "x", "y", "z"]
    assert all(float(row["x"]) > 0 and float(row["y"]) > 0 for row in rows)


async def test_charts_as_a_page_that_needs_nothing_else(client: httpx.AsyncClient) -> None:
    response = await client.post(address("chaos"), json=SMALL["chaos"], headers={"Accept": "text/html"})
    assert response.headers["content-type"].startswith("text/html")
    assert response.text.startswith("<!doctype html>")
    assert "<script src=" not in response.text
    assert len(response.text) > 1_000_000  # Plotly is in it


async def test_all_who_ask_for_the_same_share_one_experiment(client: httpx.AsyncClient, app: FastAPI) -> None:
    question, streamed = SMALL["work-precision"] | {"t_end": 1.5}, {"Accept": "text/event-stream"}
    cache, misses = app.state.service.cache, app.state.service.cache.misses
    first = asyncio.create_task(client.post(address("work-precision"), json=question))
    while not app.state.service.laboratory.state.busy:
        await asyncio.sleep(0.01)
    streams = [client.post(address("work-precision"), json=question, headers=streamed) for _ in range(30)]
    others = [asyncio.create_task(one) for one in streams]
    given_up = asyncio.create_task(client.post(address("work-precision"), json=question))
    await asyncio.sleep(0.1)
    given_up.cancel()
    answer, *told = await asyncio.gather(first, *others)
    results = [[event async for event in events_of(response)][-1] for response in told]
    assert results == 30 * [("result", answer.json())]  # times and all
    assert cache.misses == misses + 2  # one measurement and its charts


async def test_another_language_measures_nothing(client: httpx.AsyncClient, app: FastAPI) -> None:
    service, question = app.state.service, SMALL["work-precision"] | {"t_end": 1.25}
    english = (await client.post(address("work-precision"), json=question | {"lang": "en"})).json()
    spent = service.laboratory.state.processor_seconds
    assert spent > 0.0
    german = (await client.post(address("work-precision"), json=question | {"lang": "de"})).json()
    assert service.laboratory.state.processor_seconds == spent
    titles = [[chart["title"] for chart in answer.pop("charts")] for answer in (english, german)]
    assert english == german  # times and all
    assert titles[0] != titles[1]
    file = await client.post(address("work-precision"), json=question | {"lang": "de"}, headers={"Accept": "text/csv"})
    assert file.status_code == 200
    assert service.laboratory.state.processor_seconds == spent


ANEW = [
    pytest.param({"headers": {"Cache-Control": "no-cache"}}, {}, id="by the header"),
    pytest.param({}, {"fresh": True}, id="by the field"),
]


@pytest.mark.parametrize(("how", "more"), ANEW)
async def test_measured_anew_on_demand_and_kept_then(
    client: httpx.AsyncClient, app: FastAPI, how: dict[str, Any], more: dict[str, Any]
) -> None:
    question, cache = SMALL["work-precision"], app.state.service.cache
    first = await client.post(address("work-precision"), json=question)
    misses = cache.misses
    again = await client.post(address("work-precision"), json=question)
    assert (again.content, again.headers["etag"]) == (first.content, first.headers["etag"])
    anew = await client.post(address("work-precision"), json=question | more, **how)
    assert anew.json() != first.json()  # its times differ
    assert anew.headers["etag"] != first.headers["etag"]
    assert cache.misses == misses + 2  # the measurement and its charts
    kept = await client.post(address("work-precision"), json=question | {"fresh": False})
    assert kept.json() == anew.json()
    dates = [datetime.fromisoformat(answer.json()["taken"]["date"]) for answer in (first, anew)]
    assert dates[0] <= dates[1] <= datetime.now(UTC)


async def test_given_up_frees_the_bench(client: httpx.AsyncClient, app: FastAPI) -> None:
    pool = app.state.service.laboratory
    question = {"scene": "triple-pendulum", "t_end": 770.0, "peers": True}  # minutes
    running = asyncio.create_task(client.post(address("work-precision"), json=question))
    while not pool.state.busy:
        await asyncio.sleep(0.02)
    await asyncio.sleep(0.3)
    running.cancel()
    before = time.monotonic()
    while pool.state.busy:
        await asyncio.sleep(0.02)
        assert time.monotonic() - before < 30.0


@pytest.mark.parametrize("name", experiment_ids())
def test_every_experiment_has_a_title_in_both_languages(name: str) -> None:
    assert get_experiment(name).id == name
    assert len({text(lang, f"labs.experiments.{name}.summary") for lang in ("de", "en")}) == 2


@pytest.mark.parametrize("lang", ["de", "en"])
def test_the_menu_offers_the_experiments_that_there_are(lang: str) -> None:
    assert sorted(keys(lang, "labs.experiments")) == sorted(experiment_ids())


@contextmanager
def still_compiling(app: FastAPI, *groups: str) -> Iterator[None]:
    """A service that waits in vain for some groups of kernels."""
    before = app.state.service
    missing = {group: asyncio.Event() for group in groups}
    app.state.service = replace(before, kernels=Kernels(timeout=0.05, _compiled=missing))
    try:
        yield
    finally:
        app.state.service = before


@pytest.mark.always
@pytest.mark.parametrize(("name", "status"), [("poincare-section", 200), ("bifurcation", 503), ("convergence", 503)])
async def test_on_a_new_machine_an_experiment_waits_for_its_own_kernels_alone(
    app: FastAPI, client: httpx.AsyncClient, name: str, status: int
) -> None:
    """Sections take none of those that are compiled beforehand; the lanes of ensembles, or all methods, do not come."""
    with still_compiling(app, *kernel_groups()):
        response = await client.post(address(name), json={**SMALL[name], "fresh": True})
    assert response.status_code == status, response.text


async def test_on_a_new_machine_an_experiment_comes_with_its_kernels(app: FastAPI, client: httpx.AsyncClient) -> None:
    with still_compiling(app, *(group for group in kernel_groups() if group != ENSEMBLES)):
        response = await client.post(address("bifurcation"), json={**SMALL["bifurcation"], "fresh": True})
    assert response.status_code == 200, response.text
