"""Motions with constraints against what is known of them: closed forms, minimal coordinates, and what must be kept."""

from __future__ import annotations

from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest
from tests.simulation.constrained import (
    G,
    double_pendulum,
    equal_slider_crank,
    flat_linkage,
    four_bar,
    parallelogram,
    particle,
    pendulum,
    rod,
    scene,
    sleigh,
    swing_seat,
)
from tests.simulation.scenes import document

from deltaq.errors import Problem as Mistake
from deltaq.errors import RequestError, SceneError
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.model.constraints import ConstraintEquations
from deltaq.model.equations import equations
from deltaq.model.model import build
from deltaq.simulation.consistency import consistent
from deltaq.simulation.constraints import settled
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.problem import Floats, Problem
from deltaq.simulation.run import Steps
from deltaq.simulation.run import run as run_once
from deltaq.simulation.service import problem_of, run
from deltaq.simulation.trajectory import Trajectory


def moved(
    scene: Scene, t_end: float, tolerance: float = 1e-11, method: str = "dop853", samples: int = 101
) -> Trajectory:
    return simulate(problem_of(scene, t_end, samples), get_method(method), tolerance=tolerance)


def reactions(trajectory: Trajectory) -> Floats:
    """The multipliers, shape (samples, m)."""
    assert trajectory.reactions is not None
    return trajectory.reactions.multipliers


def drift(trajectory: Trajectory) -> float:
    assert trajectory.reactions is not None
    return float(trajectory.reactions.gaps.max())


def balance(scene: Scene, trajectory: Trajectory) -> float:
    """How far E + V − ∫P dt departs from its start."""
    problem = problem_of(scene, 1.0)
    seen = problem.model.observe(problem.inputs(trajectory.times, np.hstack([trajectory.values, trajectory.rates])))
    kept = seen.kinetic + seen.potential - trajectory.work
    return float(np.abs(kept - kept[0]).max())


def swing(times: Floats, amplitude: float = np.pi / 2) -> tuple[Floats, Floats]:
    """φ(t) and φ̇² of a pendulum of 1 m let go at an amplitude: sin φ/2 = k cd(ω₀t | k²), Landau, Mechanics, §11."""
    with mp.workdps(30):  # in doubles φ̇² would be wrong by more than what is compared with it
        k, frequency = mp.sin(mp.mpf(amplitude) / 2), mp.sqrt(mp.mpf(G))
        sines = [k * mp.ellipfun("cd", frequency * mp.mpf(t), m=k**2) for t in times]
        squares = [2 * G * (1 - 2 * sine**2 - mp.cos(amplitude)) for sine in sines]
        return np.array([2 * mp.asin(sine) for sine in sines], dtype=float), np.array(squares, dtype=float)


def test_a_rod_carries_weight_and_centripetal_force_in_tension() -> None:
    found = moved(pendulum(), 10.0)
    angle, square = swing(found.times)
    assert np.abs(found.values - np.column_stack([np.sin(angle), -np.cos(angle)])).max() < 1e-10
    assert np.abs(reactions(found)[:, 0] - (square + G * np.cos(angle))).max() < 1e-9
    assert found.estimate is not None
    assert found.estimate.multipliers is not None
    assert (np.abs(reactions(found)[:, 0] - (square + G * np.cos(angle))) <= found.estimate.multipliers[:, 0]).all()


@pytest.mark.parametrize("method", ["gauss-6", "implicit-midpoint", "rk4"])
def test_errors_inside_first_steps_are_told(method: str) -> None:
    """Samples lie within steps, where the force errs by more than at their ends: no more than half of what is told."""
    for t_end in (2.0, 4.0):
        found = moved(pendulum(), t_end, 1e-2, method)
        angle, square = swing(found.times)
        wrong = np.abs(reactions(found)[:, 0] - (square + G * np.cos(angle)))
        assert found.estimate is not None
        assert found.estimate.multipliers is not None
        assert (wrong <= 0.5 * found.estimate.multipliers[:, 0] + 1e-13).all()


