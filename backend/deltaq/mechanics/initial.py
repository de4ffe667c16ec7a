"""Other initial values than the scene's own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..errors import Problem, RequestError, SceneError, UnknownNameError, escaped
from .coordinate import Coordinate
from .scene import Scene


def with_initial(scene: Scene, initial: Mapping[str, Mapping[str, float]], freeze: Sequence[str] = ()) -> Scene:
    """The scene with other initial values; the range of the slider gives way."""
    if not initial:
        return scene  # and not a copy, of which everything would have to be found out anew
    known = {coordinate.name for coordinate in scene.coordinates}
    free = {coordinate.name for coordinate in scene.free}
    for name in initial:
        pointer = f"/initial/{escaped(name)}"
        if name not in known:
            parameters = {"name": name[:40], "known": ", ".join(sorted(free))}
            raise UnknownNameError(Problem("unknown-coordinate", pointer, parameters=parameters))
        if name not in free:
            raise RequestError(Problem("guided-coordinate", pointer, parameters={"name": name}))
        if name in freeze and initial[name].get("rate"):
            raise RequestError(Problem("frozen-rate", f"{pointer}/rate", parameters={"name": name}))
    coordinates = tuple(_set(coordinate, initial.get(coordinate.name, {})) for coordinate in scene.coordinates)
    return replace(scene, coordinates=coordinates)


def _set(coordinate: Coordinate, given: Mapping[str, float]) -> Coordinate:
    """Raises RequestError for values that no motion can begin with."""
    value, rate = given.get("value", coordinate.value), given.get("rate", coordinate.rate)
    low = None if coordinate.min is None else min(coordinate.min, value)
    high = None if coordinate.max is None else max(coordinate.max, value)
    try:
        return replace(coordinate, value=value, rate=rate, min=low, max=high)
    except SceneError as error:
        raise RequestError(*(one.below(f"/initial/{escaped(coordinate.name)}") for one in error.problems)) from None
