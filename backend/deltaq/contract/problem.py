"""Problem documents (RFC 9457)."""

from __future__ import annotations

from pydantic import Field

from ..vocabulary import Severity
from .base import Answer


class ProblemEntry(Answer):
    """One thing that is wrong, and where."""

    pointer: str = Field(description="JSON pointer (RFC 6901) of the field", examples=["/bodies/0/mass"])
    offset: int | None = Field(None, description="character in the text of the field", examples=[2])
    length: int | None = Field(None, description="number of characters", examples=[3])
    code: str = Field(description="machine-readable name of the problem", examples=["unknown-name"])
    severity: Severity = Field("error", description="warning where the input can be used all the same")
    message: str = Field(description="the problem in the language asked for")


class ProblemDocument(Answer):
    """Why a request failed."""

    type: str = Field(examples=["/problems/invalid-request"])
    title: str = Field(examples=["The request is not valid"])
    status: int = Field(examples=[422])
    detail: str
    problems: tuple[ProblemEntry, ...]
