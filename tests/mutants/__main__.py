"""Breaks the code on purpose and counts which faults the tests notice: `python -m tests.mutants homework`.

A part is named in pyproject.toml, [tool.deltaq.mutants], with its modules and the tests that answer for them. Each
mutant runs in a process of its own that reads the broken source in the place of the file; nothing on the disk changes.
First come the tests that enter the broken function, then all others of their files, until one fails: files that never
enter it cannot tell, and what a file keeps for all its tests is made in the first. A mutant that takes five times as
long as the sound code is noticed as well: somebody would wait for ever.
"""

from __future__ import annotations

import argparse
import importlib
import os
import pickle
import resource
import signal
import sys
import tempfile
import time
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import CodeType

import pytest

from .entries import Entries, Recorder, function_around, telling
from .faults import Mutant, sample

ROOT = Path(__file__).parents[2]
OPTIONS = [
    "-n0",
    "--every-case",
    "-x",
    "-q",
    "-p",
    "no:cacheprovider",
    "-W",
    "ignore::pytest.PytestAssertRewriteWarning",
]
HEAVY = ("sympy", "numpy", "symengine", "numba", "scipy.integrate", "flint", "hypothesis")
MEMORY = 8 << 30
PATIENCE = 5.0


@dataclass(frozen=True)
class Part:
    """What is broken, and who must notice."""

    modules: tuple[Path, ...]
    tests: tuple[str, ...]

    @classmethod
    def named(cls, name: str) -> Part:
        settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["deltaq"]["mutants"]
        if name not in settings:
            raise SystemExit(f"No part {name!r}; there are: {', '.join(settings)}")
        modules = [file for pattern in settings[name]["modules"] for file in sorted(ROOT.glob(pattern))]
        return cls(tuple(modules), tuple(settings[name]["tests"]))


def notice(runs: Sequence[Sequence[str]], mutant: Mutant) -> bool:
    """Runs in a process of its own: whether a test fails."""
    _hush()
    _replace({str(mutant.module): mutant.code})
    return any(pytest.main([*OPTIONS, *run]) != pytest.ExitCode.OK for run in runs)


def _hush() -> None:
    """No output, and no more memory than is fair."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)


def _replace(codes: Mapping[str, CodeType]) -> None:
    """From now on an import of these files runs this code."""
    sound = SourceFileLoader.get_code

    def get_code(loader: SourceFileLoader, fullname: str) -> CodeType | None:
        return codes.get(loader.path) or sound(loader, fullname)

    SourceFileLoader.get_code = get_code  # type: ignore[method-assign]


def entered(file: str, modules: Sequence[Path]) -> Entries:
    """What the tests of a file enter in the sound modules, found in a process of its own."""
    with tempfile.NamedTemporaryFile() as answer:
        child = os.fork()
        if child == 0:
            _hush()
            _replace({str(module): telling(module) for module in modules})
            recorder = Recorder()
            sound = pytest.main([*OPTIONS, file], plugins=[recorder]) == pytest.ExitCode.OK
            Path(answer.name).write_bytes(pickle.dumps(recorder.entries))
            os._exit(int(not sound))
        if os.waitpid(child, 0)[1] != 0:
            raise SystemExit(f"The tests of {file} fail without any fault.")
        found: Entries = pickle.loads(Path(answer.name).read_bytes())
        return found


def noticed(runs: Sequence[Sequence[str]], mutant: Mutant, patience: float) -> bool:
    """Whether a test fails within so many seconds, or none ends."""
    if not runs:
        return False
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        os._exit(int(notice(runs, mutant)))
    end = time.monotonic() + patience
    while time.monotonic() < end:
        found, status = os.waitpid(child, os.WNOHANG)
        if found:
            return status != 0
        time.sleep(0.02)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return True


def runs_for(mutant: Mutant, entries: Sequence[Entries]) -> list[list[str]]:
    """The tests that enter the broken function, a file at a time, then the files that have other tests as well."""
    start = function_around(mutant.module, mutant.line)
    some = [(one, one.tests_of(start)) for one in entries]
    return [tests for _, tests in some if tests] + [[one.file] for one, tests in some if 0 < len(tests) < one.number]


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("part")
    parser.add_argument("--sample", type=int, default=0, help="so many mutants, drawn at random; 0: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="mutants of modules with this in their path")
    parser.add_argument("--numbers", type=int, nargs="*", help="only these of the sample, as they were printed")
    asked = parser.parse_args()
    part = Part.named(asked.part)
    for name in HEAVY:
        importlib.import_module(name)  # once for all mutants
    began = time.monotonic()
    entries = [entered(file, part.modules) for file in part.tests]
    patience = 10.0 + PATIENCE * (time.monotonic() - began)
    chosen, there = sample([module for module in part.modules if asked.only in str(module)], asked.sample, asked.seed)
    numbered = [(n, mutant) for n, mutant in enumerate(chosen, 1) if not asked.numbers or n in asked.numbers]
    killed = 0
    for tried, (number, mutant) in enumerate(numbered, 1):
        if noticed(runs_for(mutant, entries), mutant, patience):
            killed += 1
        else:
            print(f"[{number}] {mutant}".replace(f"{ROOT}/", ""), flush=True)
        print(f"\r{killed} of {tried} noticed", end="", file=sys.stderr, flush=True)
    share, seconds = killed / max(1, len(numbered)), time.monotonic() - began
    print(f"\n{asked.part}: {killed} of {len(numbered)} noticed ({share:.0%}) of {there}; {seconds:.0f} s")


if __name__ == "__main__":
    sys.exit(main())
