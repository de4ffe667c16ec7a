"""What a derivation leads to: every expression as plain text and as LaTeX, sums term by term."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..vocabulary import CurlOutcome, GeneratorFamily, HoldKind, RangeEnd, SearchEnd, Stability, StabilityKind
from .base import Answer

Change = Literal["kept", "sign-turned", "differentiated", "integrated", "expanded", "merged"]


class Origin(Answer):
    """A term of an earlier line that a term comes from."""

    term: str = Field(description="its id", examples=["momentum-rate:phi/0.1.0"])
    change: Change = Field(
        description="what became of it: it is still there, stands on the other side with the other sign, was"
        " differentiated, integrated, multiplied out into several terms, or merged with others into one"
    )


class Term(Answer):
    """A term of a sum, and where it comes from."""

    plain: str = Field(examples=["m*l^2*ddot(phi)"])
    latex: str
    spoken: str = Field("", description="the same in words, with its sign")
    sources: tuple[str, ...] = Field(description="bodies and loads", examples=[["body:bob"]])
    origins: tuple[Origin, ...] = Field(
        (), alias="from", description="the terms it comes from, of the step that says what the sum is"
    )


class Formula(Answer):
    """An expression that programs read, and one for people."""

    plain: str = Field(examples=["m*l^2*dot(phi)^2/2"])
    latex: str
    spoken: str = Field("", description="the same in words, to be read aloud")


class Sum(Formula):
    """An expression with its terms."""

    terms: tuple[Term, ...]


class CoordinateSum(Sum):
    """What belongs to one coordinate: a generalized force, or an equation `… = 0`."""

    coordinate: str = Field(examples=["phi"])


class VectorFormula(Answer):
    """A vector by its components."""

    plain: tuple[str, ...] = Field(examples=[["l*sin(phi)", "l*cos(phi)"]])
    latex: str
    spoken: str = Field("", description="the same in words, to be read aloud")


class Forcing(VectorFormula):
    """f of M(q, t) q̈ = f(q, q̇, t)."""

    terms: tuple[tuple[Term, ...], ...]


class MassMatrix(Answer):
    """M of M(q, t) q̈ = f(q, q̇, t), by rows."""

    plain: tuple[tuple[str, ...], ...] = Field(examples=[[["l^2*m"]]])
    latex: str
    spoken: str = Field("", description="the same in words, to be read aloud")
    terms: tuple[tuple[tuple[Term, ...], ...], ...]


class GeneralizedForces(Answer):
    """Q and its split into the part that has a potential and the rest."""

    total: tuple[CoordinateSum, ...]
    conservative: tuple[CoordinateSum, ...]
    nonconservative: tuple[CoordinateSum, ...]


class Generator(Answer):
    """A small change q → q + ε ξ, t → t + ε τ that leads from motions to motions."""

    shifts: dict[str, Formula] = Field(description="ξ by coordinate, where it is not zero")
    time: Formula = Field(description="τ")


class ConservedQuantity(Sum):
    """What does not change along the motion."""

    kind: Literal["momentum", "energy", "symmetry"]
    coordinate: str = Field(description="of a momentum; else empty")
    generator: Generator
    meaning: str = Field(description="what the generator does in space, in a word", examples=["rotation-z"])
    conditions: tuple[Formula, ...] = Field(description="equations between parameters on which it rests")
    contacts: tuple[str, ...] = Field(
        (), description="events between whose impacts it holds, and as long as these contacts do not rest"
    )
    step: str = Field(description="id of the step that shows it", examples=["noether:1"])


class SymmetrySearch(Answer):
    """Which symmetries were looked for. Others, such as that of the Runge-Lenz vector, are not found."""

    generators: tuple[GeneratorFamily, ...] = Field(
        description="`affine` in coordinates and time; `motions-of-space`: translations and rotations of space and of"
        " single rigid bodies, in any coordinates; none where the search was left out"
    )


class JacobiEnergy(Sum):
    """Σ q̇ ∂L/∂q̇ − L."""

    equals_energy: bool = Field(description="whether it is kinetic + potential energy")


class CoordinateFormula(Formula):
    """What belongs to one coordinate."""

    coordinate: str = Field(examples=["phi"])


class ConstraintResult(Answer):
    """A constraint, and the reaction that keeps it: λ ∂g/∂q, or λ a where a·q̇ + b = 0 is kept."""

    name: str = Field(examples=["rod"])
    kind: Literal["equation", "distance"]
    holonomic: bool = Field(description="whether it binds positions; else it is linear in the rates")
    equation: Formula = Field(description="what is kept, as an equation `… = 0`")
    multiplier: Formula = Field(description="the symbol λ in the equations; of a distance the rod's force in tension")
    reaction: Formula | None = Field(description="λ by coordinates and rates; null where it would be too long")
    forces: tuple[CoordinateFormula, ...] = Field(description="the generalized reactions, by coordinate")


class ConstraintFormula(Formula):
    """What belongs to one constraint."""

    constraint: str = Field(examples=["rod"])


class ImpactResult(Answer):
    """What an impact does: the momenta jump by Λ ∂g/∂q, such that ġ⁺ = −e ġ⁻. Rates are those before it."""

    impulse: Formula = Field(description="Λ")
    momentum_jumps: tuple[CoordinateFormula, ...] = Field(
        description="Λ ∂g/∂q of each coordinate that changes the gap, and what constraints add"
    )
    rate_jumps: tuple[CoordinateFormula, ...] = Field(description="q̇ behind the impact less q̇ before it")
    energy_loss: Formula = Field(description="E before less E behind; negative where a moving contact feeds energy in")
    constraint_impulses: tuple[ConstraintFormula, ...] = Field(
        (), description="by which constraints answer; momenta then jump by Λ ∂g/∂q and these times a"
    )


class ContactResult(Answer):
    """A contact that closes where its gap g(q, t) falls to zero."""

    name: str = Field(examples=["impact"])
    gap: Formula
    restitution: Formula
    impact: ImpactResult | None = Field(description="null where it would be too long")


class StickingResult(Answer):
    """Dry friction that sticks as long as the magnitude of what holds is no more than the largest holding force."""

    load: str = Field(examples=["friction"])
    holding: Formula
    largest: Formula


class HeldReactionResult(Answer):
    """What holds something that was released while dry friction sticks, or while a contact rests."""

    kind: Literal["friction", "contact"]
    name: str = Field(description="of the load with friction, or of the event")
    reaction: Formula | None = Field(description="Z then; null where it would be too long, or constraints take part")


class ReactionImpulseResult(Answer):
    """What holds something that was released at an impact."""

    event: str
    impulse: Formula = Field(description="by the rates before it; its unit is that of the reaction times s")


class ReactionResult(Answer):
    """What holds a length, an angle, a guided coordinate or a displacement that was released in thought: δW = Z δl."""

    name: str = Field(examples=["l"])
    kind: HoldKind
    reaction: Formula = Field(description="Z, in the direction in which it grows: negative where a rod pulls")
    closed: bool = Field(description="whether no accelerations are left in it")
    force: Formula | None = Field(description="of a rod or string, its force −Z, positive in tension")
    at: str | None = Field(None, description="the end of a rod with mass at which that is its force")
    displacements: dict[str, tuple[str, ...]] = Field(
        {}, description="∂r/∂l of the places that it moves, as plain text: F·∂r/∂l = Z of a force F at one of them"
    )
    held: tuple[HeldReactionResult, ...] = Field(
        (), description="where `reaction` is that of slipping and of open contacts: what it is while one holds"
    )
    impulses: tuple[ReactionImpulseResult, ...] = ()
    shared_with: tuple[str, ...] = Field(
        (), description="loads with friction that may hold it as well: `reaction` is what they exert together"
    )


class Releasable(Answer):
    """What a scene holds fixed, so that `release` can ask what holds it."""

    name: str = Field(examples=["l"])
    kind: HoldKind
    latex: str
    spoken: str = Field("", description="the same in words")


class Curl(Formula):
    """∂Qᵢ/∂qₖ − ∂Qₖ/∂qᵢ for a pair of coordinates."""

    coordinates: tuple[str, str]


class LoadPotential(Answer):
    """Whether a load has a potential, by the curl of its generalized forces."""

    load: str = Field(examples=["weight"])
    outcome: CurlOutcome = Field(description="of the test, in a word", examples=["conservative"])
    has_potential: bool
    potential: Formula | None = Field(description="null where there is none, or none that can be written down")
    curl: tuple[Curl, ...]


class RouthFunction(Formula):
    """L − Σ p q̇ over the cyclic coordinates, whose constant momenta it holds instead of their rates."""

    momenta: dict[str, str] = Field(description="names of the momenta, by coordinate", examples=[{"psi": "p_psi"}])


class InitialState(Answer):
    """Where a coordinate starts."""

    value: float
    rate: float


class RelativeEquilibrium(Answer):
    """A motion in which cyclic coordinates run evenly while another one rests, where the scene starts."""

    step: str = Field(description="id of the step that shows it", examples=["relative-equilibrium:1"])
    resting: str = Field(description="the coordinate that rests", examples=["theta"])
    turning: str = Field(description="the cyclic coordinate whose rate holds it", examples=["psi"])
    rate: EquilibriumValue = Field(description="of the turning coordinate")
    stability: Stability = Field(description="for fixed momenta")
    eigenfrequency: float | None = Field(description="of small oscillations about it in rad/s, where it is stable")
    initial: dict[str, InitialState] = Field(description="what starts it, by coordinate")


class OwnSymbol(Answer):
    """A name in the results that the scene does not have."""

    name: str = Field(examples=["p_psi"])
    latex: str
    spoken: str = Field("", description="the same in words")
    kind: Literal["momentum"]
    coordinate: str


class Mode(Answer):
    """A small motion in which all coordinates swing together, or run away."""

    eigenfrequency_squared: float = Field(description="in 1/s², negative where the motion grows")
    shape: dict[str, float] = Field(description="ratio of the amplitudes, by coordinate")


class ComplexMode(Answer):
    """Re(a e^λt) with λ = −decay + i·eigenfrequency."""

    eigenfrequency: float = Field(description="in rad/s")
    decay: float = Field(description="in 1/s, negative where the motion grows")
    shape: dict[str, tuple[float, float]] = Field(description="a as [real, imaginary], by coordinate")


class EquilibriumValue(Formula):
    """Where a coordinate rests."""

    number: float = Field(description="the value in this scene")


class Inequality(Answer):
    """smaller < larger."""

    smaller: Formula
    larger: Formula


class Conditions(Answer):
    """For which parameters an equilibrium exists, and for which its stability is what it was found to be.

    An empty list: for all that make sense.
    """

    existence: tuple[Inequality, ...]
    stability: tuple[Inequality, ...]


class Band(Answer):
    """Between which values dry friction holds the coordinate at rest."""

    low: EquilibriumValue
    high: EquilibriumValue


class Equilibrium(Answer):
    """A state of rest, and the small motions about it; frequencies in rad/s."""

    values: dict[str, EquilibriumValue] = Field(description="a coordinate that is missing may have any value")
    multipliers: dict[str, EquilibriumValue] = Field(
        {}, description="with constraints, the multipliers that hold the system there"
    )
    exact: bool = Field(description="whether the values are closed forms in the parameters")
    free: tuple[str, ...] = Field(
        description="coordinates that may have any value; where they are among the values, this stands for a family"
    )
    stability: Stability
    kind: StabilityKind | None = Field(description="what the linearization leaves open")
    conditions: Conditions | None = Field(description="null where the verdict holds at the scene's values only")
    band: Band | None = Field(description="where dry friction holds the system")
    eigenvalues: tuple[tuple[float, float], ...] = Field(
        description="[real, imaginary] in 1/s; none, and no modes, where a number of them is beyond double precision"
    )
    eigenfrequencies: tuple[float, ...]
    modes: tuple[Mode, ...] = Field(description="where no force depends on rates")
    complex_modes: tuple[ComplexMode, ...] = Field(description="elsewhere")


class ContactReaction(Answer):
    """A closed contact and its reaction, the factor of ∂g/∂q: positive, as it can only act towards opening."""

    contact: str = Field(examples=["impact"])
    reaction: EquilibriumValue


class ContactEquilibrium(Answer):
    """A state of rest on closed contacts, whose reactions balance the other forces."""

    values: dict[str, EquilibriumValue] = Field(description="a coordinate that is missing may have any value")
    contacts: tuple[ContactReaction, ...]
    multipliers: dict[str, EquilibriumValue] = Field({}, description="of constraints, which hold the system as well")
    exact: bool = Field(description="whether the values are closed forms in the parameters")
    free: tuple[str, ...] = Field(
        description="coordinates that may have any value; where they are among the values, this stands for a family"
    )
    stability: Stability


class ForcesBeside(Answer):
    """The least force that acts below a kink, and the largest above it, as what rests there begins to move."""

    below: EquilibriumValue
    above: EquilibriumValue


class KinkEquilibrium(Answer):
    """A state of rest where a force jumps from one sign to the other, as at the minimum of |x|."""

    values: dict[str, EquilibriumValue] = Field(description="a coordinate that is missing may have any value")
    switches: tuple[Formula, ...] = Field(description="what is zero there, and changes a force with its sign")
    forces: ForcesBeside | None = Field(description="of one coordinate")
    shares: tuple[EquilibriumValue, ...] = Field(
        description="of several: what balances the forces in the place of each sign, from -1 to 1"
    )
    contacts: tuple[str, ...] = Field(description="that are closed there")
    exact: bool = Field(description="whether the values are closed forms in the parameters")
    free: tuple[str, ...] = Field(description="coordinates that may have any value")
    stability: Stability


class EndOfRest(EquilibriumValue):
    """Where a range of rest ends."""

    at: RangeEnd = Field(description="where a force exceeds friction, or jumps or bends, or at a contact")


class RestRange(Answer):
    """A range in which the coordinate rests anywhere; null where there is no end to it."""

    coordinate: str = Field(examples=["x"])
    low: EndOfRest | None
    high: EndOfRest | None
    friction: bool = Field(description="whether dry friction holds it; else no force acts there")


class EquilibriumSearch(Answer):
    """Whether these are all positions of rest, those on closed contacts, at kinks and in ranges included."""

    complete: bool
    count: int = Field(description="how many there are with all contacts open; the first 32 are listed")
    range: dict[str, tuple[float, float]] = Field(
        description="coordinates that were searched between two values; angles go once around, others are unbounded"
    )
    left_out: SearchEnd | None = Field(description="why it is not complete")


class DerivationResult(Answer):
    """The results, as expressions in the names of the scene."""

    degrees_of_freedom: int = Field(
        examples=[2], description="free coordinates less independent constraints, of the scene with its changes"
    )
    positions: dict[str, VectorFormula] = Field(description="by body")
    points: dict[str, VectorFormula] = Field(description="by point")
    virtual_displacements: dict[str, VectorFormula] = Field(description="by body")
    virtual_work: Sum
    kinetic_energy: Sum
    potential_energy: Sum
    generalized_forces: GeneralizedForces
    loads: tuple[LoadPotential, ...]
    lagrangian: Sum
    equations: tuple[CoordinateSum, ...]
    mass_matrix: MassMatrix
    forcing: Forcing
    conserved: tuple[ConservedQuantity, ...]
    equilibria: tuple[Equilibrium, ...]
    contact_equilibria: tuple[ContactEquilibrium, ...] = ()
    kink_equilibria: tuple[KinkEquilibrium, ...] = ()
    rest_ranges: tuple[RestRange, ...] = Field((), description="of scenes with one degree of freedom")
    equilibrium_search: EquilibriumSearch | None = Field(description="null where the laws depend on time")
    symmetry_search: SymmetrySearch
    jacobi_energy: JacobiEnergy
    routh: RouthFunction | None = Field(description="where a coordinate is cyclic")
    relative_equilibria: tuple[RelativeEquilibrium, ...]
    symbols: tuple[OwnSymbol, ...]
    constraints: tuple[ConstraintResult, ...] = ()
    contacts: tuple[ContactResult, ...] = ()
    sticking: tuple[StickingResult, ...] = ()
    reactions: tuple[ReactionResult, ...] = Field((), description="of what the request released")
    releasable: tuple[Releasable, ...] = Field((), description="what may be released")
