"""How steps are known, what they rest on, and where their terms come from: of all scenes, on both roads."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import pytest
import sympy as sp
from tests.derived import derived

from deltaq.derivation.engine import formulation_names
from deltaq.derivation.formula import Explicit, Named, Partial, Plus, Quantity, Rate, Term, minus
from deltaq.derivation.normal_algebra import NormalAlgebra
from deltaq.derivation.proof import prove
from deltaq.derivation.result import result_of
from deltaq.derivation.result_history import result_origins
from deltaq.derivation.step import Relation, Step, Summand
from deltaq.derivation.system import System
from deltaq.mechanics.library import scene_ids

ROADS = [(scene, road) for scene in scene_ids() for road in formulation_names()]
# What restates the scene, or a law of its own, rests on nothing that is said before.
FIRST = {
    "position", "guide", "work-of-potential", "work-of-dissipation", "work-of-moment", "exchange-of-variation",
    "work-of-generalized-potential", "work-of-friction",
    "generalized-force",  # where nothing acts on the coordinate
    "virtual-work",  # where no load acts
    "constraint", "contact-gap", "left-out",
}  # fmt: skip


def terms(step: Step) -> Iterator[Summand]:
    return (term for members in step.lines for line in members for term in line.terms)


def algebra_of(system: System) -> NormalAlgebra:
    held = frozenset((f"delta({q})", end) for q in system.coordinates for end in system.ends)
    return NormalAlgebra(system.coordinates, held)


def test_nine_of_ten_steps_are_proved_and_nearly_all_terms_have_a_history() -> None:
    kinds, with_history, all_terms = Counter[str](), 0, 0
    for scene, road in ROADS:
        for step in derived(scene, road)[1].steps():
            kinds[step.evidence.kind] += 1
            later = [term for members in step.lines for line in members[1:] for term in line.terms]
            counting = [term for term in later if getattr(term.shown, "value", None) != 0]
            all_terms += len(counting)
            with_history += sum(bool(term.origins) for term in counting)
    assert kinds["exact"] >= 0.9 * (kinds["exact"] + kinds["sampled"])
    assert with_history >= 0.95 * all_terms


def test_the_proof_is_exact_and_each_of_its_terms_has_a_history() -> None:
    for step in prove().steps():
        assert step.evidence.kind == "exact", step.id
        equal = [members for relation, members in zip(step.relations, step.lines, strict=True) if relation.sign != "≠"]
        assert all(term.origins for members in equal for line in members[1:] for term in line.terms), step.id


@pytest.mark.parametrize(("scene", "road"), ROADS)
def test_a_step_rests_on_steps_before_it(scene: str, road: str) -> None:
    seen: set[str] = set()

    def check(step: Step) -> None:
        for substep in step.substeps:
            check(substep)
        assert set(step.premises) <= seen, step.id
        assert step.premises or step.rule in FIRST, step.id
        assert {origin.term.rpartition("/")[0] for term in terms(step) for origin in term.origins} <= seen | {step.id}
        seen.add(step.id)

    for chapter in derived(scene, road)[1].chapters:
        for step in chapter.steps:
            check(step)


@pytest.mark.parametrize(("scene", "road"), ROADS)
def test_an_equation_rests_on_all_bodies_and_loads(scene: str, road: str) -> None:
    """Going back from step to step meets what each load does, and the position of each body."""
    system, derivation = derived(scene, road)
    known = {step.id: step for step in derivation.steps()}
    for equation in [step for step in known.values() if step.rule == "equation"]:
        seen: dict[str, Step] = {}
        left = [equation.id]
        while left:
            step = known[left.pop()]
            left += [premise for premise in step.premises if premise not in seen]
            seen[step.id] = step
        works = {source for step in seen.values() if step.rule.startswith("work-of-") for source in step.sources}
        assert {f"load:{load}" for load in system.load_names} <= works
        assert {f"position:{body.name}" for body in system.scene.bodies} <= seen.keys()


@pytest.mark.parametrize("scene", ["double-pendulum", "elastic-pendulum", "foucault", "heavy-top", "quarter-car"])
def test_no_false_relation_is_proved(scene: str) -> None:
    """Each member that is written out is changed in one term, by the sign or by a factor."""
    system, derivation = derived(scene, "hamilton")
    algebra = algebra_of(system)
    tried = 0
    for step in derivation.steps():
        for relation in step.relations:
            after = relation.after
            if relation.sign == "≠" or len(relation.members) < 2 or not isinstance(after, Explicit):
                continue
            if isinstance(after.value, sp.MatrixBase) or after.value == 0:
                continue
            first, *others = sp.Add.make_args(after.value)
            for wrong in (-first, 2 * first, first + 1):
                false = replace(relation, members=(*relation.members[:-1], Explicit(sp.Add(wrong, *others))))
                assert not algebra.holds(false), step.id
                tried += 1
    assert tried > 50


def test_the_sign_of_an_unequal_relation_is_proved_only_if_it_is_true() -> None:
    algebra = NormalAlgebra(("x",))
    x = sp.Symbol("x", real=True)
    square, product = Explicit(sp.cos(x) ** 2 - sp.sin(x) ** 2), Explicit(sp.cos(2 * x))
    assert algebra.holds(Relation((square, product)))
    assert not algebra.holds(Relation((square, product), "≠"))
    assert algebra.holds(Relation((square, Explicit(sp.cos(x))), "≠"))


@pytest.mark.parametrize(("scene", "road"), ROADS)
def test_histories_lead_to_where_bodies_and_loads_come_in(scene: str, road: str) -> None:
    """The sources of terms are found on another way: each is met alone, at a step or at a term, on the way back."""
    _, derivation = derived(scene, road)
    known = {term.id: (step, term) for step in derivation.steps() for term in terms(step)}

    def back(name: str, seen: set[str]) -> Iterator[tuple[str, ...]]:
        if name not in seen:
            seen.add(name)
            step, term = known[name]
            yield from (step.sources, term.sources) if step.rule != "equation" else ()
            for origin in term.origins:
                yield from back(origin.term, seen)

    for step in derivation.steps():
        if step.rule == "equation":
            for term in step.lines[0][-1].terms:
                alone = {sources[0] for sources in back(term.id, set()) if len(sources) == 1}
                assert set(term.sources) <= alone, term.id


def test_what_became_of_each_term_of_the_pendulum() -> None:
    """m l² φ̈ + m g l sin φ = 0 from d/dt p = m l² φ̈ and ∂L/∂φ = −m g l sin φ."""
    _, derivation = derived("pendulum", "dalembert-lagrange")
    (step,) = (step for step in derivation.steps() if step.rule == "equation")
    inertia, weight = step.lines[0][-1].terms
    assert [(o.term, o.change) for o in inertia.origins if not o.term.startswith("equation")] == [
        ("momentum-rate:phi/0.1.0", "kept")
    ]
    assert [(o.term, o.change) for o in weight.origins if not o.term.startswith("equation")] == [
        ("lagrangian-slope:phi/0.1.0", "sign-turned")
    ]
    assert step.premises[:2] == ("momentum-rate:phi", "lagrangian-slope:phi")


def test_what_cancels_between_two_parts_is_derived() -> None:
    """φ̇₁ φ̇₂ sin(φ₁ − φ₂) stands in d/dt p₁ and in ∂L/∂φ₁, and not in the equation."""
    _, derivation = derived("double-pendulum", "dalembert-lagrange")
    steps = {step.id: step for step in derivation.steps()}
    cancelled = [name for line in steps["equation:phi1"].lines[0] for name in line.cancelled]
    found = {term.id: term for step in steps.values() for term in terms(step)}
    values = [found[name].shown.value for name in cancelled]  # type: ignore[union-attr]
    first, second = (sp.Symbol(f"phi{n}", real=True) for n in (1, 2))
    assert len(values) == 2
    assert {value.has(sp.sin(first - second)) for value in values} == {True}
    assert {name.partition("/")[0] for name in cancelled} == {"momentum-rate:phi1", "lagrangian-slope:phi1"}


def test_operations_are_carried_out() -> None:
    """Known derivatives along the motion: d/dt ∂/∂ẋ (½ m ẋ² cos x) = m ẍ cos x − m ẋ² sin x."""
    x, rate, acceleration = (sp.Symbol(name, real=True) for name in ("x", "dot(x)", "ddot(x)"))
    m = sp.Symbol("m", positive=True)
    energy = Named(Quantity("kinetic-energy"), m * rate**2 * sp.cos(x) / 2)
    left = Plus((Term(Rate(Partial(energy, rate))), minus(Partial(energy, x))))
    value = m * acceleration * sp.cos(x) - m * rate**2 * sp.sin(x) / 2
    algebra = NormalAlgebra(("x",))
    assert algebra.holds(Relation((left, Explicit(value))))
    assert not algebra.holds(Relation((left, Explicit(value + m * rate**2 * sp.sin(x)))))


def test_nearly_all_terms_of_results_have_a_history_in_the_steps() -> None:
    """The terms they come from are there, and have the bodies and loads of the term among theirs."""
    with_history = all_terms = 0
    for scene in scene_ids():
        system, derivation = derived(scene, "dalembert-lagrange")
        known = {term.id: term for step in derivation.steps() for term in terms(step)}
        sums = result_of(system).terms
        found = result_origins(derivation, system, sums)
        for key, by_name in sums.items():
            for name, several in by_name.items():
                for term, origins in zip(several, found[key][name], strict=True):
                    all_terms += 1
                    with_history += bool(origins)
                    before = {source for origin in origins for source in known[origin.term].sources}
                    assert not before or before & set(term.sources), (scene, key, name)
    assert with_history >= 0.95 * all_terms > 1000


def test_what_became_of_terms_in_results() -> None:
    system, derivation = derived("double-pendulum", "dalembert-lagrange")
    sums = result_of(system).terms
    found = result_origins(derivation, system, sums)

    def origins(key: str, name: str) -> list[tuple[str, list[tuple[str, str]]]]:
        pairs = zip(sums[key][name], found[key][name], strict=True)
        return [(str(term.written_out), [(o.term, o.change) for o in several]) for term, several in pairs]

    first = "equation:phi1/0.1"
    assert origins("mass_matrix", "phi1 phi1") == [
        ("l1**2*m1", [(f"{first}.0", "differentiated")]),
        ("l1**2*m2", [(f"{first}.0", "differentiated")]),
    ]
    assert origins("forcing", "phi1")[0][1] == [(f"{first}.2", "sign-turned")]
    assert origins("equations", "phi1")[2][1] == [(f"{first}.1", "kept")]
    assert origins("conservative", "phi2") == [("g*l2*m2*sin(phi2)", [("decomposition/0.1.1", "differentiated")])]
