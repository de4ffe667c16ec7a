"""What a request is likely to cost, as far as it can be told without computing: how many degrees of freedom it has.

Seconds of a processor on chains of n links (November 2026): a derivation 0.06, 0.5, 1.3, 7 for n = 1, 4, 8, 12; a
simulation of 10 s less than 0.1 up to n = 8; a checked answer 0.2, 0.4, 1.5, 5, 45 for n = 1, 2, 4, 6, 8. What takes
longer than its scene promises, as a bead on a monstrous wire does, is found out while it runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..contract.base import SceneWithChanges
from ..errors import InputError
from ..mechanics.library import family_of, load_scene
from .workers.job import Job


def expected(job: Job, asked: SceneWithChanges, most: int) -> Job:
    """The job, fast if the scene in question has so many degrees of freedom at most, else slow."""
    few = degrees_of_freedom(asked) <= most
    return replace(job, pace="fast" if few else "slow")


def degrees_of_freedom(asked: SceneWithChanges) -> int:
    """Of the scene before its changes; 0 where there is none, which is found soon enough."""
    scene = asked.scene
    if isinstance(scene, str):
        return _of_built_in(scene, asked.parameters)
    coordinates = scene.get("coordinates", ())
    return len(coordinates) if isinstance(coordinates, Sequence) else 0


def _of_built_in(identifier: str, parameters: Mapping[str, float]) -> int:
    try:
        family = family_of(identifier)
        if family is not None:
            return int(parameters.get(family.parameter, family.default))
        return len(load_scene(identifier).free)
    except InputError:
        return 0
