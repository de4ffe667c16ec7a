"""The equations of motion are answered first; what is made of them follows, may be cut, and says so."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from tests.api.test_derivations import CHAPTERS, DERIVATIONS
from tests.derivation.large_scenes import large_scene

from deltaq.api.routes import derivations
from deltaq.api.workers.job import Job
from deltaq.contract.derivation import DerivationAnswer
from deltaq.narration.catalog import text

pytestmark = pytest.mark.anyio
EQUATIONS = [name for name in CHAPTERS if name != "model"]
BudgetOf = Callable[[str, float], None]


@pytest.fixture
def computed_by(app: FastAPI, monkeypatch: pytest.MonkeyPatch) -> BudgetOf:
    """Has derivations computed by a job of `slow`, within so many seconds of a processor."""

    def set_up(job: str, seconds: float) -> None:
        service = app.state.service
        monkeypatch.setitem(vars(service), "settings", replace(service.settings, derivation_deadline=seconds))
        monkeypatch.setattr(derivations, "DERIVE", Job(f"tests.api.slow:{job}", 5.0, pace="slow"))

    return set_up


def question(mass: float, **asked: str) -> dict[str, Any]:
    """One that nobody has asked before: what is kept would be no test."""
    return {"scene": "pendulum", "parameters": {"m": mass}, "lang": "en", **asked}


async def ask(client: httpx.AsyncClient, mass: float, **asked: str) -> DerivationAnswer:
    response = await client.post(DERIVATIONS, json=question(mass, **asked))
    assert response.status_code == 200, response.text
    return DerivationAnswer.model_validate(response.json())


def names(answer: DerivationAnswer) -> list[str]:
    return [chapter.id for chapter in answer.chapters]


def missing(answer: DerivationAnswer) -> list[tuple[str, str]]:
    return [(one.part, one.reason) for one in answer.left_out]


async def test_equations_and_the_rest_make_the_whole(client: httpx.AsyncClient) -> None:
    whole = await ask(client, 1.001)
    equations, rest = [await ask(client, 1.002, chapters=asked) for asked in ("equations", "model")]
    assert (names(whole), names(equations), names(rest)) == (CHAPTERS, EQUATIONS, ["model"])
    assert equations.chapters == whole.chapters[:-1]
    assert rest.chapters == whole.chapters[-1:]
    assert equations.id == rest.id != whole.id
    assert rest.result.equilibria == whole.result.equilibria
    assert equations.result.equations == whole.result.equations
    assert (missing(equations), missing(rest), missing(whole)) == ([("model", "later")], [], [])


async def test_what_was_derived_before_is_divided(client: httpx.AsyncClient) -> None:
    whole = await ask(client, 1.003)
    answers = [await ask(client, 1.003, chapters=asked) for asked in ("ready", "equations", "model")]
    assert [names(answer) for answer in answers] == [CHAPTERS, EQUATIONS, ["model"]]
    assert {answer.id for answer in answers} == {whole.id}


@pytest.mark.parametrize(("asked", "shown"), [("all", EQUATIONS), ("ready", EQUATIONS), ("model", [])])
async def test_an_endless_last_chapter_leaves_the_equations(
    client: httpx.AsyncClient, computed_by: BudgetOf, asked: str, shown: list[str]
) -> None:
    computed_by("endless", 3.0 if asked == "ready" else 1.0)  # which a busy machine does not reach before it answers
    if asked == "ready":
        assert missing(await ask(client, 1.11, chapters="ready")) == [("model", "later")]
        return
    answer = await ask(client, 1.12, chapters=asked)
    assert (names(answer), missing(answer)) == (shown, [("model", "time")])
    assert answer.left_out[0].text == text("en", "rules.left-out.time")
    assert answer.result.equations


async def test_what_was_cut_is_not_kept(
    client: httpx.AsyncClient, computed_by: BudgetOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    computed_by("endless", 1.0)
    response = await client.post(DERIVATIONS, json=question(1.13))
    assert "content-location" not in response.headers
    assert (await client.get(f"{DERIVATIONS}/{response.json()['id']}")).status_code == 404
    monkeypatch.undo()
    assert names(await ask(client, 1.13)) == CHAPTERS


async def test_a_mistake_in_the_last_chapter_leaves_the_equations(
    client: httpx.AsyncClient, computed_by: BudgetOf, caplog: pytest.LogCaptureFixture
) -> None:
    computed_by("failing", 5.0)
    answer = await ask(client, 1.14)
    assert (names(answer), missing(answer)) == (EQUATIONS, [("model", "failed")])
    assert "of the last chapter" in caplog.text


async def test_without_equations_the_computation_is_too_large(client: httpx.AsyncClient, computed_by: BudgetOf) -> None:
    computed_by("hopeless", 0.5)
    for asked in ("all", "equations", "ready", "model"):
        assert (await client.post(DERIVATIONS, json=question(1.15, chapters=asked))).status_code == 504


async def test_the_rest_is_computed_once_while_the_equations_are_read(
    client: httpx.AsyncClient, computed_by: BudgetOf, app: FastAPI
) -> None:
    computed_by("unhurried", 5.0)
    misses = app.state.service.cache.misses
    first = await ask(client, 1.16, chapters="ready")
    assert (names(first), missing(first)) == (EQUATIONS, [("model", "later")])
    await asyncio.sleep(0.7)  # longer than a computation goes on that nobody waits for
    rest = await ask(client, 1.16, chapters="model")
    assert (names(rest), missing(rest)) == (["model"], [])
    assert app.state.service.cache.misses == misses + 1
    assert names(await ask(client, 1.16)) == CHAPTERS


@pytest.mark.parametrize("asked", ["all", "equations", "model", "ready"])
async def test_steps_of_a_large_scene_that_take_too_long_leave_its_equations(
    client: httpx.AsyncClient, computed_by: BudgetOf, asked: str
) -> None:
    computed_by("without_steps", 60.0)
    scene = large_scene("hinges", 6, 7)
    response = await client.post(DERIVATIONS, json={"scene": scene, "lang": "en", "chapters": asked})
    assert response.status_code == 200, response.text
    answer = DerivationAnswer.model_validate(response.json())
    assert [each.coordinate for each in answer.result.equations] == [each["name"] for each in scene["coordinates"]]
    assert missing(answer) == [("steps", "time"), ("model", "time"), ("multipliers", "many")]
    told = [chapter.id for chapter in answer.chapters if chapter.steps[0].rule != "left-out"]
    assert told == ([] if asked == "model" else ["lagrange"])
    assert (await client.get(f"{DERIVATIONS}/{answer.id}")).status_code == 404


@pytest.mark.parametrize("asked", ["all", "equations", "ready"])
async def test_what_there_was_no_time_for_is_named_and_the_answer_not_kept(
    client: httpx.AsyncClient, computed_by: BudgetOf, asked: str, app: FastAPI
) -> None:
    """The time that the derivation is told is over at once, that of the worker is not."""
    computed_by("hurried", 60.0)
    response = await client.post(DERIVATIONS, json=question(1.17, chapters=asked))
    answer = DerivationAnswer.model_validate(response.json())
    assert response.status_code == 200
    assert ("steps", "time") in missing(answer)
    told = [chapter.id for chapter in answer.chapters if chapter.steps[0].rule != "left-out"]
    assert told == ["lagrange"]
    assert answer.result.equations
    assert (await client.get(f"{DERIVATIONS}/{answer.id}")).status_code == 404
