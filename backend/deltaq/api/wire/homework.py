"""Homework: tasks, answers and verdicts."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from ..languages import Language
from .base import Answer, Guides, Names, Request, SceneReference, Values, examples

Seed = Annotated[str, Field(max_length=64, description="draws each student's own parameter values")]
TaskId = Annotated[str, Field(min_length=1, max_length=80, examples=["equation:phi"])]


class SceneWithChanges(Request):
    """A scene, and what is changed before it is asked about."""

    scene: SceneReference
    guides: Guides = ()
    freeze: Names = ()
    parameters: Values = Field({}, description="values of parameters", examples=[{"l": 0.8}])
    seed: Seed | None = None


class TasksRequest(SceneWithChanges):
    """Which tasks a scene has."""

    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples({"scene": "pendulum", "parameters": {"l": 0.8}})


class StackRequest(SceneWithChanges):
    """Which tasks to export."""

    tasks: Annotated[tuple[TaskId, ...], Field(strict=False, max_length=32, description="all if empty")] = ()
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples({"scene": "pendulum", "tasks": ["equation:phi"]})


class TaskSymbol(Answer):
    """A symbol that answers may hold."""

    name: str
    latex: str
    kind: str
    unit: str
    value: float | None


class TaskEntry(Answer):
    """One task: what to answer, in which form, with hints in three levels."""

    id: str = Field(examples=["equation:phi"])
    kind: str
    subject: str
    title: str
    statement: str
    form: Literal["expression", "vector", "equation", "equations", "set"]
    form_text: str
    components: int | None = Field(description="of a vector")
    points: float
    needs: tuple[str, ...] = Field(description="the tasks whose answers this one is derived from")
    hints: tuple[str, ...]
    solution: dict[str, Any] = Field(description="the chapter of the derivation that answers it")


class TaskList(Answer):
    """The tasks of a scene, its document with the values asked about, and the symbols for a keyboard."""

    scene: dict[str, Any]
    symbols: tuple[TaskSymbol, ...]
    tasks: tuple[TaskEntry, ...]


class AssignmentRequest(Request):
    """An assignment, and the student who opens it."""

    assignment: dict[str, Any] = Field(
        description="format 1: title, individual, follow_through, tasks with scene, task and points",
        examples=[{"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:phi", "points": 3}]}],
    )
    seed: Seed | None = None
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples(
        {"assignment": {"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:phi", "points": 3}]}}
    )


class AssignedTaskEntry(Answer):
    """One task of an assignment, with its scene in the student's values."""

    scene: dict[str, Any]
    symbols: tuple[TaskSymbol, ...]
    task: TaskEntry


class AssignmentAnswer(Answer):
    """An assignment, opened."""

    title: dict[str, str]
    follow_through: float
    tasks: tuple[AssignedTaskEntry, ...]


class AnswerText(Request):
    """What a student wrote."""

    syntax: Literal["plain", "latex"] = "plain"
    value: Annotated[str, Field(max_length=2000)] = Field(examples=["m*l^2*ddot(phi) + m*g*l*sin(phi) = 0"])


class AnsweredTask(Request):
    """A line of a working: a task and what was answered."""

    task: TaskId
    answer: AnswerText


Lines = Annotated[tuple[AnsweredTask, ...], Field(strict=False, max_length=24)]


class SingleCheck(SceneWithChanges):
    """One answer to one task, in the light of the lines before it."""

    task: TaskId
    answer: AnswerText
    previous: Lines = Field((), description="the student's own earlier lines: what follows from a wrong one is told")


class ReadingRequest(SceneWithChanges):
    """An answer to be read, not checked."""

    task: TaskId
    answer: AnswerText
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples({"scene": "pendulum", "task": "equation:phi", "answer": {"value": "l*ddot(phi) = -g*phi"}})


class SolutionRequest(SceneWithChanges):
    """Which task to solve."""

    task: TaskId
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples({"scene": "pendulum", "task": "equation:phi"})


class PointScheme(Request):
    """How points are given."""

    points: dict[TaskId, Annotated[float, Field(ge=0, le=1000)]] = Field({}, max_length=64, description="by task id")
    follow_through: float = Field(0.5, ge=0, le=1, description="share of the points for a right consequence")


class LinesRequest(SceneWithChanges):
    """A whole working."""

    lines: Annotated[tuple[AnsweredTask, ...], Field(strict=False, min_length=1, max_length=24)]
    scheme: PointScheme = PointScheme()
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

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

    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

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

    checks: Annotated[tuple[SingleCheck, ...], Field(strict=False, min_length=1, max_length=64)]
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples(
        {"checks": [{"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": "m*l^2*dot(phi)^2/2"}}]}
    )


class VerdictProblem(Answer):
    """Why an answer could not be read."""

    code: str
    offset: int | None
    length: int | None
    message: str


class NamedMisconception(Answer):
    """A mistake that leads to exactly the answer given."""

    id: str
    title: str


class CounterexampleAnswer(Answer):
    """A state at which the answer given and the right one have different values."""

    values: dict[str, float]
    latex: dict[str, str] = Field(description="the names among them as LaTeX")
    of: str
    yours: float
    right: float


class VerdictAnswer(Answer):
    """What the checker says of an answer."""

    outcome: Literal["correct", "wrong", "undecided", "invalid", "follow_through"]
    understood_as: str = Field(description="LaTeX of what was read")
    feedback: str
    remark: str | None = Field(description="in which sense a correct answer is equal, or why a wrong one is")
    misconception: str | None
    misconceptions: tuple[NamedMisconception, ...]
    slip: str | None = Field(description="sign, missing, half or double: one term")
    parts: tuple[Literal["correct", "wrong", "undecided"], ...] = Field(
        description="of a wrong answer of several parts: components, equations of a set, frequencies"
    )
    problems: tuple[VerdictProblem, ...]
    offset: int | None
    counterexample: CounterexampleAnswer | None


class ReadingAnswer(Answer):
    """What was read, or why it could not be."""

    latex: str = Field(examples=[r"\ell\,\ddot{\varphi} = -g\varphi"])
    plain: str = Field(examples=["l*ddot(phi) = -g*phi"])
    problems: tuple[VerdictProblem, ...]


class SolutionAnswer(Answer):
    """The right answer, one text for each part."""

    plain: tuple[str, ...]
    latex: tuple[str, ...]


class MotionAnswer(Answer):
    """A scene for POST /simulations: the one asked about with the generalized forces that the mistake amounts to."""

    scene: dict[str, Any]


class MarkedLine(VerdictAnswer):
    """The verdict on a line, and the points it earns."""

    points: float
    of: float


class LinesAnswer(Answer):
    """A working, marked: a task earns its points once."""

    lines: tuple[MarkedLine, ...]
    first_wrong: int | None = Field(description="index of the first line that is wrong or cannot be read")
    points: float
    of: float


class BatchAnswer(Answer):
    """The verdicts in the order of the checks."""

    verdicts: tuple[VerdictAnswer, ...]
