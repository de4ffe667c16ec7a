"""The driver: which formulation, then its steps, then their verification."""

from __future__ import annotations

from dataclasses import replace
from difflib import get_close_matches

from ..errors import Problem, UnknownNameError
from ..mechanics.scene import Scene
from ..packages import modules_of
from . import model_chapter
from .grounds import Grounds
from .normal_algebra import NormalAlgebra
from .step import Chapter, Derivation
from .system import System
from .verification import SAMPLED, verified

FORMULATIONS = "deltaq.derivation.formulations"
USUAL = "dalembert-lagrange"  # if none is asked for


def formulation_names() -> tuple[str, ...]:
    """Names of all formulations there are."""
    return tuple(module.FORMULATION for module in modules_of(FORMULATIONS))


def derive(scene: Scene, formulation: str = USUAL, *, canonical: bool = False) -> tuple[System, Derivation]:
    """The derivation of a scene, every step verified and with its grounds. UnknownNameError: no such formulation.

    `canonical` adds the chapter of Hamilton's canonical equations.
    """
    check_formulation(formulation)
    wanted = next(module for module in modules_of(FORMULATIONS) if formulation == module.FORMULATION)
    system = System(scene)
    told = wanted.derive(system)
    if canonical:
        told = replace(told, chapters=(*told.chapters, Chapter("canonical", tuple(model_chapter.canonical(system)))))
    return system, _grounds(system).of(verified(told, system))


def _grounds(system: System) -> Grounds:
    """How steps of a scene are told: normal forms prove what they say.

    Only the second algebra knows that variations vanish at both ends: a term that is zero there is one all the same.
    """
    plain = NormalAlgebra(system.coordinates)
    held = frozenset((f"delta({q})", end) for q in system.coordinates for end in system.ends)
    fixed = NormalAlgebra(system.coordinates, held, plain.reader)
    return Grounds(plain, lambda relation: plain.holds(relation) or fixed.holds(relation), SAMPLED)


def check_formulation(formulation: str) -> None:
    """Raises UnknownNameError if there is no such formulation."""
    known = formulation_names()
    if formulation not in known:
        near = get_close_matches(formulation, known, n=1)
        parameters = {"name": formulation[:40], "known": ", ".join(known), "suggestion": near[0] if near else ""}
        raise UnknownNameError(Problem("unknown-formulation", "/formulation", parameters=parameters))
