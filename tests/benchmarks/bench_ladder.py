"""Whether the ladder says the same to every observer: library scenes × starts × spans × observers.

Run it from the checkout: `python -m tests.benchmarks.bench_ladder [scene …]`. Each verdict (which rungs there are,
their errors, which survive a nudge, which one is the least) is held against that of the same motion in other units,
from other origins and in moving frames, and with all initial values a millionth off. Prints; judges nothing.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from time import perf_counter

from tests.lab.ladder.climbing import climbed
from tests.lab.ladder.observers import EXACT, NUDGES, ORIGINS, UNITS, Observer, Verdict, another, frames

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

RUNS = ((3.0, 0.3), (20.0, 0.01))  # spans in seconds, with the error allowed
SMALL = 0.02  # of the scene's own deviation from its origins


def starts(scene: Scene) -> Iterator[tuple[str, Scene]]:
    """The scene's own start, a small one, and with each coordinate in turn exactly at zero, where symmetries are."""
    yield "own", scene
    small = (replace(c, value=SMALL * c.value, min=None, max=None) for c in scene.coordinates)
    yield "small", replace(scene, coordinates=tuple(small))
    for name in (each.name for each in scene.free if len(scene.free) > 1 and each.value and each.unit == "rad"):
        straight = (
            replace(c, value=0.0, rate=0.0, min=None, max=None) if c.name == name else c for c in scene.coordinates
        )
        yield f"{name} = 0", replace(scene, coordinates=tuple(straight))


def observers(scene: Scene) -> tuple[Observer, ...]:
    dimension = scene.dimension
    return (*UNITS, *ORIGINS, *frames(dimension), another(dimension), *NUDGES)


def compared(scene: Scene, span: float, tolerance: float) -> Iterator[tuple[str, list[str]]]:
    own = Verdict.of(climbed(scene, span, tolerance=tolerance))
    for observer in observers(scene):
        seen = climbed(observer.sees(scene), span * observer.second, tolerance=tolerance)
        other = Verdict.of(seen)
        yield observer.name, own.misleads(other) if observer.nudge else own.differs(other, EXACT)


def main(names: list[str]) -> None:
    total, wrong, start = Counter[str](), Counter[str](), perf_counter()
    for identifier in names or scene_ids():
        for label, scene in starts(load_scene(identifier)):
            for span, tolerance in RUNS:
                for observer, found in compared(scene, span, tolerance):
                    total[observer] += 1
                    wrong[observer] += any(each.startswith("least") for each in found)
                    if found:
                        print(f"{identifier}, {label}, {span:g} s, {tolerance:g}: {observer}: {'; '.join(found)}")
    for observer, count in total.items():
        print(f"{observer:24} {count:6} verdicts, {wrong[observer]} with another least model")
    print(f"{sum(total.values())} in all, {sum(wrong.values())} wrong, {perf_counter() - start:.0f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
