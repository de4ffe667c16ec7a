"""The driver: which formulation, then its steps, then their verification."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace
from difflib import get_close_matches
from types import MappingProxyType

from ..errors import Problem, UnknownNameError
from ..mechanics.scene import Scene
from ..packages import modules_of
from . import model_chapter
from .effort import EQUATIONS_END, PARTS_END, STEPS_END, UNBOUNDED, Allowance
from .grounds import Grounds
from .held_reactions import held_reactions, reaction_impulses
from .impacts import bouncing, frictions
from .normal_algebra import NormalAlgebra
from .released import Release
from .rules import held_reaction, left_out, reaction, reaction_equation, reaction_impulse
from .rules import release as release_rule
from .step import Chapter, Derivation, Step
from .system import System
from .verification import SAMPLED, random_points, verified_step

Steps = Mapping[str, Callable[[System], Iterator[Step]]]  # the chapters in their order
EQUATIONS = "lagrange"  # the chapter of the equations of motion
LAST = "model"  # the chapter that the equations of motion do not need
BELONGING = frozenset({"constraints", "contact"})  # chapters that have more time than those before
FORMULATIONS = "deltaq.derivation.formulations"
ON_REQUEST: Steps = MappingProxyType({"canonical": model_chapter.canonical})  # only on request
USUAL = "dalembert-lagrange"  # if none is asked for


def formulation_names() -> tuple[str, ...]:
    """Names of all formulations there are."""
    return tuple(module.FORMULATION for module in modules_of(FORMULATIONS))


def derive(
    scene: Scene, formulation: str = USUAL, *, canonical: bool = False, allowance: Allowance = UNBOUNDED
) -> tuple[System, Derivation]:
    """The derivation of a scene, every step verified and with its grounds. UnknownNameError: no such formulation.

    `canonical` adds the chapter of Hamilton's canonical equations. What the time is not enough for is left out.
    """
    system = System(scene)
    system.effort.allowance = allowance
    return system, Derivation(formulation, tuple(chapters(system, formulation, canonical=canonical)))


def chapters(system: System, formulation: str = USUAL, *, canonical: bool = False) -> Iterator[Chapter]:
    """The chapters one after the other, each when it is asked for: first those up to the equations of motion.

    Raises UnknownNameError if there is no such formulation.
    """
    by_name = _chapters(formulation)
    points, grounds = tuple(random_points(system)), _grounds(system)
    told = set[str]()
    for name, steps in {**by_name, **(ON_REQUEST if canonical else {})}.items():
        made = tuple(verified_step(step, points) for step in _in_time(system, name, steps))
        chapter = grounds.of_chapter(Chapter(name, made))
        yield _resting_on(chapter, told) if "steps" in system.effort.left_out else chapter
        told |= {each.id for step in made for each in step.walk()}


def _resting_on(chapter: Chapter, told: AbstractSet[str]) -> Chapter:
    """The chapter without premises that are left out."""
    known = told | {each.id for step in chapter.steps for each in step.walk()}

    def rested(step: Step) -> Step:
        premises = tuple(one for one in step.premises if one in known)
        return replace(step, premises=premises, substeps=tuple(map(rested, step.substeps)))

    return Chapter(chapter.id, tuple(map(rested, chapter.steps)))


def _in_time(system: System, name: str, steps: Callable[[System], Iterator[Step]]) -> tuple[Step, ...]:
    """The steps of a chapter, before they are verified; one that says so where the time for them has passed.

    The last chapter looks at the time itself.
    """
    if name in ON_REQUEST or name == EQUATIONS:  # which is what was asked for
        return tuple(steps(system))
    if name == LAST:
        if not system.effort.allowance.is_past(PARTS_END):
            return tuple(steps(system))
        system.effort.left_out["model"] = "time"
        return ()
    end, made = EQUATIONS_END if name in BELONGING else STEPS_END, list[Step]()
    for step in steps(system):
        if system.effort.allowance.is_past(end):
            system.effort.left_out["steps"] = "time"
            return (left_out.apply("steps", "time", name),)
        made.append(step)
    return tuple(made)


def untold(system: System, formulation: str = USUAL) -> tuple[Chapter, ...]:
    """The chapters up to the equations of motion, each with a step that says that its own are missing."""
    there = {"constraints": bool(system.conditions), "contact": bool(bouncing(system) or frictions(system))}
    names = (name for name in _chapters(formulation) if name != LAST and there.get(name, True))
    return tuple(Chapter(name, (left_out.apply("steps", "time", name),)) for name in names)


def equations_alone(system: System, formulation: str = USUAL) -> tuple[Chapter, ...]:
    """The same, but for the equations of motion, every one of them verified."""
    points = tuple(random_points(system))
    made = tuple(verified_step(step, points) for step in _chapters(formulation)[EQUATIONS](system))
    told = _resting_on(_grounds(system).of_chapter(Chapter(EQUATIONS, made)), frozenset())
    return tuple(told if each.id == EQUATIONS else each for each in untold(system, formulation))


def extent(system: System) -> int:
    """How much there is to tell: of each body and constraint the coordinates it hangs on, and two for each load."""
    free = {system.q(q) for q in system.free}
    places = (system.position(body.name).free_symbols for body in system.scene.bodies)
    bound = (system.expression(condition.value).free_symbols for condition in system.conditions)
    return sum(len(free & symbols) for symbols in (*places, *bound)) + 2 * len(system.scene.contributions)


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
