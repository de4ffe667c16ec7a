"""The JavaScript of the page: its types, its unit tests, its lockfile."""

from __future__ import annotations

import fcntl
import json
from pathlib import Path

import pytest
from tests.frontend.node import run

from deltaq.api.assets import Assets

# Prints the modules that say something else than what they were made from, comments apart.
COMPARE = """
const [ts, fs] = [require("typescript"), require("node:fs")];
const said = (file) => ts.transpileModule(fs.readFileSync(file, "utf8"), { compilerOptions: { target: "esnext", module: "esnext", removeComments: true } }).outputText;
const other = JSON.parse(fs.readFileSync(0, "utf8")).filter(([file, sent]) => said(file) !== said(sent));
console.log(JSON.stringify(other.map(([file]) => file)));
"""  # noqa: E501


@pytest.fixture(scope="session")
def frontend(root: Path) -> Path:
    """The front end's folder with its development tools; they are fetched once if they are missing."""
    folder = root / "frontend"
    with (folder / "package.json").open("rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # tests may run in several processes
        if not (folder / "node_modules" / "typescript").is_dir():
            done = run("npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", cwd=folder)
            assert done.returncode == 0, done.stdout + done.stderr
    return folder


def test_types(frontend: Path) -> None:
    done = run("node", "node_modules/typescript/bin/tsc", "--noEmit", "--project", ".", cwd=frontend)
    assert done.returncode == 0, done.stdout


def test_modules_say_the_same_as_they_are_sent(frontend: Path, tmp_path: Path) -> None:
    folders = (frontend, *(frontend / name for name in ("model", "view")))
    files = sorted({file for folder in folders for file in folder.glob("*.js" if folder == frontend else "**/*.js")})
    pairs = []
    for number, file in enumerate(files):
        asset = Assets(frontend).find(str(file.relative_to(frontend)))
        assert asset is not None
        (tmp_path / f"{number}.js").write_bytes(asset.content)
        pairs.append((str(file), str(tmp_path / f"{number}.js")))
    done = run("node", "-e", COMPARE, cwd=frontend, sent=json.dumps(pairs))
    assert (len(pairs) > 100, done.stdout.strip()) == (True, "[]")


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
