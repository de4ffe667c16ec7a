"""The service that all tests of a run share ends with its last user, however the others ended."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tests import serving

SERVICE = (sys.executable, "-c", "import time; print('http://127.0.0.1:9/', flush=True); time.sleep(600)")
USER = """
import sys, time
from pathlib import Path
from tests import serving
serving.COMMAND = sys.argv[2:]
with serving.shared(Path(sys.argv[1])):
    print(flush=True)
    time.sleep(600)
"""


def using(place: Path, root: Path) -> subprocess.Popen[str]:
    """Another process that uses the service, until it is killed."""
    command = (sys.executable, "-c", USER, str(place), *SERVICE)
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=root)
    assert process.stdout is not None
    process.stdout.readline()
    return process


def numbers(place: Path) -> list[int]:
    """The processes of the service and of those who use it, as they are written down."""
    found: list[int] = json.loads(place.with_suffix(".users").read_text(encoding="utf-8"))
    return found


def has_ended(process: int) -> bool:
    """Whether a process ends within a while."""
    end = time.monotonic() + serving.PATIENCE
    while serving.lives(process) and time.monotonic() < end:
        time.sleep(0.01)
    return not serving.lives(process)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where a service is written down that only says its address."""
    monkeypatch.setattr(serving, "COMMAND", SERVICE)
    return tmp_path / "server"


def test_who_leaves_last_ends_it(place: Path) -> None:
    with serving.shared(place):
        service = numbers(place)[0]
        with serving.shared(place):
            pass
        assert serving.lives(service)
    assert has_ended(service)


def test_who_was_killed_is_not_waited_for(place: Path, root: Path) -> None:
    with using(place, root) as killed:
        service = numbers(place)[0]
        with serving.shared(place):
            assert numbers(place)[0] == service
            killed.kill()
            killed.wait()
        assert has_ended(service)


def test_a_service_that_has_died_is_started_anew(place: Path, root: Path) -> None:
    with using(place, root) as user:
        dead = numbers(place)[0]
        subprocess.run(["kill", "-9", str(dead)], check=True)
        assert has_ended(dead)
        with serving.shared(place):
            service = numbers(place)[0]
            assert service not in {dead, user.pid}
            user.kill()
        assert has_ended(service)
