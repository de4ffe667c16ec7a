"""The same table, or zip of what was handed in, marked by the shell's command and by the page's modules, which ask a
running service.
"""

from __future__ import annotations

import base64
import json
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.frontend.node import run
from tests.homework.classes import ClassTable, sheet_file

from deltaq.cli import main

PAGE = Path(__file__).with_name("page_grader.mjs")


@dataclass(frozen=True)
class Saved:
    """The table of results, and the points for Moodle and Canvas: none without an assignment."""

    results: bytes
    moodle: bytes
    canvas: bytes


def by_shell(table: ClassTable, folder: Path) -> Saved:
    """The files that `deltaq check` writes."""
    answers, output, sheet = folder / "answers.csv", folder / "results.csv", folder / "sheet.json"
    points = [output.with_name(f"results-{platform}.csv") for platform in ("moodle", "canvas")]
    for file in points:
        file.unlink(missing_ok=True)
    answers.write_bytes(table.data)
    sheet.write_text(sheet_file(table), encoding="utf-8")
    more = ["--assignment", str(sheet)] if table.assignment else ["--scene", table.scene] if table.scene else []
    assert main(["check", str(answers), "--output", str(output), "--lang", table.language, *more]) == 0
    return Saved(output.read_bytes(), *(file.read_bytes() if file.exists() else b"" for file in points))


def by_page(tables: Sequence[ClassTable], address: str, root: Path) -> Iterator[Saved]:
    """The files that the page saves."""
    asked = [
        {
            "address": address,
            "table": base64.b64encode(table.data).decode(),
            "assignment": table.assignment,
            "scene": table.scene,
            "language": table.language,
        }
        for table in tables
    ]
    done: subprocess.CompletedProcess[str] = run("node", str(PAGE), cwd=root, sent="\n".join(map(json.dumps, asked)))
    assert done.returncode == 0, done.stderr
    for table, line in zip(tables, done.stdout.splitlines(), strict=True):
        answer = json.loads(line)
        assert answer["failure"] is None, (table.seed, answer["failure"])
        yield Saved(*map(base64.b64decode, answer["saved"]))
