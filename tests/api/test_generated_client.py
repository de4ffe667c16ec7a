"""A client that a program wrote from the description, talking to the service."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest
from tests.serving import PATIENT, served

from deltaq.api.app import create_app
from deltaq.settings import Settings

PACKAGE = "deltaq_client"
# Kinds of text that the generator does not know by name.
CONFIGURATION = {
    "content_type_overrides": {"application/toml": "application/octet-stream", "application/xml": "text/plain"},
    "post_hooks": [],
}


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The package, written and importable; what the generator had to say."""
    folder = tmp_path_factory.mktemp("client")
    document, configuration = folder / "openapi.json", folder / "configuration.json"
    document.write_text(json.dumps(create_app(Settings(workers=1)).openapi()), encoding="utf-8")
    configuration.write_text(json.dumps(CONFIGURATION), encoding="utf-8")
    command = [sys.executable, "-m", "openapi_python_client", "generate", "--meta", "none"]
    options = ["--path", document, "--config", configuration, "--output-path", folder / PACKAGE]
    ended = subprocess.run([*command, *map(str, options)], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    sys.path.insert(0, str(folder))
    yield ended.stdout + ended.stderr
    sys.path.remove(str(folder))
    for name in [name for name in sys.modules if name.partition(".")[0] == PACKAGE]:
        del sys.modules[name]


@pytest.fixture(scope="module")
def client(generated: str) -> Iterator[Any]:
    with (
        served(workers=2, **PATIENT) as service,
        part("client").Client(base_url=service.address.rstrip("/"), timeout=300) as one,
    ):
        yield one


def part(name: str) -> ModuleType:
    return importlib.import_module(f"{PACKAGE}.{name}")


def test_generator_has_no_complaint(generated: str) -> None:
    assert "WARNING" not in generated
    assert "ERROR" not in generated


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
