"""A stiff spring taken to be rigid: it keeps the length that it has at rest.

The fast oscillation, of frequency √(k/m), is gone, and with it one degree of freedom; the error of what is left falls
like 1/k. Source: Landau, Lifshitz, Mechanics, §11 (rigid constraints); Hairer, Lubich, Wanner, Geometric Numerical
Integration, 2nd ed., XIV.3 (stiff springs and their rigid limit).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from ....language.expression import Expression
from ....language.tree import Node
from ....mechanics.changes import change
from ....mechanics.coordinate import Coordinate
from ....mechanics.guide import Guide
from ....mechanics.loads import Load
from ....mechanics.parameter import Parameter
from ....mechanics.scene import Scene
from ....model.compiled import compile_expressions
from ....model.dependence import dependencies, solved
from ....model.elimination import eliminated
from ....model.symbols import Symbols
from ....model.symengine_algebra import to_symengine
from ....simulation.problem import Floats
from ..findings import Part
from ..names import fresh, tidied, with_parameters
from ..simplification import Back, Kind, Motion, SimplificationContext, Simplified
from ..stretch import length

AHEAD = 1e-3  # of the time between two samples


def _offered(context: SimplificationContext) -> Iterator[Part]:
    if context.centre and len(context.scene.free) > 1:
        names = (load.name for load in context.scene.loads if next(_ways(load, context), None))
        yield from (Part("rigid", {"load": name}) for name in names)


def _simplify(context: SimplificationContext, part: Part) -> Simplified:
    load = next(load for load in context.scene.loads if load.name == part.parameters["load"])
    return next(_ways(load, context)).simplified(context)


class _Way(Protocol):
    def simplified(self, context: SimplificationContext, /) -> Simplified: ...


@dataclass(frozen=True)
class _Held:
    """The length depends on one coordinate alone, which keeps its value at rest."""

    coordinate: str

    def simplified(self, context: SimplificationContext) -> Simplified:
        scene, name = context.scene, self.coordinate
        at_rest = tuple(_at(context, each) if each.name == name else each for each in scene.coordinates)
        return Simplified(change(replace(scene, coordinates=at_rest), freeze=(name,)))


def _at(context: SimplificationContext, coordinate: Coordinate) -> Coordinate:
    """The coordinate at rest from the start."""
    return replace(coordinate, value=context.centre[coordinate.name], rate=0.0, min=None, max=None)


@dataclass(frozen=True)
class _GivenUp:
    """A coordinate is what the others and the length at rest, the parameter `target`, make it."""

    length: Node
    coordinate: str
    target: str
    value: Expression

    def simplified(self, context: SimplificationContext) -> Simplified:
        """A guide where the time alone is left, else the coordinate is put in everywhere."""
        scene, name = context.scene, self.coordinate
        unit = next(each.unit for each in scene.coordinates if each.name == name)
        rest = Parameter(self.target, unit=unit, value=_at_rest(context, self.length), positive=False)
        wider = with_parameters(scene, (rest,))
        if not dependencies(wider, self.value.tree) & {each.name for each in scene.free}:
            return Simplified(replace(wider, guides=(*wider.guides, Guide(name, self.value))))
        found = eliminated(wider, name, self.value)
        return Simplified(tidied(found, wider.labels), _back(wider, name, self.value))


def _ways(load: Load, context: SimplificationContext) -> Iterator[_Way]:
    """How the spring of a load can be made rigid."""
    scene = context.scene
    found = length(load, scene)
    if found is None:
        return
    depends = dependencies(scene, found)
    free = [each.name for each in scene.free if each.name in depends]
    if depends == set(free) and len(free) == 1 and free[0] in context.centre:
        yield _Held(free[0])
    target = fresh(scene, "s_rest")
    wider = with_parameters(scene, (Parameter(target),))
    for name in free:
        value = solved(wider, found, name, target)
        if value is not None:
            yield _GivenUp(found, name, target, value)


def _at_rest(context: SimplificationContext, length: Node) -> float:
    """The length at rest, the mean where guides move its ends."""
    scene, mean = context.scene, context.mean
    known = {each.name: context.centre.get(each.name, each.value) for each in scene.coordinates}
    values = scene.parameter_values | known | {"t": mean.times}
    guided = {each.coordinate: _sampled(each.value.tree, values) for each in scene.guides}
    return float(mean.weights @ _sampled(length, values | guided))


def _sampled(node: Node, values: Mapping[str, Floats | float]) -> Floats:
    """An expression at all samples; what does not change is one number. NaN where it is not defined."""
    names = tuple(name for name in values if name != "t")
    symbols = Symbols((), (), names)
    found = compile_expressions([symbols.values[name] for name in (*names, "t")], [to_symengine(node, symbols)])
    rows = np.broadcast_arrays(*(values[name] for name in (*names, "t")))
    return np.asarray(found.table(np.column_stack(rows))[:, 0])


def _back(scene: Scene, name: str, value: Expression) -> Back:
    """The coordinate that was given up, from the others; its rate by a difference along the motion."""
    constants = scene.parameter_values

    def at(motion: Motion, ahead: float) -> Floats:
        moved = {key: motion.values[key] + ahead * motion.rates[key] for key in motion.values}
        return _sampled(value.tree, constants | moved | {"t": motion.times + ahead})

    def back(motion: Motion) -> Motion:
        step = AHEAD * float(np.ptp(motion.times[:2])) or AHEAD
        rate = (at(motion, step) - at(motion, -step)) / (2 * step)
        values, rates = {**motion.values, name: at(motion, 0.0)}, {**motion.rates, name: rate}
        return Motion(motion.times, values, rates)

    return back


KIND = Kind("rigid", _offered, _simplify, ("linearized",))
