"""`deltaq bench`: the benchmarks of a checkout."""

from __future__ import annotations

import argparse

from ..errors import CommandError

HELP = "measure speed and accuracy against peers (in a checkout)"
DESCRIPTION = """Runs the benchmarks of the checkout: tables with ratios to C, SciPy, SymPy and, where installed,
heyoka. Without names all of them, which takes about half an hour."""


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("names", nargs="*", help="which: simulation, derivation, chain, rhs …")


def run(options: argparse.Namespace) -> int:
    """Run benchmarks by name; the exit code is that of the first that failed."""
    from ..bench import benchmark_names, run_benchmarks

    known = benchmark_names()
    if not known:
        raise CommandError("the benchmarks are part of a checkout, not of the installed package")
    if unknown := [name for name in options.names if name not in known]:
        raise CommandError(f"no benchmark {', '.join(unknown)}; there are {', '.join(known)}")
    return run_benchmarks(tuple(options.names) or known)
