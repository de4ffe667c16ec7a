"""Health, methods, catalogs, OpenAPI, and the life of the application."""

from __future__ import annotations

import asyncio
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from deltaq import __version__
from deltaq.api import service as service_module
from deltaq.api.app import create_app
from deltaq.api.flights import Update
from deltaq.api.routes.derivations import derivation_id
from deltaq.api.service import Service, source_digest
from deltaq.api.workers.job import Job
from deltaq.api.workers.queue import Place
from deltaq.lab.library import experiment_ids
from deltaq.settings import Settings
from deltaq.simulation.library import method_ids

pytestmark = pytest.mark.anyio
API = "/api/v1"


async def test_health(client: httpx.AsyncClient) -> None:
    await client.post(f"{API}/scenes/validate", json={})  # now a worker is up
    answer = (await client.get(f"{API}/health")).json()
    assert (answer["status"], answer["version"]) == ("ok", __version__)
    assert answer["workers"].keys() == {"workers", "ready", "busy", "waiting", "kills", "processor_seconds"}
    assert answer["workers"]["workers"] == 3  # one is kept for what is fast
    assert answer["cache"].keys() == {"entries", "bytes", "hits", "misses"}


async def test_health_says_when_no_worker_is_up_yet() -> None:
    transport = httpx.ASGITransport(app=create_app(Settings(workers=1)))
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        assert (await client.get(f"{API}/health")).json()["status"] == "starting"


async def test_ready_once_a_worker_is_up(client: httpx.AsyncClient) -> None:
    await client.post(f"{API}/scenes/validate", json={})
    response = await client.get(f"{API}/ready")
    assert (response.status_code, response.json()) == (200, {"ready": True})


async def test_not_ready_without_a_worker() -> None:
    transport = httpx.ASGITransport(app=create_app(Settings(workers=1)))
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        response = await client.get(f"{API}/ready")
    assert (response.status_code, response.headers["retry-after"]) == (503, "2")
    assert response.json()["type"] == "/problems/overloaded"


async def test_no_place_in_the_queue_is_told_behind_a_part(app: FastAPI, monkeypatch: pytest.MonkeyPatch) -> None:
    """The queue is looked at now and again: that a job has begun is known by its first part, too."""
    service: Service = app.state.service

    async def run(_job: Any, _document: Any, tell_part: Any, _account: Any, tell_place: Any, _key: str) -> bytes:
        tell_place(Place(1, 2.0))
        tell_part(b"{}")
        tell_place(Place(0, 0.0))
        return b"{}"

    monkeypatch.setattr(service.laboratory, "run", run)
    told: list[Update] = []
    job = Job("json:loads", deadline=1.0)
    await service.measurement("in the queue", job, {}, told.append, anew=True, kernels=())
    assert [each.kind for each in told] == ["waiting", "part"]


async def test_version(client: httpx.AsyncClient) -> None:
    assert (await client.get(f"{API}/version")).json() == {"version": __version__, "source": source_digest()}


@pytest.mark.parametrize("language", ["de", "en"])
async def test_methods(client: httpx.AsyncClient, language: str) -> None:
    answer = (await client.get(f"{API}/methods", headers={"Accept-Language": language})).json()
    assert [method["id"] for method in answer["methods"]] == list(method_ids())
    for method in answer["methods"]:
        assert method.keys() >= {"id", "title", "order", "stages", "family", "adaptive", "symplectic"}
    rk4 = next(method for method in answer["methods"] if method["id"] == "rk4")
    assert (rk4["order"], rk4["stages"], rk4["adaptive"], rk4["symplectic"]) == (4, 4, False, False)


@pytest.mark.parametrize("language", ["de", "en"])
async def test_catalog(client: httpx.AsyncClient, language: str) -> None:
    response = await client.get(f"{API}/catalogs/{language}")
    answer = response.json()
    assert answer.keys() >= {"rules", "errors", "statuses", "page", "methods", "editor", "homework", "start"}
    assert {"type", "request-scene-type", "missing-field"} <= answer["errors"].keys()  # of three files
    again = await client.get(f"{API}/catalogs/{language}", headers={"If-None-Match": response.headers["etag"]})
    assert again.status_code == 304


async def test_sections_of_a_catalog(client: httpx.AsyncClient) -> None:
    response = await client.get(f"{API}/catalogs/de?sections=page,methods,none")
    assert response.json().keys() == {"page", "methods"}


