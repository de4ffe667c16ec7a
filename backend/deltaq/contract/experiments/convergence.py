"""Convergence: what may be asked."""

from __future__ import annotations

from typing import ClassVar

from ..base import examples
from ..experiment import ExperimentRequest, MethodIds


class ConvergenceRequest(ExperimentRequest):
    """Order of convergence: the error of each method against its step."""

    experiment: ClassVar[str] = "convergence"

    methods: MethodIds = ()

    model_config = examples({"scene": "pendulum", "t_end": 2.0, "methods": ["heun", "rk4"]})
