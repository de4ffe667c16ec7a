"""Which way the axes of a scene point and where they begin, in words: without that no component has a sign."""

from __future__ import annotations

from ..mechanics.scene import Scene
from ..narration.catalog import text
from ..narration.prose import CatalogText, joined
from ..narration.things import called


def axes_text(scene: Scene, language: str) -> CatalogText:
    """A sentence on the axes, and the origin where a labelled point stands in it."""
    direction = text(language, f"homework.axes.{scene.dimension}-{scene.drawing.vertical}")
    at_zero = [point.name for point in scene.points if all(part.text.strip() == "0" for part in point.position)]
    origin = next((called(scene, name, language) for name in at_zero if name in scene.labels), None)
    parts = [direction, text(language, "homework.axes.origin", place=origin)] if origin else [direction]
    return joined("", [joined("; ", parts), "."])