def test_nothing_drifts_in_a_thousand_periods() -> None:
    assert drift(moved(pendulum(), 2370.0, 1e-6, samples=401)) < 1e-13
    rocking = four_bar()
    assert drift(moved(rocking, 500.0, 1e-4, samples=401)) < 1e-13


def test_two_rods_move_as_the_double_pendulum_in_angles() -> None:
    angles = load_scene("double-pendulum")
    first, second = angles.free
    values = {parameter.name: parameter.value for parameter in angles.parameters}
    rods = double_pendulum((first.value, second.value), (first.rate, second.rate), values)
    by_angles, by_rods = moved(angles, 3.0), moved(rods, 3.0)
    phi, psi = by_angles.values.T
    places = np.column_stack(
        [
            values["l1"] * np.sin(phi),
            -values["l1"] * np.cos(phi),
            values["l1"] * np.sin(phi) + values["l2"] * np.sin(psi),
            -values["l1"] * np.cos(phi) - values["l2"] * np.cos(psi),
        ]
    )
    assert np.abs(by_rods.values - places).max() < 1e-9


def test_series_are_refused_with_what_to_take_instead() -> None:
    with pytest.raises(RequestError) as caught:
        simulate(problem_of(pendulum(), 1.0, 11), get_method("taylor"), tolerance=1e-6)
    parameters = {"name": "taylor", "other": "dop853"}
    assert caught.value.problems == (Mistake("method-constraints", "/method", parameters=parameters),)


@pytest.mark.parametrize("method", [name for name in method_ids() if name != "taylor"])
def test_every_method_keeps_constraints_and_comes_near(method: str) -> None:
    order = get_method(method).order
    problem = problem_of(pendulum(), 1.0, 11)
    errors = []
    for step in (0.01, 0.005):
        found = simulate(problem, get_method(method), step=step, with_error=False)
        angle, _ = swing(found.times)
        assert found.outcome.status == "ok"
        assert drift(found) < 1e-14
        errors.append(np.abs(found.values - np.column_stack([np.sin(angle), -np.cos(angle)])).max())
    assert errors[1] < max(1.5 * errors[0] / 2**order, 1e-12), errors


@pytest.mark.parametrize("method", [name for name in method_ids() if name != "taylor"])
@pytest.mark.parametrize("scene", [pendulum(), four_bar()], ids=["pendulum", "four-bar"])
def test_short_runs_do_not_wait_for_machine_code_of_long_ones(scene: Scene, method: str) -> None:
    problem = replace(problem_of(scene, 0.1, 3), model=build(equations(scene), scene))
    assert simulate(problem, get_method(method), step=0.01, with_error=False).outcome.status == "ok"
    assert not problem.model.is_thorough


