"""Tables of answers as classes hand them in, drawn by a seed: what is right, wrong, corrected, what follows, and what
makes no sense; names that a spreadsheet takes for formulas; in all the ways in which a table may be written.
"""

from __future__ import annotations

import csv
import io
import json
import random
import zipfile
from dataclasses import dataclass, field
from typing import Any

from deltaq.homework.assignment import read_assignment
from deltaq.homework.handins import code_of

# Workings of the pendulum: right, with a T that is twice too large, with a V of the wrong sign, and what follows.
RIGHT = {
    "kinetic-energy": "m*l^2*dot(phi)^2/2",
    "potential-energy": "-m*g*l*cos(phi)",
    "lagrangian": "m*l^2*dot(phi)^2/2 + m*g*l*cos(phi)",
    "equation:phi": "m*l^2*ddot(phi) + m*g*l*sin(phi) = 0",
}
DOUBLE_T = {
    "kinetic-energy": "m*l^2*dot(phi)^2",
    "lagrangian": "m*l^2*dot(phi)^2 + m*g*l*cos(phi)",
    "equation:phi": "2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0",
}
WRONG_V = {
    "potential-energy": "m*g*l*cos(phi)",
    "lagrangian": "m*l^2*dot(phi)^2/2 - m*g*l*cos(phi)",
    "equation:phi": "l*ddot(phi) - g*sin(phi) = 0",
}
LATEX = {
    "kinetic-energy": r"\frac{1}{2}m\ell^2\dot\varphi^2",
    "potential-energy": r"-m g \ell\cos\varphi",
    "lagrangian": r"\frac12 m\ell^2\dot\varphi^2 + m g\ell\cos\varphi",
    "equation:phi": r"\ddot\varphi = -\frac{g}{\ell}\sin\varphi",
}
LONG = "x" * 300
ODD = ["", " ", "0 = 0", "foo", "m*l^2*(", '9,81 "m"', "=1+1", "+m\n-m", "dot(phi)", "l*ddot(phi) + g*phi = 0", LONG]
FORMULAS = ["=SUM(A1:A9)", "+49 170", "@max", "-1"]
NAMES = ["ada", "Zoë", "Zoe\u0308", *FORMULAS, "Łukasz; Ö.", "李 雷", "😀", 'O"Hara', "\tx", ""]
TASKS = tuple(RIGHT)
POINTS = {"kinetic-energy": 2, "potential-energy": 1.5, "lagrangian": 3, "equation:phi": 4}
SHEET: dict[str, Any] = {
    "format": 1,
    "follow_through": 0.3,
    "tasks": [{"scene": "pendulum", "task": task, "points": points} for task, points in POINTS.items()],
}
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "cp1252")
COLUMNS = ("student", "scene", "task", "answer", "syntax", "seed", "line")


@dataclass(frozen=True)
class ClassTable:
    """The bytes of a table, and what it is marked with: an assignment, the scene around, a language."""

    seed: int
    data: bytes
    assignment: dict[str, Any] | None
    scene: str
    language: str
    rows: list[dict[str, str]] = field(default_factory=list, repr=False)


def class_table(seed: int, students: int = 4) -> ClassTable:
    """The table of this seed."""
    source = random.Random(seed)
    assignment = {**SHEET, "individual": source.random() < 0.5} if source.random() < 0.5 else None
    columns = [name for name in COLUMNS if name in ("task", "answer") or source.random() < 0.8]
    people = source.sample(NAMES, students)
    rows = [row for name in people for row in _working(source, name, numbered=assignment is not None)]
    if source.random() < 0.5:
        source.shuffle(rows)
    data = _written(source, columns, rows)
    scene = "pendulum" if assignment is None and "scene" not in columns else ""
    return ClassTable(seed, data, assignment, scene, source.choice(("en", "de")), rows)


def class_archive(seed: int, students: int = 3) -> ClassTable:
    """What a class hands in on an assignment with all the rules, as a zip: some twice, some late, some of it broken."""
    source = random.Random(seed)
    rules = {"deadline": "2026-11-30T12:00Z", "late": 0.5, "attempts": source.choice([1, 2])}
    sheet = {**SHEET, "title": "Blatt (3)", **rules}
    code, out = code_of(read_assignment(sheet)), io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, name in enumerate(source.sample(NAMES, students) * 2):
            found = {
                "format": "deltaq-handin-1",
                "sheet": source.choice([code] * 9 + ["AAAA-AAAA"]),
                "student": name,
                "id": source.choice(["", f"id{number}"]),
                "time": f"2026-11-{source.choice((29, 30))}T{source.choice((11, 13))}:{number:02}Z",
                "answers": [_handed(source, task) for task in TASKS if source.random() < 0.8],
            }
            text = json.dumps(found, ensure_ascii=source.random() < 0.5)
            archive.writestr(f"{name or 'none'}/{number}.json", text[: source.choice([None] * 9 + [40])])
    return ClassTable(seed, out.getvalue(), sheet, "", source.choice(("en", "de")))


def _handed(source: random.Random, task: str) -> dict[str, Any]:
    value, syntax = _answer(source, task)
    known = syntax if syntax in ("plain", "latex") else "plain"
    return {"task": TASKS.index(task) + 1, "syntax": known, "value": value}


def _working(source: random.Random, student: str, *, numbered: bool) -> list[dict[str, str]]:
    """What a student hands in: lines of some ways of going on, some twice, some corrected, some odd."""
    rows = []
    for number in range(1, source.randint(2, 9)):
        task = source.choice(TASKS)
        answer, syntax = _answer(source, task)
        named = str(TASKS.index(task) + 1) if numbered and source.random() < 0.5 else task
        row = {
            "student": student + source.choice(["", "", "", " "]),
            "scene": source.choice(["pendulum"] * 20 + ["", "swing"]),
            "task": source.choice([named] * 20 + ["equation:psi", "9", ""]),
            "answer": answer,
            "syntax": syntax,
            "seed": source.choice([""] * 9 + ["7"]),
            "line": source.choice([str(number)] * 12 + [f"{number}.5", "", "", "2", "first", "nan"]),
        }
        rows += [row] * source.choice([1, 1, 1, 1, 1, 2])
    return rows


def _answer(source: random.Random, task: str) -> tuple[str, str]:
    kind = source.random()
    if kind < 0.15:
        return source.choice(ODD), source.choice(["", "plain", "latex"])
    if kind < 0.3:
        return LATEX[task], source.choice(["latex", "LaTeX ", "latex", "word"])
    return source.choice([RIGHT, RIGHT, DOUBLE_T, DOUBLE_T, WRONG_V]).get(task, RIGHT[task]), source.choice(
        ["", "plain"]
    )


def _written(source: random.Random, columns: list[str], rows: list[dict[str, str]]) -> bytes:
    """The table as some program writes it."""
    separator, ending = source.choice(",;\t"), source.choice(["\n", "\r\n"])
    out = io.StringIO()
    writer = csv.writer(out, delimiter=separator, lineterminator=ending)
    writer.writerow([name.capitalize() if source.random() < 0.2 else name for name in columns])
    for row in rows:
        cells = [row[name] for name in columns]
        writer.writerow([*cells, "beyond"] if source.random() < 0.03 else cells)
        if source.random() < 0.05:
            out.write(separator * 3 + ending)
    told = f"sep={separator}{ending}" if source.random() < 0.2 else ""
    return (told + out.getvalue()).encode(source.choice(ENCODINGS), errors="replace")


def sheet_file(table: ClassTable) -> str:
    """The assignment as a file's text."""
    return json.dumps(table.assignment)
