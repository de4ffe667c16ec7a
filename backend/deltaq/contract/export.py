"""Exports: a derivation as a document, its motion as a program."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator

from .base import AskedLanguage, Released, SceneWithInitialValues, examples
from .derivation import PRINCIPLE, Formulation
from .simulation import LARGEST_SPAN, can_be_parted

Form = Literal["latex", "markdown", "python"]


class ExportRequest(SceneWithInitialValues):
    """Which scene to export, what to change before, and in which language."""

    t_end: float = Field(10.0, gt=0, le=LARGEST_SPAN, description="seconds that the program simulates")
    formulation: Formulation = Field("dalembert-lagrange", description=PRINCIPLE)
    release: Released = ()
    substeps: bool = Field(default=True, description="whether a document tells the substeps, too")
    lang: AskedLanguage = None

    _parted = field_validator("t_end")(can_be_parted)

    model_config = examples({"scene": "elastic-pendulum"})


class FileRequest(ExportRequest):
    """The same with the kind of file, which stands in the address of the call."""

    form: Form

    model_config = examples()
