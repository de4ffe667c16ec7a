from __future__ import annotations

import asyncio
import json
from typing import Any, get_args

import httpx
import pytest
from fastapi import FastAPI

from deltaq.cli import main
from deltaq.contract.derivation import DerivationAnswer, DerivationRequest, Formulation
from deltaq.derivation.engine import formulation_names
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

pytestmark = pytest.mark.anyio
DERIVATIONS = "/api/v1/derivations"
CHAPTERS = [
    "configuration",
    "variation",
    "virtual-work",
    "kinetic-energy",
    "dalembert-to-lagrange",
    "decomposition",
    "lagrange",
    "model",
]


def further(scene: Scene) -> list[str]:
    """Chapters of scenes with constraints, and of those with impacts or dry friction."""
    jumps = any(event.bounces for event in scene.events) or any(load.kind == "friction" for load in scene.loads)
    return ["constraints"] * bool(scene.constraints) + ["contact"] * jumps


@pytest.mark.one_in(18)
@pytest.mark.parametrize("language", ["de", "en"])
@pytest.mark.parametrize("scene", scene_ids())
async def test_every_scene_is_derived(client: httpx.AsyncClient, scene: str, language: str) -> None:
    response = await client.post(DERIVATIONS, json={"scene": scene, "lang": language})
    assert response.status_code == 200, response.text
    answer = DerivationAnswer.model_validate(response.json())
    chapters = [chapter.id for chapter in answer.chapters]
    assert chapters == [*CHAPTERS[:-1], *further(load_scene(scene)), "model"]
    assert all(chapter.steps for chapter in answer.chapters)
    assert answer.result.model_dump().keys() == {
        "degrees_of_freedom",
        "positions",
        "points",
        "virtual_displacements",
        "virtual_work",
        "kinetic_energy",
        "potential_energy",
        "generalized_forces",
        "lagrangian",
        "equations",
        "mass_matrix",
        "forcing",
        "conserved",
        "symmetry_search",
        "equilibria",
        "contact_equilibria",
        "kink_equilibria",
        "rest_ranges",
        "equilibrium_search",
        "jacobi_energy",
        "routh",
        "relative_equilibria",
        "loads",
        "symbols",
        "constraints",
        "reactions",
        "releasable",
        "contacts",
        "sticking",
    }


async def test_formulations_are_those_of_the_engine(client: httpx.AsyncClient) -> None:
    assert get_args(Formulation) == formulation_names()
    answers = {}
    for formulation in formulation_names():
        response = await client.post(DERIVATIONS, json={"scene": "damped-pendulum", "formulation": formulation})
        answers[formulation] = response.json()
    assert answers["hamilton"]["formulation"] == "hamilton"
    assert answers["hamilton"]["result"] == answers["dalembert-lagrange"]["result"]
    assert answers["hamilton"]["id"] != answers["dalembert-lagrange"]["id"]


async def test_canonical_equations_come_on_request(client: httpx.AsyncClient) -> None:
    response = await client.post(DERIVATIONS, json={"scene": "foucault", "canonical": True})
    *others, last = DerivationAnswer.model_validate(response.json()).chapters
    assert [chapter.id for chapter in others] == CHAPTERS
    assert last.id == "canonical"
    assert all(step.verified for step in last.steps)
    assert [step.id for step in last.steps if step.rule == "poisson-bracket"] == [
        "poisson-bracket:1",
        "poisson-bracket:2",
    ]


async def test_a_steady_motion_has_its_start(client: httpx.AsyncClient) -> None:
    response = await client.post(DERIVATIONS, json={"scene": "conical-pendulum"})
    (motion,) = DerivationAnswer.model_validate(response.json()).result.relative_equilibria
    assert (motion.resting, motion.turning, motion.stability) == ("theta", "psi", "stable")
    assert motion.initial["theta"].rate == 0
    assert motion.initial["psi"].rate == motion.rate.number


def without_words(answer: Any) -> Any:
    """An answer but for what is to be read aloud."""
    match answer:
        case dict():
            return {key: without_words(value) for key, value in answer.items() if key != "spoken"}
        case list():
            return list(map(without_words, answer))
    return answer


async def test_language_changes_the_texts_and_nothing_else(client: httpx.AsyncClient) -> None:
    german, english = [
        (await client.post(DERIVATIONS, json={"scene": "pendulum"}, headers={"Accept-Language": one})).json()
        for one in ("de", "en")
    ]
    assert without_words(german["result"]) == without_words(english["result"])
    assert german["chapters"][0]["title"] != english["chapters"][0]["title"]
    assert german["id"] != english["id"]


