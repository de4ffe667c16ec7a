"""Simulations: a scene's motion in time, with status, error estimate, energy balance and cost."""

from __future__ import annotations

from typing import Annotated, Literal, Self, get_args

from pydantic import Field, field_validator, model_validator
from pydantic_core import PydanticCustomError
from typing_extensions import TypeAliasType

from ..vocabulary import AUTO, Status, TransitionKind
from .base import Answer, AskedLanguage, Name, NotAbove, Released, SceneWithInitialValues, examples, items, outside

LARGEST_SPAN = 1e5  # seconds
SHORTEST = 1e-250  # seconds; parts of less are no longer different numbers
USUAL_TOLERANCE = 1e-6
Part = Literal["coordinates", "rates", "positions", "loads", "multipliers", "energy", "power", "error"]
PARTS: tuple[Part, ...] = get_args(Part)
Written = Literal["numbers", "base64", "planes"]
COLUMNS: tuple[Written, ...] = get_args(Written)
Base64 = Annotated[str, Field(json_schema_extra={"contentEncoding": "base64"})]


def can_be_parted(seconds: float | None) -> float | None:
    """The seconds. Raises PydanticCustomError for fewer than `SHORTEST`."""
    if seconds is not None and seconds < SHORTEST:
        raise outside(seconds, SHORTEST, LARGEST_SPAN)
    return seconds


class SimulationRequest(SceneWithInitialValues):
    """What to simulate, how long, and how accurately."""

    t_end: float = Field(gt=0, le=LARGEST_SPAN, description="seconds", examples=[10.0])
    samples: int = Field(501, ge=2, le=20001, description="number of samples, evenly spaced, both ends included")
    method: Name = Field(AUTO, description="a method of GET /methods, or auto", examples=["dop853"])
    tolerance: float | None = Field(
        None, ge=1e-13, le=1e-1, description="wanted error of the coordinates: absolute below 1, relative above"
    )
    step: Annotated[
        float | None,
        Field(gt=0, description="fixed step in seconds, instead of a tolerance"),
        NotAbove("t_end", LARGEST_SPAN),
    ] = None
    include: Annotated[tuple[Part, ...], items(max_length=32)] = Field(
        (), description=f"the parts wanted, of {', '.join(PARTS)}; all if empty", examples=[[]]
    )
    release: Released = ()
    columns: Written = Field(
        "numbers",
        description="how arrays are written; base64: little-endian doubles, components of a vector together; planes:"
        " base64 of all first bytes of these doubles, then of all second ones …, which is smaller when compressed",
    )
    lang: AskedLanguage = None

    model_config = examples(
        {"scene": "elastic-pendulum", "t_end": 10.0, "samples": 101, "tolerance": 1e-9},
        {"scene": "pendulum", "t_end": 5.0, "method": "rk4", "step": 0.01, "initial": {"phi": {"value": 1.0}}},
    )

    _parted = field_validator("t_end", "step")(can_be_parted)

    @model_validator(mode="after")
    def _one_accuracy(self) -> Self:
        if self.step is not None and self.tolerance is not None:
            raise PydanticCustomError("request-step-and-tolerance", "either step or tolerance", {"at": "/tolerance"})
        return self

    @property
    def wanted_tolerance(self) -> float | None:
        """The tolerance; the usual one where nothing is said of the accuracy, none where there is a step."""
        return USUAL_TOLERANCE if self.step is None and self.tolerance is None else self.tolerance


# As `columns` of the answer says: numbers, or little-endian doubles where base64 or planes were asked for. What is not
# determined in a part of the time is null there, packed not a number.
Column = TypeAliasType("Column", tuple[float, ...] | Base64)
PartialColumn = TypeAliasType("PartialColumn", tuple[float | None, ...] | Base64)
VectorColumn = TypeAliasType("VectorColumn", tuple[tuple[float, ...], ...] | Base64)


class Energy(Answer):
    """Energies at the samples in joule, the work of the other forces, and the balance kinetic + potential − work."""

    kinetic: Column
    potential: Column
    power: Column | None = Field(
        None, description="of all that is not in kinetic + potential, in watt; where `power` is included"
    )
    work: Column | None = Field(None, description="the power's integral over the time; where `power` is included")
    works: bool = Field(
        description="whether other forces do work in this motion; else the balance is kinetic + potential"
    )
    balance: Column = Field(description="constant when all is right")
    drift: float = Field(description="largest departure of the balance from its start")


class ErrorEstimate(Answer):
    """The estimated largest absolute error of any coordinate at each sample, and the time after which none is right."""

    estimate: tuple[float | None, ...]
    horizon: float | None
    worst: float | None = Field(description="largest of all, absolute below 1, relative above")
    tolerance: float | None = Field(description="as it was asked for")
    reached: bool | None = Field(description="whether the error stays below it; null where nothing was estimated")
    multipliers: dict[str, tuple[float | None, ...]] | None = Field(
        None,
        description="of the multipliers of constraints: the estimated absolute error of each at each sample; null where"
        " they are `indeterminate`",
    )


class MovedValue(Answer):
    """What was added to the initial value and rate of a coordinate, so that all constraints are kept."""

    value: float
    rate: float


