"""Integrals of motion by Noether's theorem: those that textbooks state, all of them, and nothing else."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest
import sympy as sp
from tests.derivation.kinked_scenes import document
from tests.derivation.model_scenes import particle
from tests.derivation.textbook_integrals import SYSTEMS, Published, mass, plane, potential, scene

from deltaq.derivation import symmetry
from deltaq.derivation.elimination import kernel
from deltaq.derivation.formula import Explicit, Plus
from deltaq.derivation.matrix_form import forcing, mass_matrix
from deltaq.derivation.model_chapter import canonical
from deltaq.derivation.result import result_of
from deltaq.derivation.rules import noether, relative_equilibrium
from deltaq.derivation.steady import steady_motions
from deltaq.derivation.symmetry import symmetries
from deltaq.derivation.system import System
from deltaq.derivation.verification import random_points, verified_step
from deltaq.language.parser import parse
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request

NUMBER = 1e-9


def point(system: System, seed: int) -> dict[sp.Symbol, sp.Float]:
    """Random values of t, q and q̇, the parameters as the scene has them."""
    source = random.Random(seed)
    moving = [system.t, *map(system.q, system.free), *map(system.rate, system.free)]
    return {symbol: sp.Float(source.uniform(0.4, 1.4), 40) for symbol in moving} | dict(system.parameter_values)


def slopes(system: System, value: sp.Expr, at: dict[sp.Symbol, sp.Float]) -> list[sp.Expr]:
    moving = [*map(system.q, system.free), *map(system.rate, system.free)]
    return [sp.N(value.diff(x).subs(at), 30) for x in moving]


def rank(rows: list[list[sp.Expr]]) -> int:
    """By singular values of rows of length 1."""
    numbers = np.array([[float(entry) for entry in row] for row in rows])
    return int(np.linalg.matrix_rank(numbers / np.linalg.norm(numbers, axis=1)[:, None], tol=1e-9)) if rows else 0


def rate(system: System, value: sp.Expr, at: dict[sp.Symbol, sp.Float]) -> tuple[sp.Expr, sp.Expr]:
    """dI/dt with q̈ = M⁻¹ f, and the size of its summands."""
    accelerations = sp.Matrix(mass_matrix(system).subs(at)).LUsolve(sp.Matrix(forcing(system).subs(at)))
    pairs = [(value.diff(system.t), sp.Integer(1))]
    pairs += [(value.diff(system.q(q)), at[system.rate(q)]) for q in system.free]
    pairs += [(value.diff(system.rate(q)), a) for q, a in zip(system.free, accelerations, strict=True)]
    parts = [sp.N((slope * speed).subs(at), 30) for slope, speed in pairs]
    return sum(parts), sum(map(abs, parts)) + 1


@pytest.fixture(params=SYSTEMS, scope="module")
def solved(request: pytest.FixtureRequest) -> tuple[Published, System]:
    published = SYSTEMS[request.param]
    return published, System(published.scene)


@pytest.mark.one_in(5)
def test_it_has_the_names_that_are_published(solved: tuple[Published, System]) -> None:
    published, system = solved
    found = [each.meaning for each in result_of(system).conserved]
    assert sorted(found) == sorted(published.meanings.split())


@pytest.mark.one_in(5)
def test_published_formulas_are_found(solved: tuple[Published, System]) -> None:
    """Up to a factor and a constant: the slopes are parallel everywhere."""
    published, system = solved
    for formula in published.integrals:
        wanted = system.expression(parse(formula, system.scene.names).tree)
        found = [each.value for each in symmetries(system)]
        ratios = [{r for seed in (1, 2) for r in parallel(system, wanted, each, seed)} for each in found]
        assert any(len(each) == 1 and None not in each for each in ratios), formula


def parallel(system: System, one: sp.Expr, other: sp.Expr, seed: int) -> list[object]:
    """The ratios of all slopes, rounded; None where only one of a pair is zero."""
    at = point(system, seed)
    pairs = zip(slopes(system, one, at), slopes(system, other, at), strict=True)
    return [
        None if abs(a) < NUMBER or abs(b) < NUMBER else round(float(a / b), 9)
        for a, b in pairs
        if abs(a) > NUMBER or abs(b) > NUMBER
    ]


@pytest.mark.one_in(5)
def test_nothing_is_false(solved: tuple[Published, System]) -> None:
    _, system = solved
    for each in result_of(system).conserved:
        change, size = rate(system, each.value, point(system, 3))
        assert abs(change) < NUMBER * size, each.value


@pytest.mark.one_in(5)
def test_each_says_something_new(solved: tuple[Published, System]) -> None:
    _, system = solved
    at = point(system, 4)
    known = [slopes(system, each.value, at) for each in result_of(system).conserved if each.kind != "symmetry"]
    for each in symmetries(system):
        before = rank(known)
        known.append(slopes(system, each.value, at))
        assert rank(known) == before + 1, each.value


@pytest.mark.one_in(5)
def test_every_step_is_verified(solved: tuple[Published, System]) -> None:
    _, system = solved
    points = tuple(random_points(system))
    for number, each in enumerate(symmetries(system), 1):
        assert verified_step(noether.apply(system, each, number), points).verified


@pytest.mark.parametrize(
    "name", ["Kepler, plane", "magnetic field, plane", "linear drag", "projectile", "turning field"]
)
def test_brackets_with_hamilton_s_function_vanish(name: str) -> None:
    system = System(SYSTEMS[name].scene)
    points = tuple(random_points(system))
    steps = [verified_step(step, points) for step in canonical(system)]
    assert [step.id for step in steps if not step.verified] == []
    brackets = [step for step in steps if step.rule == "poisson-bracket"]
    assert len(brackets) == len(result_of(system).conserved)


@pytest.mark.parametrize(
    ("name", "outcomes"),
    [
        ("Kepler, plane", ["invariant"]),
        ("projectile", ["impulse", "invariant", "gauge"]),  # m ż + m g t; turned about z; m ẋ t − m x
        ("driven particle", ["impulse", "gauge"]),  # a force of time alone: its impulse; and moved on evenly
        ("magnetic field, plane", ["gauge", "gauge"]),
        ("linear drag", ["gauge", "gauge"]),  # −c x depends on where the particle is
        ("Atwood's machine", ["impulse"]),
        ("inverse cube force", ["invariant", "time"]),  # scaling
        ("oscillator, κ = 1", ["invariant-special"]),
    ],
)
def test_what_a_change_does_to_the_lagrangian(name: str, outcomes: list[str]) -> None:
    system = System(SYSTEMS[name].scene)
    steps = [noether.apply(system, each, number) for number, each in enumerate(symmetries(system), 1)]
    assert [step.about["outcome"] for step in steps] == outcomes


@pytest.mark.parametrize("name", ["Kepler, plane", "projectile", "inverse cube force"])
def test_a_symmetry_of_all_there_is_names_no_bodies(name: str) -> None:
    system = System(SYSTEMS[name].scene)
    steps = [noether.apply(system, each, number) for number, each in enumerate(symmetries(system), 1)]
    assert [(step.about.get("place"), step.about["symmetry"].endswith("-of")) for step in steps] == [
        (None, False)
    ] * len(steps)


@pytest.mark.parametrize("name", ["Kepler, plane", "free in the plane", "magnetic field, plane", "projectile"])
def test_no_sum_of_the_law_has_a_term_that_is_zero(name: str) -> None:
    system = System(SYSTEMS[name].scene)
    steps = [noether.apply(system, each, number) for number, each in enumerate(symmetries(system), 1)]
    for step in (one for whole in (*steps, *canonical(system)) for one in whole.walk()):
        sums = [part for relation in step.relations for member in relation.members for part in _sums(member)]
        assert not any(isinstance(t.formula, Explicit) and t.formula.value == 0 for one in sums for t in one.terms)


def _sums(formula: object) -> Iterator[Plus]:
    """The sums of several terms in a formula, those in brackets first."""
    if isinstance(formula, tuple):
        for part in formula:
            yield from _sums(part)
    elif is_dataclass(formula) and not isinstance(formula, type):
        for each in fields(formula):
            yield from _sums(getattr(formula, each.name))
        if isinstance(formula, Plus) and len(formula.terms) > 1:
            yield formula


def test_a_bracket_shows_what_is_not_zero_at_sight() -> None:
    """{p_ψ, H} = −∂H/∂ψ where ψ is cyclic; in {h, H} no derivative by ψ, of which neither depends on it."""
    answer = derive_request({"scene": "spherical-pendulum", "canonical": True})
    steps = {step["id"]: step["latex"] for chapter in answer["chapters"] for step in chapter["steps"]}  # type: ignore[attr-defined]
    assert r"\frac{\partial H}{\partial \psi} &= 0" in steps["poisson-bracket:1"]
    assert r"\\" not in steps["poisson-bracket:1"]
    assert r"\partial \psi" not in steps["poisson-bracket:2"]
    assert steps["poisson-bracket:2"].count(r"\frac{\partial H}") == 2


def test_a_wrong_integral_is_no_verified_step() -> None:
    system = System(SYSTEMS["magnetic field, plane"].scene)
    points = tuple(random_points(system))
    for each in symmetries(system):
        lost = replace(each, gauge=system.zero, value=each.value + each.gauge)
        turned = replace(each, value=-each.value)
        for wrong in (lost, turned):
            assert not verified_step(noether.apply(system, wrong, 1), points).verified


def test_a_condition_is_told() -> None:
    (each,) = symmetries(System(SYSTEMS["oscillator, κ = 1"].scene))
    assert [str(condition) for condition in each.conditions] == ["kappa - 1"]
    step = noether.apply(System(SYSTEMS["oscillator, κ = 1"].scene), each, 1)
    assert step.about["outcome"] == "invariant-special"
    answer = derive_request({"scene": write_scene(SYSTEMS["oscillator, κ = 1"].scene)})
    (told,) = (one for one in answer["result"]["conserved"] if one["kind"] == "symmetry")  # type: ignore[index]
    assert [one["plain"] for one in told["conditions"]] == ["kappa = 1"]


def test_two_equal_parameters_are_a_condition() -> None:
    """Two springs of one stiffness in the plane, x and y."""
    system = System(plane({"k1": 2, "k2": 2}, potential("k1*x^2/2+k2*y^2/2")))
    (each,) = symmetries(system)
    assert [str(condition) for condition in each.conditions] == ["k1 - k2"]


def test_a_nearly_equal_stiffness_is_no_symmetry() -> None:
    assert symmetries(System(plane({"k1": 2, "k2": 2.0001}, potential("k1*x^2/2+k2*y^2/2")))) == ()


@pytest.mark.parametrize("energy", ["k*abs(x - a)", "k*abs(x - a) + m*g*x", "k*max(x - a, 0)", "k*min(a*x, x)"])
def test_a_force_that_jumps_is_not_constant(energy: str) -> None:
    """Its slope is zero beside the jump, and p − F t is no integral of motion."""
    scene_with_jump = document([potential(energy)], {"k": 20.0, "a": 0.5})
    assert symmetries(System(read_scene(scene_with_jump))) == ()


def random_scene(seed: int) -> tuple[Scene, int]:
    """Masses on a line or in a plane with springs between some of them; how many groups hang together."""
    source = random.Random(seed)
    count = source.choice((2, 3))
    names = [f"x{i}" for i in range(count)]
    bodies = [mass(f"b{i}", f"x{i}", "0", value=f"m{i}") for i in range(count)]
    springs = [(i, k) for i in range(count) for k in range(i) if source.random() < 0.6]
    loads = [potential(f"k{i}{k}*(x{i}-x{k})^{source.choice((2, 4))}") for i, k in springs]
    parameters = {f"m{i}": source.uniform(1, 2) for i in range(count)}
    parameters |= {f"k{i}{k}": source.uniform(1, 2) for i, k in springs}
    groups = {i: i for i in range(count)}
    for i, k in springs:
        groups = {node: groups[k] if group == groups[i] else group for node, group in groups.items()}
    return scene(names, parameters, bodies, *loads), len(set(groups.values()))


@pytest.mark.parametrize("seed", range(8))
def test_every_group_that_hangs_together_has_its_momentum(seed: int) -> None:
    drawn, groups = random_scene(seed)
    found = result_of(System(drawn)).conserved
    still = [each for each in found if each.generator.time == 0 and not each.value.has(System(drawn).t)]
    shifts = [each for each in still if all(shift.is_number for shift in each.generator.shifts.values())]
    assert len(shifts) == groups


@pytest.mark.one_in(5)
@pytest.mark.parametrize("name", scene_ids())
def test_every_step_of_the_library_is_verified(name: str) -> None:
    system = System(load_scene(name))
    points = tuple(random_points(system))
    steps = [noether.apply(system, each, number) for number, each in enumerate(symmetries(system), 1)]
    steps += [relative_equilibrium.apply(system, each, number) for number, each in enumerate(steady_motions(system), 1)]
    assert [step.id for step in steps if not verified_step(step, points).verified] == []


def test_the_kernel_of_linear_equations() -> None:
    rows = [[1.0, 2.0, 0.0, 1e-13], [0.0, 0.0, 1e6, 0.0]]
    vectors = kernel(rows, [1.0, 1.0, 1e6, 1.0])
    assert len(vectors) == 2
    for vector in vectors:
        assert all(abs(sum(a * c for a, c in zip(row, vector, strict=True))) < 1e-6 for row in rows)


def test_long_expressions_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(symmetry, "MOST_OPERATIONS", 5)
    assert symmetries(System(SYSTEMS["Kepler, plane"].scene)) == ()


@pytest.mark.parametrize(
    "taken", [(), ("h",), ("epsilon",), ("h", "epsilon"), ("epsilon", "eta"), ("h", "epsilon", "eta")], ids=" ".join
)
def test_the_small_number_of_a_change_is_no_other_symbol(taken: tuple[str, ...]) -> None:
    """Neither one of the scene nor the h by which derivatives along a direction are defined."""
    system = System(particle(["x"], dict.fromkeys(taken, 1.0), ["x", "0"]))
    assert len({*taken, "x", "m", "t", system.h.name, noether.epsilon(system).name}) == len(taken) + 5
