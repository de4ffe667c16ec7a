"""Answers to `POST /exports/{form}`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..contract.export import ExportRequest, FileRequest
from ..contract.reading import read
from ..mechanics.requests import begun_scene
from ..mechanics.scene import Scene
from ..narration.catalog import language_of
from .document import handout_of
from .latex import latex_file
from .markdown import markdown_file
from .script import script

Document = dict[str, object]
SUFFIXES: Mapping[str, str] = MappingProxyType({"latex": "tex", "markdown": "md", "python": "py"})


def export_request(document: Mapping[str, object]) -> Document:
    """{text, name}: the file, and what it may be called. Raises InputError for what cannot be read.

    `document`: the fields of a FileRequest.
    """
    asked = read(FileRequest, document)
    scene = begun_scene(asked)
    return {"text": _WRITERS[asked.form](scene, asked), "name": f"{scene.id}.{SUFFIXES[asked.form]}"}


def _told(write: Callable[..., str]) -> Callable[[Scene, ExportRequest], str]:
    def told(scene: Scene, asked: ExportRequest) -> str:
        language = language_of(asked.lang)
        made = handout_of(scene, language, asked.formulation, substeps=asked.substeps, release=asked.release)
        return write(made)

    return told


def _program(scene: Scene, asked: ExportRequest) -> str:
    return script(scene, language_of(asked.lang), asked.t_end, asked.release)


_WRITERS: Mapping[str, Callable[[Scene, ExportRequest], str]] = MappingProxyType(
    {"latex": _told(latex_file), "markdown": _told(markdown_file), "python": _program}
)
