"""The page as packages have it: bundled by the build hook, in the checkout, once for all processes."""

from __future__ import annotations

import fcntl
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest


def build_hook(root: Path) -> ModuleType:
    """The build hook as a module."""
    spec = spec_from_file_location("hatch_build", root / "backend" / "hatch_build.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def made(root: Path) -> Path | None:
    """The folder of the bundle, if there is an esbuild to make it."""
    frontend, hook = root / "frontend", build_hook(root)
    with (frontend / "package.json").open("rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # tests may run in several processes
        return frontend / "bundle" if hook.bundled(frontend) else None


def bundle_of(root: Path) -> Path:
    """The folder of the bundle; the end of a run says loudly if there is no esbuild to make it."""
    folder = made(root)
    if folder is None:
        pytest.skip("NO ESBUILD, SO THE BUNDLED PAGE IS NOT TESTED: npm ci in frontend/ brings it")
    return folder
