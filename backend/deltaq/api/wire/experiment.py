"""Experiments: what may be asked of each, and what a result is."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from ...lab.bounds import (
    APART,
    AT,
    CHAOS_LONGEST,
    CHAOS_SPAN,
    DRIFT_STEPS,
    FLIP_POINTS,
    LOCAL_TOLERANCES,
    LONGEST,
    MAP_POINTS,
    SHORTEST,
    SPAN,
    TOLERANCES_OF_MODEL,
    USUAL_DRIFT,
    USUAL_FLIPS,
    USUAL_MAP,
)
from .base import Answer, AskedLanguage, InitialValues, Name, Names, Request, SceneWithChanges, examples


class ExperimentRequest(SceneWithChanges):
    """The scene to experiment on, with its changes and values."""

    initial: InitialValues = Field({})
    t_end: float = Field(SPAN, ge=SHORTEST, le=LONGEST, description="seconds of motion", examples=[10.0])
    lang: AskedLanguage = None


MethodIds = Annotated[Names, Field(description="methods of GET /methods; all if empty", examples=[["rk4", "dop853"]])]


class WorkPrecisionRequest(ExperimentRequest):
    """Error against time and right-hand sides."""

    methods: MethodIds = ()
    peers: bool = Field(default=False, description="whether SciPy's integrators take part, where SciPy is installed")

    model_config = examples({"scene": "pendulum", "t_end": 2.0, "methods": ["rk4", "dop853"]})


class ConvergenceRequest(ExperimentRequest):
    """Error against a fixed step."""

    methods: MethodIds = ()

    model_config = examples({"scene": "pendulum", "t_end": 2.0, "methods": ["heun", "rk4"]})


class EnergyDriftRequest(ExperimentRequest):
    """Departure of the energy balance over many steps; the span is their number times the step."""

    methods: MethodIds = ()
    steps: int = Field(USUAL_DRIFT, ge=DRIFT_STEPS[0], le=DRIFT_STEPS[1], description="how many")
    step: float | None = Field(None, gt=0, le=1e3, description="seconds; else a fortieth of the fastest period")
    tolerance: float | None = Field(
        None, ge=LOCAL_TOLERANCES[0], le=LOCAL_TOLERANCES[1], description="local tolerance of variable steps"
    )

    model_config = examples({"scene": "pendulum", "methods": ["stormer-verlet", "rk4"], "steps": 2000})


class StabilityRequest(ExperimentRequest):
    """Regions of stability, steps of failure, and a series over a stiffness."""

    methods: MethodIds = ()
    at: Literal["state", "rest"] = Field("state", description=f"where the scene is linearized: {' or '.join(AT)}")
    stiffness: str | None = Field(None, max_length=64, description="parameter that is made larger; a spring's if empty")

    model_config = examples({"scene": "pendulum", "methods": ["rk4"], "at": "rest"})


class MapAxis(Request):
    """A parameter and its range."""

    parameter: Name = Field(description="of the scene", examples=["omega"])
    start: float = Field(alias="from", description="its least value", examples=[20.0])
    to: float = Field(description="its largest value", examples=[120.0])
    count: int = Field(USUAL_MAP, ge=MAP_POINTS[0], le=MAP_POINTS[1], description="points on this side")

    model_config = ConfigDict(serialize_by_alias=True)


class StabilityMapRequest(ExperimentRequest):
    """Floquet multipliers over two parameters of a scene that something drives periodically."""

    x: MapAxis = Field(description="to the right")
    y: MapAxis = Field(description="upwards")

    model_config = examples(
        {
            "scene": "kapitza",
            "x": {"parameter": "omega", "from": 20.0, "to": 120.0, "count": 12},
            "y": {"parameter": "y0", "from": 0.05, "to": 0.3, "count": 12},
        }
    )


class ChaosRequest(ExperimentRequest):
    """Twin runs, Lyapunov exponent, horizon against tolerance, and a map of flips."""

    t_end: float = Field(CHAOS_SPAN, ge=SHORTEST, le=CHAOS_LONGEST, description="seconds of motion")
    apart: float | None = Field(None, ge=APART[0], le=APART[1], description="how far the twins are apart at first")
    map: bool = Field(default=False, description="whether to map the times at which angles turn over")
    count: int = Field(USUAL_FLIPS, ge=FLIP_POINTS[0], le=FLIP_POINTS[1], description="points on a side of the map")

    model_config = examples({"scene": "double-pendulum", "t_end": 10.0})


class FidelityRequest(ExperimentRequest):
    """Simpler models of the scene, each with its cost and its error."""

    tolerance: float | None = Field(
        None,
        ge=TOLERANCES_OF_MODEL[0],
        le=TOLERANCES_OF_MODEL[1],
        description="relative error allowed of the least rung; 0.01 if empty",
    )

    model_config = examples({"scene": "elastic-pendulum", "tolerance": 0.05})


class Chart(Answer):
    """A figure for Plotly, with what it shows and how that was measured."""

    id: str
    title: str
    subject: str = Field(description="scene and values")
    caption: str
    data: tuple[dict[str, Any], ...]
    layout: dict[str, Any]


class ExperimentAnswer(Answer):
    """What was found, as numbers and as charts. Members besides these depend on the experiment."""

    experiment: str = Field(examples=["work-precision"])
    scene: str
    t_end: float
    charts: tuple[Chart, ...]
