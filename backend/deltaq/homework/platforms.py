"""Points of a class as files that course platforms import.

Moodle (Grades → Import → CSV; grade/import/csv/classes/load_data.php): a header, one row for each person, who is found
by an ID number, a login or an address; one person whom the course does not have calls off the whole import, an empty
cell only passes the row over. Points are numbers with a point. What stands between backslash brackets is typeset.

Canvas (Gradebook → Import; lib/gradebook_importer.rb): the columns Student, ID, SIS User ID, SIS Login ID, Section, and
below the header a row of the points that are possible. Who has no id is found by name. A number in brackets at the
end of a title would be taken for the id of an assignment.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from ..narration.catalog import text
from ..narration.prose import pieces, plain
from .table import Style

STYLE = Style()
MOODLE = ("Full name", "ID number", "Email address")
CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
POSSIBLE = ("    Points Possible", "", "", "", "")

Document = Mapping[str, Any]


def moodle_csv(found: Document, title: str, language: str) -> bytes:
    """The `totals` of a class for Moodle: points, and as feedback the points by task."""
    header = (*MOODLE, title, text(language, "homework.platforms.feedback", title=title))
    return STYLE.written(header, _moodle_rows(found, language))


def _moodle_rows(found: Document, language: str) -> Iterable[tuple[object, ...]]:
    for student in found["students"]:
        number, address = ("", student["id"]) if "@" in student["id"] else (student["id"], "")
        yield student["student"], number, address, _points(student), _feedback(student, found["tasks"], language)


def _feedback(student: Document, tasks: Iterable[Document], language: str) -> str:
    told = (
        text(
            language,
            "homework.platforms.task",
            task="".join(f"\\({one.text}\\)" if one.is_formula else one.text for one in pieces(task["title"])),
            points=float(f"{answer['points'] if answer else 0.0:.4g}"),
            of=float(f"{task['of']:.4g}"),
        )
        for answer, task in zip(student["answers"], tasks, strict=True)
    )
    return "; ".join(map(plain, told))


def canvas_csv(found: Document, of: float, title: str) -> bytes:
    """The `totals` of a class for Canvas."""
    rows = [
        (student["student"], "", student["id"], student["id"], "", _points(student)) for student in found["students"]
    ]
    return STYLE.written((*CANVAS, re.sub(r"\((\d+)\)\s*$", r"\1", title)), [(*POSSIBLE, of), *rows])


def _points(student: Document) -> float:
    return float(student["points"])