@pytest.mark.parametrize("is_long", [False, True], ids=["short", "long"])
@pytest.mark.parametrize("step", [1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("name", ["double-pendulum-by-rods", "four-bar", "slider-crank", "rolling-disc-in-space"])
def test_long_steps_of_euler_end_on_constraints_but_for_rounding(name: str, step: float, *, is_long: bool) -> None:
    """In q and in q̇, though a step may leave g by a part in a thousand, and before samples are brought any nearer."""
    scene, nothing = load_scene(name), np.zeros(1, dtype=np.int64)
    problem = replace(problem_of(scene, 1.0, 3), model=build(equations(scene), scene))
    if is_long:
        problem.model.settle()
    ends = run_once(problem, get_method("explicit-euler"), np.array([0.0, 1.0]), nothing, Steps(step, is_recorded=True))
    states = ends.mesh_states[2:]  # behind the first step, which is done by numbers
    assert ends.is_complete
    assert len(states) > 50
    assert problem.model.gaps is not None
    off = np.abs(problem.model.gaps.table(problem.inputs(ends.mesh_times[2:], states)))
    assert (off.max(axis=1) <= 16.0 * 2.0**-52 * np.maximum(1.0, np.abs(states).max(axis=1))).all()


@pytest.mark.parametrize("t_end", [1.0, 5.0])
@pytest.mark.parametrize(
    ("method", "tolerance"), [("dop853", 1e-9), ("gauss-6", 1e-9), ("rk4", 1e-7), ("stormer-verlet", 1e-6)]
)
def test_a_seat_on_parallel_rods_swings_as_a_pendulum(method: str, tolerance: float, t_end: float) -> None:
    """Its angle is zero all the time, where parts of a solution in symbols may have no value; long runs have it."""
    found = simulate(problem_of(swing_seat(), t_end, 101), get_method(method), tolerance=tolerance)
    assert found.outcome.status == "ok"
    angle, _ = swing(found.times, float(np.arcsin(0.6)))
    true = np.column_stack([np.sin(angle), -np.cos(angle), np.zeros_like(angle)])
    assert found.estimate is not None
    assert (np.abs(found.values - true).max(axis=1) <= found.estimate.errors + 1e-14).all()


def test_rates_that_are_but_rounding_lose_no_sample() -> None:
    """Of a seat that turns by less than rounding, what is left of its rate may be halved by each correction."""
    source, count = np.random.default_rng(2), 20_000
    angle, rate = source.uniform(-0.64, 0.64, count), source.uniform(-3.0, 3.0, count)
    tiny = [source.choice([0.0, 1.0, -1.0], count) * 10.0 ** source.uniform(-22.0, -15.0, count) for _ in range(2)]
    swinging = [np.sin(angle), -np.cos(angle), tiny[0], np.cos(angle) * rate, np.sin(angle) * rate, tiny[1]]
    states, reactions = settled(problem_of(swing_seat(), 5.0), np.zeros(count), np.column_stack(swinging))
    assert len(states) == count
    assert reactions.gaps.max() < 1e-15


def test_the_sleigh_turns_its_spin_into_speed() -> None:
    """v → √(v₀² + (J + ma²)ω₀²/m), v = c tanh(κt + artanh v₀/c): Bloch, Nonholonomic Mechanics and Control, §1.7."""
    speed, spin, m, inertia, a = 0.2, 1.5, 2.0, 0.3, 0.4
    found = moved(sleigh(speed, spin), 10.0)
    v = speed_of_sleigh(found)
    assert np.abs(v - glide(found.times, speed, spin)).max() < 1e-10
    # The skate's force: m times the acceleration across it, v ω + a ω̇.
    omega = found.rates[:, 2]
    force = m * (v * omega - a * (m * a * v * omega) / (inertia + m * a**2))
    assert np.abs(reactions(found)[:, 0] - force).max() < 1e-9


def speed_of_sleigh(found: Trajectory) -> Floats:
    """Of its blade along itself, shape (samples,)."""
    angle = found.values[:, 2]
    return np.asarray(np.cos(angle) * found.rates[:, 0] + np.sin(angle) * found.rates[:, 1])


def glide(times: Floats, speed: float, spin: float) -> Floats:
    """The same in closed form, at `times`, shape (samples,)."""
    m, inertia, a = 2.0, 0.3, 0.4
    limit = np.sqrt(speed**2 + (inertia + m * a**2) / m * spin**2)
    return np.asarray(limit * np.tanh(m * a * limit / (inertia + m * a**2) * times + np.arctanh(speed / limit)))


@pytest.mark.parametrize("method", [name for name in method_ids() if name != "taylor"])
def test_every_method_has_its_order_where_rates_are_constrained(method: str) -> None:
    """Reactions of constraints that have no g belong into the stages: at the ends of steps they are of order 1."""
    order, errors = get_method(method).order, []
    for step in (0.02, 0.01):
        found = simulate(problem_of(sleigh(0.2, 1.5), 2.0, 21), get_method(method), step=step, with_error=False)
        errors.append(np.abs(speed_of_sleigh(found) - glide(found.times, 0.2, 1.5)).max())
    assert errors[1] < max(1.5 * errors[0] / 2**order, 1e-12), errors


def test_a_moving_pivot_feeds_power_in_through_its_rod() -> None:
    scene = pendulum(pivot=("0", "a*sin(Omega*t)"))
    found = moved(scene, 10.0)
    assert np.abs(found.work).max() > 0.1
    assert balance(scene, found) < 1e-9


def test_flat_parallelogram_ends_the_motion_where_it_may_fold() -> None:
    found = moved(parallelogram(), 2.0, 1e-8)
    assert (found.outcome.status, found.outcome.code) == ("singular_constraints", "singular_constraints")
    assert found.reached == pytest.approx(np.pi / 6, abs=1e-5)
    angle = np.pi / 2 + 3.0 * found.times
    assert np.abs(found.values[:, 0] - np.cos(angle)).max() < 1e-8


@pytest.mark.parametrize("accuracy", [{"tolerance": 1e-5}, {"step": 5e-5}], ids=str)
@pytest.mark.parametrize("method", [name for name in method_ids() if name != "taylor"])
def test_a_linkage_without_weight_turns_evenly(method: str, accuracy: dict[str, float]) -> None:
    """q̈ = 0, towards which Newton's corrections in accelerations become ever smaller, and none is the last."""
    found = simulate(problem_of(flat_linkage(), 0.6, 31), get_method(method), **accuracy)
    assert found.outcome.status == "ok"
    assert found.estimate is not None
    evenly = np.column_stack([0.5 + 2.0 * found.times, 0.0 * found.times, 0.5 + 2.0 * found.times])
    assert np.abs(found.values - evenly).max() <= found.estimate.worst


@pytest.mark.parametrize("accuracy", [{"tolerance": 1e-9}, {"tolerance": 1e-5}, {"step": 0.01}], ids=str)
@pytest.mark.parametrize(
    "method", ["dop853", "dormand-prince-54", "rk4", "radau-5", "gauss-4", "implicit-midpoint", "newmark"]
)
@pytest.mark.parametrize("held", [flat_linkage(), equal_slider_crank()], ids=["flat", "upright"])
def test_a_fork_is_told_as_one_by_whatever_fails_there(held: Scene, method: str, accuracy: dict[str, float]) -> None:
    """Close to a fork Newton's corrections fail, steps vanish, or rounding decides on a branch: no step would help.

    Both linkages are there when their angles of equal cranks have come to π, or to π/2: A loses a row.
    """
    found = simulate(problem_of(held, 3.5, 101), get_method(method), **accuracy)
    assert found.outcome.status == "singular_constraints"
    goal = np.pi if len(held.coordinates) == 3 and held.coordinates[2].name == "c" else np.pi / 2
    last = found.values[-1] + (found.reached - found.times[-1]) * found.rates[-1]
    assert last[0] == pytest.approx(goal, abs=0.03)


@pytest.mark.parametrize(
    ("angle", "rate", "tolerance"),
    [(0.2, 2.0, 1e-2), (0.2, 1.7, 3e-4), (0.3, 2.0, 3e-3), (0.3, 2.0, 1e-4), (0.31, 1.7, 1e-3), (0.4, 2.4, 3e-3)],
)
def test_a_fork_between_two_ends_of_steps_is_seen(angle: float, rate: float, tolerance: float) -> None:
    """Long steps go over it: a state between, put on the constraints, may come to lie on the other branch."""
    given = problem_of(equal_slider_crank(), 3.0, 61)
    values, rates = (angle, angle, 2.0 * np.cos(angle)), (rate, rate, -2.0 * rate * np.sin(angle))
    began = consistent(replace(given, values=values, rates=rates))
    assert simulate(began, get_method("radau-5"), tolerance=tolerance).outcome.status == "singular_constraints"


def test_initial_values_are_moved_onto_the_constraints_and_told() -> None:
    problem = problem_of(pendulum(1.2, 0.0, 0.5, 0.7), 1.0)
    assert problem.moved is not None
    assert problem.values == pytest.approx((1.0, 0.0))
    assert problem.rates == pytest.approx((0.0, 0.7))
    assert problem.moved.values == pytest.approx((-0.2, 0.0))
    assert problem.moved.rates == pytest.approx((-0.5, 0.0))


@pytest.mark.parametrize("power", range(-20, -12))
@pytest.mark.parametrize("tilt", [0.1, 0.5, 0.9, 1.4])
def test_rates_as_small_as_rounding_are_kept(tilt: float, power: int) -> None:
    """A falling rod turns as slowly as its ends part across it; as if it did not, its rate says g t."""
    part, ends = 10.0**power, [(0.0, 0.0), (float(np.cos(tilt)), float(np.sin(tilt)))]
    begin = {
        "x1": (ends[0][0], -part),
        "y1": (ends[0][1], -2.0),
        "x2": (ends[1][0], part),
        "y2": (ends[1][1], -2.0),
    }
    bodies = [particle("one", "x1", "y1"), particle("two", "x2", "y2")]
    found = moved(scene(begin, {"m": 1.0, "l": 1.0, "g": G}, bodies, [rod("S", "one", "two")]), 0.1)
    assert found.outcome.status in ("ok", "horizon_reached")  # of what is as small as rounding no digit may be left
    assert found.reached == 0.1
    np.testing.assert_allclose(found.rates[-1], [0.0, -2.0 - 0.1 * G, 0.0, -2.0 - 0.1 * G], atol=1e-11)


def test_parts_that_do_not_fit_are_refused_at_their_constraint() -> None:
    with pytest.raises(SceneError) as caught:
        problem_of(four_bar(5.0), 1.0)
    assert [(problem.code, problem.pointer) for problem in caught.value.problems] == [
        ("constraint-not-met", "/constraints/0")
    ]


AT_A_FORK = ("constraint-not-met", "constraint-rate-not-met")  # a last digit decides between them


@pytest.mark.parametrize(
    ("change", "codes"),
    [
        ({"parameters": {"c": 1e-300}}, ("constraint-not-met",)),
        ({"parameters": {"s": 1e-15}}, AT_A_FORK),
        ({"initial": {"phi1": {"value": 1e15}}}, ("constraint-not-met",)),
        (
            {"initial": {"phi2": {"value": -167538116.81675162}, "phi3": {"value": -1622727.3279064395}}},
            ("constraint-not-met",),
        ),
    ],
    ids=["no length", "a short one", "an angle of few digits", "kept in a run, and not at its samples"],
)
def test_numbers_with_which_constraints_cannot_be_kept_are_refused_at_one(
    change: dict[str, object], codes: tuple[str, ...]
) -> None:
    with pytest.raises(SceneError) as caught:
        run({"scene": "four-bar", "t_end": 1.0, "samples": 11, "tolerance": 1e-12, **change})
    (problem,) = caught.value.problems
    assert problem.code in codes
    assert problem.pointer[:-1] == "/scene/constraints/"


@pytest.mark.parametrize("angle", [4.6e-6, 5e-6, 5.5e-6, 6e-6])
def test_what_counts_as_independent_is_solved_for(angle: float) -> None:
    """Two lines that cross by so much hold a particle, their share angle²/2 of 2: both count, so rates are zero."""
    free = document({"x": (0.0, 0.0), "y": (0.0, 1.0), "z": (0.0, 2.0)}, {"m": 1.0}, {"bead": ("m", ["x", "y", "z"])})
    lines = {"first": "x = 0", "second": f"x*cos({angle:.8f}) + y*sin({angle:.8f}) = 0"}
    constraints = [{"name": name, "kind": "equation", "equation": each} for name, each in lines.items()]
    begun = problem_of(read_scene({**free, "constraints": constraints}), 1.0, 11)
    assert begun.rank == 2
    assert begun.rates == pytest.approx((0.0, 0.0, 2.0), abs=1e-9)


def doubled(scene: Scene, t_end: float) -> Problem:
    """The problem with its first constraint said twice: a rod beside the rod."""
    eqs = equations(scene)
    held, plain = eqs.constraints, problem_of(scene, t_end, 51)
    twice = ConstraintEquations(
        (*held.places, 0),
        (*held.names, "twin"),
        (*held.gaps, held.gaps[0]),
        (*held.slips, held.slips[0]),
        (*held.jacobian, held.jacobian[0]),
        (*held.accelerations, held.accelerations[0]),
        (*held.drives, held.drives[0]),
    )
    return consistent(replace(plain, model=build(replace(eqs, constraints=twice), scene)))


def test_a_rod_beside_a_rod_changes_no_motion_and_has_no_force_of_its_own() -> None:
    problem = doubled(pendulum(), 3.0)
    found = simulate(problem, get_method("dop853"), tolerance=1e-11)
    angle, _ = swing(found.times)
    assert problem.rank == 1
    assert problem.moved is not None
    assert problem.moved.undetermined == ("S", "twin")
    assert np.abs(found.values - np.column_stack([np.sin(angle), -np.cos(angle)])).max() < 1e-10


# Kicks are of order 2: methods of higher order are projected.
LOW = [name for name in method_ids() if get_method(name).is_symplectic and get_method(name).order <= 2]


@pytest.mark.parametrize("method", LOW)
def test_kicks_keep_a_symplectic_method_of_low_order_one(method: str) -> None:
    """Over a thousand times its step the energy errs no more than over a hundred; projection alone lets it drift."""
    swinging, spans = pendulum(), []
    for t_end in (10.0, 100.0):
        found = simulate(problem_of(swinging, t_end, 201), get_method(method), step=0.02, with_error=False)
        spans.append(balance(swinging, found))
    assert spans[1] < 1.2 * spans[0], spans


@pytest.mark.parametrize("method", LOW)
def test_kicks_are_found_along_with_the_stages(method: str) -> None:
    """No step is made again for them, and a rod beside the rod, whose kicks are not unique, changes no motion."""
    rods = double_pendulum((1.0, 0.5), (0.3, 0.2), {"m1": 1.0, "m2": 0.5, "l1": 1.0, "l2": 0.7, "g": G})
    cost = simulate(problem_of(rods, 10.0, 11), get_method(method), step=0.004, with_error=False).cost
    assert cost.run_evaluations < 11 * cost.steps
    problems = (problem_of(pendulum(), 3.0, 51), doubled(pendulum(), 3.0))
    once, twice = (simulate(each, get_method(method), step=0.01, with_error=False) for each in problems)
    assert twice.outcome.status == "ok"
    assert np.abs(twice.values - once.values).max() < 1e-12


def test_a_fast_force_on_a_held_particle_is_seen() -> None:
    """A blow of a millisecond, between steps that a resting pendulum would let grow: m Δv = ∫F dt sets it swinging."""
    blow = {"name": "blow", "kind": "force", "at": "bob", "force": ["F*exp(-((t - c)/w)^2)", "0"]}
    force, width = 1000.0, 0.001
    resting = scene(
        {"x": (0.0, 0.0), "y": (-1.0, 0.0)},
        {"m": 1.0, "l": 1.0, "g": G, "F": force, "c": 1.37, "w": width},
        [particle("bob", "x", "y")],
        [rod("S", "pivot", "bob")],
        points={"pivot": ["0", "0"]},
        loads=[blow],
    )
    found = moved(resting, 3.0, 1e-8, samples=301)
    speed = force * width * np.sqrt(np.pi)
    highest = found.values[:, 1].max()
    assert found.outcome.status == "ok"
    assert highest == pytest.approx(-1.0 + speed**2 / (2.0 * G), abs=1e-4)
