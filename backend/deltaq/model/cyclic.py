"""Cyclic coordinates of a scene, by its numeric model's expressions.

A coordinate is cyclic if nothing depends on it, no force works on it, and no other force depends on its rate; then its
momentum p = ∂E/∂q̇ is conserved. Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.2.
"""

from __future__ import annotations

from ..mechanics.scene import Scene
from .equations import Equations, equations
from .phase import vanishes


def cyclic_coordinates(scene: Scene) -> tuple[str, ...]:
    """The free coordinates that are cyclic, in their order."""
    eqs = equations(scene)
    return tuple(name for index, name in enumerate(eqs.symbols.free) if _is_cyclic(eqs, index, name))


def _is_cyclic(eqs: Equations, index: int, name: str) -> bool:
    value, rate = eqs.symbols.values[name], eqs.symbols.rates[name]
    entries = [entry for row in eqs.mass_matrix for entry in row]
    untouched = [*entries, *eqs.forcing, eqs.kinetic]
    slopes = [*(each.diff(value) for each in untouched), *(force.diff(rate) for force in eqs.forces)]
    return vanishes(eqs.forces[index]) and all(map(vanishes, slopes))