async def test_catalog_of_a_language_we_do_not_speak(client: httpx.AsyncClient) -> None:
    response = await client.get(f"{API}/catalogs/fr")
    message = "There are no texts in fr; there are: de, en."
    assert response.status_code == 404
    assert response.json() == {
        "type": "/problems/unknown-name",
        "title": "There is nothing of this name",
        "status": 404,
        "detail": message,
        "problems": [
            {
                "pointer": "",
                "offset": None,
                "length": None,
                "code": "request-unknown-language",
                "severity": "error",
                "message": message,
            }
        ],
    }


async def test_openapi_describes_every_call(client: httpx.AsyncClient) -> None:
    description = (await client.get(f"{API}/openapi.json")).json()
    calls = {
        f"{method.upper()} {path.removeprefix(API)}"
        for path, methods in description["paths"].items()
        for method in methods
    }
    assert calls == {
        "GET /catalogs/{lang}",
        "GET /experiments",
        "POST /derivations",
        "POST /expressions",
        "POST /expressions/batch",
        "GET /derivations/{identifier}",
        "GET /health",
        "GET /ready",
        "GET /version",
        "GET /metrics",
        "GET /methods",
        "GET /scenes",
        "GET /scenes/{identifier}",
        "POST /scenes/toml",
        "POST /scenes/validate",
        "POST /simulations",
        "POST /variations",
        "GET /proofs",
        "GET /proofs/{identifier}",
        "GET /scenes/{identifier}/tasks",
        "POST /tasks",
        "POST /checks",
        "POST /checks/batch",
        "POST /checks/lines",
        "POST /checks/motion",
        "POST /checks/reading",
        "POST /checks/table",
        "POST /tasks/poll",
        "POST /tasks/solution",
        "POST /tasks/stack",
        "POST /assignments",
        "POST /practice",
        "POST /exports/{form}",
        "POST /ensembles",
        *(f"POST /experiments/{name}" for name in experiment_ids()),
    }
    for path, methods in description["paths"].items():
        for method, call in methods.items():
            assert call["summary"], (path, method)
            assert call["description"], (path, method)
            assert "HTTPValidationError" not in str(call), (path, method)


async def test_life_of_the_application() -> None:
    app: FastAPI = create_app(Settings(workers=2))
    async with app.router.lifespan_context(app):
        transport = httpx.ASGITransport(app=app)
        async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test", timeout=120) as client:
            assert (await client.post(f"{API}/scenes/validate", json={})).status_code == 200
        threads = app.state.service.pool._threads
        assert all(thread.is_alive() for thread in threads)
    await asyncio.sleep(0.1)
    assert [thread for thread in threads if thread.is_alive() or thread.worker] == []


async def test_web_process_does_not_load_the_libraries_of_the_workers() -> None:
    code = "import deltaq.api.app, json, sys; deltaq.api.app.create_app(); print(json.dumps(list(sys.modules)))"
    loaded = json.loads(subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.PIPE).stdout)
    assert "deltaq.api.app" in loaded
    assert {"sympy", "numpy", "numba", "symengine", "flint", "plotly"} & set(loaded) == set()


def test_other_code_has_other_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    """An answer of the version before is no answer of this one; the same question has the same key else."""
    question = {"scene": "pendulum"}
    derivation = {"scene": "pendulum", "formulation": "hamilton"}
    before = Service.key("a job", question), derivation_id(derivation)
    assert (Service.key("a job", dict(question)), derivation_id(dict(derivation))) == before
    monkeypatch.setattr(service_module, "source_digest", lambda: "another version")
    assert not {Service.key("a job", question), derivation_id(derivation)} & set(before)


def test_the_digest_is_of_all_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each kind of file in each package counts, wherever it stands; the files of the page do not."""
    copy = tmp_path / "deltaq"
    shutil.copytree(service_module.PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__", "static"))
    monkeypatch.setattr(service_module, "PACKAGE", copy)
    kinds = {
        (file.parent, file.suffix): file for file in sorted(copy.rglob("*")) if file.suffix in (".py", ".toml", ".json")
    }
    digests = {_digest_now()}
    for file in kinds.values():
        file.write_bytes(file.read_bytes() + b" ")
        digests.add(_digest_now())
    assert len(digests) == 1 + len(kinds) > 30
    (copy / "static").mkdir()
    (copy / "static" / "page.json").touch()
    assert _digest_now() in digests
    source_digest.cache_clear()


def _digest_now() -> str:
    source_digest.cache_clear()
    return source_digest()
