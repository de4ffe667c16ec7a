"""Derivations: from a scene to its equations of motion, step by step."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .base import Answer, AskedLanguage, SceneWithChanges, examples
from .result import DerivationResult

Formulation = Literal["dalembert-lagrange", "hamilton"]
ROAD = "which road leads to the equations"


class DerivationRequest(SceneWithChanges):
    """Which scene to derive, what to change before, and in which language."""

    formulation: Formulation = Field("dalembert-lagrange", description=ROAD)
    lang: AskedLanguage = None

    model_config = examples(
        {"scene": "elastic-pendulum"},
        {
            "scene": "base-pendulum",
            "guides": [{"coordinate": "y", "value": "y0*sin(omega*t)"}],
            "parameters": {"y0": 0.1, "omega": 12.0},
        },
    )


class Step(Answer):
    """One law applied once."""

    id: str = Field(examples=["virtual-displacement:bob"])
    rule: str = Field(description="the law", examples=["virtual-displacement"])
    title: str
    text: str
    latex: str = Field(examples=["\\delta E = m\\ell^2\\dot{\\varphi}\\,\\delta\\dot{\\varphi}"])
    marked: str = Field(description="the same with \\htmlClass hooks that tell which term is what")
    verified: bool = Field(description="whether an independent route confirmed the step")
    sources: tuple[str, ...] = Field(description="bodies and loads that the terms come from")
    substeps: tuple[Step, ...]


class Chapter(Answer):
    """Steps that belong together."""

    id: str = Field(examples=["variation"])
    title: str
    steps: tuple[Step, ...]


class DerivationAnswer(Answer):
    """The derivation, and its results as plain expressions and as LaTeX."""

    id: str = Field(description="content hash; GET /derivations/{id} answers the same", examples=["9f3c…"])
    scene: str = Field(description="id of the scene", examples=["pendulum"])
    formulation: Formulation = Field(description=ROAD)
    chapters: tuple[Chapter, ...]
    result: DerivationResult
