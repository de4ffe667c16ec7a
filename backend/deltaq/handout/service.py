"""Answers to `POST /exports/{form}`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Mapping
from types import MappingProxyType

from ..contract.export import ExportRequest, FileRequest
from ..contract.reading import read
from ..derivation.effort import UNBOUNDED, Allowance
from ..mechanics.requests import begun_scene
from ..mechanics.scene import Scene
from ..narration.catalog import language_of
from ..narration.derive import TimeIsUp
from .document import Handout, handouts
from .latex import latex_file
from .markdown import markdown_file
from .script import script

Document = dict[str, object]
Texts = Iterator[tuple[str, bool]]  # each with whether it is cut; the last one is the best
Writer = Callable[[Scene, ExportRequest, Allowance], Texts]
SUFFIXES: Mapping[str, str] = MappingProxyType({"latex": "tex", "markdown": "md", "python": "py"})


def export_request(document: Mapping[str, object]) -> Document:
    """{text, name}: the file, and what it may be called. Raises InputError for what cannot be read.

    `document`: the fields of a FileRequest.
    """
    return [file for file, _ in _exported(document, UNBOUNDED)][-1]


def export_parts(document: Mapping[str, object], allowance: Allowance) -> Generator[Document, None, Document]:
    """Returns the same; where the time that is allowed may not be enough, yields it cut, and raises TimeIsUp if so."""
    for file, is_cut in _exported(document, allowance):
        if not is_cut:
            return file
        yield file
    raise TimeIsUp


def _exported(document: Mapping[str, object], allowance: Allowance) -> Iterator[tuple[Document, bool]]:
    """The file, and whether it lacks what there was no time for; before it one that does."""
    asked = read(FileRequest, document)
    scene = begun_scene(asked)
    name = f"{scene.id}.{SUFFIXES[asked.form]}"
    return (({"text": text, "name": name}, is_cut) for text, is_cut in _WRITERS[asked.form](scene, asked, allowance))


def _told(write: Callable[[Handout], str]) -> Writer:
    def told(scene: Scene, asked: ExportRequest, allowance: Allowance) -> Texts:
        made = handouts(
            scene,
            language_of(asked.lang),
            asked.formulation,
            substeps=asked.substeps,
            release=asked.release,
            allowance=allowance,
        )
        return ((write(each), each.is_cut) for each in made)

    return told


def _program(scene: Scene, asked: ExportRequest, _: Allowance) -> Texts:
    yield script(scene, language_of(asked.lang), asked.t_end, asked.release), False


_WRITERS: Mapping[str, Writer] = MappingProxyType(
    {"latex": _told(latex_file), "markdown": _told(markdown_file), "python": _program}
)
