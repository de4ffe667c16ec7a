"""Hamilton's principle: the same equations by another road, every step of it verified."""

from __future__ import annotations

import dataclasses

import pytest
from tests.derivation.scenes import spring_in_space
from tests.derived import derived as library

from deltaq.derivation.action import action
from deltaq.derivation.engine import derive, formulation_names
from deltaq.derivation.formula import Explicit
from deltaq.derivation.result import result_of
from deltaq.derivation.rules import exchange_of_variation, integration_by_parts
from deltaq.derivation.step import Derivation, Relation, Step
from deltaq.derivation.system import System
from deltaq.derivation.verification import random_points, verified_step
from deltaq.mechanics.library import load_scene, scene_ids

OWN = {"spring in space": spring_in_space()}


@pytest.fixture(scope="module", params=[*scene_ids(), *OWN])
def derived(request: pytest.FixtureRequest) -> dict[str, tuple[System, Derivation]]:
    """A scene by each formulation; its tests follow each other."""
    return {
        formulation: derive(OWN[scene], formulation) if (scene := request.param) in OWN else library(scene, formulation)
        for formulation in formulation_names()
    }


@pytest.mark.one_in(4)
def test_it_leads_to_the_same_equations(derived: dict[str, tuple[System, Derivation]]) -> None:
    for _, derivation in derived.values():
        assert [step.id for step in derivation.steps() if not step.verified] == []
    by_work, by_action = (result_of(system) for system, _ in derived.values())
    assert dataclasses.replace(by_action, scene=by_work.scene) == by_work


@pytest.mark.one_in(4)
def test_the_factor_of_each_variation_is_the_equation_of_motion(
    derived: dict[str, tuple[System, Derivation]],
) -> None:
    system, derivation = derived["hamilton"]
    lemma = next(step for step in derivation.steps() if step.rule == "fundamental-lemma")
    factors = [relation.after for relation in lemma.relations[1:]]
    equations = result_of(system).equations.values()
    for factor, equation in zip(factors, equations, strict=True):
        terms = factor.left.terms  # type: ignore[union-attr]
        assert all(term.sources for term in terms)
        assert system.is_zero(sum(term.sign * term.formula.value for term in terms) + equation)


CHAPTERS = {
    "dalembert-lagrange": (
        "configuration variation virtual-work kinetic-energy dalembert-to-lagrange decomposition lagrange constraints"
        " contact model"
    ),
    "hamilton": (
        "configuration kinetic-energy variation virtual-work decomposition hamilton lagrange constraints contact model"
    ),
}


@pytest.mark.parametrize("formulation", formulation_names())
def test_chapters(formulation: str) -> None:
    _, derivation = library("elastic-pendulum", formulation)
    assert " ".join(chapter.id for chapter in derivation.chapters) == CHAPTERS[formulation]


def is_found(step: Step, system: System) -> bool:
    return not verified_step(step, tuple(random_points(system))).verified


def test_a_wrong_exchange_is_found() -> None:
    system = System(load_scene("pendulum"))
    step = exchange_of_variation.apply(action(system))
    (line,) = step.relations
    doubled = Relation((line.before, Explicit(2 * system.symbols.variation("phi", 1))))
    assert not is_found(step, system)
    assert is_found(dataclasses.replace(step, relations=(doubled,)), system)


def test_a_lost_boundary_term_is_found_where_the_ends_are_not_fixed() -> None:
    """The boundary term counts: without fixed ends, parts alone do not make the two integrals equal."""
    system = System(load_scene("pendulum"))
    step = integration_by_parts.apply(action(system), "phi")
    (line,) = step.relations
    speed, formal, written = line.members
    points = tuple({**point, "dot(delta(phi))": point["phi"]} for point in random_points(system))
    whole = dataclasses.replace(step, relations=(Relation((speed, formal, written)),))
    without = tuple(dataclasses.replace(member, terms=member.terms[1:]) for member in (formal, written))  # type: ignore[arg-type, union-attr, type-var]
    lost = dataclasses.replace(step, relations=(Relation((speed, *without)),))
    assert verified_step(whole, points).verified
    assert not verified_step(lost, points).verified
