"""What bodies come down to: every kinetic energy is a sum of these few, and the laws need to know only these."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Node
from .material import Material


@dataclass(frozen=True)
class Translation:
    """E = m/2 v·v of a mass m at r(q, t)."""

    body: str
    mass: Node
    position: tuple[Node, ...]


@dataclass(frozen=True)
class Rotation:
    """E = 1/2 Σ Jₖ ωₖ² about principal axes; in the plane there is one, and ω is the rate of an angle."""

    body: str
    inertia: tuple[Node, ...]
    angular_velocity: tuple[Node, ...]


@dataclass(frozen=True)
class Distribution:
    """E = ∫ 1/2 v·v dm with dm = density · d(material), over all material coordinates."""

    body: str
    density: Node
    position: tuple[Node, ...]
    material: tuple[Material, ...]


Kinetics = Translation | Rotation | Distribution
