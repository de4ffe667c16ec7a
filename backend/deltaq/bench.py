"""The benchmarks of a checkout: each is a program in tests/benchmarks that prints a table with ratios to its peers.

They need the peers (SciPy, a C compiler, heyoka …), so an installed package does not bring them along.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

CHECKOUT = Path(__file__).parents[2]
PREFIX = "bench_"


def benchmark_names(checkout: Path = CHECKOUT) -> tuple[str, ...]:
    """What stands in tests/benchmarks, without its prefix; nothing outside a checkout."""
    files = sorted((checkout / "tests" / "benchmarks").glob(f"{PREFIX}*.py"))
    return tuple(file.stem.removeprefix(PREFIX) for file in files)


def run_benchmarks(names: tuple[str, ...], checkout: Path = CHECKOUT) -> int:
    """Runs each in a process of its own, one after the other; the first exit code that is not 0, else 0."""
    codes = []
    for name in names:
        print(f"\n== {name} ==", flush=True)
        codes.append(subprocess.call([sys.executable, "-m", f"tests.benchmarks.{PREFIX}{name}"], cwd=checkout))
    return next((code for code in codes if code), 0)
