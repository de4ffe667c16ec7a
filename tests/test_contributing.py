"""What CONTRIBUTING and the README say to add is added to a copy of the package, and found there by API and tests."""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
from tests.frontend.node import run as run_node

FILE = re.compile(r"^`(backend/[\w./-]+)`\n\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SCENE = re.compile(r"^```toml\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMPILED = "backend/deltaq/simulation/kernels/__pycache__"
COUPLE = {"kind": "couple", "name": "pair", "angle": "phi", "force": "F", "distance": "l"}

# What a program asks of the service over the copy.
CLIENT = """
import asyncio, json, sys
import httpx
from deltaq.api.app import create_app
from deltaq.settings import Settings

async def main():
    app = create_app(Settings(workers=1, derivation_deadline=300.0, simulation_deadline=300.0, queue_patience=300.0))
    pools = (app.state.service.pool, app.state.service.laboratory)
    for pool in pools:
        pool.start()
    try:
        transport = httpx.ASGITransport(app=app)
        async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test/api/v1", timeout=300) as client:
            for method, path, body in json.load(sys.stdin):
                answer = await client.request(method, path, json=body)
                print(json.dumps(answer.json()))
    finally:
        for pool in pools:
            pool.stop(0.1)

asyncio.run(main())
"""


def merged(old: dict[str, Any], new: dict[str, Any]) -> dict[str, Any]:
    """Texts of a catalog, and more of them."""
    both = {key: merged(old[key], new[key]) for key in old.keys() & new.keys()}
    return old | new | both


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory, root: Path) -> Path:
    """A checkout in which every example has its place, and nothing else is changed but the catalogs."""
    checkout = tmp_path_factory.mktemp("checkout")
    left_out = shutil.ignore_patterns("__pycache__", "static", "node_modules")
    for folder in ("backend/deltaq", "tests"):
        shutil.copytree(root / folder, checkout / folder, ignore=left_out)
    if (root / COMPILED).is_dir():  # kernels are valid for their code, wherever it stands
        shutil.copytree(root / COMPILED, checkout / COMPILED, ignore=shutil.ignore_patterns("*.pyc", "*.lock"))
    shutil.copy(root / "pyproject.toml", checkout)
    for name, content in FILE.findall((root / ".github/CONTRIBUTING.md").read_text(encoding="utf-8")):
        place = checkout / name
        assert place.exists() is (place.suffix == ".json"), f"{name} is there already"
        if place.suffix == ".json":
            texts = merged(json.loads(place.read_text(encoding="utf-8")), json.loads(content))
            content = json.dumps(texts, ensure_ascii=False)  # noqa: PLW2901
        place.write_text(content, encoding="utf-8")
    (scene,) = SCENE.findall((root / "README.md").read_text(encoding="utf-8"))
    (checkout / "backend/deltaq/scenes/slide.toml").write_text(scene, encoding="utf-8")
    return checkout


def run(copy: Path, *arguments: str, sent: str = "") -> str:
    """What Python prints with the copy as `deltaq`."""
    environment = os.environ | {"PYTHONPATH": str(copy / "backend"), "PYTHONDONTWRITEBYTECODE": "1"}
    ended = subprocess.run(
        [sys.executable, *arguments], input=sent, env=environment, cwd=copy, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, (ended.stdout + ended.stderr)[-6000:]
    return ended.stdout


def asked(copy: Path, *calls: tuple[str, str, Any]) -> list[Any]:
    return [json.loads(line) for line in run(copy, "-c", CLIENT, sent=json.dumps(calls)).splitlines()]


def coupled(root: Path) -> dict[str, Any]:
    """A pendulum that a couple turns."""
    scene = tomllib.loads((root / "backend/deltaq/scenes/pendulum.toml").read_text(encoding="utf-8"))
    force = {"name": "F", "unit": "N", "value": 1.0}
    return {**scene, "id": "coupled", "parameters": [*scene["parameters"], force], "loads": [*scene["loads"], COUPLE]}


def test_the_api_knows_what_was_added(copy: Path, root: Path) -> None:
    answer = {"value": "-m*l^2*dot(phi)^2/2 - m*g*l*cos(phi)"}
    scenes, methods, derivation, experiment, refused, experiments, menu, verdict = asked(
        copy,
        ("GET", "/scenes", None),
        ("GET", "/methods?lang=de", None),
        ("POST", "/derivations", {"scene": coupled(root), "lang": "en"}),
        ("POST", "/experiments/eigenvalues", {"scene": "pendulum", "initial": {"phi": {"value": 0.0}}, "lang": "de"}),
        ("POST", "/experiments/eigenvalues", {"scene": "pendulum", "digits": 99, "lang": "en"}),
        ("GET", "/experiments", None),
        ("GET", "/catalogs/de?sections=labs", None),
        ("POST", "/checks", {"scene": "pendulum", "task": "lagrangian", "answer": answer, "lang": "en"}),
    )
    assert "slide" in [scene["id"] for scene in scenes["scenes"]]
    assert "Ralston" in [method["title"] for method in methods["methods"]]
    steps = {step["rule"]: step for chapter in derivation["chapters"] for step in chapter["steps"]}
    assert steps["work-of-couple"]["verified"] is True
    assert derivation["result"]["virtual_work"]["terms"][-1]["plain"] == "F*l*delta(phi)"
    (chart,) = experiment["charts"]
    assert (chart["title"], chart["caption"]) == ("Eigenwerte", "Der Bewegung, linearisiert an ihrem Anfang.")
    assert sorted(experiment["imaginary"]) == pytest.approx([-math.sqrt(9.81), math.sqrt(9.81)], rel=1e-6)
    assert [(one["pointer"], one["message"]) for one in refused["problems"]] == [
        ("/digits", "The value must be at most 15.")
    ]
    assert "eigenvalues" in menu["labs"]["experiments"]
    assert on_the_page(root, experiments["experiments"], menu["labs"]) == [
        {"kind": "number", "label": "Dauer der Bewegung / s", "range": {"shown": 10, "min": 1e-6, "max": 1000}},
        {"kind": "number", "label": "Gültige Ziffern", "range": {"shown": 12, "min": 2, "max": 15}},
    ]
    assert verdict["misconception"] == "energies-swapped"
    assert verdict["feedback"] == (
        "Not right yet. Which of the two energies is positive in L? It is about these terms: "
        r"$-\frac{1}{2} m \ell^{2} \dot{\varphi}^{2} - m g \ell \cos\varphi$."
    )


ASKED = """
import { translator } from "./model/catalog.js";
import { experimentsOf } from "./model/labs/experiments.js";
const [menu, words] = JSON.parse(process.argv[1]);
const { options } = experimentsOf(menu).experiment("eigenvalues");
const t = translator(words);
console.log(JSON.stringify(options.map(({ kind, label, range }) => ({ kind, label: t(label), range }))));
"""


def on_the_page(root: Path, menu: Any, words: Any) -> Any:
    """What the page asks of the experiment, as it is in the repository: nothing is added to it."""
    told = json.dumps([menu, words])
    done = run_node("node", "--input-type=module", "--eval", ASKED, told, cwd=root / "frontend")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_the_tests_of_its_kind_take_it_up(copy: Path) -> None:
    modules = {
        "tests/mechanics/test_library.py": "slide",
        "tests/narration/test_catalogs.py": "says_the_same or states_its_law or slide",
        "tests/simulation/test_methods.py": "ralston and not (falls or growth)",
        "tests/api/test_experiments.py": "eigenvalues and title",
        "tests/homework/test_misconceptions.py": "told",
    }
    chosen = " or ".join(f"({words})" for words in modules.values())
    options = ["-p", "no:cacheprovider", "-n", "0", "-v", "--color=no", "-k", chosen]
    passed = run(copy, "-m", "pytest", *options, *modules)
    assert {name for name in modules if f"{name}::" in passed} == set(modules)
    for one in ("slide", "ralston", "eigenvalues"):
        assert re.search(rf"\[.*{one}.*\] PASSED", passed), one
