"""Energy drift: what may be asked."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from ..bounds import DRIFT_STEPS, LOCAL_TOLERANCES, USUAL_DRIFT
from ..base import examples
from ..experiment import ExperimentRequest, MethodIds


class EnergyDriftRequest(ExperimentRequest):
    """Departure of the energy balance over many steps, symplectic methods against others.

    The span is the number of steps times the step.
    """

    experiment: ClassVar[str] = "energy-drift"

    methods: MethodIds = ()
    steps: int = Field(USUAL_DRIFT, ge=DRIFT_STEPS[0], le=DRIFT_STEPS[1], description="how many")
    step: float | None = Field(None, gt=0, le=1e3, description="seconds; else a fortieth of the fastest period")
    tolerance: float | None = Field(
        None, ge=LOCAL_TOLERANCES[0], le=LOCAL_TOLERANCES[1], description="local tolerance of variable steps"
    )

    model_config = examples({"scene": "pendulum", "methods": ["stormer-verlet", "rk4"], "steps": 2000})
