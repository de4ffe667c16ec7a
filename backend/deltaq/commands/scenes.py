"""`deltaq scenes`: what there is to derive."""

from __future__ import annotations

import argparse

from ._common import language_argument

HELP = "list the built-in scenes"
DESCRIPTION = "Lists the built-in scenes: id, degrees of freedom, title."
EXAMPLE = "deltaq scenes --lang de"


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    language_argument(parser)


def run(options: argparse.Namespace) -> None:
    """One line for each scene."""
    from ..mechanics.library import load_scene, scene_ids
    from ..mechanics.user_text import in_language

    width = max(map(len, scene_ids()))
    for identifier in scene_ids():
        scene = load_scene(identifier)
        print(f"{identifier:{width}}  {scene.degrees_of_freedom}  {in_language(scene.title, options.lang).line}")
