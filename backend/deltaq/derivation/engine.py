"""The driver: which formulation, then its steps, then their verification."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from difflib import get_close_matches
from types import MappingProxyType

from ..errors import Problem, UnknownNameError
from ..mechanics.scene import Scene
from ..packages import modules_of
from . import model_chapter
from .grounds import Grounds
from .held_reactions import held_reactions, reaction_impulses
from .normal_algebra import NormalAlgebra
from .released import Release
from .rules import held_reaction, reaction, reaction_equation, reaction_impulse
from .rules import release as release_rule
from .step import Chapter, Derivation, Step
from .system import System
from .verification import SAMPLED, random_points, verified_step

Steps = Mapping[str, Callable[[System], Iterator[Step]]]  # the chapters in their order
FORMULATIONS = "deltaq.derivation.formulations"
ON_REQUEST: Steps = MappingProxyType({"canonical": model_chapter.canonical})  # only on request
USUAL = "dalembert-lagrange"  # if none is asked for


def formulation_names() -> tuple[str, ...]:
    """Names of all formulations there are."""
    return tuple(module.FORMULATION for module in modules_of(FORMULATIONS))


def derive(scene: Scene, formulation: str = USUAL, *, canonical: bool = False) -> tuple[System, Derivation]:
    """The derivation of a scene, every step verified and with its grounds. UnknownNameError: no such formulation.

    `canonical` adds the chapter of Hamilton's canonical equations.
    """
    system = System(scene)
    return system, Derivation(formulation, tuple(chapters(system, formulation, canonical=canonical)))


def chapters(system: System, formulation: str = USUAL, *, canonical: bool = False) -> Iterator[Chapter]:
    """The chapters one after the other, each when it is asked for: first those up to the equations of motion.

    Raises UnknownNameError if there is no such formulation.
    """
    by_name = _chapters(formulation)
    points, grounds = tuple(random_points(system)), _grounds(system)
    for name, steps in {**by_name, **(ON_REQUEST if canonical else {})}.items():
        told = tuple(verified_step(step, points) for step in steps(system))
        yield grounds.of_chapter(Chapter(name, told))


def reactions(release: Release) -> Chapter:
    """What holds a released length or coordinate, every step verified and with its grounds.

    They are those of the wider system; of steps of the scene itself only the ids are named. Ids of substeps that the
    scene has as well end in what is released.
    """
    wider = release.wider
    points, grounds = tuple(random_points(wider)), _grounds(wider)
    told = tuple(verified_step(_marked(step, release.name), points) for step in _reaction_steps(release))
    return grounds.of_chapter(Chapter("reactions", told))


def _reaction_steps(release: Release) -> Iterator[Step]:
    """Z, then what it is while something sticks or rests, and at impacts."""
    yield from (rule.apply(release) for rule in (release_rule, reaction_equation, reaction))
    yield from (held_reaction.apply(release, each) for each in held_reactions(release))
    yield from (reaction_impulse.apply(release, each) for each in reaction_impulses(release))


def _marked(step: Step, name: str) -> Step:
    substeps = (replace(each, subject=f"{each.subject}:{name}-released") for each in step.substeps)
    return step.with_substeps(*substeps)


def chapters_of_equations(formulation: str) -> int:
    """How many chapters lead to the equations of motion: all but the last. Raises UnknownNameError."""
    return len(_chapters(formulation)) - 1


def _chapters(formulation: str) -> Steps:
    check_formulation(formulation)
    found: Steps = next(module for module in modules_of(FORMULATIONS) if formulation == module.FORMULATION).CHAPTERS
    return found


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
