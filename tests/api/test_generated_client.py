"""Clients that programs wrote from the description, each with its defaults, talking to the service."""

from __future__ import annotations

import importlib
import inspect
import io
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from tests.api import typescript
from tests.description import openapi
from tests.frontend.node import run

from deltaq.contract.document import EXAMPLE
from deltaq.contract.scene import TOML_EXAMPLE

PACKAGE = "deltaq_client"
DOCUMENT = openapi()
BUSY = 120.0  # seconds for which the service may have its hands full with other tests: "ready" then says 503
# What the generator does not know by name stands beside what it knows.
KNOWN_GAPS = ("Unsupported content type application/toml",)


def operations() -> dict[str, dict[str, Any]]:
    """Each operation by its name."""
    return {one["operationId"]: one for methods in DOCUMENT["paths"].values() for one in methods.values()}


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The package, written with the generator's own defaults and importable; what the generator had to say."""
    folder = tmp_path_factory.mktemp("client")
    document = folder / "openapi.json"
    document.write_text(json.dumps(DOCUMENT), encoding="utf-8")
    command = [sys.executable, "-m", "openapi_python_client", "generate", "--meta", "none"]
    options = map(str, ["--path", document, "--output-path", folder / PACKAGE])
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"  # where ruff is, which it formats with
    settings = {**os.environ, "PATH": path}
    ended = subprocess.run([*command, *options], capture_output=True, text=True, check=False, env=settings)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    sys.path.insert(0, str(folder))
    yield ended.stdout + ended.stderr
    sys.path.remove(str(folder))
    for name in [name for name in sys.modules if name.partition(".")[0] == PACKAGE]:
        del sys.modules[name]


@pytest.fixture(scope="module")
def client(generated: str, server: str) -> Iterator[Any]:
    with part("client").Client(base_url=server.rstrip("/"), timeout=300) as one:
        yield one


def part(name: str) -> ModuleType:
    return importlib.import_module(f"{PACKAGE}.{name}")


def test_generator_has_no_complaint_but_of_what_stands_there_twice(generated: str) -> None:
    told = generated
    for gap in KNOWN_GAPS:
        assert gap in told
        told = told.replace(gap, "")
    assert "Unsupported" not in told
    assert "omitted" not in told
    assert "will not be generated" not in told
    assert "ERROR" not in told


def test_no_operation_is_skipped_and_each_has_types(generated: str) -> None:
    assert generated
    for name, operation in operations().items():
        module = part(f"api.{operation['tags'][0]}.{name}")
        if "application/json" in operation["responses"]["200"]["content"]:
            assert inspect.signature(module.sync).return_annotation not in ("Any", Any), name


def examples() -> Iterator[Any]:
    """Each documented body by its operation."""
    for name, operation in operations().items():
        for content in operation.get("requestBody", {}).get("content", {}).values():
            model = content["schema"].get("$ref", "").rpartition("/")[2]
            shown = DOCUMENT["components"]["schemas"][model] if model else {}
            for number, body in enumerate(shown.get("examples", ())):
                yield pytest.param(name, model, body, id=f"{name}-{number}")


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("name", "model", "body"), [*examples()])
def test_documented_examples_run(client: Any, name: str, model: str, body: dict[str, Any]) -> None:
    asked = getattr(part("models"), model).from_dict(body)
    assert asked.to_dict().items() >= body.items()
    module = part(f"api.{operations()[name]['tags'][0]}.{name}")
    form = inspect.signature(module.sync_detailed).parameters.get("form")
    path = {"form": form.annotation("python")} if form else {}
    answer = module.sync_detailed(**path, client=client, body=asked)
    assert answer.status_code == 200, answer.content
    assert answer.parsed is not None


def readings() -> Iterator[Any]:
    """Each operation that is asked by its address alone, with the examples of what stands in it."""
    for path, methods in DOCUMENT["paths"].items():
        operation = methods.get("get")
        if operation and operation["operationId"] != typescript.BY_ID:  # which is asked for below
            inside = [one for one in operation.get("parameters", []) if one["in"] == "path"]
            yield pytest.param(
                operation["operationId"], {one["name"]: one["schema"]["examples"][0] for one in inside}, id=path
            )


@pytest.mark.parametrize(("name", "path"), [*readings()])
def test_documented_addresses_answer(client: Any, name: str, path: dict[str, str]) -> None:
    module, deadline = part(f"api.{operations()[name]['tags'][0]}.{name}"), time.monotonic() + BUSY
    answer = module.sync_detailed(**path, client=client)
    while answer.status_code == 503 and time.monotonic() < deadline:
        time.sleep(float(answer.headers["retry-after"]))
        answer = module.sync_detailed(**path, client=client)
    assert answer.status_code == 200, answer.content


