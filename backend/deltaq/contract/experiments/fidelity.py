"""Fidelity: what may be asked."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from ..bounds import TOLERANCES_OF_MODEL
from ..base import examples
from ..experiment import ExperimentRequest


class FidelityRequest(ExperimentRequest):
    """The least model that will do: simpler models of the scene, each with its cost and its error."""

    experiment: ClassVar[str] = "fidelity"

    tolerance: float | None = Field(
        None,
        ge=TOLERANCES_OF_MODEL[0],
        le=TOLERANCES_OF_MODEL[1],
        description="relative error allowed of the least rung; 0.01 if empty",
    )

    model_config = examples({"scene": "elastic-pendulum", "tolerance": 0.05})
