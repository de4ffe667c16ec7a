"""What bodies come down to: every kinetic energy is a sum of these few, and the laws need to know only these."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..language.tree import Node, Number
from .material import Material

PAIRS = ((0, 1), (0, 2), (1, 2))  # axes, in the order of products of inertia


@dataclass(frozen=True)
class Translation:
    """E = m/2 v·v of a mass m at r(q, t)."""

    body: str
    mass: Node
    position: tuple[Node, ...]


@dataclass(frozen=True)
class Rotation:
    """E = 1/2 Σ Jₖₗ ωₖ ωₗ; in the plane there is one J, and ω is the rate of an angle.

    The moments Jₖₖ of a body in space are its `inertia`, J₁₂ J₁₃ J₂₃ its `products`, which principal axes have none of.
    Source: Landau, Lifshitz, Mechanics, 3rd ed., §32.
    """

    body: str
    inertia: tuple[Node, ...]
    angular_velocity: tuple[Node, ...]
    products: tuple[Node, ...] = ()

    @property
    def entries(self) -> tuple[tuple[int, int, Node], ...]:
        """k, l and Jₖₗ for k ≤ l, without products of inertia that are the number 0."""
        moments = tuple((k, k, moment) for k, moment in enumerate(self.inertia))
        pairs = zip(PAIRS, self.products, strict=True) if self.products else ()
        return moments + tuple((k, l, product) for (k, l), product in pairs if product != Number(Fraction(0)))


@dataclass(frozen=True)
class Distribution:
    """E = ∫ 1/2 v·v dm with dm = density · d(material), over all material coordinates."""

    body: str
    density: Node
    position: tuple[Node, ...]
    material: tuple[Material, ...]


Kinetics = Translation | Rotation | Distribution
