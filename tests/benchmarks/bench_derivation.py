"""Milliseconds for the whole derivation of scenes, cold in a warm process, and how much of it the last chapter takes.

Run it from the checkout: `python -m tests.benchmarks.bench_derivation`. SymPy's cache is emptied before each run;
medians. Prints; judges nothing.
"""

from __future__ import annotations

import statistics
from time import perf_counter

from sympy.core.cache import clear_cache
from tests.derivation.scenes import chain

from deltaq.derivation.engine import derive
from deltaq.derivation.model_chapter import model
from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.derivation.verification import random_points, verified_step
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

REPEATS = 5


def whole(scene: Scene) -> float:
    """All chapters with their verification, and the result."""
    clear_cache()
    start = perf_counter()
    system, _ = derive(scene)
    result_of(system)
    return (perf_counter() - start) * 1e3


def last_chapter(scene: Scene) -> float:
    """The chapter "model" with its verification, when the others are done."""
    system, _ = derive(scene)
    fresh = System(scene)
    for name, value in vars(system).items():
        vars(fresh)[name] = value
    for name in [name for name in vars(fresh) if name.startswith("answers of ") and _is_of_the_model(name)]:
        del vars(fresh)[name]
    start = perf_counter()
    points = tuple(random_points(fresh))
    for step in model(fresh):
        verified_step(step, points)
    return (perf_counter() - start) * 1e3


def _is_of_the_model(name: str) -> bool:
    words = ("equilibria", "linearizations", "mass_matrix", "forc", "jacobi", "reduction", "rest")
    return any(word in name for word in words)


def main() -> None:
    scenes = {name: load_scene(name) for name in scene_ids()} | {f"{n}-link": chain(n) for n in (2, 3, 4)}
    derive(scenes["pendulum"])
    print(f"{'scene':32}{'whole, ms':>12}{'model, ms':>12}")
    for name, scene in scenes.items():
        rounds = [(whole(scene), last_chapter(scene)) for _ in range(REPEATS)]
        medians = [statistics.median(each) for each in zip(*rounds, strict=True)]
        print(f"{name:32}{medians[0]:12.1f}{medians[1]:12.1f}")


if __name__ == "__main__":
    main()
