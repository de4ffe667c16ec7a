"""Reads the table of answers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

TABLE = Path(__file__).with_name("answers.txt")


@dataclass(frozen=True)
class Row:
    """One answer with what the checker must say of it; `reason` is a misconception, `slip:…`, a remark or a code."""

    scene: str
    task: str
    syntax: str
    answer: str
    outcome: str
    reason: str
    comment: str


def rows() -> Iterator[Row]:
    scene = ""
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            scene = line.strip("[]")
        elif line and not line.startswith("#"):
            yield Row(scene, *(field.strip() for field in line.split(" | ")))
