"""What simplifications are made of and from."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from ...mechanics.scene import Scene
from ...simulation.problem import Floats
from .findings import Part
from .mean import Mean


@dataclass(frozen=True)
class Motion:
    """A motion of a scene at `times`, shape (samples,): all coordinates, the guided ones among them.

    `values` and `rates` are q and q̇ by name, shape (samples,) each.
    """

    times: Floats
    values: Mapping[str, Floats]
    rates: Mapping[str, Floats]

    def until(self, count: int) -> Motion:
        """The first samples of it."""
        parts = ({name: values[:count] for name, values in part.items()} for part in (self.values, self.rates))
        return Motion(self.times[:count], *parts)


@dataclass(frozen=True)
class SimplificationContext:
    """A scene with its initial values, and what is known of rest nearby.

    `centre` holds the values of its coordinates at rest; in steady motion, of those that are not cyclic; it is empty
    where there is neither. `mean` is how to average over time what guides bring in. `motion` is that of the full scene.
    """

    scene: Scene
    centre: Mapping[str, float]
    mean: Mean
    motion: Motion

    def with_scene(self, scene: Scene) -> SimplificationContext:
        """The same with another scene."""
        return replace(self, scene=scene)


Back = Callable[[Motion], Motion]


def as_it_is(motion: Motion) -> Motion:
    """The way back where the coordinates are the same."""
    return motion


@dataclass(frozen=True)
class Simplified:
    """The simpler scene, and the way back from its motion to that of the scene it was made from."""

    scene: Scene
    back: Back = as_it_is


@dataclass(frozen=True)
class Kind:
    """A kind of simplification: where it can be `offered` for a scene, how it is done, and the kinds that may follow.

    `simplify` raises InputError where the result is no scene. Kinds `of_constrained` scenes are for these alone, where
    coordinates cannot be moved at will, and the others for scenes without constraints.
    """

    id: str
    offered: Callable[[SimplificationContext], Iterator[Part]]
    simplify: Callable[[SimplificationContext, Part], Simplified]
    followers: tuple[str, ...] = ()
    of_constrained: bool = False
