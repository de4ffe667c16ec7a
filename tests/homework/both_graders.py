"""The same table marked by the shell's command and by the page's modules, which ask a running service."""

from __future__ import annotations

import base64
import json
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.frontend.node import run
from tests.homework.classes import ClassTable, sheet_file

from deltaq.cli import main

PAGE = Path(__file__).with_name("page_grader.mjs")


def by_shell(table: ClassTable, folder: Path) -> bytes:
    """The file that `deltaq check` writes."""
    answers, output, sheet = folder / "answers.csv", folder / "results.csv", folder / "sheet.json"
    answers.write_bytes(table.data)
    sheet.write_text(sheet_file(table), encoding="utf-8")
    more = ["--assignment", str(sheet)] if table.assignment else ["--scene", table.scene] if table.scene else []
    assert main(["check", str(answers), "--output", str(output), "--lang", table.language, *more]) == 0
    return output.read_bytes()


def by_page(tables: Sequence[ClassTable], address: str, root: Path) -> Iterator[bytes]:
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
        yield base64.b64decode(answer["saved"])
