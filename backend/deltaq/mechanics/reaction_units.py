"""Units of reactions: λ ∂g/∂qᵢ works through δqᵢ, so λ by the unit of its condition is an energy, or a power.

It is a power where the condition is on the rates; what holds a coordinate or a length works through that.
"""

from __future__ import annotations

from fractions import Fraction

from .event import Event
from .homogeneity import SECOND, DimensionCheck
from .scene import Scene
from .units import UNITS, Dimension, dimension_of

ENERGY = UNITS["J"]


def units_of(scene: Scene) -> dict[str, Dimension | None]:
    """The dimension of every name of a scene; None where it states no unit."""
    units = {c.name: dimension_of(c.unit) for c in scene.coordinates} | {"t": dimension_of("s")}
    return units | {p.name: dimension_of(p.unit) for p in scene.parameters}


def reaction_unit(scene: Scene, name: str) -> str:
    """The unit of a multiplier, or of what holds the coordinate or parameter of this name, as `N` or `N m`.

    "" where the scene states too few units.
    """
    return _unit(_works_through(scene, name, units_of(scene)), units_of(scene))


def contact_unit(scene: Scene, event: Event) -> str:
    """The unit of the force of a contact, which works through its gap; "" where the scene states too few units."""
    units = units_of(scene)
    found = DimensionCheck(units, "", []).of(event.value.tree)
    return _unit(found if isinstance(found, Dimension) else None, units)


def _unit(works_through: Dimension | None, units: dict[str, Dimension | None]) -> str:
    if works_through is None or not any(unit.mass for unit in units.values() if unit is not None):
        return ""
    return _by_newtons(ENERGY.times(works_through.to(Fraction(-1))))


def _works_through(scene: Scene, name: str, units: dict[str, Dimension | None]) -> Dimension | None:
    for symbol, condition in zip(scene.multipliers, scene.conditions, strict=True):
        if symbol.name == name:
            found = DimensionCheck(units, "", []).of(condition.value)
            if not isinstance(found, Dimension):
                return None
            return found if condition.is_holonomic else found.times(SECOND)
    return units.get(name)


def _by_newtons(dimension: Dimension) -> str:
    """A force times powers of metre and second: N, N m, N/m, N s …; "" for anything else."""
    if dimension.mass != 1 or dimension.current or dimension.scale != 1.0:
        return ""
    powers = {"m": dimension.length - 1, "s": dimension.time + 2}
    above = [_raised(unit, power) for unit, power in powers.items() if power > 0]
    below = [_raised(unit, -power) for unit, power in powers.items() if power < 0]
    return "/".join([" ".join(["N", *above]), *below])


def _raised(unit: str, power: Fraction) -> str:
    return unit if power == 1 else f"{unit}^{power}"
