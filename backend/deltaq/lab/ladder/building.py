"""The rungs of a scene: every kind of simplification that can be made, and the chains of them that are worth it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import islice

from ...errors import InputError
from ...mechanics.document import IDENTIFIER, read_scene
from ...mechanics.scene import Scene
from ...mechanics.writing import write_scene
from ...packages import modules_of
from .findings import FULL, Part, Rung
from .simplification import Back, Kind, Motion, SimplificationContext, Simplified

MOST_RUNGS, MOST_OF_KIND = 20, 6
LONGEST_CHAIN = 3
Chain = tuple[Part, ...]


@cache
def kinds() -> dict[str, Kind]:
    """The kinds there are: whatever stands in `rungs/`."""
    found: list[Kind] = [module.KIND for module in modules_of("deltaq.lab.ladder.rungs")]
    return {kind.id: kind for kind in found}


def chains(context: SimplificationContext) -> tuple[Chain, ...]:
    """The simplifications to try, the shortest chains first, no more than a ladder needs."""
    found = sorted(_chains(context, tuple(kinds())), key=len)
    return tuple(islice(found, MOST_RUNGS - 1))


def _chains(context: SimplificationContext, allowed: tuple[str, ...], depth: int = 1) -> Iterator[Chain]:
    bound = bool(context.scene.constraints)
    for kind in (kinds()[name] for name in allowed if kinds()[name].of_constrained is bound):
        for part in islice(kind.offered(context), MOST_OF_KIND):
            yield (part,)
            if depth < LONGEST_CHAIN and kind.followers:
                yield from ((part, *rest) for rest in _after(context, part, depth))


def _after(context: SimplificationContext, part: Part, depth: int) -> Iterator[Chain]:
    kind = kinds()[part.kind]
    try:
        below = context.with_scene(kind.simplify(context, part).scene)
    except InputError:  # the rung itself will say so
        return
    yield from _chains(below, kind.followers, depth + 1)


def simplified(context: SimplificationContext, chain: Chain) -> Simplified:
    """The scene at the end of a chain, and the way back from it. Raises InputError where there is none."""
    scene, back = context.scene, Simplified(context.scene).back
    for part in chain:
        step = kinds()[part.kind].simplify(context.with_scene(scene), part)
        scene, back = step.scene, _both(step.back, back)
    return Simplified(_renamed(scene, chain), back)


def _both(first: Back, then: Back) -> Back:
    def back(motion: Motion) -> Motion:
        return then(first(motion))

    return back


def _renamed(scene: Scene, chain: Chain) -> Scene:
    wanted = "-".join((scene.id, *(word for part in chain for word in (part.kind, *part.parameters.values()))))
    name = wanted.lower().replace("_", "-")[:64]
    return replace(scene, id=name if IDENTIFIER.fullmatch(name) else scene.id)


def rung_of(context: SimplificationContext, chain: Chain) -> Rung:
    """The rung of a chain; its scene is read back from its document, so that it is one that anyone could send."""
    name = "+".join(part.id for part in chain) or FULL
    try:
        document = write_scene(simplified(context, chain).scene)
        return Rung(name, chain, read_scene(document).degrees_of_freedom, document)
    except InputError as error:
        return Rung(name, chain, 0, None, error.problems)
