"""The scene that a request means: named or brought along, with its changes. One reading for every call of the API."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Protocol

from ..errors import InputError, SceneError
from .bounds import value_problems
from .changes import change
from .document import read_scene
from .initial import with_initial
from .library import family_of, load_scene
from .scene import Scene


def requested_scene(
    reference: str | Mapping[str, object], parameters: Mapping[str, float]
) -> tuple[Scene, Mapping[str, float]]:
    """The scene without its changes, and the parameter values left once the size of a family is taken out.

    Problems of a scene that the request brings along point below /scene.
    """
    if isinstance(reference, str):
        return _named(reference, parameters)
    with inside("/scene"):
        return _brought(reference), parameters


def _brought(document: Mapping[str, object]) -> Scene:
    """The scene of a document; of one that came before, as it does with every value that is tried, that from then."""
    try:
        text = json.dumps(document)
    except (TypeError, ValueError, RecursionError):  # what is no JSON is read all the same, or refused
        return read_scene(document)
    return _read(text)


@lru_cache(maxsize=32)
def _read(text: str) -> Scene:
    """The scene that a document describes, written as JSON. Raises SceneError, each time anew."""
    document: dict[str, object] = json.loads(text)
    return read_scene(document)


class ChangedScene(Protocol):
    """What a request says of its scene: `contract.base.SceneWithChanges` is one."""

    @property
    def scene(self) -> str | Mapping[str, object]:
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


class BegunScene(ChangedScene, Protocol):
    """The same where a motion begins: `contract.base.SceneWithInitialValues` is one."""

    @property
    def given_initial(self) -> Mapping[str, Mapping[str, float]]:
        """Initial `value` and `rate` by coordinate."""


def changed_scene(asked: ChangedScene) -> Scene:
    """The scene that a request means, its changes applied. Raises InputError that points into the request."""
    scene, parameters = requested_scene(asked.scene, asked.parameters)
    return _within_bounds(scene, change(scene, asked.given_guides, asked.freeze, parameters))


def begun_scene(asked: BegunScene) -> Scene:
    """The scene that a request means, its changes applied and its motion begun where the request says."""
    scene, parameters = requested_scene(asked.scene, asked.parameters)
    begun = with_initial(scene, asked.given_initial, asked.freeze)
    return _within_bounds(scene, change(begun, asked.given_guides, asked.freeze, parameters))


def _within_bounds(scene: Scene, changed: Scene) -> Scene:
    """The changed scene. Raises SceneError where its values are none that the scene could have been read with."""
    if changed is not scene:
        with inside("/scene"):
            require_bounds(changed)
    return changed


def require_bounds(scene: Scene) -> None:
    """Raises SceneError where values of a scene that reads well break a bound."""
    problems = tuple(value_problems(scene))
    if problems:
        raise SceneError(*problems)


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
