"""What loads come down to: every load is a sum of these few, and the laws need to know only these."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Node


@dataclass(frozen=True)
class PointForce:
    """A force F at a place: δW = F · δr. `source` is the name of the load it comes from."""

    source: str
    place: str
    force: tuple[Node, ...]


@dataclass(frozen=True)
class PotentialEnergy:
    """A potential V(q, t): δW = −δV, with the time frozen."""

    source: str
    energy: Node


Contribution = PointForce | PotentialEnergy
