"""Assignments as they are read, and everything that is wrong with one at once, each told at its place."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from deltaq.contract.assignment import AssignedTaskDocument, AssignmentDocument
from deltaq.contract.base import GuideChange
from deltaq.errors import InputError
from deltaq.homework.assignment import load_assignment, read_assignment, resolved

TASK = {"scene": "pendulum", "task": "lagrangian"}
GUIDED = {
    "scene": "base-pendulum",
    "freeze": [],
    "guides": [{"coordinate": "y", "value": "0.1*sin(3*t)"}],
    "parameters": {"m": 2.0},
    "task": "equation:phi",
    "points": 0,
}
FULL = {
    "format": 1,
    "title": {"de": "Blatt", "en": "Sheet"},
    "individual": True,
    "follow_through": 1,
    "tasks": [{**TASK, "points": 2.5}, GUIDED],
}
READ = AssignmentDocument(
    format=1,
    title={"de": "Blatt", "en": "Sheet"},
    individual=True,
    follow_through=1.0,
    tasks=(
        AssignedTaskDocument(scene="pendulum", task="lagrangian", points=2.5),
        AssignedTaskDocument(
            scene="base-pendulum",
            guides=(GuideChange(coordinate="y", value="0.1*sin(3*t)"),),
            parameters={"m": 2.0},
            task="equation:phi",
            points=0.0,
        ),
    ),
)
Told = list[tuple[str, str, dict[str, Any]]]


def sheet(**more: object) -> dict[str, object]:
    return {"format": 1, "tasks": [TASK], **more}


def tasks(*entries: object) -> dict[str, object]:
    return sheet(tasks=list(entries))


def told(document: object) -> Told:
    with pytest.raises(InputError) as found:
        read_assignment(document)
    return [(problem.pointer, problem.code, dict(problem.parameters)) for problem in found.value.problems]


def field(pointer: str, code: str, name: str) -> tuple[str, str, dict[str, Any]]:
    return pointer, code, {"field": name}


def test_an_assignment_with_everything() -> None:
    assert read_assignment(FULL) == READ


def test_an_assignment_with_nothing_but_a_task() -> None:
    usual = read_assignment(sheet())
    assert (usual.title, usual.individual, usual.follow_through) == ({}, False, 0.5)
    assert usual.tasks == (AssignedTaskDocument(scene="pendulum", task="lagrangian"),)
    nothing = dict.fromkeys(("title", "individual", "follow_through"))
    assert read_assignment(sheet(title="Blatt")).title == {"en": "Blatt", "de": "Blatt"}
    assert read_assignment(sheet(title="")) == read_assignment(sheet(**nothing)) == usual
    unchanged = dict.fromkeys(("points", "guides", "freeze", "parameters"))
    assert read_assignment(tasks(TASK | unchanged)) == usual
    assert read_assignment(sheet(follow_through=0)).follow_through == 0.0


@pytest.mark.parametrize(
    ("name", "content"),
    [
        pytest.param("sheet.json", json.dumps(FULL).encode(), id="JSON"),
        pytest.param("sheet.json", json.dumps(FULL).encode("utf-8-sig"), id="JSON with a mark"),
        pytest.param(
            "sheet.toml",
            b"""format = 1
