"""Every error is a problem document, in the client's language, and echoes nothing it should not."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Iterator
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from deltaq.api.app import create_app
from deltaq.api.workers.account import QuotaExceeded
from deltaq.api.workers.job import DeadlineExceeded, JobFailed, MemoryExceeded, Overloaded, WorkerDied, WorkerKilled
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
DERIVATIONS, SIMULATIONS = "/api/v1/derivations", "/api/v1/simulations"
JSON = {"Content-Type": "application/json"}


def problem(code: str, message: str, pointer: str = "", offset: int | None = None) -> dict[str, Any]:
    return {"pointer": pointer, "offset": offset, "length": None, "code": code, "severity": "error", "message": message}


def document(
    name: str, status: int, title: str, *problems: dict[str, Any], detail: str | None = None
) -> dict[str, Any]:
    return {
        "type": f"/problems/{name}",
        "title": title,
        "status": status,
        "detail": " ".join(one["message"] for one in problems) if detail is None else detail,
        "problems": list(problems),
    }


def invalid(*problems: dict[str, Any]) -> dict[str, Any]:
    return document("invalid-request", 422, "The request is not valid", *problems)


def not_json(code: str, message: str, offset: int | None = None) -> dict[str, Any]:
    return document("invalid-json", 400, "The body is not JSON", problem(code, message, offset=offset))


FINITE = "NaN and Infinity are not allowed; numbers must be finite."
NO_UNICODE = "The text is not valid Unicode (UTF-8)."
NO_JSON = "Here the text stops being JSON."
RUN = '"scene": "pendulum", "t_end": 1'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        pytest.param(b"{", not_json("json-syntax", NO_JSON, 1), id="cut off"),
        pytest.param(b'{"scene": x}', not_json("json-syntax", NO_JSON, 10), id="bare word"),
        pytest.param(b'{"\xff": 1}', not_json("json-not-unicode", NO_UNICODE), id="bytes"),
        pytest.param(
            b'{"scene": "\\ud800"}',
            not_json("json-not-unicode", NO_UNICODE),
            id="surrogate",
        ),
        pytest.param(
            b"[" * 100_000, not_json("json-too-deep", "The document is nested too deeply."), id="stack of brackets"
        ),
        pytest.param(
            b'{"scene": ' + b"[" * 70 + b"]" * 70 + b"}",
            not_json("json-too-deep", "The document is nested too deeply."),
            id="deep",
        ),
        pytest.param(
            b'{"t_end": ' + b"9" * 5000 + b"}",
            not_json("json-number-too-long", "A number has too many digits."),
            id="5000 digits",
        ),
        pytest.param(
            f'{{{RUN}, "step": NaN, "parameters": {{"m": -Infinity}}}}'.encode(),
            invalid(problem("json-not-finite", FINITE, "/parameters/m"), problem("json-not-finite", FINITE, "/step")),
            id="NaN and Infinity",
        ),
        pytest.param(
            b'{"scene": {"format": 1, "coordinates": [{"value": 1e999}]}}',
            invalid(problem("json-not-finite", FINITE, "/scene/coordinates/0/value")),
            id="number that is infinite",
        ),
        pytest.param(b"", invalid(problem("request-not-object", "A JSON object is needed here.")), id="no body"),
        pytest.param(b"[]", invalid(problem("request-not-object", "A JSON object is needed here.")), id="array"),
        pytest.param(
            b"{}",
            invalid(
                problem("missing-field", "The field scene is missing.", "/scene"),
                problem("missing-field", "The field t_end is missing.", "/t_end"),
            ),
            id="nothing given",
        ),
        pytest.param(
            f'{{{RUN}, "colour": 1}}'.encode(),
            invalid(problem("unknown-field", "There is no field “colour” here.", "/colour")),
            id="unknown field",
        ),
        pytest.param(
            b'{"scene": 3, "t_end": 1}',
            invalid(
                problem("request-scene-type", "A scene is given by its id (text) or as a document (object).", "/scene")
            ),
            id="scene is a number",
        ),
        pytest.param(
            b'{"scene": "pendulum", "t_end": "1"}',
            invalid(problem("request-not-number", "A number is needed here.", "/t_end")),
            id="number as text",
        ),
        pytest.param(
            b'{"scene": "pendulum", "t_end": true}',
            invalid(problem("request-not-number", "A number is needed here.", "/t_end")),
            id="boolean for a number",
        ),
        pytest.param(
            b'{"scene": "pendulum", "t_end": 0}',
            invalid(problem("request-not-above", "The value must be greater than 0.", "/t_end")),
            id="no time",
        ),
        pytest.param(
            b'{"scene": "pendulum", "t_end": 1e300}',
            invalid(problem("request-too-large", "The value must be at most 100000.", "/t_end")),
            id="too much time",
        ),
        pytest.param(
            f'{{{RUN}, "samples": 1}}'.encode(),
            invalid(problem("request-too-small", "The value must be at least 2.", "/samples")),
            id="one sample",
        ),
        pytest.param(
            f'{{{RUN}, "samples": 2.5}}'.encode(),
            invalid(problem("request-not-integer", "A whole number is needed here.", "/samples")),
            id="half a sample",
        ),
        pytest.param(
            f'{{{RUN}, "step": 0.1, "tolerance": 0.001}}'.encode(),
            invalid(
                problem("request-step-and-tolerance", "Give either a step or a tolerance, not both.", "/tolerance")
            ),
            id="step and tolerance",
        ),
        pytest.param(
            f'{{{RUN}, "initial": {{"phi": {{"velocity": 1}}}}}}'.encode(),
            invalid(problem("unknown-field", "There is no field “velocity” here.", "/initial/phi/velocity")),
            id="unknown initial value",
        ),
        pytest.param(
            f'{{{RUN}, "parameters": {{"a/b~c": "x"}}}}'.encode(),
            invalid(problem("request-not-number", "A number is needed here.", "/parameters/a~1b~0c")),
            id="pointer is escaped",
        ),
        pytest.param(
            f'{{{RUN}, "guides": 5}}'.encode(),
            invalid(problem("request-not-array", "An array is needed here.", "/guides")),
            id="guides not a list",
        ),
        pytest.param(
            f'{{{RUN}, "lang": "fr"}}'.encode(),
            invalid(problem("request-not-one-of", "Allowed here: de, en.", "/lang")),
            id="language",
        ),
    ],
)
async def test_wrong_body(client: httpx.AsyncClient, body: bytes, expected: dict[str, Any]) -> None:
    response = await client.post(SIMULATIONS, content=body, headers=JSON)
    assert response.headers["content-type"] == "application/problem+json"
    assert response.status_code == expected["status"]
    assert response.json() == expected


@pytest.mark.parametrize(
    ("headers", "query", "body", "title"),
    [
        pytest.param({}, "", {}, "The request is not valid", id="nothing said"),
        pytest.param({"Accept-Language": "de"}, "", {}, "Die Anfrage ist nicht gültig", id="header"),
        pytest.param({"Accept-Language": "fr, en;q=.3, de-AT;q=.8"}, "", {}, "Die Anfrage ist nicht gültig", id="best"),
        pytest.param({"Accept-Language": "de;q=0, fr"}, "", {}, "The request is not valid", id="not wanted"),
        pytest.param({"Accept-Language": "de;q=x,,;;"}, "", {}, "The request is not valid", id="not a header"),
        pytest.param({"Accept-Language": "de"}, "?lang=en", {}, "The request is not valid", id="query before header"),
        pytest.param({}, "?lang=en", {"lang": "de"}, "Die Anfrage ist nicht gültig", id="body before query"),
        pytest.param({"Accept-Language": "de"}, "", {"lang": 7}, "Die Anfrage ist nicht gültig", id="nonsense"),
    ],
)
async def test_language(
    client: httpx.AsyncClient, headers: dict[str, str], query: str, body: dict[str, Any], title: str
) -> None:
    response = await client.post(SIMULATIONS + query, json=body, headers=headers)
    assert response.json()["title"] == title
    assert response.headers["content-language"] == {"T": "en", "D": "de"}[title[0]]


async def test_no_such_address(client: httpx.AsyncClient) -> None:
    for path in ("/api/v1/nothing", "/nothing"):
        response = await client.get(path)
        assert response.json() == document("not-found", 404, "There is nothing at this address", detail="")


async def test_a_derivation_that_is_not_kept_says_how_to_get_it(client: httpx.AsyncClient) -> None:
    response = await client.get(f"{DERIVATIONS}/0123")
    told = "There is no derivation of this id, or it is no longer kept. Ask for it by POST /api/v1/derivations."
    unknown = problem("unknown-derivation", told)
    assert response.json() == document("unknown-name", 404, "There is nothing of this name", unknown)


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        pytest.param("DELETE", "/api/v1/scenes", "GET, HEAD", id="not GET"),
        pytest.param("GET", DERIVATIONS, "POST", id="not POST"),
        pytest.param("OPTIONS", "/api/v1/scenes/validate", "POST", id="a name where others have an identifier"),
        pytest.param("POST", "/app.js", "GET, HEAD", id="a file"),
    ],
)
async def test_wrong_method(client: httpx.AsyncClient, method: str, path: str, allowed: str) -> None:
    response = await client.request(method, path)
    assert response.headers["allow"] == allowed
    assert response.json() == document(
        "method-not-allowed",
        405,
        "This address does not take this method",
        detail=f"Allowed here: {response.headers['allow']}.",
    )


@pytest.mark.parametrize(
    "kind",
    [
        pytest.param({}, id="nothing said"),
        pytest.param({"Content-Type": "application/x-www-form-urlencoded"}, id="as curl does"),
        pytest.param({"Content-Type": "text/plain"}, id="as a page of another origin may"),
    ],
)
async def test_not_declared_as_json(client: httpx.AsyncClient, kind: dict[str, str]) -> None:
    response = await client.post(SIMULATIONS, content=b'{"scene": "pendulum"}', headers=kind)
    told = "Send it with the header content-type: application/json."
    assert response.json() == document("body-not-called-json", 415, "The body is not called JSON", detail=told)


@pytest.mark.parametrize("kind", ["application/json; charset=utf-8", "Application/JSON", "application/vnd.api+json"])
async def test_declared_as_json(client: httpx.AsyncClient, kind: str) -> None:
    response = await client.post(DERIVATIONS, content=b'{"scene": "pendulum"}', headers={"Content-Type": kind})
    assert response.status_code == 200


TOO_LARGE = document("body-too-large", 413, "The body is too large", detail="A request may hold 1048576 bytes at most.")


async def chunks(count: int) -> AsyncIterator[bytes]:
    for _ in range(count):
        yield b" " * 2**16


@pytest.mark.parametrize(
    ("content", "headers"),
    [
        pytest.param(b" " * (2**20 + 1), {}, id="announced"),
        pytest.param(chunks(17), {}, id="chunked"),
    ],
)
async def test_body_too_large(client: httpx.AsyncClient, content: Any, headers: dict[str, str]) -> None:
    response = await client.post(SIMULATIONS, content=content, headers=JSON | headers)
    assert response.status_code == 413
    assert response.json() == TOO_LARGE
    assert response.headers["connection"] == "close"


async def drip() -> AsyncIterator[bytes]:
    yield b'{"scene": '
    await asyncio.sleep(30)
    yield b'"pendulum"}'


async def test_body_too_slow() -> None:
    transport = httpx.ASGITransport(app=create_app(Settings(workers=1, body_timeout=0.2)))
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        response = await client.post(SIMULATIONS, content=drip(), headers=JSON)
    assert response.json() == document(
        "body-too-slow", 408, "The body came too slowly", detail="The body must be complete within 0.2 seconds."
    )


BUSY = document(
    "overloaded", 503, "The service is busy", detail="Too many computations are waiting. Ask again in 2 seconds."
)
INTERRUPTED = document(
    "interrupted",
    503,
    "The computation was interrupted",
    detail="The process that worked on it was ended from outside. Ask again in 2 seconds.",
)
SHARE_USED = document(
    "quota-exceeded",
    429,
    "You have used your share of computing time",
    detail="The service computes for others, too. Ask again in 31 seconds.",
)
HEAVY = document(
    "computation-too-large",
    504,
    "The computation is too large",
    detail="The computation was stopped because it needs more time or memory than a request may take. Fewer "
    "coordinates, simpler expressions, a shorter time span or a larger tolerance make it smaller.",
)


@pytest.fixture
def idle_app() -> Iterator[FastAPI]:
    """An application whose workers were never started."""
    return create_app(Settings(workers=1))


async def asked(app: FastAPI, error: Exception, monkeypatch: pytest.MonkeyPatch) -> httpx.Response:
    """What the client gets when the job ends with this error."""

    async def fail(self: object, *question: object, **how: object) -> bytes:
        raise error

    monkeypatch.setattr(type(app.state.service.pool), "run", fail)
    transport = httpx.ASGITransport(app=app, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        return await client.post(DERIVATIONS, json={"scene": "pendulum"})


@pytest.mark.parametrize(
    ("error", "expected"),
    [
        pytest.param(Overloaded("the queue is full"), BUSY, id="queue full"),
        pytest.param(QuotaExceeded("192.0.2.1", 30.2), SHARE_USED, id="share used up"),
        pytest.param(WorkerKilled("exit code -9"), INTERRUPTED, id="killed from outside"),
        pytest.param(DeadlineExceeded("no answer within 5 s"), HEAVY, id="deadline"),
        pytest.param(MemoryExceeded("MemoryError"), HEAVY, id="memory"),
    ],
)
async def test_job_that_cannot_be_done(
    idle_app: FastAPI, error: Exception, expected: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    response = await asked(idle_app, error, monkeypatch)
    assert response.json() == expected
    assert response.headers.get("retry-after") == {503: "2", 429: "31", 504: None}[expected["status"]]


@pytest.mark.parametrize(
    "error",
    [
        pytest.param(JobFailed("ValueError: secret", "trace with a secret"), id="in the worker"),
        pytest.param(WorkerDied("exit code -11"), id="crash"),
        pytest.param(KeyError("secret"), id="in the service"),
    ],
)
async def test_our_mistakes_are_logged_and_not_told(
    idle_app: FastAPI, error: Exception, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    response = await asked(idle_app, error, monkeypatch)
    assert response.status_code == 500
    assert "secret" not in response.text
    answer = response.json()
    incident = answer["detail"].rpartition(" ")[2].removesuffix(".")
    assert answer == document(
        "internal-error",
        500,
        "δq has made a mistake",
        detail=f"The input is not to blame. The server's log has the trace under {incident}.",
    )
    assert f"incident {incident}" in caplog.text
    assert response.headers["x-content-type-options"] == "nosniff"


async def test_problem_documents_match_their_schema(client: httpx.AsyncClient) -> None:
    schema = (await client.get("/api/v1/openapi.json")).json()["components"]["schemas"]
    answer = (await client.post(SIMULATIONS, json={})).json()
    assert answer.keys() == schema["ProblemDocument"]["properties"].keys()
    assert answer["problems"][0].keys() == schema["ProblemEntry"]["properties"].keys()
