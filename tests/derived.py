"""The library's scenes, derived once for all tests that read derivations; `tests/order.py` gives these one worker."""

from __future__ import annotations

from functools import cache
from typing import Any

from deltaq.derivation.engine import USUAL, derive
from deltaq.derivation.step import Derivation
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene
from deltaq.narration.derive import narrated


@cache
def derived(scene: str, formulation: str = USUAL) -> tuple[System, Derivation]:
    """A scene's derivation; nobody may change it."""
    return derive(load_scene(scene), formulation)


@cache
def told(scene: str, language: str, formulation: str = USUAL) -> dict[str, Any]:
    """The answer of `POST /derivations`; nobody may change it."""
    return narrated(*derived(scene, formulation), language)
