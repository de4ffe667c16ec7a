"""The answers of a class as a file: a table of texts, whose columns are the fields of a row."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True)
class TableRow:
    """A row as it was written; empty texts where the table has no such column."""

    task: str
    answer: str
    student: str = ""
    scene: str = ""
    syntax: str = ""
    seed: str = ""
    line: str = ""
    id: str = ""
    time: str = ""
    file: str = ""


COLUMNS = tuple(one.name for one in fields(TableRow))
NEEDED = ("task", "answer")
