"""What a request for a simulation means: its scene, ready to be run, and how accurately."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..contract.reading import read
from ..contract.simulation import PARTS, SimulationRequest
from ..mechanics.requests import begun_scene
from ..mechanics.scene import Scene


@dataclass(frozen=True)
class Request:
    """A simulation to run. `scene` has the parameter and initial values wanted; exactly one of step and tolerance.

    `release` names what is asked what holds it.
    """

    scene: Scene
    t_end: float
    samples: int
    method: str
    step: float | None
    tolerance: float | None
    include: frozenset[str]
    columns: str
    release: tuple[str, ...] = ()


def read_request(document: Mapping[str, object]) -> Request:
    """The request in a document. Raises InputError with all problems of the fields, or of the scene."""
    asked = read(SimulationRequest, document)
    accuracy, include = (asked.step, asked.wanted_tolerance), frozenset(asked.include or PARTS)
    release = tuple(dict.fromkeys(asked.release))
    scene = begun_scene(asked)
    return Request(scene, asked.t_end, asked.samples, asked.method, *accuracy, include, asked.columns, release)