async def test_answer_is_found_again_under_its_id(client: httpx.AsyncClient) -> None:
    posted = await client.post(DERIVATIONS, json={"scene": "pendulum"})
    place = posted.headers["content-location"]
    assert place == f"{DERIVATIONS}/{posted.json()['id']}"
    assert posted.headers["etag"] == f'"{posted.json()["id"]}"'
    found = await client.get(place)
    assert found.content == posted.content
    assert found.headers["cache-control"] == "public, max-age=31536000, immutable"
    known = await client.get(place, headers={"If-None-Match": found.headers["etag"]})
    assert (known.status_code, known.content) == (304, b"")


async def test_compressed_and_plain_answers_are_the_same(client: httpx.AsyncClient) -> None:
    compressed = await client.post(DERIVATIONS, json={"scene": "pendulum"})
    plain = await client.post(DERIVATIONS, json={"scene": "pendulum"}, headers={"Accept-Encoding": "identity"})
    assert compressed.headers["content-encoding"] == "gzip"
    assert "content-encoding" not in plain.headers
    assert compressed.json() == plain.json()
    assert int(compressed.headers["content-length"]) * 4 < int(plain.headers["content-length"])


async def test_same_question_at_the_same_time_is_computed_once(client: httpx.AsyncClient, app: FastAPI) -> None:
    pool, ran = app.state.service.pool, []
    run = pool.run

    async def counted(job: Any, *question: Any, **how: Any) -> bytes:
        ran.append(job)
        answer: bytes = await run(job, *question, **how)
        return answer

    pool.run = counted
    try:
        question = {"scene": "pendulum", "parameters": {"m": 1.2345}}
        answers = await asyncio.gather(*(client.post(DERIVATIONS, json=question) for _ in range(30)))
    finally:
        del pool.run
    assert len(ran) == 1
    assert {answer.content for answer in answers} == {answers[0].content}
    assert answers[0].status_code == 200


@pytest.mark.parametrize(
    ("question", "status", "pointer", "code"),
    [
        pytest.param({"scene": "nothing"}, 404, "/scene", "unknown-scene", id="unknown scene"),
        pytest.param({"scene": "x" * 5000}, 422, "/scene", "request-text-too-long", id="endless name"),
        pytest.param({"scene": "../settings"}, 404, "/scene", "unknown-scene", id="path for a name"),
        pytest.param(
            {"scene": "pendulum", "formulation": "newton"}, 422, "/formulation", "request-not-one-of", id="formulation"
        ),
        pytest.param({"scene": "pendulum", "freeze": ["x"]}, 404, "/freeze/0", "unknown-coordinate", id="freeze"),
        pytest.param(
            {"scene": "pendulum", "parameters": {"m": -1}}, 422, "/parameters/m", "not-positive", id="negative mass"
        ),
        pytest.param(
            {"scene": "base-pendulum", "guides": [{"coordinate": "y"}]},
            422,
            "/guides/0/value",
            "missing-field",
            id="guide without value",
        ),
        pytest.param({"scene": {"format": 1}}, 422, "/scene/bodies", "no-body", id="scene without bodies"),
    ],
)
async def test_wrong_question(
    client: httpx.AsyncClient, question: dict[str, Any], status: int, pointer: str, code: str
) -> None:
    response = await client.post(DERIVATIONS, json=question)
    answer = response.json()
    assert response.headers["content-type"] == "application/problem+json"
    assert (response.status_code, answer["status"]) == (status, status)
    assert (pointer, code) in [(one["pointer"], one["code"]) for one in answer["problems"]]
    assert all(one["message"] != one["code"] for one in answer["problems"])


ROD = {"name": "rod", "kind": "continuum", "material": [{"name": "s", "from": "0", "to": "l"}]}


