"""What the API asks of homework: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

from ..language.parser import Syntax
from ..mechanics.writing import write_scene
from ..narration.catalog import language_of
from .checking import check
from .feedback import Document, task_document, verdict_document
from .workbook import Workbook, workbook_of


def tasks_request(document: Mapping[str, object]) -> Document:
    """{scene, guides?, freeze?, parameters?, seed?, lang?} → {scene, symbols, tasks}."""
    workbook = workbook_of(document)
    language = language_of(cast("str | None", document.get("lang")))
    return {
        "scene": write_scene(workbook.scene),
        "symbols": _symbols(workbook),
        "tasks": [task_document(task, workbook, language) for task in workbook.tasks],
    }


def _symbols(workbook: Workbook) -> list[Document]:
    """What an answer may speak of: names with their LaTeX, for a keyboard."""
    scene = workbook.scene
    units = {c.name: c.unit for c in scene.coordinates} | {p.name: p.unit for p in scene.parameters}
    values = {p.name: p.value for p in scene.parameters}
    return [
        {"name": s.name, "latex": s.typeset, "kind": s.kind, "unit": units.get(s.name, ""), "value": values.get(s.name)}
        for s in scene.names.symbols
    ]


def check_request(document: Mapping[str, object]) -> Document:
    """{scene, task, answer: {syntax, value}, …} → the verdict. Raises InputError for what is not an answer."""
    workbook = workbook_of(document)
    answer = cast("Mapping[str, str]", document["answer"])
    task = workbook.task(str(document["task"]))
    verdict = check(workbook, task, answer["value"], cast("Syntax", answer.get("syntax") or "plain"))
    return verdict_document(verdict, workbook.scene, language_of(cast("str | None", document.get("lang"))))


def batch_request(document: Mapping[str, object]) -> list[Document]:
    """The verdicts on several answers, one after the other."""
    checks = cast("Sequence[Mapping[str, object]]", document["checks"])
    return [check_request({"lang": document.get("lang"), **one}) for one in checks]
