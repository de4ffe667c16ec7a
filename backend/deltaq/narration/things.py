"""What points, bodies and loads are called in a sentence."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ..mechanics.scene import Scene
from .catalog import catalog
from .prose import CatalogText, words

# What has no name is called by its kind, with a number where there are several: gravity, spring-2, particle2.
NAMELESS = re.compile(r"([a-z]+(?:_[a-z]+)*)-?(\d*)")


def called(scene: Scene, name: str, language: str) -> CatalogText:
    """The label in this language, or what happens at an event, else the word for the kind of what has no name, else
    the name.
    """
    happens = {event.name: event.title for event in scene.events}
    label = scene.labels.get(name, happens.get(name, {})).get(language)
    match = NAMELESS.fullmatch(name)
    kinds = catalog(language)["page"]
    word = kinds.get(f"kinds.{match[1].replace('_', '-')}") if match and isinstance(kinds, Mapping) else None
    return words(label or (f"{word} {match[2]}".strip() if match and word else name))
