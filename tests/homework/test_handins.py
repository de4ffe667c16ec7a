"""What a class hands in: many files as one table, what cannot be taken named, late and repeated answers by the rule."""

from __future__ import annotations

import csv
import io
import json
import random
import zipfile
from collections.abc import Mapping
from typing import Any

import pytest

from deltaq.errors import InputError
from deltaq.homework.assignment import read_assignment
from deltaq.homework.gradebook import Gradebook, Plan, refusal
from deltaq.homework.grading import Sheet, plan_of, read_answers, read_class
from deltaq.homework.handins import LARGEST, archived, code_of
from deltaq.homework.platforms import canvas_csv, moodle_csv
from deltaq.homework.results import Graded, totals

SHEET = {
    "format": 1,
    "title": "Sheet (3)",
    "deadline": "2026-11-30T23:59+01:00",
    "late": 0.5,
    "attempts": 2,
    "tasks": [
        {"scene": "pendulum", "task": "kinetic-energy", "points": 4},
        {"scene": "pendulum", "task": "equation:phi", "points": 6},
    ],
}
CODE = code_of(read_assignment(SHEET))
IN_TIME, LATER, LATE = "2026-11-30T22:00Z", "2026-11-30T22:30Z", "2026-11-30T23:00:01Z"


def handin(student: str = "ada", time: str = IN_TIME, **more: Any) -> dict[str, Any]:
    answers = [{"task": 1, "syntax": "plain", "value": "T"}]
    found = {"format": "deltaq-handin-1", "sheet": CODE, "student": student, "time": time, "answers": answers}
    return found | more