def scene(**changes: Any) -> dict[str, Any]:
    """A particle in the plane, with changes."""
    base = {
        "coordinates": [{"name": "x"}, {"name": "y"}],
        "parameters": [{"name": "m"}, {"name": "k"}, {"name": "l"}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
    }
    return base | changes


def bob(*position: str) -> list[dict[str, Any]]:
    return [{"name": "bob", "kind": "particle", "mass": "m", "position": list(position)}]


def rod(density: str) -> list[dict[str, Any]]:
    return [{**ROD, "density": density, "position": ["x + s*sin(y)", "s*cos(y)"]}]


@pytest.mark.parametrize(
    ("changes", "pointer", "code"),
    [
        pytest.param({"bodies": bob("x + y", "0")}, "/coordinates/1", "dependent-coordinates", id="dependent"),
        pytest.param(
            {"coordinates": [{"name": "x"}, {"name": "y"}, {"name": "z"}], "bodies": bob("x + l*sin(z)", "y")},
            "/coordinates/2",
            "dependent-coordinates",
            id="three coordinates for a particle in the plane",
        ),
        pytest.param(
            {"bodies": bob("x", "sqrt(-1 - y^2)")}, "/bodies/0/position/1", "never-defined", id="impossible position"
        ),
        pytest.param({"bodies": bob("x", "0")}, "/coordinates/1", "coordinate-without-inertia", id="singular M"),
        pytest.param({"bodies": rod("m/s")}, "/bodies/0/density", "divergent-integral", id="infinite mass"),
        pytest.param({"bodies": rod("m*exp(s^2)")}, "/bodies/0/density", "no-closed-integral", id="no closed form"),
        pytest.param({"bodies": rod("-m/l")}, "/bodies/0/density", "density-not-positive", id="negative density"),
        pytest.param(
            {"loads": [{"kind": "potential", "energy": "k*dot(x)^2"}]},
            "/loads/0/energy",
            "potential-with-rate",
            id="potential of a rate",
        ),
        pytest.param(
            {"loads": [{"kind": "potential", "energy": "k*log(-1 - x^2)"}]},
            "/loads/0/energy",
            "never-defined",
            id="potential that is nowhere real",
        ),
    ],
)
async def test_impossible_mechanics(
    client: httpx.AsyncClient, changes: dict[str, Any], pointer: str, code: str
) -> None:
    response = await client.post(DERIVATIONS, json={"scene": scene(**changes), "lang": "en"})
    assert response.status_code == 422
    problems = [(one["pointer"], one["code"]) for one in response.json()["problems"]]
    assert problems == [(f"/scene{pointer}", code)]


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("__import__('os').system('id')", id="code"),
        pytest.param("10^10^10", id="tower"),
        pytest.param("1e1000000000", id="exponent"),
        pytest.param("((((x+1)^64)^64)^64)", id="powers"),
        pytest.param("(" * 1000 + "y" + ")" * 1000, id="brackets"),
        pytest.param("factorial(10^9)", id="factorial"),
        pytest.param("y\0", id="NUL"),
        pytest.param("", id="empty"),
    ],
)
async def test_hostile_expression_is_refused(client: httpx.AsyncClient, text: str) -> None:
    question = {"scene": "base-pendulum", "guides": [{"coordinate": "y", "value": text}]}
    response = await client.post(DERIVATIONS, json=question)
    assert response.status_code == 422
    assert response.json()["problems"][0]["pointer"] == "/guides/0/value"


@pytest.mark.parametrize("number", range(len(DerivationRequest.model_config["json_schema_extra"]["examples"])))  # type: ignore[index, arg-type, call-overload]
async def test_examples_of_the_documentation_work(client: httpx.AsyncClient, number: int) -> None:
    schema = (await client.get("/api/v1/openapi.json")).json()["components"]["schemas"]["DerivationRequest"]
    response = await client.post(DERIVATIONS, json=schema["examples"][number])
    assert response.status_code == 200, response.text


PENDULUM = {"scene": "pendulum"}
TASK = {"task": "kinetic-energy", "answer": {"syntax": "plain", "value": "0"}}
OTHERS = [
    ("checks", PENDULUM | TASK),
    ("tasks", PENDULUM),
    ("tasks/solution", PENDULUM | {"task": "kinetic-energy"}),
    ("variations", {"expression": "x^2", "functions": ["x"]}),
    ("simulations", PENDULUM | {"t_end": 0.1, "samples": 3, "method": "rk4"}),
]


@pytest.mark.parametrize(("address", "body"), OTHERS, ids=[address for address, _ in OTHERS])
async def test_ids_of_derivations_lead_to_nothing_else(client: httpx.AsyncClient, address: str, body: Any) -> None:
    """Whatever has a name in the cache: asked for as a derivation, it is unknown."""
    answer = await client.post(f"/api/v1/{address}", json=body)
    assert answer.status_code == 200, answer.text
    name = answer.headers["etag"].strip('"')
    assert len(name) == 32
    for asked in (name, f"{name}.derivation", f"x{name}", name.upper(), name[:-1]):
        response = await client.get(f"{DERIVATIONS}/{asked}")
        assert response.status_code == 404, asked


async def test_a_derivation_has_one_id(client: httpx.AsyncClient, capsys: pytest.CaptureFixture[str]) -> None:
    """In its answer, in its address, in its entity tag, and in the answer of the shell, which the API then knows."""
    for options, body in (
        (["--lang", "de"], {"lang": "de"}),
        (["--set", "formulation=hamilton"], {"formulation": "hamilton"}),
    ):
        assert main(["derive", "pendulum", "--format", "json", *options]) == 0
        told = json.loads(capsys.readouterr().out)
        answer = await client.post(DERIVATIONS, json=PENDULUM | body)
        assert answer.json() == told
        assert answer.headers["content-location"] == f"{DERIVATIONS}/{told['id']}"
        assert answer.headers["etag"] == f'"{told["id"]}"'
        assert (await client.get(answer.headers["content-location"])).json() == told
