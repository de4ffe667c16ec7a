"""What a derivation leads to: every expression as plain text and as LaTeX, sums term by term."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .base import Answer


class Term(Answer):
    """A term of a sum, and where it comes from."""

    plain: str = Field(examples=["m*l^2*ddot(phi)"])
    latex: str
    sources: tuple[str, ...] = Field(description="bodies and loads", examples=[["body:bob"]])


class Formula(Answer):
    """An expression that programs read, and one for people."""

    plain: str = Field(examples=["m*l^2*dot(phi)^2/2"])
    latex: str


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


class Forcing(VectorFormula):
    """f of M(q, t) q̈ = f(q, q̇, t)."""

    terms: tuple[tuple[Term, ...], ...]


class MassMatrix(Answer):
    """M of M(q, t) q̈ = f(q, q̇, t), by rows."""

    plain: tuple[tuple[str, ...], ...] = Field(examples=[[["l^2*m"]]])
    latex: str
    terms: tuple[tuple[tuple[Term, ...], ...], ...]


class GeneralizedForces(Answer):
    """Q and its split into the part that has a potential and the rest."""

    total: tuple[CoordinateSum, ...]
    conservative: tuple[CoordinateSum, ...]
    nonconservative: tuple[CoordinateSum, ...]


class ConservedQuantity(Sum):
    """What does not change along the motion."""

    kind: Literal["momentum", "energy"]
    coordinate: str = Field(description="of a momentum; else empty")


class JacobiEnergy(Sum):
    """Σ q̇ ∂L/∂q̇ − L."""

    equals_energy: bool = Field(description="whether it is kinetic + potential energy")


class EquilibriumValue(Formula):
    """Where a coordinate rests."""

    number: float = Field(description="the value in this scene")


class Equilibrium(Answer):
    """A state of rest, and the small motions about it; frequencies in rad/s."""

    values: dict[str, EquilibriumValue] = Field(description="a coordinate that is missing may have any value")
    exact: bool = Field(description="whether the values are closed forms in the parameters")
    stability: str
    eigenvalues: tuple[tuple[float, float], ...] = Field(description="[real, imaginary] in 1/s")
    eigenfrequencies: tuple[float, ...]


class DerivationResult(Answer):
    """The results, as expressions in the names of the scene."""

    positions: dict[str, VectorFormula] = Field(description="by body")
    points: dict[str, VectorFormula] = Field(description="by point")
    virtual_displacements: dict[str, VectorFormula] = Field(description="by body")
    virtual_work: Sum
    kinetic_energy: Sum
    potential_energy: Sum
    generalized_forces: GeneralizedForces
    lagrangian: Sum
    equations: tuple[CoordinateSum, ...]
    mass_matrix: MassMatrix
    forcing: Forcing
    conserved: tuple[ConservedQuantity, ...]
    equilibria: tuple[Equilibrium, ...]
    jacobi_energy: JacobiEnergy
