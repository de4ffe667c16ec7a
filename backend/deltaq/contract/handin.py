"""What a student hands in: a file with a name, the code of the assignment and an answer to each task."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from .assignment import LONGEST_TIME, MOST_TASKS
from .base import Syntax

FORMAT = "deltaq-handin-1"
LONGEST_NAME = 100  # signs


class _HandedIn(BaseModel):
    """Later versions may add fields."""

    model_config = ConfigDict(extra="ignore", strict=True, frozen=True)


class HandedAnswer(_HandedIn):
    """An answer to a task of the assignment, by its number there."""

    task: Annotated[int, Field(ge=1, le=MOST_TASKS)]
    syntax: Syntax = "plain"
    value: str  # however long: the reader says what is too long for it


class HandIn(_HandedIn):
    """The answers of one student, handed in together."""

    format: Literal["deltaq-handin-1"]
    sheet: Annotated[str, Field(max_length=LONGEST_NAME)] = Field(description="code of the assignment")
    student: Annotated[str, Field(max_length=LONGEST_NAME)]
    id: Annotated[str, Field(max_length=LONGEST_NAME)] = Field("", description="number, login or address in the course")
    time: Annotated[str, Field(max_length=LONGEST_TIME)] = Field(description="when (ISO 8601)")
    answers: Annotated[tuple[HandedAnswer, ...], Field(strict=False, max_length=MOST_TASKS)]
