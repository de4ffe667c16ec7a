"""POST /exports: files to take away."""

from __future__ import annotations

import httpx
import pytest

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
