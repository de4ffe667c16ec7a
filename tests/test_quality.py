"""The source passes its linter, its formatter and its type checker."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

LONGEST_FILE = 500  # a concern that a reader keeps in the head
LONGEST_FUNCTION = 40  # but for the stepping loops of kernels, which keep all their state in one place


@pytest.mark.always
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


def length_of(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines without the docstring."""
    first = function.body[0]
    told = (first.end_lineno or 0) - first.lineno + 1 if ast.get_docstring(function) else 0
    return (function.end_lineno or 0) - function.lineno + 1 - told


def test_functions_are_short(root: Path) -> None:
    lengths = {
        f"{file.relative_to(root)}: {node.name}": length_of(node)
        for file in (root / "backend").rglob("*.py")
        if "kernels" not in file.parts
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    assert {name: length for name, length in lengths.items() if length > LONGEST_FUNCTION} == {}