def archive(files: Mapping[str, object]) -> bytes:
    """A zip of the files; what is no text yet is JSON."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as zipped:
        for name, content in files.items():
            zipped.writestr(name, content if isinstance(content, str | bytes) else json.dumps(content))
    return out.getvalue()


def plan(files: Mapping[str, object], **sheet: object) -> Plan:
    asked = Sheet(read_assignment(SHEET | sheet))
    found = read_class(archive(files), asked, "en")
    return plan_of(found.table, asked, "en", found.refused)


HOSTILE: dict[str, tuple[object, str]] = {
    "no name.json": (handin("  "), "no name"),
    "other sheet.json": (handin(sheet="AAAA-BBBB"), "another assignment"),
    "broken.json": ('{"format": "deltaq-handin-1", ', "no JSON"),
    "deep.json": ("[" * 50_000, "no JSON"),
    "megabyte.json": ("x" * 1_000_000, "larger than anything"),
    "picture.png": (b"\x89PNG\r\n\x1a\n\x00", "no JSON"),
    "rows.json": (handin(answers=[{"task": 1, "value": "T"}] * 1000), "answers"),
    "work.json": ({"format": "deltaq-homework-1", "records": {}}, "“Hand in”"),
    "list.json": ([1, 2], "“Hand in”"),
    "script.json": (handin(answers="<script>alert(1)</script>"), "answers"),
    "number.json": (handin(answers=[{"task": "1", "value": 3}]), "answers/0"),
    "beyond.json": (handin(answers=[{"task": 3, "value": "T"}]), "a task 3"),
    "empty.json": (handin(answers=[]), "no answer"),
    "no time.json": (handin(time="yesterday"), "“yesterday” is no time"),
    "often.json": (handin(answers=[{"task": 1, "value": "T"}] * 3), "answers"),
    "endless name.json": (handin("x" * 101), "student"),
    "twice.json": (handin("ada"), "the same as “right.json”"),
}


def test_what_cannot_be_taken_is_named_and_takes_nothing_along() -> None:
    found = plan(
        {"right.json": handin("ada"), **{name: content for name, (content, _) in HOSTILE.items()}, "z": handin("zoe")}
    )
    assert [(row.student, row.file) for row in found.rows] == [("ada", "right.json"), ("zoe", "z")]
    told = {one.file: one.why for one in found.refused}
    assert told.keys() == HOSTILE.keys()
    assert [name for name, (_, why) in HOSTILE.items() if why not in told[name]] == []


@pytest.mark.parametrize("seed", range(20))
def test_whatever_is_in_a_file_the_others_are_read(seed: int) -> None:
    """Bytes flipped, cut and drawn: each file is taken or named, never both, and never lost."""
    source = random.Random(seed)
    files: dict[str, object] = {}
    for number in range(30):
        content = bytearray(json.dumps(handin(f"student {number}")).encode())
        for _ in range(source.choice([0, 0, 1, 5])):
            content[source.randrange(len(content))] = source.randrange(256)
        files[f"{number}.json"] = bytes(content[: source.choice([len(content), len(content), source.randrange(99)])])
    found = plan(files)
    taken, refused = {row.file for row in found.rows}, {one.file for one in found.refused}
    assert taken | refused == set(files)
    assert not taken & refused


@pytest.mark.parametrize(
    ("data", "code"),
    [
        pytest.param(archive({"a.json": handin()})[:-30], "handins-archive", id="cut off"),
        pytest.param(b"PK\x03\x04" + b"?" * 50, "handins-archive", id="nothing in it"),
        pytest.param(archive({f"{n}": "" for n in range(4001)}), "handins-many", id="too many files"),
    ],
)
def test_an_archive_that_cannot_be_read(data: bytes, code: str) -> None:
    with pytest.raises(InputError) as caught:
        read_class(data, Sheet(read_assignment(SHEET)), "en")
    assert [one.code for one in caught.value.problems] == [code]


def test_an_archive_that_blows_up_is_read_no_further_than_a_file_may_be_long() -> None:
    bomb = archive({"bomb.json": b" " * 20_000_000})
    ((_, content),) = archived(bomb)
    assert len(content) == LARGEST + 1
    (refused,) = read_class(bomb, Sheet(read_assignment(SHEET)), "en").refused
    assert str(LARGEST // 1024) in refused.why


def test_answers_that_are_handed_in_need_their_assignment() -> None:
    with pytest.raises(InputError) as caught:
        read_class(archive({"a": handin()}), Sheet(), "en")
    assert [one.code for one in caught.value.problems] == ["handins-assignment"]


def test_the_code_names_the_tasks_and_nothing_else() -> None:
    same = {**SHEET, "title": "other", "attempts": None, "deadline": None, "late": 0.1}
    points = {**SHEET, "tasks": [{**one, "points": 1} for one in SHEET["tasks"]]}
    assert {code_of(read_assignment(one)) for one in (same, points)} == {CODE}
    others = [
        {**SHEET, "tasks": SHEET["tasks"][::-1]},
        {**SHEET, "tasks": SHEET["tasks"][:1]},
        {**SHEET, "individual": True},
        {**SHEET, "tasks": [SHEET["tasks"][0], {**SHEET["tasks"][1], "parameters": {"l": 2.0}}]},
    ]
    assert len({CODE, *(code_of(read_assignment(one)) for one in others)}) == 5


def answered(*values: str, task: int = 1) -> list[dict[str, Any]]:
    return [{"task": task, "value": value} for value in values]


def marked(found: Plan, outcomes: Mapping[str, str]) -> list[Graded]:
    """The rows when the judge says this of each answer."""
    book = Gradebook(found)
    told = {
        index: book.enter(found.rows[index], refusal("", outcomes[found.rows[index].answer])) for index in found.order
    }
    return [told[index] for index in range(len(found.rows))]


JUDGE = {"T": "wrong", "U": "correct", "W": "wrong"}


def test_the_best_counts_and_late_answers_count_in_part() -> None:
    files = {
        "3": handin(time=LATE, answers=answered("U")),
        "1": handin(time=IN_TIME, answers=answered("T")),
    }
    late, early = marked(plan(files), JUDGE)
    assert (early.attempt, early.late, early.points) == (1, False, 0.0)
    assert (late.attempt, late.late, late.counts, late.points, late.worth) == (2, True, 0.5, 2.0, 2.0)
    (student,) = totals([late, early], 10.0, "en")["students"]
    assert (student["points"], student["late"]) == (2.0, 1)
    assert student["answers"][0] | {"last": "correct", "last_points": 2.0, "attempts": 2} == student["answers"][0]


def test_attempts_are_counted_in_the_order_of_time_and_those_beyond_earn_nothing() -> None:
    times = [LATER, IN_TIME, "2026-11-30T22:45Z"]
    files = {value: handin(time=time, answers=answered(value)) for value, time in zip("UTW", times, strict=True)}
    found = marked(plan(files | {"x": handin(time="2026-11-30T22:50Z", answers=answered("U"))}), JUDGE)
    assert [(one.answer, one.attempt, one.counts) for one in found] == [
        ("U", 2, 1.0),
        ("T", 1, 1.0),
        ("W", 3, 0.0),
        ("U", 4, 0.0),
    ]
    (student,) = totals(found, 10.0, "en")["students"]
    assert (student["points"], student["beyond"]) == (4.0, 2)


def test_the_best_outcome_is_one_that_counts() -> None:
    files = {value: handin(time=time, answers=answered(value)) for value, time in (("T", IN_TIME), ("U", LATER))}
    (student,) = totals(marked(plan(files, attempts=1), JUDGE), 10.0, "en")["students"]
    answer = student["answers"][0]
    assert (answer["outcome"], answer["points"], answer["last"], answer["last_points"]) == (
        "wrong",
        0.0,
        "correct",
        0.0,
    )


def test_who_hands_in_the_same_again_has_made_no_further_attempt() -> None:
    files = {time: handin(time=time, answers=answered("T")) for time in (IN_TIME, LATER, "2026-11-30T22:45Z")}
    assert [row.attempt for row in plan(files, attempts=1).rows] == [1, 1, 1]


def test_a_working_is_what_was_handed_in_together() -> None:
    """What follows from a wrong line follows from one in the same file, not from one that was handed in before."""
    both = [*answered("T"), *answered("U", task=2)]
    found = plan({"a": handin(answers=both), "b": handin(time=LATER, answers=answered("U", task=2))})
    book = Gradebook(found)
    standing = {}
    for index in found.order:
        row = found.rows[index]
        question = book.question(row)
        standing[row.file, row.task] = [] if question is None else [one.task for one in question.standing]
        book.enter(row, refusal("", JUDGE[row.answer]))
    assert standing == {("a", "1"): [], ("a", "2"): ["kinetic-energy"], ("b", "2"): []}


def test_persons_are_told_apart_by_their_number_where_they_give_one() -> None:
    files = {
        "a": handin("Max Müller", id="1"),
        "b": handin("Max Müller", id="2"),
        "c": handin("M. Müller", id="1", time=LATER),
    }
    found = totals(marked(plan(files), JUDGE), 10.0, "en")
    assert [(one["student"], one["id"]) for one in found["students"]] == [("Max Müller", "1"), ("Max Müller", "2")]


@pytest.mark.parametrize(("individual", "seed"), [(True, "Ada  L."), (False, None)])
def test_values_of_ones_own_are_those_of_the_name_as_it_was_typed(individual: bool, seed: str | None) -> None:
    sheet = SHEET | {"individual": individual}
    found = handin(" Ada  L. ", sheet=code_of(read_assignment(sheet)))
    (row,) = plan({"a": found}, individual=individual).rows
    assert (row.student, row.seed) == ("Ada L.", seed)


def test_a_table_tells_times_too() -> None:
    sheet = Sheet(read_assignment(SHEET))
    table = f"student,task,answer,time\nada,1,T,{LATE}\nada,1,U,soon\nada,2,U,\n"
    rows = plan_of(read_answers(table.encode()), sheet, "en").rows
    assert [(row.late, row.column, row.attempt) for row in rows] == [(True, "", 1), (False, "time", 0), (False, "", 1)]


@pytest.mark.parametrize(
    ("field", "value", "code"),
    [
        ("deadline", "soon", "assignment-time"),
        ("deadline", 5, "assignment-time"),
        ("attempts", 0, "assignment-attempts"),
        ("attempts", 1.5, "assignment-attempts"),
        ("late", 2, "assignment-share"),
    ],
)
def test_a_rule_that_makes_no_sense(field: str, value: object, code: str) -> None:
    with pytest.raises(InputError) as caught:
        read_assignment({**SHEET, field: value})
    assert [(one.pointer, one.code) for one in caught.value.problems] == [(f"/{field}", code)]


NAMES = ['Müller, "Zoë"', "=cmd|' /C calc'!A0", "@ada", "x\ny", "李 雷"]


def class_totals() -> Mapping[str, Any]:
    files = {
        str(n): handin(name, id=f"{n}@uni.example" if n % 2 else f"0{n}", answers=answered("U"))
        for n, name in enumerate(NAMES)
    }
    return totals(marked(plan(files), JUDGE), 10.0, "en")


def cells(data: bytes) -> list[list[str]]:
    return list(csv.reader(io.StringIO(data.decode("utf-8"))))


def test_moodle_finds_everybody_and_their_points() -> None:
    """The columns of its own export; a point in the numbers; no cell that a spreadsheet carries out."""
    header, *rows = cells(moodle_csv(class_totals(), "Sheet (3)", "en"))
    assert header == ["Full name", "ID number", "Email address", "Sheet (3)", "Sheet (3): feedback"]
    assert [row[0] for row in rows] == ['Müller, "Zoë"', "'=cmd|' /C calc'!A0", "'@ada", "x y", "李 雷"]
    assert [row[1:4] for row in rows[:2]] == [["00", "", "4"], ["", "1@uni.example", "4"]]
    assert rows[0][4] == "Kinetic energy: 4 of 4"


def test_canvas_finds_everybody_and_what_could_be_earned() -> None:
    """As its importer reads it: the fixed columns, then titles; a number in brackets would be an id."""
    header, possible, *rows = cells(canvas_csv(class_totals(), 10.0, "Sheet (3)"))
    assert header == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Sheet 3"]
    assert possible == ["    Points Possible", "", "", "", "", "10"]
    assert [len(row) for row in rows] == [6] * len(NAMES)
    assert rows[1] == ["'=cmd|' /C calc'!A0", "", "1@uni.example", "1@uni.example", "", "4"]