title = { de = "Blatt", en = "Sheet" }
individual = true
follow_through = 1
[[tasks]]
scene = "pendulum"
task = "lagrangian"
points = 2.5
[[tasks]]
scene = "base-pendulum"
freeze = []
guides = [{ coordinate = "y", value = "0.1*sin(3*t)" }]
parameters = { m = 2.0 }
task = "equation:phi"
points = 0
""",
            id="TOML",
        ),
    ],
)
def test_an_assignment_of_a_file(tmp_path: Path, name: str, content: bytes) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    assert load_assignment(path) == READ


@pytest.mark.parametrize(
    ("name", "content", "detail"),
    [
        pytest.param("sheet.json", "{", "Expecting property name", id="JSON"),
        pytest.param("sheet.toml", "tasks = [", "Invalid value", id="TOML"),
        pytest.param("sheet.toml", f"a = 1\na = {'1' * 300}", "Cannot overwrite a value", id="twice"),
        pytest.param("sheet.toml", '# "Blätter"', "'utf-8' codec can't decode byte 0xe4", id="another encoding"),
    ],
)
def test_a_file_that_cannot_be_read_says_where(tmp_path: Path, name: str, content: str, detail: str) -> None:
    path = tmp_path / name
    path.write_bytes(content.encode("cp1252"))
    with pytest.raises(InputError) as found:
        load_assignment(path)
    (problem,) = found.value.problems
    assert (problem.code, problem.pointer) == ("assignment-syntax", "")
    assert str(problem.parameters["detail"]).startswith(detail)


@pytest.mark.parametrize(
    ("document", "problems"),
    [
        pytest.param("x", [("", "request-not-object", {})], id="a text"),
        pytest.param(sheet(format=2), [("/format", "assignment-format", {"format": 1})], id="another format"),
        pytest.param({"tasks": [TASK]}, [("/format", "assignment-format", {"format": 1})], id="no format"),
        pytest.param(
            sheet(zeta=1, alpha=1),
            [field("/alpha", "unknown-field", "alpha"), field("/zeta", "unknown-field", "zeta")],
            id="unknown fields by name",
        ),
        pytest.param(
            sheet(title={"en": 1, "de": 2}),
            [("/title/en", "request-not-text", {}), ("/title/de", "request-not-text", {})],
            id="titles that are no text",
        ),
        pytest.param(sheet(title=3), [("/title", "request-not-text", {})], id="a title that is no text"),
        pytest.param(sheet(**{"x" * 60: 1}), [field(f"/{'x' * 60}", "unknown-field", "x" * 60)], id="an endless name"),
        pytest.param(
            tasks(TASK | {"x" * 60: 1}),
            [field(f"/tasks/0/{'x' * 60}", "unknown-field", "x" * 60)],
            id="an endless name in a task",
        ),
        pytest.param(sheet(title={"en": "x", "a/b": 2}), [("/title/a~1b", "request-not-text", {})], id="an odd name"),
        pytest.param(sheet(individual=1), [("/individual", "request-not-boolean", {})], id="1 is no truth"),
        *(
            pytest.param(
                sheet(follow_through=share), [("/follow_through", "assignment-share", {})], id=f"share {share}"
            )
            for share in (-0.01, 1.01, True, "1")
        ),
        *(
            pytest.param(sheet(tasks=none), [("/tasks", "assignment-no-task", {})], id=f"tasks {none}")
            for none in ([], {"a": 1}, "x", None)
        ),
        pytest.param(tasks(*[TASK] * 65), [("/tasks", "request-too-many", {"max_length": 64})], id="a task too many"),
        pytest.param(
            tasks(3, {}, TASK | {"z": 1, "a/b": 1}),
            [
                ("/tasks/0", "request-not-object", {}),
                field("/tasks/1/scene", "missing-field", "scene"),
                field("/tasks/1/task", "missing-field", "task"),
                field("/tasks/2/a~1b", "unknown-field", "a/b"),
                field("/tasks/2/z", "unknown-field", "z"),
            ],
            id="tasks that are none",
        ),
        *(
            pytest.param(tasks(TASK | {name: wrong}), [(f"/tasks/0/{name}{below}", code, {})], id=f"{name} {wrong}")
            for name, wrong, below, code in (
                ("task", 5, "", "request-not-text"),
                ("scene", 5, "", "request-scene-type"),
                ("guides", 5, "", "request-not-array"),
                ("guides", [5], "/0", "request-not-object"),
                ("guides", [{"coordinate": "phi", "value": 5}], "/0/value", "request-not-text"),
                ("freeze", "phi", "", "request-not-array"),
                ("parameters", [], "", "request-not-object"),
                ("parameters", {"l": "x"}, "/l", "request-not-number"),
                ("parameters", {"l": math.inf}, "/l", "request-not-finite"),
            )
        ),
        *(
            pytest.param(
                tasks(TASK, TASK | {"points": points}),
                [("/tasks/1/points", "request-not-number", {})],
                id=f"points {points}"[:20],
            )
            for points in (-0.01, 1000.01, True, "1", math.nan, 10**400)
        ),
    ],
)
def test_what_is_wrong_is_told_at_its_place(document: object, problems: Told) -> None:
    assert told(document) == problems


def test_an_endless_reason_is_told_by_its_beginning(tmp_path: Path) -> None:
    path = tmp_path / "sheet.toml"
    path.write_text(f"[{'x' * 300}]\n" * 2, encoding="utf-8")
    with pytest.raises(InputError) as found:
        load_assignment(path)
    told = str(found.value.problems[0].parameters["detail"])
    assert (told[:16], len(told)) == ("Cannot declare (", 200)


def test_the_most_that_there_may_be() -> None:
    assert len(read_assignment(tasks(*[TASK] * 64)).tasks) == 64
    assert read_assignment(tasks(TASK | {"points": 1000})).tasks[0].points == 1000.0


@pytest.mark.parametrize(
    ("entry", "pointer", "code"),
    [
        pytest.param({"task": "none"}, "/tasks/1/task", "unknown-task", id="task"),
        pytest.param({"scene": "none"}, "/tasks/1/scene", "unknown-scene", id="scene"),
        pytest.param({"parameters": {"m": -1.0}}, "/tasks/1/parameters/m", "not-positive", id="parameter"),
    ],
)
def test_what_a_scene_does_not_have_is_told_at_its_task(entry: dict[str, object], pointer: str, code: str) -> None:
    ((where, what, _),) = told(tasks(TASK, TASK | entry))
    assert (where, what) == (pointer, code)


def test_values_belong_to_a_seed() -> None:
    (assigned,) = read_assignment(sheet()).tasks
    values = [{p.name: p.value for p in resolved(assigned, seed)[0].scene.parameters} for seed in (None, "ada", "bob")]
    assert values[0] == {"m": 1.0, "l": 1.0, "g": 9.81}
    assert values[1] not in (values[0], values[2])
