"""What the README promises is what comes."""

from __future__ import annotations

import ast
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import httpx
import pytest

from deltaq.api.samples import ADDRESS

NUMBER = re.compile(r"-?\d+\.\d+(?:e-?\d+)?|-?\d+e-?\d+")


@pytest.fixture(scope="module")
def blocks(root: Path) -> dict[str, list[str]]:
    """The blocks of the README by their language."""
    found: dict[str, list[str]] = {}
    for language, block in re.findall(
        r"^```(\w+)\n(.*?)^```$", (root / "README.md").read_text(), re.MULTILINE | re.DOTALL
    ):
        found.setdefault(language, []).append(block)
    return found


def alike(one: str, other: str) -> bool:
    """Whether two texts are the same but for the last digits of their numbers."""
    numbers = [[float(number) for number in NUMBER.findall(text)] for text in (one, other)]
    return NUMBER.sub("·", one) == NUMBER.sub("·", other) and numbers[0] == pytest.approx(
        numbers[1], rel=1e-6, abs=1e-9
    )


def test_a_system_of_ones_own(blocks: dict[str, list[str]], tmp_path: Path) -> None:
    (scene,), (console,) = blocks["toml"], blocks["console"]
    assert len(scene.splitlines()) == 10
    (tmp_path / "slide.toml").write_text(scene, encoding="utf-8")
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    for command, told in re.findall(r"^\$ (.*)\n((?:[^$\n].*\n)+)", console, re.MULTILINE):
        ended = subprocess.run(
            ["sh", "-c", command], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        assert alike(ended.stdout, told), ended.stdout + ended.stderr


def test_derivation_by_a_line_for_a_shell(blocks: dict[str, list[str]], server: str) -> None:
    line = next(block for block in blocks["sh"] if "/derivations" in block)
    body = shlex.split(line)[-1]
    answer = httpx.post(f"{server}api/v1/derivations", json=json.loads(body), timeout=60).json()["result"]
    told = json.loads(f"{{{blocks['json'][0]}}}")["generalized_forces"]["nonconservative"]
    found = answer["generalized_forces"]["nonconservative"]
    assert [{key: one[key] for key in ("coordinate", "plain", "latex")} for one in found] == told


def test_simulation_by_a_program(blocks: dict[str, list[str]], server: str) -> None:
    program, told = blocks["python"]
    *lines, last = program.replace(ADDRESS, server.rstrip("/")).splitlines()
    known: dict[str, object] = {}
    exec("\n".join(lines), known)
    found = eval(last, known)
    status, value, estimate = ast.literal_eval(told)
    assert found == (status, pytest.approx(value, abs=1e-9), pytest.approx(estimate, rel=0.5))


def test_an_answer_is_checked_by_a_line_for_a_shell(blocks: dict[str, list[str]], server: str) -> None:
    line = next(block for block in blocks["sh"] if "/checks" in block).partition("\ndeltaq")[0]
    answer = httpx.post(f"{server}api/v1/checks", json=json.loads(shlex.split(line)[-1]), timeout=60).json()
    assert (answer["outcome"], answer["misconception"]) == ("wrong", "half-in-kinetic-energy")


@pytest.mark.parametrize("language", ["sh", "console"])
def test_every_command_that_is_named_is_there(blocks: dict[str, list[str]], language: str) -> None:
    named = set(re.findall(r"^(?:\$ |\w+=\S+ )?deltaq (\w[\w-]*)", "\n".join(blocks[language]), re.MULTILINE))
    assert named
    for command in named:
        ended = subprocess.run(
            [sys.executable, "-m", "deltaq.cli", command, "--help"], capture_output=True, check=False
        )
        assert ended.returncode == 0, command


def test_every_file_that_is_named_is_there(root: Path) -> None:
    for page in ("README.md", ".github/CONTRIBUTING.md", "backend/README.md"):
        text = (root / page).read_text(encoding="utf-8")
        linked = [
            name for name in re.findall(r"\]\(([^):#]+)\)|src(?:set)?=\"([^\":]+)\"", text) for name in name if name
        ]
        assert linked, page
        assert [name for name in linked if not ((root / page).parent / name).exists()] == [], page


def test_every_key_that_is_named_is_one_of_the_page(root: Path) -> None:
    signs = {"→": "ArrowRight", "←": "ArrowLeft", "↓": "ArrowDown", "↑": "ArrowUp", "Esc": "Escape", "Space": " "}
    signs |= {key: key for key in ("Ctrl+Z", "Ctrl+Y")}
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \|$", (root / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    named = [signs.get(key, key.lower()) for row in rows if row != "key" for key in re.split(r", | / ", row)]
    known = re.findall(r'"([^"]+)"', (root / "frontend" / "model" / "keys.js").read_text(encoding="utf-8"))
    assert len(named) > 9
    assert set(named) <= set(known)


def test_the_words_of_the_glossary_are_where_it_says(root: Path) -> None:
    text = (root / "backend" / "README.md").read_text(encoding="utf-8").partition("## Glossary")[2]
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \| `([^|]+)` \|$", text, re.MULTILINE)
    assert len(rows) > 20
    for words, place in rows:
        where = root / "backend" / "deltaq" / place
        files = sorted(where.rglob("*.py")) if where.is_dir() else [where]
        said = "".join(file.read_text(encoding="utf-8") for file in files).lower().replace("_", " ")
        assert [word for word in words.split(", ") if word.replace(" ", "") not in said.replace(" ", "")] == [], place
