"""Whether the ladder says the same to every observer: library scenes × starts × spans × observers.

Run it from the checkout: `python -m tests.benchmarks.bench_ladder [seed=N] [scene …]`; with a seed the
scenes have other values. Each verdict (which rungs there are,
their errors, which survive a nudge, which one is the least) is held against that of the same motion in other units,
from other origins and in moving frames, and with all initial values a millionth off. Verdicts for unlike
parts of the span are given anew for the part that both speak of. Prints; judges nothing.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from time import perf_counter

from tests.lab.ladder.climbing import climbed
from tests.lab.ladder.observers import EXACT, NUDGES, ORIGINS, UNITS, Observer, Verdict, another, frames

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene

RUNS = ((3.0, 0.3), (20.0, 0.01))  # spans in seconds, with the error allowed
SAME, COMMON = 0.01, 0.98  # parts of a span: verdicts for other times are held against each other over the common one
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


@dataclass(frozen=True)
class Comparison:
    """What one observer says and what another does: `found` are the differences over the time that both speak of."""

    observer: str
    found: list[str]
    is_shorter: bool  # than the span asked for
    is_silent: bool  # no verdict at all

    @property
    def is_wrong(self) -> bool:
        return any(each.startswith("least") for each in self.found)


def compared(scene: Scene, span: float, tolerance: float) -> Iterator[Comparison]:
    own = said(scene, span, tolerance)
    for observer in observers(scene):
        seen = observer.sees(scene)
        other = said(seen, span * observer.second, tolerance)
        both = (own, other)
        if own.least and other.least and abs(own.until - other.until) > SAME:
            common = COMMON * min(own.until, other.until) * span
            both = (said(scene, common, tolerance), said(seen, common * observer.second, tolerance))
        found = both[0].misleads(both[1]) if observer.nudge else both[0].differs(both[1], EXACT)
        yield Comparison(observer.name, found, other.until < 1.0 - SAME, other.least is None)


def said(scene: Scene, span: float, tolerance: float) -> Verdict:
    return Verdict.of(climbed(scene, span, tolerance=tolerance))


def changed(scene: Scene, seed: int | None) -> Scene:
    """The scene with other initial values, rates and parameters: up to a fifth off."""
    if seed is None:
        return scene
    source = random.Random(f"{scene.id} {seed}")
    coordinates = (
        replace(c, value=c.value * source.uniform(0.8, 1.2), rate=c.rate * source.uniform(0.8, 1.2), min=None, max=None)
        for c in scene.coordinates
    )
    parameters = (replace(p, value=p.value * source.uniform(0.9, 1.1)) for p in scene.parameters)
    return replace(
        scene, coordinates=tuple(coordinates), parameters=tuple(replace(p, min=None, max=None) for p in parameters)
    )


def main(arguments: list[str]) -> None:
    seeds = [int(each.removeprefix("seed=")) for each in arguments if each.startswith("seed=")]
    names = [each for each in arguments if not each.startswith("seed=")]
    total, wrong, short, silent, start = Counter[str](), Counter[str](), Counter[str](), Counter[str](), perf_counter()
    for identifier in names or scene_ids():
        for label, scene in starts(changed(load_scene(identifier), seeds[0] if seeds else None)):
            for span, tolerance in RUNS:
                for one in compared(scene, span, tolerance):
                    total[one.observer] += 1
                    wrong[one.observer] += one.is_wrong
                    short[one.observer] += one.is_shorter
                    silent[one.observer] += one.is_silent
                    if one.found:
                        print(
                            f"{identifier}, {label}, {span:g} s, {tolerance:g}: {one.observer}: {'; '.join(one.found)}",
                            flush=True,
                        )
    for observer, count in total.items():
        told = f"{short[observer]} for a part of the span, {silent[observer]} of them for none"
        print(f"{observer:24} {count:6} verdicts, {wrong[observer]} with another least model, {told}")
    all_of_it = [sum(each.values()) for each in (total, wrong, short, silent)]
    print("{} in all, {} wrong, {} short, {} silent".format(*all_of_it) + f", {perf_counter() - start:.0f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
