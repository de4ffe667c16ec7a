"""Every command of the README is run as it stands, in a fresh clone, with what is installed already.

Stand-ins on the PATH take the place of what would install, build or run all the tests: they say whether what they are
given can be meant. `deltaq serve` takes a free port, must come up, and is stopped.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import httpx
import pytest

BLOCK = re.compile(r"^```(sh|console|toml)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
ANSWERS = "student,task,answer\nada,kinetic-energy,m*l^2*dot(phi)^2/2\n"
SHEET = 'format = 1\n[[tasks]]\nscene = "pendulum"\ntask = "kinetic-energy"\n'
DELTAQ = """#!/bin/sh
[ "$1" = serve ] && set -- "$@" --port 0
exec {python} -m deltaq.cli "$@"
"""
# A name on the PATH, and the arguments that it may be given.
STAND_INS = {
    "python3": r"-m venv \.venv",
    "pip": r"install (\.|-e \.\[test\])",
    "pytest": r"",
    "docker": r"build --tag deltaq \."
    r"|run --read-only --tmpfs /cache -p 8000:8000 deltaq"
    r"|compose --file backend/deploy/compose\.yaml up --build",
}
STAND_IN = """#!{python}
import re, sys
sys.exit(0 if re.fullmatch({arguments!r}, " ".join(sys.argv[1:])) else f"not meant: {{sys.argv}}")
"""


@dataclass(frozen=True)
class Clone:
    """A checkout of its own with a `.venv`, and the service that commands ask."""

    folder: Path
    address: str

    def started(self, command: str) -> subprocess.Popen[str]:
        """The command in a shell that has just been opened: it knows `.venv/bin` only by its path, or if activated."""
        asked = command.replace("localhost:8000", self.address.removeprefix("http://").rstrip("/"))
        system = os.pathsep.join([str(self.folder / "system"), os.defpath])
        settings = os.environ | {"PATH": system}
        return subprocess.Popen(
            ["sh", "-c", asked],
            cwd=self.folder,
            env=settings,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )


def commands(text: str) -> Iterator[str]:
    """The lines for a shell, a line that goes on with its rest."""
    for language, block in BLOCK.findall(text):
        if language == "console":
            yield from re.findall(r"^\$ (.*)$", block, re.MULTILINE)
        elif language == "sh":
            yield from _whole(block)


def _whole(block: str) -> Iterator[str]:
    command = ""
    for line in block.splitlines():
        command += line + "\n"
        open_quote = re.sub(r"\"[^\"]*\"", "", re.sub(r"'[^']*'", "", command)).count("'") % 2
        if not open_quote and not line.endswith("\\"):
            yield command.strip()
            command = ""


README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory, root: Path, server: str) -> Clone:
    folder = tmp_path_factory.mktemp("clone") / "deltaq"
    subprocess.run(["git", "clone", "--quiet", "--shared", str(root), str(folder)], check=True)
    (scene,) = [block for language, block in BLOCK.findall(README) if language == "toml"]
    for name, content in {"slide.toml": scene, "answers.csv": ANSWERS, "sheet.toml": SHEET}.items():
        (folder / name).write_text(content, encoding="utf-8")
    programs = folder / ".venv/bin"
    _write(programs / "deltaq", DELTAQ.format(python=sys.executable))
    _write(programs / "activate", f"PATH={programs}:$PATH\n")
    for name, arguments in STAND_INS.items():
        place = programs if name in ("pip", "pytest") else folder / "system"
        _write(place / name, STAND_IN.format(python=sys.executable, arguments=arguments))
    return Clone(folder, server)


def _write(file: Path, content: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(content, encoding="utf-8")
    file.chmod(0o755)


def test_the_readme_has_commands_of_every_kind() -> None:
    found = "\n".join(commands(README))
    for word in ("pip install", "deltaq serve", "deltaq lab", "deltaq check", "docker compose", "curl -N"):
        assert word in found
    assert (Path(__file__).parents[2] / "backend/deploy/compose.yaml").is_file()


@pytest.mark.parametrize("command", [pytest.param(one, id=one[:50]) for one in commands(README)])
def test_a_command_does_what_it_is_there_for(clone: Clone, command: str) -> None:
    """Whoever has followed the README so far has activated `.venv`, if it says so before."""
    before = README.partition(command.splitlines()[0])[0]
    activated = ". .venv/bin/activate\n" if ". .venv/bin/activate" in before else ""
    with clone.started(activated + command) as running:
        if "deltaq serve" in command:
            assert running.stdout is not None
            address = re.search(r"http://\S+/", running.stdout.readline())
            os.killpg(running.pid, signal.SIGINT) if address is None else _answers_and_ends(running, address[0])
            assert address is not None, running.communicate()
            return
        said, complaints = running.communicate(timeout=600)
    assert running.returncode == 0, said + complaints
    assert '"/problems/' not in said


def _answers_and_ends(running: subprocess.Popen[str], address: str) -> None:
    assert httpx.get(f"{address}api/v1/health", timeout=120).status_code == 200
    os.killpg(running.pid, signal.SIGINT)
    running.wait(timeout=120)
