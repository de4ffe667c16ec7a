"""The driver: which formulation, then its steps, then their verification."""

from __future__ import annotations

from difflib import get_close_matches

from ..errors import Problem, UnknownNameError
from ..mechanics.scene import Scene
from ..packages import modules_of
from .step import Derivation
from .system import System
from .verification import verified

FORMULATIONS = "deltaq.derivation.formulations"
USUAL = "dalembert-lagrange"  # if none is asked for


def formulation_names() -> tuple[str, ...]:
    """Names of all formulations there are."""
    return tuple(module.FORMULATION for module in modules_of(FORMULATIONS))


def derive(scene: Scene, formulation: str = USUAL) -> tuple[System, Derivation]:
    """The derivation of a scene, every step verified. Raises UnknownNameError for an unknown formulation."""
    check_formulation(formulation)
    road = next(module for module in modules_of(FORMULATIONS) if formulation == module.FORMULATION)
    system = System(scene)
    return system, verified(road.derive(system), system)


def check_formulation(formulation: str) -> None:
    """Raises UnknownNameError if there is no such formulation."""
    roads = formulation_names()
    if formulation not in roads:
        near = get_close_matches(formulation, roads, n=1)
        parameters = {"name": formulation[:40], "known": ", ".join(roads), "suggestion": near[0] if near else ""}
        raise UnknownNameError(Problem("unknown-formulation", "/formulation", parameters=parameters))
