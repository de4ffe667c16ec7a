"""The built-in scenes: whatever TOML files stand in `scenes/`."""

from __future__ import annotations

import tomllib
from difflib import get_close_matches
from functools import cache
from importlib.resources import files

from ..errors import Problem, UnknownNameError
from .document import read_scene
from .scene import Scene

SUFFIX = ".toml"


@cache
def scene_ids() -> tuple[str, ...]:
    """Ids of the built-in scenes, in alphabetical order."""
    folder = files("deltaq") / "scenes"
    return tuple(sorted(file.name.removesuffix(SUFFIX) for file in folder.iterdir() if file.name.endswith(SUFFIX)))


@cache
def load_scene(identifier: str) -> Scene:
    """A built-in scene. Raises UnknownNameError if there is none of this id."""
    if identifier not in scene_ids():
        near = get_close_matches(identifier, scene_ids(), n=1)
        suggestion = near[0] if near else ""
        parameters = {"name": identifier[:64], "suggestion": suggestion, "known": ", ".join(scene_ids())}
        raise UnknownNameError(Problem("unknown-scene", parameters=parameters))
    text = (files("deltaq") / "scenes" / f"{identifier}{SUFFIX}").read_text(encoding="utf-8")
    return read_scene(tomllib.loads(text))
