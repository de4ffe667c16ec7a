"""The built-in scenes: whatever TOML files stand in `scenes/`, and the families."""

from __future__ import annotations

import tomllib
from difflib import get_close_matches
from functools import cache
from importlib.resources import files
from typing import cast

from ..errors import Problem, RequestError, UnknownNameError
from ..packages import classes_of
from .document import read_scene
from .families import Family
from .scene import Scene

SUFFIX = ".toml"


@cache
def scene_ids() -> tuple[str, ...]:
    """Ids of the built-in scenes and families, in alphabetical order."""
    folder = files("deltaq") / "scenes"
    on_disk = (file.name.removesuffix(SUFFIX) for file in folder.iterdir() if file.name.endswith(SUFFIX))
    return tuple(sorted((*on_disk, *_families())))


def family_of(identifier: str) -> Family | None:
    """The family of this id, if it is one."""
    kind = _families().get(identifier)
    return None if kind is None else cast("Family", kind())


@cache
def load_scene(identifier: str, size: int | None = None) -> Scene:
    """A built-in scene; `size` chooses the member of a family. Raises UnknownNameError if there is none of this id."""
    family = family_of(identifier)
    if family is not None:
        return read_scene(family.document(_checked(family, size)))
    if identifier not in scene_ids():
        near = get_close_matches(identifier, scene_ids(), n=1)
        suggestion = near[0] if near else ""
        parameters = {"name": identifier[:64], "suggestion": suggestion, "known": ", ".join(scene_ids())}
        raise UnknownNameError(Problem("unknown-scene", parameters=parameters))
    text = (files("deltaq") / "scenes" / f"{identifier}{SUFFIX}").read_text(encoding="utf-8")
    return read_scene(tomllib.loads(text))


def _checked(family: Family, size: int | None) -> int:
    wanted = family.default if size is None else size
    if family.least <= wanted <= family.most:
        return wanted
    parameters: dict[str, str | int | float] = {"name": family.parameter, "least": family.least, "most": family.most}
    raise RequestError(Problem("family-size", f"/parameters/{family.parameter}", parameters=parameters))


def _families() -> dict[str, type]:
    return classes_of("deltaq.mechanics.families", "id")
