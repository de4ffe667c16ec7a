"""Exports: a derivation as a document, its motion as a program."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from ...simulation.request import LARGEST_SPAN
from ..languages import Language
from .base import Guides, Name, Names, Request, SceneReference, Values, examples
from .derivation import Formulation
from .simulation import InitialValue

Form = Literal["latex", "markdown", "python"]


class ExportRequest(Request):
    """Which scene to export, what to change before, and in which language."""

    scene: SceneReference
    guides: Guides = Field((), description="coordinates to be made functions of time")
    freeze: Names = Field((), description="coordinates to be held constant", examples=[[]])
    parameters: Values = Field({}, description="values of parameters", examples=[{"l": 0.8}])
    initial: Annotated[dict[Name, InitialValue], Field(max_length=64)] = Field({}, examples=[{"phi": {"value": 0.5}}])
    t_end: float = Field(10.0, gt=0, le=LARGEST_SPAN, description="seconds that the program simulates")
    formulation: Formulation = "dalembert-lagrange"
    substeps: bool = Field(default=True, description="whether a document tells the substeps, too")
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

    model_config = examples({"scene": "elastic-pendulum", "lang": "de"})
