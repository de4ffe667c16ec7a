"""Answers to `POST /exports/{form}`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import cast

from ..derivation.engine import USUAL
from ..mechanics.changes import change
from ..mechanics.initial import with_initial
from ..mechanics.requests import requested_scene
from ..mechanics.scene import Scene
from ..narration.catalog import language_in
from .document import handout_of
from .latex import latex_file
from .markdown import markdown_file
from .script import script

Document = dict[str, object]
SUFFIXES: Mapping[str, str] = MappingProxyType({"latex": "tex", "markdown": "md", "python": "py"})


def export_request(document: Mapping[str, object]) -> Document:
    """{text, name}: the file, and what it may be called. Raises InputError for what cannot be read.

    `document`: {form, scene, guides?, freeze?, parameters?, initial?, t_end?, formulation?, substeps?, lang?}, already
    checked for types.
    """
    form = str(document["form"])
    scene = _scene_of(document)
    return {"text": _WRITERS[form](scene, document), "name": f"{scene.id}.{SUFFIXES[form]}"}


def _scene_of(document: Mapping[str, object]) -> Scene:
    freeze = cast("list[str]", document.get("freeze") or [])
    scene, parameters = requested_scene(document["scene"], cast("dict[str, float]", document.get("parameters") or {}))
    initial = cast("dict[str, dict[str, float | None]]", document.get("initial") or {})
    given = {name: {key: one for key, one in values.items() if one is not None} for name, values in initial.items()}
    begun = with_initial(scene, given, freeze)
    return change(begun, cast("list[dict[str, str]]", document.get("guides") or []), freeze, parameters)


def _told(write: Callable[..., str]) -> Callable[[Scene, Mapping[str, object]], str]:
    def told(scene: Scene, document: Mapping[str, object]) -> str:
        formulation, substeps = str(document.get("formulation") or USUAL), document.get("substeps") is not False
        return write(handout_of(scene, language_in(document), formulation, substeps=substeps))

    return told


def _program(scene: Scene, document: Mapping[str, object]) -> str:
    language = language_in(document)
    return script(scene, language, float(cast("float", document.get("t_end") or 10.0)))


_WRITERS: Mapping[str, Callable[[Scene, Mapping[str, object]], str]] = MappingProxyType(
    {"latex": _told(latex_file), "markdown": _told(markdown_file), "python": _program}
)
