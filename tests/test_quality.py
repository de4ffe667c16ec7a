"""The source passes its linter, its formatter and its type checker."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

LONGEST_FILE = 300


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(["ruff", "check", "--no-cache", "backend", "tests"], id="ruff check"),
        pytest.param(["ruff", "format", "--no-cache", "--check", "backend", "tests"], id="ruff format"),
        pytest.param(["mypy"], id="mypy"),
    ],
)
def test_tool_finds_nothing(command: list[str], root: Path) -> None:
    found = subprocess.run([sys.executable, "-m", *command], cwd=root, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout + found.stderr


def test_files_are_short(root: Path) -> None:
    lengths = {
        str(file.relative_to(root)): len(file.read_text(encoding="utf-8").splitlines())
        for file in (root / "backend").rglob("*.py")
    }
    assert {name: length for name, length in lengths.items() if length > LONGEST_FILE and "/methods/" not in name} == {}
