"""Breaks the code on purpose and counts which faults the tests notice: `python -m tests.mutants homework`.

A part is named in pyproject.toml, [tool.deltaq.mutants], with its modules and the tests that answer for them. Nothing
on the disk changes. First come the tests that enter the broken function, the quickest first, then all others of their
files, until one fails: files that never enter it cannot tell. A mutant that takes five times as long as the sound code
is noticed as well: somebody would wait for ever.
"""

from __future__ import annotations

import argparse
import importlib
import math
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

from tests import order

from .faults import sample
from .running import recorded, verdicts

ROOT = Path(__file__).parents[2]
HEAVY = ("sympy", "numpy", "symengine", "numba", "scipy.integrate", "flint", "hypothesis")


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


def main() -> None:
    asked = parser().parse_args()
    tried(Part.named(asked.part), asked)


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("part")
    parser.add_argument("--sample", type=int, default=0, help="so many mutants, drawn at random; 0: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="mutants of modules with this in their path")
    parser.add_argument("--numbers", type=int, nargs="*", help="only these of the sample, as they were printed")
    parser.add_argument("--processes", type=int, default=1, help="so many mutants at a time")
    parser.add_argument(
        "--seconds", type=float, default=math.inf, help="of tests for each mutant, files that take longer left out"
    )
    return parser


def tried(part: Part, asked: argparse.Namespace) -> None:
    """Tries as many faults of a part as are asked for, and prints those that nobody noticed."""
    for name in HEAVY:
        importlib.import_module(name)  # once for all processes
    began = time.monotonic()
    chosen, there = sample([module for module in part.modules if asked.only in str(module)], asked.sample, asked.seed)
    mutants = {n: mutant for n, mutant in enumerate(chosen, 1) if not asked.numbers or n in asked.numbers}
    measured = order.recorded()
    took = measured.by_file(measured.long)
    tests = [file for file in part.tests if took.get(file, 0.0) <= asked.seconds]
    record = recorded(tests, part.modules, asked.processes, asked.seconds)
    killed = 0
    for number, (of, noticed) in enumerate(verdicts(mutants, record, part.modules, asked.processes), 1):
        killed += noticed
        if not noticed:
            print(f"\r[{of}] {mutants[of]}".replace(f"{ROOT}/", ""), flush=True)
        print(f"\r{killed} of {number} noticed", end="", file=sys.stderr, flush=True)
    share, seconds = killed / max(1, len(mutants)), time.monotonic() - began
    print(f"\n{asked.part}: {killed} of {len(mutants)} noticed ({share:.0%}) of {there}; {seconds:.0f} s")


if __name__ == "__main__":
    sys.exit(main())
