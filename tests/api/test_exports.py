"""POST /exports: files to take away."""

from __future__ import annotations

from dataclasses import replace

import httpx
import pytest
from fastapi import FastAPI
from tests.derivation.large_scenes import large_scene

from deltaq.api.routes import exports
from deltaq.api.workers.job import Job

pytestmark = pytest.mark.anyio


@pytest.mark.parametrize(
    ("form", "media_type", "name", "beginning"),
    [
        pytest.param("latex", "application/x-tex", "pendulum.tex", "\\documentclass", id="latex"),
        pytest.param("markdown", "text/markdown", "pendulum.md", "# Mathematisches Pendel", id="markdown"),
        pytest.param("python", "text/x-python", "pendulum.py", "# Mathematisches Pendel", id="python"),
    ],
)
async def test_file(client: httpx.AsyncClient, form: str, media_type: str, name: str, beginning: str) -> None:
    answer = await client.post(f"/api/v1/exports/{form}", json={"scene": "pendulum", "lang": "de"})
    assert answer.status_code == 200
    assert answer.headers["content-type"] == f"{media_type}; charset=utf-8"
    assert answer.headers["content-disposition"] == f'attachment; filename="{name}"'
    assert answer.text.startswith(beginning)


@pytest.mark.parametrize(
    ("form", "body", "status", "pointer"),
    [
        pytest.param("word", {"scene": "pendulum"}, 422, None, id="unknown form"),
        pytest.param("latex", {"scene": "nothing"}, 404, "/scene", id="unknown scene"),
        pytest.param("latex", {}, 422, "/scene", id="no scene"),
        pytest.param("python", {"scene": "pendulum", "t_end": -1}, 422, "/t_end", id="time backwards"),
        pytest.param("python", {"scene": "pendulum", "t_end": 5e-324}, 422, "/t_end", id="a time without parts"),
        pytest.param("python", {"scene": "pendulum", "parameters": {"x": 1}}, 404, "/parameters/x", id="parameter"),
        pytest.param("python", {"scene": "pendulum", "initial": {"x": {}}}, 404, "/initial/x", id="coordinate"),
        pytest.param("latex", {"scene": "pendulum", "formulation": "x"}, 422, "/formulation", id="formulation"),
        pytest.param("latex", {"scene": {"format": 1}}, 422, "/scene/bodies", id="faulty document"),
    ],
)
async def test_refused(
    client: httpx.AsyncClient, form: str, body: dict[str, object], status: int, pointer: str | None
) -> None:
    answer = await client.post(f"/api/v1/exports/{form}", json=body)
    assert answer.status_code == status, answer.text
    problems = answer.json()["problems"]
    assert pointer is None or pointer in [problem["pointer"] for problem in problems]
    assert all(problem["message"] for problem in problems)


async def test_half_of_an_initial_state(client: httpx.AsyncClient) -> None:
    answer = await client.post(
        "/api/v1/exports/python", json={"scene": "pendulum", "initial": {"phi": {"value": 0.25}}}
    )
    assert answer.status_code == 200
    assert "0.25" in answer.text


@pytest.mark.parametrize("form", ["latex", "markdown"])
async def test_a_handout_for_which_the_time_is_not_enough_says_what_is_missing(
    client: httpx.AsyncClient, app: FastAPI, monkeypatch: pytest.MonkeyPatch, form: str
) -> None:
    service = app.state.service
    monkeypatch.setitem(vars(service), "settings", replace(service.settings, derivation_deadline=60.0))
    monkeypatch.setattr(exports, "EXPORT", Job("tests.api.slow:file_without_steps", 5.0, pace="slow"))
    question = {"scene": large_scene("hinges", 2, 5), "lang": "en"}
    answer = await client.post(f"/api/v1/exports/{form}", json=question)
    assert answer.status_code == 200, answer.text
    assert answer.text.count("The steps of this chapter are left out") > 4
    assert "Chapter 8 is missing" in answer.text
    assert all(f"phi{i}" in answer.text or f"varphi_{{{i}}}" in answer.text for i in (1, 2))
    monkeypatch.undo()
    whole = await client.post(f"/api/v1/exports/{form}", json=question)
    assert "left out" not in whole.text
    assert len(whole.text) > 2 * len(answer.text)
