"""Work and precision: what may be asked."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from ..base import examples
from ..experiment import ExperimentRequest, MethodIds


class WorkPrecisionRequest(ExperimentRequest):
    """Speed against accuracy: the error of each method against time and right-hand sides."""

    experiment: ClassVar[str] = "work-precision"

    methods: MethodIds = ()
    peers: bool = Field(default=False, description="whether SciPy's integrators take part, where SciPy is installed")

    model_config = examples({"scene": "pendulum", "t_end": 2.0, "methods": ["rk4", "dop853"]})
