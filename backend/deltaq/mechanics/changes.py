"""Changes that a request may apply to a scene before it is used."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..errors import InputError, Problem, SceneError, UnknownNameError, escaped
from ..language.expression import Expression
from ..language.names import Symbol
from ..language.parser import parse
from ..language.tree import Name
from .coordinate import Coordinate
from .guide import Guide
from .parameter import Parameter
from .scene import Scene


def change(
    scene: Scene,
    guides: Sequence[Mapping[str, str]] = (),
    freeze: Sequence[str] = (),
    parameters: Mapping[str, float] | None = None,
) -> Scene:
    """The scene with parameter values set, guides added and coordinates held constant.

    A parameter that the scene lacks is added if a guide is, so that `y := y0 sin(ωt)` can bring its y0 and ω along.
    Problems point into the request: /parameters/m, /guides/0/value, /freeze/1.
    """
    changed = _with_parameters(scene, parameters or {}, may_add=bool(guides))
    for index, guide in enumerate(guides):
        changed = _with_guide(changed, guide, f"/guides/{index}")
    for index, name in enumerate(freeze):
        changed = _frozen(changed, name, f"/freeze/{index}")
    return changed


def _with_parameters(scene: Scene, values: Mapping[str, float], *, may_add: bool) -> Scene:
    if not values:
        return scene  # and not a copy, of which everything would have to be found out anew
    known = {parameter.name: parameter for parameter in scene.parameters}
    for name, value in values.items():
        if name not in known and not may_add:
            parameters = {"name": name[:40], "known": ", ".join(known)}
            raise UnknownNameError(Problem("unknown-parameter", f"/parameters/{escaped(name)}", parameters=parameters))
        known[name] = _set(known.get(name), name, value)
    return replace(scene, parameters=tuple(known.values()))


def _set(parameter: Parameter | None, name: str, value: float) -> Parameter:
    """The parameter with its value; the slider's range gives way, the sign does not."""
    pointer = f"/parameters/{escaped(name)}"
    if not math.isfinite(value):
        raise SceneError(Problem("not-finite", pointer))
    try:
        if parameter is None:
            return Parameter(name, value=value, positive=value > 0)
        low = None if parameter.min is None else min(parameter.min, value)
        high = None if parameter.max is None else max(parameter.max, value)
        return replace(parameter, value=value, min=low, max=high)
    except SceneError as error:
        raise SceneError(*(replace(problem, pointer=pointer) for problem in error.problems)) from None


def _with_guide(scene: Scene, guide: Mapping[str, str], pointer: str) -> Scene:
    try:
        added = Guide(guide["coordinate"], parse(guide["value"], scene.stated_names))
    except InputError as error:
        raise SceneError(*(problem.below(f"{pointer}/value") for problem in error.problems)) from None
    return _guided(scene, added, pointer)


def _guided(scene: Scene, guide: Guide, pointer: str) -> Scene:
    if guide.coordinate not in {coordinate.name for coordinate in scene.free}:
        known = ", ".join(coordinate.name for coordinate in scene.free)
        parameters = {"name": guide.coordinate[:40], "known": known}
        raise UnknownNameError(Problem("unknown-coordinate", f"{pointer}/coordinate", parameters=parameters))
    if len(scene.free) == 1:
        raise SceneError(Problem("no-free-coordinate", pointer))
    try:
        return replace(scene, guides=(*scene.guides, guide))
    except SceneError as error:  # a constraint that it leaves without a coordinate is no mistake of the scene
        raise SceneError(*(_of_guide(pointer, problem) for problem in error.problems)) from None


def _of_guide(pointer: str, problem: Problem) -> Problem:
    return replace(problem, pointer=pointer) if problem.pointer.startswith("/constraints") else problem


def _frozen(scene: Scene, name: str, pointer: str) -> Scene:
    """Holds a coordinate at its initial value, which becomes a parameter: q := q₀."""
    coordinate = next((c for c in scene.free if c.name == name), None)
    if coordinate is None:
        known = ", ".join(c.name for c in scene.free)
        raise UnknownNameError(Problem("unknown-coordinate", pointer, parameters={"name": name[:40], "known": known}))
    constant = _constant(scene, coordinate)
    widened = replace(scene, parameters=(*scene.parameters, constant))
    return _guided(widened, Guide(name, Expression(constant.name, Name(constant.name))), pointer)


def _constant(scene: Scene, coordinate: Coordinate) -> Parameter:
    taken = {symbol.name for symbol in scene.names.symbols}
    name = next(n for k in range(len(taken) + 1) if (n := f"{coordinate.name}_{k}") not in taken)
    latex = f"{{{Symbol(coordinate.name, 'coordinate', coordinate.latex).typeset}}}_{{0}}"
    return Parameter(name, latex, coordinate.unit, coordinate.value, coordinate.min, coordinate.max, positive=False)
