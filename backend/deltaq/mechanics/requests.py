"""The scene that a request means: named or brought along, with its changes. One reading for every call of the API."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Protocol, cast

from ..errors import InputError, Problem, RequestError
from .changes import change
from .document import read_scene
from .initial import with_initial
from .library import family_of, load_scene
from .scene import Scene


def requested_scene(reference: object, parameters: Mapping[str, float]) -> tuple[Scene, Mapping[str, float]]:
    """The scene without its changes, and the parameter values left once the size of a family is taken out.

    Problems of a scene that the request brings along point below /scene.
    """
    if isinstance(reference, str):
        return _named(reference, parameters)
    if not isinstance(reference, Mapping):
        raise RequestError(Problem("request-scene-type", "/scene"))
    with inside("/scene"):
        return read_scene(reference), parameters


def changed_scene(document: Mapping[str, object]) -> Scene:
    """The scene that a request {scene, guides?, freeze?, parameters?} means, its changes applied.

    The types of the fields are checked already.
    """
    guides = cast("Sequence[Mapping[str, str]]", document.get("guides") or ())
    freeze = cast("Sequence[str]", document.get("freeze") or ())
    parameters = cast("Mapping[str, float]", document.get("parameters") or {})
    scene, values = requested_scene(document["scene"], parameters)
    return change(scene, guides, freeze, values)


class BegunScene(Protocol):
    """What a request says of its scene where a motion begins: `contract.base.SceneWithInitialValues` is one."""

    @property
    def scene(self) -> object:
        """The id of a built-in scene, or a scene document."""

    @property
    def given_guides(self) -> Sequence[Mapping[str, str]]:
        """Guides that replace coordinates: `coordinate` and `value` of each."""

    @property
    def freeze(self) -> Sequence[str]:
        """The coordinates held at their initial values."""

    @property
    def parameters(self) -> Mapping[str, float]:
        """Parameter values by name, the size of a family among them."""

    @property
    def given_initial(self) -> Mapping[str, Mapping[str, float]]:
        """Initial `value` and `rate` by coordinate."""


def begun_scene(asked: BegunScene) -> Scene:
    """The scene that a request means, its changes applied and its motion begun where the request says."""
    scene, parameters = requested_scene(asked.scene, asked.parameters)
    begun = with_initial(scene, asked.given_initial, asked.freeze)
    return change(begun, asked.given_guides, asked.freeze, parameters)


def _named(identifier: str, parameters: Mapping[str, float]) -> tuple[Scene, Mapping[str, float]]:
    family = family_of(identifier)
    if family is None or family.parameter not in parameters:
        with inside("/scene"):
            return load_scene(identifier), parameters
    size = parameters[family.parameter]
    rest = {name: value for name, value in parameters.items() if name != family.parameter}
    return load_scene(identifier, int(size) if size == int(size) else -1), rest


@contextmanager
def inside(pointer: str) -> Iterator[None]:
    """Problems raised within are told as seen from the request, in which their document stands at `pointer`."""
    try:
        yield
    except InputError as error:
        raise type(error)(*(problem.below(pointer) for problem in error.problems)) from None
