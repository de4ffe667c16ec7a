"""Homework: answers that are to be checked or read."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from .assignment import FOLLOW_THROUGH, SIMPLIFIED, VARY, Aspect, AssignmentDocument
from .base import AskedLanguage, Request, SceneWithChanges, Syntax, examples, items
from .document import SceneReference
from .task import TASK, SceneAskedAbout, TaskId

ANSWER = Field(description="what was written")


class WrittenAnswer(Request):
    """What stands in a table, however long: the reader says what is too long for it."""

    syntax: Syntax = "plain"
    value: str


class WrittenLine(Request):
    """A task that the scene has, and what was answered."""

    task: str
    answer: WrittenAnswer


class RowQuestion(SceneWithChanges):
    """A row of a table, as a worker is asked about it: `standing` are the wrong lines that it may follow from."""

    seed: str | None = None
    vary: tuple[Aspect, ...] = VARY
    task: str
    answer: WrittenAnswer
    standing: Annotated[tuple[WrittenLine, ...], items()] = ()
    lang: AskedLanguage = None


class AnswerText(WrittenAnswer):
    """What a student wrote."""

    value: Annotated[str, Field(max_length=2000)] = Field(
        description="the answer", examples=["m*l^2*ddot(phi) + m*g*l*sin(phi) = 0"]
    )


class AnsweredTask(WrittenLine):
    """A line of a working: a task and what was answered."""

    task: TaskId = TASK
    answer: AnswerText = ANSWER


Lines = Annotated[tuple[AnsweredTask, ...], items(max_length=24)]


class SingleCheck(SceneAskedAbout):
    """One answer to one task, in the light of the lines before it."""

    task: TaskId = TASK
    answer: AnswerText = ANSWER
    previous: Lines = Field((), description="the student's own earlier lines: what follows from a wrong one is told")


class ReadingRequest(SceneAskedAbout):
    """An answer to be read, not checked."""

    task: TaskId = TASK
    answer: AnswerText = ANSWER
    lang: AskedLanguage = None

    model_config = examples({"scene": "pendulum", "task": "equation:phi", "answer": {"value": "l*ddot(phi) = -g*phi"}})


class PointScheme(Request):
    """How points are given."""

    points: dict[TaskId, Annotated[float, Field(ge=0, le=1000)]] = Field({}, max_length=64, description="by task id")
    follow_through: float = Field(FOLLOW_THROUGH, ge=0, le=1, description="share of the points for a right consequence")
    simplified: float = Field(SIMPLIFIED, ge=0, le=1, description="share of those where the mistake made it easier")


class LinesRequest(SceneAskedAbout):
    """A whole working."""

    lines: Annotated[tuple[AnsweredTask, ...], items(min_length=1, max_length=24)] = Field(
        description="tasks and answers, one after the other"
    )
    scheme: PointScheme = Field(PointScheme(), description="how points are given")
    lang: AskedLanguage = None

    model_config = examples(
        {
            "scene": "pendulum",
            "lines": [
                {"task": "kinetic-energy", "answer": {"value": "m*l^2*dot(phi)^2"}},
                {"task": "equation:phi", "answer": {"value": "2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0"}},
            ],
        }
    )


class CheckRequest(SingleCheck):
    """One answer to one task, and the language of the feedback."""

    lang: AskedLanguage = None

    model_config = examples(
        {"scene": "pendulum", "task": "equation:phi", "answer": {"value": "ddot(phi) = -g/l*sin(phi)"}},
        {"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": "m*l^2*dot(phi)^2"}},
        {
            "scene": "elastic-pendulum",
            "task": "virtual-displacement:bob",
            "answer": {
                "syntax": "latex",
                "value": "\\begin{bmatrix} \\ell\\cos q_2\\,\\delta q_2 \\\\ "
                "\\delta q_1 - \\ell\\sin q_2\\,\\delta q_2\\end{bmatrix}",
            },
        },
    )


class BatchRequest(Request):
    """Several answers at once."""

    checks: Annotated[tuple[SingleCheck, ...], items(min_length=1, max_length=64)] = Field(
        description="one after the other, of the same or of different scenes"
    )
    lang: AskedLanguage = None

    model_config = examples(
        {
            "checks": [
                {"scene": "pendulum", "task": "equation:phi", "answer": {"value": "ddot(phi) = -g/l*sin(phi)"}},
                {"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": "m*l^2*dot(phi)^2"}},
            ]
        }
    )


TablePiece = Annotated[str, Field(max_length=10_000)]


class TableRequest(Request):
    """The answers of a class."""

    table: Annotated[tuple[TablePiece, ...], items(min_length=1, max_length=1000)] = Field(
        description="CSV with the columns task and answer, and student, id, scene, syntax, seed, line, time (ISO 8601) "
        "and file where wanted; between the cells commas, semicolons or tabs. Pieces of any kind, such as its lines, "
        "that are put together. In base64 also a zip of the files that students hand in",
        examples=[["student,scene,task,answer\n", "ada,pendulum,kinetic-energy,m*l^2*dot(phi)^2/2\n"]],
    )
    encoding: Literal["text", "base64"] = Field(
        "text", description="base64: the bytes of a file as a spreadsheet wrote it, in UTF-8, UTF-16 or Windows-1252"
    )
    assignment: AssignmentDocument | None = Field(None, description="whose tasks are answered, by number or by id")
    scene: SceneReference | None = Field(None, description="of the rows that name none, where there is no assignment")
    lang: AskedLanguage = None

    model_config = examples(
        {
            "table": [
                "student,scene,task,answer,line\n",
                "ada,pendulum,kinetic-energy,m*l^2*dot(phi)^2,1\n",
                "ada,pendulum,equation:phi,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,2\n",
            ]
        },
        {
            "table": ["student;task;answer\n", "ada;1;ddot(phi) = -g/l*sin(phi)\n"],
            "assignment": {"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:phi", "points": 4}]},
        },
    )
