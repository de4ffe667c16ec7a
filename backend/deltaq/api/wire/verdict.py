"""Homework: what the checker says."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from .base import Answer


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
