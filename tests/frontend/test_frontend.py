"""The JavaScript of the page: its types, its unit tests, its lockfile."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tests.frontend.contract import FILE, types
from tests.frontend.node import frontend_with_tools, run


@pytest.fixture(scope="session")
def frontend() -> Path:
    return frontend_with_tools()


@pytest.mark.always
def test_types(frontend: Path) -> None:
    done = run("node", "node_modules/typescript/bin/tsc", "--noEmit", "--project", ".", cwd=frontend)
    assert done.returncode == 0, done.stdout


@pytest.mark.usefixtures("frontend")
def test_types_of_the_api_are_current() -> None:
    assert FILE.read_text(encoding="utf-8") == types(), "not current: .venv/bin/python -m tests.frontend.contract"


@pytest.mark.always
def test_linter_finds_nothing(frontend: Path) -> None:
    done = run("node", "node_modules/eslint/bin/eslint.js", ".", "--max-warnings", "0", cwd=frontend)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.always
def test_formatter_changes_nothing(frontend: Path) -> None:
    done = run("node", "node_modules/prettier/bin/prettier.cjs", "--check", "**/*.{js,mjs}", cwd=frontend)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.always
def test_units(root: Path) -> None:
    files = sorted(str(path) for path in (root / "tests" / "frontend").glob("*.test.js"))
    assert len(files) >= 10
    done = run("node", "--test", *files, cwd=root)
    assert done.returncode == 0, done.stdout


def test_lockfile_names_no_registry(root: Path) -> None:
    lock = json.loads((root / "frontend" / "package-lock.json").read_text(encoding="utf-8"))
    addresses = {name: package["resolved"] for name, package in lock["packages"].items() if "resolved" in package}
    assert addresses == {}


def test_versions_are_exact(root: Path) -> None:
    package = json.loads((root / "frontend" / "package.json").read_text(encoding="utf-8"))
    loose = {
        name: version
        for kind in ("dependencies", "devDependencies")
        for name, version in package[kind].items()
        if not version[0].isdecimal()
    }
    assert loose == {}


def test_what_is_served_comes_with_its_licence(root: Path) -> None:
    allowed = json.loads((root / "frontend" / "vendor.json").read_text(encoding="utf-8"))
    dependencies = json.loads((root / "frontend" / "package.json").read_text(encoding="utf-8"))["dependencies"]
    assert set(allowed) == set(dependencies)
    assert [package for package, files in allowed.items() if not {"LICENSE", "LICENSE.txt"} & set(files)] == []
