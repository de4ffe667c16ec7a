"""Parameters that come and go with a simplification."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ...mechanics.drawing import Element
from ...mechanics.loads import Load
from ...mechanics.parameter import Parameter
from ...mechanics.scene import Scene
from ...mechanics.soundness import expressions
from ...mechanics.user_text import Translated


def fresh(scene: Scene, wanted: str) -> str:
    """A name that the scene does not use yet."""
    taken = {symbol.name for symbol in scene.names.symbols}
    cut = wanted[:28]
    return next(name for k in range(len(taken) + 1) if (name := f"{cut}_{k}" if k else cut) not in taken)


def with_parameters(scene: Scene, parameters: tuple[Parameter, ...]) -> Scene:
    """The scene with further parameters."""
    return replace(scene, parameters=(*scene.parameters, *parameters))


def with_loads(scene: Scene, loads: tuple[Load, ...]) -> Scene:
    """The scene with other loads, tidied."""
    return tidied(replace(scene, loads=loads, labels={}), scene.labels)


def tidied(scene: Scene, labels: Mapping[str, Translated]) -> Scene:
    """The scene with these labels, without what nothing refers to any more.

    Parameters go, labels, and drawings of loads and coordinates.
    """
    coordinates = {each.name for each in scene.coordinates}
    named = {*scene.places, *(load.name for load in scene.loads), *(body.name for body in scene.bodies)}
    elements = tuple(_drawn(each, named) for each in scene.drawing.elements if _has_its_own(each, named, coordinates))
    drawing = replace(scene.drawing, elements=elements)
    used = drawing.sizes.union(*(field.expression.names for field in expressions(scene)))
    return replace(
        scene,
        parameters=tuple(each for each in scene.parameters if each.name in used),
        labels={name: label for name, label in labels.items() if name in named},
        drawing=drawing,
    )


def _has_its_own(element: Element, named: set[str], coordinates: set[str]) -> bool:
    """Whether the coordinate it shows is still there, and, if it is an arrow, the force."""
    options = dict(element.options)
    is_arrow = element.kind == "force"
    return options.get("coordinate") in {None, *coordinates} and not (is_arrow and options.get("load") not in named)


def _drawn(element: Element, named: set[str]) -> Element:
    """A spring stays where it was drawn, even where its force has become part of another."""
    options = tuple((key, value) for key, value in element.options if key != "load" or value in named)
    return replace(element, options=options)
