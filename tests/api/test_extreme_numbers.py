"""Whatever numbers a request has, the service makes no mistake of its own of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
import sympy as sp
from fastapi import FastAPI
from tests.api.extreme_numbers import QUICK, is_wrong, requests

from deltaq.api.app import create_app
from deltaq.narration.derive import derive_request
from deltaq.narration.matrix_writing import rounded
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
    ("path", "body", "status"),
    [
        pytest.param(
            "simulations",
            {"scene": "base-pendulum", "t_end": 1.0, "method": "newmark", "step": 0.01, "parameters": {"g": 1e300}},
            200,
            id="rounding to decimals",
        ),
        pytest.param(
            "simulations",
            {"scene": "quarter-car", "t_end": 1.0, "parameters": {"k1": 2.3e-308, "m1": 1e77, "w0": 1e300}},
            200,
            id="rates of a guide",
        ),
        pytest.param("simulations", {"scene": "pendulum", "t_end": 1e-200}, 200, id="the square of a span"),
        pytest.param(
            "simulations",
            {
                "scene": "bouncing-ball",
                "t_end": 1.0,
                "parameters": {"a": 1e300},
                "initial": {"z": {"value": 1e-300, "rate": 0.0}},
            },
            200,
            id="the square of the rate of a rebound",
        ),
        pytest.param(
            "simulations",
            {"scene": "bouncing-ball", "t_end": 1.0, "parameters": {"omega": 8e263}, "method": "explicit-euler"},
            200,
            id="a table that moves faster than any number",
        ),
        pytest.param(
            "exports/markdown",
            {"scene": "stick-slip", "t_end": 1.0, "parameters": {"g": 1.7e308}},
            200,
            id="what rubs exceeds all numbers",
        ),
        pytest.param(
            "simulations",
            {
                "scene": "string-pendulum",
                "t_end": 1.0,
                "parameters": {"l": 1e-155},
                "initial": {"phi": {"value": 0.1, "rate": 3.6e-162}},
                "method": "radau-5",
                "step": 0.01,
            },
            200,
            id="the value of an event is no number",
        ),
        pytest.param(
            "simulations",
            {
                "scene": "stick-slip",
                "t_end": 1.0,
                "parameters": {"v_0": 2.3e-308, "g": 1.7e308, "v_s": 5e-324},
                "method": "stormer-verlet",
            },
            200,
            id="friction that is no number",
        ),
        pytest.param(
            "simulations",
            {"scene": "bouncing-ball", "t_end": 1.0, "parameters": {"g": 9.9e-210, "a": 1.7e308, "omega": 1e-16}},
            200,
            id="the energy behind an impact is no number",
        ),
        pytest.param("simulations", {"scene": "pendulum", "t_end": 5e-324}, 422, id="no part of a span"),
        pytest.param("derivations", {"scene": "base-pendulum", "parameters": {"m": 1e-155}}, 200, id="a root of -0"),
        pytest.param(
            "derivations", {"scene": "base-pendulum", "parameters": {"g": 5e-324}}, 200, id="exact and inexact rest"
        ),
        pytest.param(
            "derivations",
            {"scene": "double-pendulum", "parameters": {"g": 1e154, "l2": 8e-278, "l1": 9e-157}},
            200,
            id="the square of a frequency",
        ),
        pytest.param(
            "simulations",
            {
                "scene": "double-pendulum",
                "parameters": {"m2": 6.859554133520522e42},
                "initial": {"phi1": {"value": 0.1, "rate": 0.0}},
                "t_end": 1.0,
                "method": "dop853",
                "step": 0.01,
            },
            200,
            id="an error that is no number",
        ),
        pytest.param(
            "variations",
            {
                "functions": ["x"],
                "expression": "x",
                "include": ["quotient"],
                "numeric": {"functions": {"x": "t"}, "direction": {"x": "1"}, "t": 1.7e308},
            },
            200,
            id="twice an instant",
        ),
    ],
)
async def test_numbers_whose_answers_are_known(
    quick: httpx.AsyncClient, path: str, body: dict[str, Any], status: int
) -> None:
    """No answer holds a number that is not finite, and what can be answered is."""
    answer = await quick.post(f"/api/v1/{path}", json=body)
    assert answer.status_code in {status, 504}, answer.text[:300]


def test_frequencies_beyond_all_doubles_are_not_given() -> None:
    body = {"scene": "double-pendulum", "parameters": {"g": 1e154, "l2": 8e-278, "l1": 9e-157}}
    found = derive_request(body)["result"]["equilibria"]  # type: ignore[index]
    assert found
    assert all(one["modes"] == [] == one["eigenvalues"] for one in found)


@pytest.mark.parametrize(
    ("value", "latex"),
    [
        (sp.Integer(10) ** 400 * 3, r"3.000 \cdot 10^{400}"),
        (-sp.Rational(10**400, 3), r"-3.333 \cdot 10^{399}"),
        (sp.Rational(5, 2), "2.5"),
    ],
)
def test_numbers_beyond_all_doubles_are_written(value: sp.Expr, latex: str) -> None:
    assert rounded(value) == latex
