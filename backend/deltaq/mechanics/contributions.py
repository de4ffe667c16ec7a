"""What loads come down to: every load is a sum of these few, and the laws need to know only these."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Node
from .material import Material


@dataclass(frozen=True)
class PointForce:
    """A force F at a place: δW = F · δr. `source` is the name of the load it comes from."""

    source: str
    place: str
    force: tuple[Node, ...]


@dataclass(frozen=True)
class Moment:
    """A moment M about the axis of an angle φ(q, t): δW = M δφ."""

    source: str
    angle: Node
    moment: Node


@dataclass(frozen=True)
class PotentialEnergy:
    """A potential V(q, t): δW = −δV, with the time frozen."""

    source: str
    energy: Node


@dataclass(frozen=True)
class GeneralizedPotential:
    """A potential U(q, q̇, t), linear in the rates: δW = (d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ) δqᵢ."""

    source: str
    energy: Node


@dataclass(frozen=True)
class DissipationFunction:
    """Rayleigh's function R(q, q̇, t): δW = −∂R/∂q̇ᵢ δqᵢ."""

    source: str
    function: Node


@dataclass(frozen=True)
class Friction:
    """Coulomb friction against the motion of c(q, t) over a surface: δW = −F sgn(ċ − u) δc, and less where it sticks.

    `force` is F while it slips, `static` the most it holds with, `surface_rate` the rate u(t) of the surface.
    """

    source: str
    coordinate: Node
    force: Node
    static: Node
    surface_rate: Node


@dataclass(frozen=True)
class DistributedForce:
    """A force density f over material coordinates: δW = ∫ f · δr d(material). `place` is a body, or the load itself."""

    source: str
    place: str
    density: tuple[Node, ...]
    position: tuple[Node, ...]
    material: tuple[Material, ...]


Contribution = (
    PointForce | Moment | PotentialEnergy | GeneralizedPotential | DissipationFunction | Friction | DistributedForce
)
