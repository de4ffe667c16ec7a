"""What a quantity can be asked of in a scene: its bodies, its coordinates, the scene as a whole (""), or nothing."""

from __future__ import annotations

from .equality import frequencies
from .road import Road


def bodies(road: Road) -> list[str]:
    """Each body."""
    return [body.name for body in road.scene.bodies]


def coordinates(road: Road) -> tuple[str, ...]:
    """Each free coordinate."""
    return road.free


def whole(_road: Road) -> tuple[str, ...]:
    """The scene as a whole."""
    return ("",)


def loaded(road: Road) -> tuple[str, ...]:
    """The scene, if loads act on it."""
    return ("",) if road.load_names else ()


def with_potential(road: Road) -> tuple[str, ...]:
    """The scene, if a load has a potential."""
    return ("",) if any(map(road.is_conservative, road.load_names)) else ()


def coupled(road: Road) -> tuple[str, ...]:
    """The scene, if it has several degrees of freedom."""
    return ("",) if len(road.free) > 1 else ()


def resting(road: Road) -> tuple[str, ...]:
    """Each free coordinate, if the scene has a position of rest."""
    return road.free if road.rest is not None else ()


def oscillating(road: Road) -> tuple[str, ...]:
    """The scene, if it oscillates about a position of rest."""
    return ("",) if road.rest is not None and _positive(road) else ()


def _positive(road: Road) -> bool:
    return bool(road.frequencies) and all(frequencies.number_of(each, road) > 1e-9 for each in road.frequencies)


def numbered(road: Road) -> list[str]:
    """Each conserved quantity, by its number."""
    return [str(n) for n, _ in enumerate(road.conserved_of, 1)]
