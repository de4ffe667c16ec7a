"""Milliseconds from a scene to the whole answer of `POST /derivations`, and how many of its steps are verified.

Run it from the checkout: `python -m tests.benchmarks.bench_derivation`. Cold means a warm process that has not seen
the scene: the caches of SymPy and of δq are emptied before each run. Cached means asked for again over HTTP. Medians.
Prints; judges nothing.
"""

from __future__ import annotations

import asyncio
import statistics
from time import perf_counter

import httpx
from sympy.core.cache import clear_cache

from deltaq.api.app import create_app
from deltaq.derivation.engine import derive
from deltaq.derivation.program import program
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.narration.derive import derive_request

COLD, CACHED = 5, 20


def cold(request: dict[str, object]) -> float:
    """Derivation, verification, sentences and LaTeX."""
    clear_cache()
    program.cache_clear()
    start = perf_counter()
    derive_request(request)
    return (perf_counter() - start) * 1e3


def verified(name: str) -> tuple[int, int]:
    """Steps verified, and all steps."""
    _, derivation = derive(load_scene(name))
    steps = list(derivation.steps())
    return sum(step.verified for step in steps), len(steps)


async def cached() -> dict[str, float]:
    """Each scene asked for again, over HTTP in one process."""
    app = create_app()
    found = {}
    async with app.router.lifespan_context(app):
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://deltaq", timeout=120.0) as client:
            for name in scene_ids():
                times = []
                for _ in range(CACHED + 1):
                    start = perf_counter()
                    response = await client.post("/api/v1/derivations", json={"scene": name, "lang": "en"})
                    times.append((perf_counter() - start) * 1e3)
                    response.raise_for_status()
                found[name] = statistics.median(times[1:])
    return found


def main() -> None:
    derive_request({"scene": "pendulum"})
    again = asyncio.run(cached())
    print(f"{'scene':32}{'cold, ms':>10}{'worst':>8}{'cached, ms':>12}{'verified':>12}")
    for name in scene_ids():
        times = [cold({"scene": name, "lang": "en"}) for _ in range(COLD)]
        good, steps = verified(name)
        counted = f"{good}/{steps}"
        print(f"{name:32}{statistics.median(times):10.0f}{max(times):8.0f}{again[name]:12.1f}{counted:>12}")


if __name__ == "__main__":
    main()
