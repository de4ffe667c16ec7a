"""The samples of the documentation do what they say, as they stand."""

from __future__ import annotations

import json
import shutil
import subprocess

import httpx
import pytest

from deltaq.api.samples import ADDRESS


@pytest.fixture(scope="module")
def sources(server: str) -> dict[tuple[str, str], str]:
    """Every sample by its operation and language, with the address of the service."""
    document = httpx.get(f"{server}api/v1/openapi.json", timeout=60).json()
    operations = [operation for methods in document["paths"].values() for operation in methods.values()]
    return {
        (operation["operationId"], sample["lang"]): sample["source"].replace(ADDRESS, server.rstrip("/"))
        for operation in operations
        for sample in operation["x-codeSamples"]
    }


@pytest.mark.slow
def test_cells_for_a_notebook_run(sources: dict[tuple[str, str], str]) -> None:
    shown = {}
    for (name, language), source in sources.items():
        if language == "Python":
            *lines, last = source.splitlines()
            known: dict[str, object] = {}
            if last.startswith(("print", "    ", ")")):
                exec(source, known)
            else:
                exec("\n".join(lines), known)
                shown[name] = eval(last, known)
    assert shown["derive"] == [
        "m*ddot(y) - m*l*sin(phi)*ddot(phi) - m*l*cos(phi)*dot(phi)^2 + F0*sin(phi) + k*y - m*g = 0",
        "m*l^2*ddot(phi) - m*l*sin(phi)*ddot(y) - l*F0 + m*g*l*sin(phi) = 0",
    ]
    assert shown["check"] == ("correct", "Correct.")
    assert shown["validate_scene"] is True
    assert shown["list_methods"]["dop853"] == 8
    assert [name for name, value in shown.items() if value in (None, [], {}, "")] == []


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("curl") is None, reason="curl is not installed")
def test_lines_for_a_shell_run(sources: dict[tuple[str, str], str]) -> None:
    failed = {}
    for (name, language), source in sources.items():
        if language == "Shell":
            ended = subprocess.run(["sh", "-c", source], capture_output=True, text=True, check=False, timeout=300)
            if ended.returncode or not ended.stdout or ended.stdout.startswith('{"type": "/problems/'):
                failed[name] = ended.stdout[:300] + ended.stderr[-300:]
    assert json.dumps(failed) == "{}"
