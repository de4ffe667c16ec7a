"""Whatever numbers a request has, the service makes no mistake of its own of them."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from tests.api.extreme_numbers import QUICK, is_wrong, requests

from deltaq.api.app import create_app
from deltaq.api.extremes import extremes, unless_extreme
from deltaq.api.workers.job import DeadlineExceeded, JobFailed
from deltaq.errors import RequestError
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
COUNT = 24  # five thousand in the long run, extreme_numbers


@pytest.fixture(scope="module")
def quick_app() -> Iterator[FastAPI]:
    """Nothing is computed for long."""
    app = create_app(Settings(workers=2, **QUICK))
    app.state.service.pool.start()
    yield app
    app.state.service.pool.stop()


@pytest.fixture
async def quick(quick_app: FastAPI) -> Any:
    transport = httpx.ASGITransport(app=quick_app, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test", timeout=120) as one:
        yield one


async def test_drawn_requests(quick: httpx.AsyncClient) -> None:
    statuses: Counter[int] = Counter()
    wrong = []
    for path, body in requests(COUNT, seed=2):
        if "/experiments/" not in path:  # they are not quick
            answer = await quick.post(path, json=body)
            statuses[answer.status_code] += 1
            wrong += [f"{answer.status_code} {path} {body}"] * is_wrong(answer.status_code)
    assert wrong == []
    assert statuses[200] > 3
    assert statuses[422] > 3


@pytest.mark.parametrize(
    ("path", "body"),
    [
        pytest.param(
            "exports/markdown",
            {"scene": "base-pendulum", "parameters": {"k": 9.300710179014507e127, "l": 1e16}},
            id="an equilibrium that is no number",
        ),
        pytest.param("exports/latex", {"scene": "two-mass-oscillator", "parameters": {"kappa": 1e154}}, id="squares"),
        pytest.param("derivations", {"scene": "two-mass-oscillator", "parameters": {"kappa": 1e200}}, id="derivation"),
        pytest.param(
            "simulations",
            {"scene": "double-pendulum", "t_end": 1.0, "method": "gauss-4", "step": 5e-324},
            id="half of the smallest step",
        ),
        pytest.param("tasks", {"scene": "pendulum", "parameters": {"m": 1.7e308, "l": 1.7e308}}, id="tasks"),
        pytest.param("simulations", {"scene": "pendulum", "t_end": 10**399}, id="a whole number that is no other"),
        pytest.param(
            "simulations",
            {"scene": "pendulum", "t_end": 1.0, "parameters": {"m": 10**399}},
            id="a mass that is no number",
        ),
        pytest.param(
            "scenes/validate", {"format": 1, "coordinates": [{"name": "x", "value": 10**399}]}, id="value of a scene"
        ),
    ],
)
async def test_numbers_that_were_too_much(quick: httpx.AsyncClient, path: str, body: dict[str, Any]) -> None:
    answer = await quick.post(f"/api/v1/{path}", json=body)
    assert answer.status_code in {200, 422, 504}


@pytest.mark.parametrize(
    ("question", "pointers"),
    [
        pytest.param({"parameters": {"m": 1e31, "l": 1.0}}, ["/parameters/m"], id="large"),
        pytest.param({"initial": {"a/b": {"value": -1e-31}}}, ["/initial/a~1b/value"], id="small"),
        pytest.param({"scene": {"bodies": [{}, {"mass": "(10^30)^64"}]}}, ["/scene/bodies/1/mass"], id="power"),
        pytest.param({"guides": [{"value": "1e200*t"}]}, ["/guides/0/value"], id="exponent"),
        pytest.param({"guides": [{"value": "123456789012345678901"}]}, ["/guides/0/value"], id="digits"),
        pytest.param({"parameters": {"m": 0.0, "g": 9.81, "G": 6.7e-11, "M": 2e30 / 3}}, [], id="physics"),
        pytest.param({"scene": "chain-pendulum", "value": "m*l^2*x^12/2 + 1e-6", "seed": "4711"}, [], id="formulas"),
    ],
)
async def test_extreme_numbers_are_to_blame_for_a_failure(
    question: dict[str, Any], pointers: list[str], caplog: pytest.LogCaptureFixture
) -> None:
    async def failing() -> bytes:
        raise JobFailed("ZeroDivisionError: secret", "a trace")

    expected = RequestError if pointers else JobFailed
    with caplog.at_level(logging.WARNING), pytest.raises(expected) as caught:
        await unless_extreme(failing(), question)
    if isinstance(caught.value, RequestError):
        assert [(one.code, one.pointer) for one in caught.value.problems] == [
            ("extreme-number", one) for one in pointers
        ]
        assert "a trace" in caplog.text  # it may be our mistake all the same
    assert [one.pointer for one in extremes(question)] == pointers


async def test_other_ends_of_a_job_are_what_they_are() -> None:
    async def slow() -> bytes:
        raise DeadlineExceeded("too slow")

    with pytest.raises(DeadlineExceeded):
        await unless_extreme(slow(), {"parameters": {"m": 1e300}})
