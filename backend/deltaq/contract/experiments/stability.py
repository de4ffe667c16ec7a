"""Stability of methods: what may be asked."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from ..bounds import AT
from ..base import examples
from ..experiment import ExperimentRequest, MethodIds


class StabilityRequest(ExperimentRequest):
    """Regions of stability with the eigenvalues of the scene, steps of failure, and a series over a stiffness."""

    experiment: ClassVar[str] = "stability"

    methods: MethodIds = ()
    at: Literal["state", "rest"] = Field("state", description=f"where the scene is linearized: {' or '.join(AT)}")
    stiffness: str | None = Field(None, max_length=64, description="parameter that is made larger; a spring's if empty")

    model_config = examples({"scene": "pendulum", "methods": ["rk4"], "at": "rest"})