class ReactionKind(Answer):
    """What a reaction is a quantity of."""

    unit: str = Field(description='"" where the scene states too few units', examples=["N"])
    of_rod: bool = Field(description="whether a rod or string exerts it, which goes slack where the sign changes")


class EventAnswer(Answer):
    """What ended the motion: an event of the scene, its time in seconds and the estimated error of that time."""

    name: str = Field(examples=["slack"])
    title: str = Field(examples=["the string goes slack"])
    t: float
    error: float | None = Field(description="null where it was not asked for, or where the event itself is doubtful")


class TransitionAnswer(Answer):
    """An event behind which the motion went on: an impact, rest, release, sticking, slipping, a turn of slipping.

    Where a force jumps with a rate, a motion may slide along the zero of what the sign is taken of, and leave it.
    """

    name: str = Field(
        description="of the event, of the load with friction, or what is zero while the motion slides along a kink",
        examples=["impact"],
    )
    time: float = Field(description="in seconds")
    kind: TransitionKind = Field(description="what happened")
    loss: float = Field(description="energy that it took, in J")
    error: float | None = Field(description="estimated error of the time in seconds; null where it is not known")
    together: list[str] = Field(
        description="further contacts that pushed at that time, one after the other in this order"
    )
    impulses: dict[str, float] = Field(
        description="of an impact, if `loads` or `multipliers` were asked for: by name, of contacts that pushed, of"
        " constraints and of what is in `release`, as far as they are unique, in the unit of the force times s"
    )


class ContactAnswer(Answer):
    """The force of a contact, at rest or of a taut string, along the gradient of its gap; 0 while it is open."""

    force: PartialColumn = Field(description="without the impulses of impacts; null where it is `indeterminate`")
    unit: str = Field(description="N where the gap is a length; empty where the scene states too few units")


class FrictionAnswer(Answer):
    """The force of a load with dry friction along its coordinate, and the largest that could hold, at the samples."""

    force: PartialColumn = Field(description="null where it is `indeterminate`")
    largest: Column


class IndeterminateSpan(Answer):
    """A part of the time in which more holds at rest than the equations of motion tell apart.

    Friction that sticks, contacts that rest and constraints, dependent on each other, have no single forces.
    """

    names: tuple[str, ...] = Field(
        description="loads with friction, multipliers and contacts whose forces are not determined", examples=[["R"]]
    )
    start: float = Field(description="in seconds")
    end: float = Field(description="in seconds")


class Cost(Answer):
    """What it took: steps are those of the run that is returned, the rest that of all runs; times in seconds."""

    steps: int
    rejected: int
    rhs_evaluations: int
    wall_time: float
    compile_time: float
    runs: int = Field(description="that were made for the motion and the estimate of its error")
    run_time: float = Field(description="of the run that is returned")
    run_evaluations: int = Field(description="of the right-hand side, in the run that is returned")


class SimulationAnswer(Answer):
    """The trajectory at the samples that were reached; parts that were not asked for are missing."""

    status: Status = Field(description="ok, or why the run ended early", examples=["ok"])
    reason: str = Field(description="the status as a sentence")
    remedy: str = Field(description="what to do about it")
    event: EventAnswer | None = Field(None, description="the event that ended it; its time is the last of t")
    events: list[TransitionAnswer] = Field([], description="events behind which it went on, in their order")
    method: str = Field(examples=["dop853"])
    choice: str | None = Field(description="why this method, if it was left to be chosen")
    columns: Written = Field("numbers", description="how all columns of this answer are written")
    t: Column = Field(
        description="the samples, in seconds; at each of `events` its time twice, with the values before and behind it"
    )
    coordinates: dict[str, Column] | None = None
    rates: dict[str, Column] | None = None
    positions: dict[str, VectorColumn] | None = None
    loads: dict[str, VectorColumn] | None = Field(None, description="force vectors")
    friction: dict[str, FrictionAnswer] | None = Field(
        None, description="by load, with `loads`: what acts, and F₀ up to which it can hold"
    )
    contacts: dict[str, ContactAnswer] | None = Field(
        None, description="by event that goes on with a rebound, with `loads`: what keeps its value at zero"
    )
    multipliers: dict[str, PartialColumn] | None = Field(
        None,
        description="of constraints, as far as they are unique (of a distance the force, positive in tension), and Z of"
        " each name in `release`, in the direction in which it grows; null where they are `indeterminate`, without the"
        " `impulses` of `events`",
    )
    reactions: dict[str, ReactionKind] | None = Field(None, description="what each of the `multipliers` is")
    undetermined: tuple[str, ...] | None = Field(
        None,
        description="multipliers and reactions that are not unique, since constraints depend on one another",
    )
    indeterminate: list[IndeterminateSpan] = Field(
        [], description="when forces are not determined, since more sticks or rests than the motion needs"
    )
    drift: float | None = Field(None, description="largest amount by which a holonomic constraint is not kept")
    moved: dict[str, MovedValue] | None = Field(
        None,
        description="by how much initial values were moved to keep the constraints, in the metric of the mass matrix",
    )
    energy: Energy | None = None
    error: ErrorEstimate | None = None
    t_reached: float = Field(description="when the run ended, in seconds")
    trusted_until: float = Field(description="up to when at least one digit is right")
    condition: float | None = Field(
        description="of the mass matrix: largest ratio of a diagonal entry to a pivot; null if it has no inverse"
    )
    cost: Cost