def test_a_derivation_is_read_by_its_id(client: Any) -> None:
    derived = part("api.derivations.derive").sync(client=client, body=part("models").DerivationRequest(scene="atwood"))
    assert part("api.derivations.get_derivation").sync(derived.id, client=client).result == derived.result


OWN = {"derive": {}, "simulate": {"t_end": 1.0}, "list_tasks": {}, "solve_task": {"task": "equation:phi"}}


@pytest.mark.parametrize("name", OWN)
def test_scenes_of_ones_own_are_typed_and_answered(client: Any, name: str) -> None:
    models, operation = part("models"), operations()[name]
    scene = models.SceneDocument.from_dict(EXAMPLE)
    assert scene.to_dict() == EXAMPLE
    model = operation["requestBody"]["content"]["application/json"]["schema"]["$ref"].rpartition("/")[2]
    asked = getattr(models, model)(scene=scene, **OWN[name])
    answer = part(f"api.{operation['tags'][0]}.{name}").sync(client=client, body=asked)
    assert not isinstance(answer, models.ProblemDocument), answer


def test_a_scene_in_toml_is_sent_as_bytes(client: Any) -> None:
    body = part("types").File(payload=io.BytesIO(TOML_EXAMPLE.encode()))
    answer = part("api.scenes.read_toml_scene").sync(client=client, body=body)
    assert answer.scene.bodies[0].name == "bead"


def test_scenes_are_listed(client: Any) -> None:
    scenes = part("api.scenes.list_scenes").sync(client=client).scenes
    assert {"pendulum", "double-pendulum"} <= {scene.id for scene in scenes}


def test_a_derivation_has_typed_results(client: Any) -> None:
    request = part("models").DerivationRequest(scene="pendulum")
    result = part("api.derivations.derive").sync(client=client, body=request).result
    assert [(one.coordinate, one.plain) for one in result.equations] == [
        ("phi", "m*l^2*ddot(phi) + m*g*l*sin(phi) = 0")
    ]
    assert result.mass_matrix.plain == [["m*l^2"]]
    assert result.kinetic_energy.terms[0].sources == ["body:bob"]


def test_a_simulation_says_how_accurate_it_is(client: Any) -> None:
    request = part("models").SimulationRequest(scene="pendulum", t_end=2.0, samples=5, tolerance=1e-9)
    motion = part("api.simulations.simulate").sync(client=client, body=request)
    assert motion.t == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert max(motion.error.estimate) < 1e-9


def test_an_answer_is_checked(client: Any) -> None:
    models = part("models")
    answer = models.AnswerText(value="m*l^2*dot(phi)^2")
    request = models.CheckRequest(
        scene="pendulum", task="kinetic-energy", answer=answer, lang=models.CheckRequestLangType0.DE
    )
    verdict = part("api.homework.check").sync(client=client, body=request)
    assert (verdict.outcome, verdict.misconception) == ("wrong", "half-in-kinetic-energy")


def test_a_failure_is_a_problem_document_with_its_place(client: Any) -> None:
    request = part("models").DerivationRequest(scene="no-such-scene")
    response = part("api.derivations.derive").sync_detailed(client=client, body=request)
    assert response.status_code == 404
    assert isinstance(response.parsed, part("models").ProblemDocument)
    assert [problem.pointer for problem in response.parsed.problems] == ["/scene"]


PATHS = {one["operationId"]: path for path, methods in DOCUMENT["paths"].items() for one in methods.values()}
CALLS = [*typescript.calls(DOCUMENT)]
OWN_CALLS = [
    typescript.Call(f"{name}-own", "POST", PATHS[name], {"body": {"scene": EXAMPLE, **rest}})
    for name, rest in OWN.items()
]


@pytest.fixture(scope="module")
def statuses(tmp_path_factory: pytest.TempPathFactory, server: str) -> dict[str, int]:
    """The status of the answer to every call of the program in TypeScript, by its name."""
    folder = tmp_path_factory.mktemp("typescript")
    typed = [own for one in CALLS if (own := typescript.with_scene(one, EXAMPLE))]
    compiled = typescript.build(folder, DOCUMENT, typescript.program([*CALLS, *OWN_CALLS], typed))
    done = run("node", str(compiled), server.rstrip("/"), cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return {str(name): int(status) for name, status in json.loads(done.stdout).items()}


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", [one.name for one in (*CALLS, *OWN_CALLS)])
def test_what_is_documented_runs_in_typescript_without_a_cast(statuses: dict[str, int], name: str) -> None:
    assert statuses[name] == 200


def test_no_operation_is_left_out_in_typescript() -> None:
    called = {name.partition("-")[0] for name in (one.name for one in CALLS)}
    assert operations().keys() - called == {typescript.BY_ID}
