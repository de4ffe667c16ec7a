"""`deltaq compile`: the numerical kernels, before anybody asks for a motion."""

from __future__ import annotations

import argparse
from time import perf_counter

HELP = "compile the numerical kernels for this machine"
DESCRIPTION = """Compiles the numerical kernels and keeps them on disk (NUMBA_CACHE_DIR). The service does so itself
when it first runs on a machine; a deployment does it beforehand."""


def arguments(parser: argparse.ArgumentParser) -> None:
    """It takes none."""


def run(_options: argparse.Namespace) -> None:
    """Compile what is not compiled yet, when no other process does."""
    from ..api.workers.kernels import are_compiled, compiling

    with compiling():
        if are_compiled():
            print("all kernels are there")
        else:
            _compile()


def _compile() -> None:
    """Each family of methods and the lanes of ensembles, then what only the lab needs."""
    from ..lab import divergence, monodromy
    from ..simulation.library import kernel_groups
    from ..simulation.service import warm

    for family in kernel_groups():
        start = perf_counter()
        warm(family)
        print(f"{family:22} {perf_counter() - start:5.1f} s", flush=True)
    start = perf_counter()
    monodromy.warm()
    print(f"{'stability maps':22} {perf_counter() - start:5.1f} s", flush=True)
    start = perf_counter()
    divergence.warm()
    print(f"{'chaos':22} {perf_counter() - start:5.1f} s")
