"""Homework: the tasks of a scene, and assignments made of them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from .assignment import VARY, Aspect, AssignmentDocument
from .base import Answer, AskedLanguage, Name, Request, SceneWithChanges, examples, items
from .document import GivenScene

Seed = Annotated[str, Field(max_length=64)]
SEED = Field(None, description="draws what each student gets of their own", examples=["student 7"])
TaskId = Annotated[str, Field(min_length=1, max_length=80, examples=["equation:phi"])]
TASK = Field(description="a task of the scene by its id", examples=["equation:phi"])


class SceneAskedAbout(SceneWithChanges):
    """A scene, and whose values it has."""

    seed: Seed | None = SEED
    vary: tuple[Aspect, ...] = VARY


class TasksRequest(SceneAskedAbout):
    """Which tasks a scene has."""

    lang: AskedLanguage = None

    model_config = examples({"scene": "elastic-pendulum", "freeze": ["y"]})


class StackRequest(SceneAskedAbout):
    """Which tasks to export."""

    tasks: Annotated[tuple[TaskId, ...], items(max_length=32, description="all if empty")] = ()
    lang: AskedLanguage = None

    model_config = examples({"scene": "pendulum", "tasks": ["equation:phi"]})


class TaskSymbol(Answer):
    """A symbol that answers may hold."""

    name: str
    latex: str
    kind: str
    unit: str
    value: float | None


class TaskSolution(Answer):
    """Where the derivation answers a task."""

    chapter: str = Field(description="its id", examples=["equations"])
    steps: tuple[str, ...] = Field(description="ids of the steps that may show the answer, the likeliest first")


class TaskBlock(Answer):
    """A step of the derivation, or a wrong one, that is to be put in its place."""

    id: str = Field(description="its letter: an answer is a list of them", examples=["c"])
    title: str = Field(examples=["Kinetic energy of the system"])
    announced: str = Field(description="the title as it is read aloud, without mathematics between signs")
    latex: str = Field(description="what the step says")
    marked: str = Field(description="the same with \\htmlClass hooks that tell which symbol is what")
    spoken: str = Field(description="the same in words of the language of the answer")


class TaskEntry(Answer):
    """One task: what to answer, in which form, with hints in three levels."""

    id: str = Field(examples=["equation:phi"])
    kind: str
    subject: str
    title: str
    statement: str
    form: Literal["expression", "vector", "equation", "equations", "set", "positions", "stability", "rate", "order"]
    form_text: str
    components: int | None = Field(description="of a vector")
    points: float
    needs: tuple[str, ...] = Field(description="the tasks whose answers this one is derived from")
    hints: tuple[str, ...]
    blocks: tuple[TaskBlock, ...] = Field(
        (), description="what is to be put in order where `form` is `order`, as it is shown; the answer: `c; a; b`"
    )
    solution: TaskSolution = Field(description="the chapter of the derivation that answers it")


class TaskList(Answer):
    """The tasks of a scene, its document with the values asked about, and the symbols for a keyboard."""

    scene: GivenScene
    symbols: tuple[TaskSymbol, ...]
    tasks: tuple[TaskEntry, ...]


class SolutionRequest(SceneAskedAbout):
    """Which task to solve."""

    task: TaskId = TASK
    lang: AskedLanguage = None

    model_config = examples({"scene": "pendulum", "task": "equation:phi"})


class SolutionAnswer(Answer):
    """The right answer, one text for each part."""

    plain: tuple[str, ...]
    latex: tuple[str, ...]


class PollRequest(SceneAskedAbout):
    """Which result to ask a hall for."""

    step: Annotated[str, Field(min_length=1, max_length=80)] = Field(
        description="a step of the derivation by its id", examples=["lagrangian"]
    )
    lang: AskedLanguage = None

    model_config = examples({"scene": "pendulum", "step": "lagrangian"})


class PollChoice(Answer):
    """One result to choose."""

    latex: str
    right: bool
    title: str = Field(description="of the misconception that leads to it; empty for the right one")
    hint: str = Field(description="what that forgets")


class PollAnswer(Answer):
    """Two to four results, one of them right; none where no misconception is known to lead to another."""

    choices: tuple[PollChoice, ...]


class AssignmentRequest(Request):
    """An assignment, and the student who opens it."""

    assignment: AssignmentDocument = Field(
        description="format 1: title, individual, follow_through, simplified, tasks with scene, task and points",
        examples=[{"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:phi", "points": 3}]}],
    )
    seed: Seed | None = SEED
    lang: AskedLanguage = None

    model_config = examples(
        {
            "assignment": {"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:phi", "points": 3}]},
            "seed": "student 7",
        }
    )


class AssignedTaskEntry(Answer):
    """One task of an assignment, with its scene in the student's values."""

    scene: GivenScene
    symbols: tuple[TaskSymbol, ...]
    task: TaskEntry


class AssignmentAnswer(Answer):
    """An assignment, opened."""

    title: dict[str, str]
    follow_through: float
    simplified: float
    code: str = Field("", description="by which what is handed in says which assignment it answers")
    tasks: tuple[AssignedTaskEntry, ...]


class PracticeRequest(Request):
    """Which exercise: the same seed, level and number draw the same one."""

    seed: Annotated[str, Field(min_length=1, max_length=64)] = Field(
        description="of a row of exercises", examples=["ada"]
    )
    level: int = Field(1, ge=1, le=6, description="from one degree of freedom to positions of rest and stability")
    number: int = Field(1, ge=1, le=1_000_000, description="which one of the row; neighbours are of different families")
    recall: Name | None = Field(
        None, description="id of a misconception that the exercise can be got wrong by", examples=["gravity-sign"]
    )
    kind: Name | None = Field(None, description="the kind of task wanted with `recall`", examples=["potential-energy"])
    lang: AskedLanguage = None

    model_config = examples(
        {"seed": "ada", "level": 2, "number": 3}, {"seed": "ada", "recall": "gravity-sign", "kind": "potential-energy"}
    )


class PracticeAnswer(Answer):
    """A system drawn at random, and a task about it. Its answers are checked with the scene document."""

    scene: GivenScene
    symbols: tuple[TaskSymbol, ...]
    task: TaskEntry
    level: int = Field(description="of the exercise: with `recall` perhaps another one than was asked for")
    recalled: str | None = Field(None, description="the misconception, if there is a system on which it can be made")
