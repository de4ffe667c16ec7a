"""A scene with a rod more than it needs, by every address that takes a scene."""

from __future__ import annotations

from typing import Any

import httpx
import pytest
from tests.simulation.constrained import platform

from deltaq.mechanics.writing import write_scene

pytestmark = pytest.mark.anyio
SCENE: dict[str, Any] = {**write_scene(platform(3)), "title": {"de": "Tisch", "en": "Table"}}


async def asked(client: httpx.AsyncClient, address: str, **body: Any) -> Any:
    response = await client.post(f"/api/v1/{address}", json=body)
    assert response.status_code == 200, response.text
    return response.json() if "json" in response.headers["content-type"] else response.text


async def test_it_is_valid_derived_and_moves(client: httpx.AsyncClient) -> None:
    validity = await asked(client, "scenes/validate", **SCENE)
    assert [problem for problem in validity["problems"] if problem["severity"] == "error"] == []
    derived = await asked(client, "derivations", scene=SCENE, lang="en")
    assert derived["result"]["degrees_of_freedom"] == 1
    moved = await asked(client, "simulations", scene=SCENE, t_end=2.0, samples=21)
    assert (moved["status"], moved["undetermined"], moved["multipliers"]) == ("ok", ["S0", "S1", "S2"], {})


@pytest.mark.parametrize("form", ["latex", "markdown", "python"])
async def test_it_is_handed_out(client: httpx.AsyncClient, form: str) -> None:
    text = await asked(client, f"exports/{form}", scene=SCENE, lang="en", t_end=2.0)
    assert ("least(" in text) == (form == "python")


async def test_its_equations_are_practised(client: httpx.AsyncClient) -> None:
    told = await asked(client, "tasks", scene=SCENE, lang="en")
    kinds = {task["kind"] for task in told["tasks"]}
    assert "equation" in kinds
    assert "constraint-force" not in kinds
    answer = {"syntax": "plain", "value": "m*ddot(x) = -(S0 + S1 + S2)*x/l"}
    verdict = await asked(client, "checks", scene=SCENE, task="equation:x", answer=answer, lang="en")
    assert verdict["outcome"] == "correct"


async def test_what_is_held_fast_is_refused_in_words(client: httpx.AsyncClient) -> None:
    still = {"name": "stop", "kind": "equation", "equation": "y = -0.8*l"}
    scene = {**SCENE, "constraints": [*SCENE["constraints"], still]}
    response = await client.post("/api/v1/derivations", json={"scene": scene, "lang": "en"})
    (problem,) = response.json()["problems"]
    assert (response.status_code, problem["code"]) == (422, "too-many-constraints")
    assert problem["message"].startswith("The constraints (4) determine the free coordinates (3) completely")
