"""Expressions: what a text means, in the names of a scene."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from .base import Answer, AskedLanguage, Names, Request, Syntax, examples, items
from .document import DraftReference
from .problem import ProblemEntry

Text = Annotated[str, Field(min_length=1, max_length=4000)]


class ExpressionText(Request):
    """A text to be read."""

    expression: Text = Field(description="the text", examples=["l*sin(phi)"])
    syntax: Syntax = "plain"
    material: Names = Field((), description="material coordinates that may be used besides", examples=[[]])


class ExpressionRequest(ExpressionText):
    """A text, and the scene whose names it uses."""

    scene: DraftReference
    lang: AskedLanguage = None

    model_config = examples({"scene": "elastic-pendulum", "expression": "l*sin(phi)"})


class ExpressionsRequest(Request):
    """Several texts that use the names of one scene."""

    scene: DraftReference
    expressions: Annotated[tuple[ExpressionText, ...], items(max_length=500, description="the texts")]
    lang: AskedLanguage = None

    model_config = examples(
        {"scene": "pendulum", "expressions": [{"expression": "m*l^2*dot(phi)"}, {"expression": "l*sin(phi"}]}
    )


class ExpressionAnswer(Answer):
    """What the text means."""

    latex: str = Field(examples=["\\ell\\sin\\varphi"])
    plain: str = Field(examples=["l*sin(phi)"])
    spoken: str = Field("", description="the same in words of the language asked for", examples=["l times sine of phi"])


class ExpressionOutcome(ExpressionAnswer):
    """What the text means, or empty texts and what is wrong with it."""

    problems: tuple[ProblemEntry, ...]


class ExpressionsAnswer(Answer):
    """One outcome for each text, in order."""

    expressions: tuple[ExpressionOutcome, ...]
