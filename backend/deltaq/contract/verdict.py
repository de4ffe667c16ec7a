"""Homework: what the checker says."""

from __future__ import annotations

from pydantic import Field

from ..vocabulary import Outcome, PartOutcome, SlipKind
from .base import Answer
from .document import GivenScene


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


class SlipAnswer(Answer):
    """What is wrong with one term: with this change the answer, or its part, is right."""

    kind: SlipKind
    title: str
    latex: str = Field(description="the term as it was written; empty where it is missing")
    part: int = Field(description="which component, equation or frequency it is in, from 0")
    offset: int | None = Field(description="where it stands in the answer; null where it is missing")
    length: int | None


class CounterexampleAnswer(Answer):
    """A state at which the answer given and the right one have different values."""

    values: dict[str, float]
    latex: dict[str, str] = Field(description="the names among them as LaTeX")
    of: str
    yours: float
    right: float
    reference: dict[str, float] = Field(
        {}, description="of what is known up to a constant: where the constant makes both agree"
    )


class PossibleReading(Answer):
    """One way to read an answer: either text, sent as the answer, is read so and in no other way."""

    latex: str
    plain: str
    taken: bool = Field(description="whether it was judged")


READINGS = Field((), description="all that make sense, where there is more than one: the conventional one first")


class VerdictAnswer(Answer):
    """What the checker says of an answer."""

    outcome: Outcome
    understood_as: str = Field(description="LaTeX of what was read")
    feedback: str
    remark: str | None = Field(description="in which sense a correct answer is equal, or why a wrong one is")
    misconception: str | None
    misconceptions: tuple[NamedMisconception, ...]
    slip: SlipKind | None = Field(description="what is wrong with one term")
    slips: tuple[SlipAnswer, ...] = Field((), description="the terms that are wrong, the first of them being `slip`")
    marked: str = Field("", description="LaTeX of the answer as it was written, the wrong terms in \\htmlClass{slip}")
    parts: tuple[PartOutcome, ...] = Field(
        description="of a wrong answer of several parts: components, equations of a set, frequencies"
    )
    share: float = Field(0.0, description="of the points: 1 if right, of a wrong answer what its right parts earn")
    problems: tuple[VerdictProblem, ...]
    offset: int | None
    counterexample: CounterexampleAnswer | None
    readings: tuple[PossibleReading, ...] = READINGS
    blocks: tuple[str, ...] = Field(
        (),
        description="of an order: letters of the block where it goes wrong, and of the one that this needs before it",
    )


class ReadingAnswer(Answer):
    """What was read, or why it could not be."""

    latex: str = Field(examples=[r"\ell\,\ddot{\varphi} = -g\varphi"])
    plain: str = Field(examples=["l*ddot(phi) = -g*phi"])
    problems: tuple[VerdictProblem, ...]
    readings: tuple[PossibleReading, ...] = READINGS


class MotionAnswer(Answer):
    """A scene for POST /simulations: the one asked about with the generalized forces that the mistake amounts to."""

    scene: GivenScene


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


class RowVerdict(Answer):
    """What a worker says of a row, from which its points are computed."""

    outcome: Outcome
    remark: str = ""
    misconception: str = Field("", description="its id, `slip:` and its kind, or empty")
    mistake: str = Field("", description="what went wrong, in words; empty where nothing did")
    understood_as: str = ""
    feedback: str
    share: float = Field(0.0, description="of the points that the right parts of a wrong answer earn")


class GradedRow(Answer):
    """A row of a table, marked."""

    index: int = Field(description="among the rows, from 0")
    row: int = Field(description="as a spreadsheet counts, the header being row 1")
    column: str = Field(description="which cell keeps the row from being marked; else empty")
    student: str
    scene: str
    task: str
    title: str
    outcome: Outcome
    misconception: str = Field(description="its id, `slip:` and its kind, or empty")
    mistake: str = Field(description="what went wrong, in words; empty where nothing did")
    points: float = Field(description="what it adds to the answers of the same student to the same task before")
    of: float
    understood_as: str
    feedback: str
    answer: str
    id: str = Field("", description="of the student in the course")
    time: str = Field("", description="when it was handed in")
    file: str = Field("", description="in which file it was handed in")
    attempt: int = Field(0, description="which of the student's different answers to the task, from 1; 0 if nobody's")
    late: bool = Field(default=False, description="whether it came after the deadline")
    counts: float = Field(
        1.0, description="share of its points that counts: less if late, 0 beyond the attempts allowed"
    )
    worth: float = Field(0.0, description="what it earns by itself")


class RefusedFile(Answer):
    """A file that could not be taken; the others are marked."""

    file: str
    why: str


class FrequentMistake(Answer):
    """How often something went wrong in one task."""

    outcome: Outcome
    mistake: str = Field(description="in words")
    count: int
    students: tuple[str, ...]


class TaskTotals(Answer):
    """What came of one task."""

    scene: str
    task: str
    title: str
    of: float = Field(0.0, description="what it counts")
    count: int
    outcomes: dict[Outcome, int]
    mistakes: tuple[FrequentMistake, ...] = Field(description="the most frequent first")


class BestAnswer(Answer):
    """The best of a student's answers to one task."""

    outcome: Outcome
    points: float
    last: Outcome = Field("invalid", description="of the last attempt")
    last_points: float = Field(0.0, description="what the last attempt earns by itself")
    attempts: int = Field(1, description="how many different answers there were")
    late: int = Field(0, description="how many of them came after the deadline")


class StudentTotals(Answer):
    """What one student earned."""

    student: str
    points: float
    of: float = Field(description="on the assignment; without one, by the tasks that were answered")
    id: str = Field("", description="in the course")
    late: int = Field(0, description="answers after the deadline")
    beyond: int = Field(0, description="answers beyond the attempts that are allowed")
    answers: tuple[BestAnswer | None, ...] = Field(description="to each of `tasks`, in their order")


class TableAnswer(Answer):
    """A table, marked. A task earns its points once: of several answers of a student the best counts."""

    rows: tuple[GradedRow, ...] = Field(description="in the order of the table")
    points: float
    of: float
    tasks: tuple[TaskTotals, ...]
    students: tuple[StudentTotals, ...]
    csv: str = Field(description="the rows as a table, written as the one that was sent")
    mistakes: tuple[FrequentMistake, ...] = Field((), description="of all tasks, the most frequent first")
    refused: tuple[RefusedFile, ...] = Field((), description="files that could not be taken, and why")
    moodle: str = Field("", description="the points of an assignment as Moodle imports them (CSV)")
    canvas: str = Field("", description="the same for Canvas")


class BatchAnswer(Answer):
    """The verdicts in the order of the checks."""

    verdicts: tuple[VerdictAnswer, ...]
