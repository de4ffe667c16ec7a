"""The numbers of an answer that say how good it is, and how long the others are."""

from __future__ import annotations

import math
import sys
from decimal import Decimal
from time import perf_counter

import numpy as np
import pytest
from tests.simulation.constrained import G, equation, particle, pendulum, rod
from tests.simulation.constrained import scene as constrained
from tests.simulation.scenes import document

from deltaq.mechanics.writing import write_scene
from deltaq.simulation.service import run

REST = {"phi1": {"value": 0.0, "rate": 0.0}, "phi2": {"value": 0.0, "rate": 0.0}}


def ask(**fields: object) -> dict[str, object]:
    return run({"scene": "pendulum", "t_end": 2.0, "samples": 9, **fields})


def digits(value: float) -> int:
    """Significant digits of the shortest decimal."""
    return len(Decimal(repr(value)).normalize().as_tuple().digits)


@pytest.mark.parametrize(("m1", "m2", "condition"), [(1.0, 1.0, 2.0), (1.0, 3.0, 4.0), (4.0, 1.0, 1.25)])
def test_condition_of_the_mass_matrix(m1: float, m2: float, condition: float) -> None:
    """M₁₂²/(M₁₁M₂₂) = m2/(m1 + m2) of the hanging double pendulum: what is left of M₂₂ is m1/(m1 + m2) of it."""
    answer = ask(scene="double-pendulum", initial=REST, parameters={"m1": m1, "m2": m2})
    assert answer["condition"] == pytest.approx(condition, rel=1e-12)


def test_the_error_is_that_of_the_harmonic_oscillator() -> None:
    """x = cos 2t: the answer is off by no more than it says, and by no less than a hundredth of that at its worst."""
    pull = {"kind": "force", "at": "mass", "force": ["-4*x", "0"]}
    scene = document({"x": (1.0, 0.0)}, {"m": 1.0}, {"mass": ("m", ["x", "0"])}, [pull])
    answer = ask(scene=scene, method="rk4", step=0.05, t_end=10.0)
    off = np.abs(np.array(answer["coordinates"]["x"]) - np.cos(2.0 * np.array(answer["t"])))
    error = answer["error"]
    assert np.all(off <= 1.05 * np.array(error["estimate"]))
    assert off.max() >= 0.01 * error["worst"] > 0.0
    assert (error["tolerance"], error["reached"]) == (None, None)
    assert max(error["estimate"]) <= error["worst"] <= 1.1 * max(error["estimate"])
    told = [digits(value) for value in [*error["estimate"], error["worst"], answer["energy"]["drift"]]]
    assert max(told) == max(told[:-2]) == 3


def test_a_horizon_is_told_from_where_on_no_digit_is_left() -> None:
    """Euler's method makes x = cos 2t larger by a factor of √(1 + ω²h²) in each step: e¹⁰ in 50 s for h = 0.1."""
    pull = {"kind": "force", "at": "mass", "force": ["-4*x", "0"]}
    scene = document({"x": (1.0, 0.0)}, {"m": 1.0}, {"mass": ("m", ["x", "0"])}, [pull])
    answer = ask(scene=scene, method="explicit-euler", step=0.1, t_end=50.0, samples=201)
    horizon, t = answer["error"]["horizon"], np.array(answer["t"])
    assert (answer["status"], answer["reason"]["parameters"]["t"]) == ("horizon_reached", float(f"{horizon:.3g}"))
    assert answer["trusted_until"] == horizon < answer["t_reached"] == 50.0
    off = np.abs(np.array(answer["coordinates"]["x"]) - np.cos(2.0 * t))
    estimate = np.array(answer["error"]["estimate"])
    assert (off <= 1.05 * estimate)[t < horizon].all()
    assert off[t > horizon].max() > 0.5
    assert min(estimate[t > horizon]) > 0.5


def test_the_drift_is_how_far_the_balance_goes_from_where_it_began() -> None:
    """Euler's method adds ω²h² to the energy E = 2 J of x = cos 2t in each step: the farthest is the end."""
    pull = {"kind": "force", "at": "mass", "force": ["-4*x", "0"]}
    scene = document({"x": (1.0, 0.0)}, {"m": 1.0}, {"mass": ("m", ["x", "0"])}, [pull])
    energy = ask(scene=scene, method="explicit-euler", step=0.001)["energy"]
    assert energy["drift"] == pytest.approx(energy["balance"][-1] - energy["balance"][0], rel=0.005)
    assert energy["drift"] > 0.001


@pytest.mark.parametrize("tolerance", [1e-3, 1e-9])
def test_a_tolerance_is_told_with_whether_it_was_reached(tolerance: float) -> None:
    error = ask(tolerance=tolerance)["error"]
    assert (error["tolerance"], error["reached"]) == (tolerance, True)
    assert error["worst"] <= tolerance


def test_without_an_estimate_numbers_are_given_to_twelve_places() -> None:
    answer = ask(include=["coordinates"], tolerance=1e-12)
    assert "error" not in answer
    shown = answer["coordinates"]["phi"]
    assert all(value == round(value, 15) for value in shown)
    full = ask(tolerance=1e-12)["coordinates"]["phi"]
    np.testing.assert_allclose(shown, full, atol=1e-9)


def thrown(mass: float) -> dict[str, object]:
    """A mass thrown upwards with 5 m/s: E = m (5 − g t)²/2, V = m g (5 t − g t²/2)."""
    weight = {"kind": "gravity", "acceleration": ["0", "-g"]}
    return document({"y": (0.0, 5.0)}, {"m": mass, "g": 10.0}, {"stone": ("m", ["0", "y"])}, [weight])


@pytest.mark.parametrize("mass", [1e-9, 1.0, 1e9])
def test_energies_have_their_digits_however_light_or_heavy_the_body(mass: float) -> None:
    answer = ask(scene=thrown(mass), t_end=1.5)
    t, energy = np.array(answer["t"]), answer["energy"]
    np.testing.assert_allclose(energy["kinetic"], mass * (5.0 - 10.0 * t) ** 2 / 2.0, rtol=1e-5, atol=1e-5 * mass)
    np.testing.assert_allclose(energy["potential"], mass * 10.0 * (5.0 * t - 5.0 * t**2), rtol=1e-5, atol=1e-5 * mass)
    np.testing.assert_allclose(energy["balance"], 12.5 * mass, rtol=1e-5)
    assert energy["power"] == energy["work"] == [0.0] * 9


def test_energies_have_no_digits_beyond_what_doubles_hold() -> None:
    """However good the motion is: 10⁻¹⁴ of the energies is left to rounding."""
    energies = ask(scene="elastic-pendulum", tolerance=1e-12)["energy"]
    told = [value for name in ("kinetic", "potential", "balance") for value in energies[name]]
    assert max(len(repr(value).partition(".")[2]) for value in told) <= 15


def test_energies_of_a_rough_motion_are_short() -> None:
    """Errors of 1e-5 and more leave no use for fifteen digits; a hundred times heavier, two decimals fewer."""
    rough = {"method": "heun", "step": 0.02, "t_end": 3.0}
    light, heavy = (ask(parameters={"m": mass}, **rough)["energy"] for mass in (1.0, 100.0))
    for name in ("kinetic", "potential", "balance"):
        assert all(digits(value) <= 12 for value in light[name][1:])
        places = [[max(0, -Decimal(repr(v)).as_tuple().exponent) for v in each[name][1:]] for each in (light, heavy)]
        assert max(places[1]) == max(places[0]) - 2
        np.testing.assert_allclose(np.array(heavy[name]), 100.0 * np.array(light[name]), rtol=1e-8)


def test_energies_of_a_small_swing_have_the_digits_of_the_largest_of_them() -> None:
    """E stays below 10⁻³ J and V near −9.81 J: what V may be off by, the balance may be off by as well."""
    answer = ask(method="explicit-euler", step=0.01, initial={"phi": {"value": 0.01}})
    energy, doubts = answer["energy"], np.array(answer["error"]["estimate"])
    places = np.ceil(-np.log10(np.maximum(1e-3 * doubts, 1e-14) * 9.0)) + 3
    for told, most in zip(energy["balance"][1:], places[1:], strict=True):
        assert told == round(told, int(most))


def test_where_nothing_moves_there_is_no_error_to_tell() -> None:
    """The force is infinite where the particle stands at first."""
    push = {"kind": "force", "at": "mass", "force": ["1/x", "0"]}
    answer = ask(scene=document({"x": (0.0, 0.0)}, {"m": 1.0}, {"mass": ("m", ["x", "0"])}, [push]))
    assert (answer["status"], answer["t"], answer["energy"]["drift"]) == ("singular", [], 0.0)
    assert (answer["error"]["estimate"], answer["error"]["horizon"]) == ([], None)
    assert answer["error"]["worst"] < 1e-15


def test_parts_that_were_asked_for_hold_their_own_numbers() -> None:
    """Each part by itself says what it says among the others."""
    names = ("coordinates", "rates", "positions", "loads")
    asked = {"scene": "elastic-pendulum", "tolerance": 1e-9}
    full = ask(**asked)
    assert [set(full[name]) for name in ("coordinates", "rates")] == [{"y", "phi"}] * 2
    for name in names:
        alone = ask(include=[name, "error"], **asked)
        assert {part for part in names if part in alone} == {name}
        assert alone[name] == full[name]


def test_cost_is_of_this_answer() -> None:
    """Runge–Kutta of order four asks for four slopes a step; the second run has half the steps, or twice as many."""
    cost = ask(method="rk4", step=0.01)["cost"]
    assert cost["runs"] == 2
    assert cost["steps"] in (100, 200, 400)
    assert cost["run_evaluations"] == pytest.approx(4 * cost["steps"], abs=4)
    assert cost["rhs_evaluations"] > cost["run_evaluations"]
    assert 0.0 < cost["run_time"] <= cost["wall_time"]
    assert cost["rejected"] == 0
    assert math.isfinite(cost["wall_time"])


def test_times_of_a_computation_are_less_than_it_took() -> None:
    start = perf_counter()
    cost = ask()["cost"]
    taken = perf_counter() - start
    assert 0.0 <= cost["compile_time"] <= taken
    assert 0.0 < cost["run_time"] <= cost["wall_time"] <= taken


@pytest.mark.parametrize(("share", "samples"), [(0.99, 9), (1.01, 8)])
def test_an_answer_leaves_room_for_differences_below_the_largest_double(share: float, samples: int) -> None:
    """A point that moves to a sixteenth of it, and no farther."""
    far = share * (sys.float_info.max / 16.0)
    points = {"far": ["c*x", "0"]}
    scene = document({"x": (0.0, 64.0)}, {"m": 1.0, "c": far / 64.0}, {"mass": ("m", ["x", "0"])}, points=points)
    answer = ask(scene=scene, t_end=1.0)
    assert len(answer["t"]) == len(answer["positions"]["far"]) == samples


@pytest.mark.parametrize("include", [["coordinates"], ["error"]])
def test_impacts_are_told_with_their_times_and_losses(include: list[str]) -> None:
    """A ball of 3 kg falls 0.7 m; of each speed 0.6 is left, of each energy 0.36: t₁ = √(2h/g), then 2·0.6ᵏ·t₁ more."""
    weight = {"kind": "gravity", "acceleration": ["0", "-g"]}
    floor = {"name": "floor", "value": "y", "then": "bounce", "restitution": "0.6"}
    scene = document({"y": (0.7, 0.0)}, {"m": 3.0, "g": 9.81}, {"ball": ("m", ["0", "y"])}, [weight])
    told = ask(scene=scene | {"events": [floor]}, t_end=1.2, include=include)["events"]
    first, energy = math.sqrt(1.4 / 9.81), 3.0 * 9.81 * 0.7
    times = [first, 2.2 * first, 2.92 * first]
    assert [each["time"] for each in told] == pytest.approx(times, rel=1e-12)
    assert [each["loss"] for each in told] == [float(f"{0.64 * energy * 0.36**k:.6g}") for k in range(3)]
    assert [(each["name"], each["kind"]) for each in told] == [("floor", "impact")] * 3
    errors = [each["error"] for each in told]
    if "error" in include:
        assert all(0.0 < error < 1e-10 for error in errors)
        assert max(map(digits, errors)) == 3
    else:
        assert errors == [None] * 3
        assert all(each["time"] == round(each["time"], 15) for each in told)


@pytest.mark.parametrize(
    ("scene", "more", "reactions"),
    [
        ("guided-pendulum", {"release": ["l", "y"]}, {"l": ("N", True), "y": ("N", False)}),
        ("cartesian-pendulum", {}, {"S": ("N", True)}),
        ("chaplygin-sleigh", {}, {"lambda": ("N", False)}),
        ("four-bar", {}, {"lambda_x": ("N", False), "lambda_y": ("N", False)}),
    ],
)
def test_a_length_is_held_by_what_can_go_slack(
    scene: str, more: dict[str, object], reactions: dict[str, tuple[str, bool]]
) -> None:
    """A rod or a string by its constraint or its length; not a blade, a loop that closes, or a guide."""
    told = ask(scene=scene, include=["multipliers"], t_end=0.1, samples=2, **more)
    assert {name: (each["unit"], each["of_rod"]) for name, each in told["reactions"].items()} == reactions
    assert told["multipliers"].keys() == reactions.keys()


@pytest.mark.parametrize(("share", "moved"), [(0.9, False), (1.1, True)])
def test_a_large_value_may_be_moved_by_a_billionth_of_itself(share: float, moved: bool) -> None:
    """On a circle of 500 m, where x = 300 and y = −400 but for what is added to y; along the rod that is 0.8 of it."""
    added = share * 400e-9 / 0.8**2
    initial = {"x": {"value": 300.0}, "y": {"value": -400.0 - added}}
    told = ask(scene=write_scene(pendulum()), t_end=0.01, parameters={"l": 500.0}, initial=initial)["moved"]
    assert (told is not None) is moved
    if told:
        assert told["y"]["value"] == pytest.approx(0.8**2 * added, rel=1e-3)


def test_multipliers_are_told_to_those_who_ask_and_as_long_as_their_errors_allow() -> None:
    asked = {"scene": write_scene(pendulum()), "method": "rk4", "step": 0.02, "t_end": 1.0}
    whole, alone, others = (ask(**asked, **more) for more in ({}, {"include": ["multipliers"]}, {"include": ["rates"]}))
    told, errors = whole["multipliers"]["S"], whole["error"]["multipliers"]["S"]
    for value, error in zip(told[1:], errors[1:], strict=True):
        assert value == round(value, math.ceil(-math.log10(error)) + 3)
    np.testing.assert_allclose(alone["multipliers"]["S"], told, atol=1e-4)
    assert max(digits(value) for value in alone["multipliers"]["S"]) > max(map(digits, told))
    assert {"multipliers", "reactions"} <= alone.keys()
    assert not {"multipliers", "reactions"} & others.keys()
    assert max(map(digits, errors)) == 3


@pytest.mark.parametrize(
    ("x", "rate", "told"),
    [
        ((1.0, 0.0), (8e-10, 0.0), None),
        ((1.0, 0.0), (1.5e-9, 0.0), {"x": {"value": 0.0, "rate": -1.5e-9}}),
        ((1.0 + 8e-10, 0.0), (0.0, 0.0), None),
        ((1.0 + 1.5e-9, 0.0), (0.0, 0.0), {"x": {"value": -1.5e-9, "rate": 0.0}}),
        ((0.6, -0.8), (800.0 + 1e-6, 600.0), None),
        (
            (0.6, -0.8),
            (800.0 + 4e-6, 600.0),
            {"x": {"value": 0.0, "rate": -1.44e-6}, "y": {"value": 0.0, "rate": 1.92e-6}},
        ),
    ],
)
def test_what_was_added_to_initial_values_is_told_from_a_billionth_of_them_or_of_one_on(
    x: tuple[float, float], rate: tuple[float, float], told: object
) -> None:
    """On a circle of 1 m: what lies along the rod is taken away, of values and of rates."""
    initial = {name: {"value": q, "rate": v} for name, q, v in zip("xy", x, rate, strict=True)}
    assert ask(scene=write_scene(pendulum()), t_end=0.01, initial=initial)["moved"] == told


def test_what_was_added_has_six_digits() -> None:
    initial = {"x": {"value": 0.6012345678, "rate": 0.0123456789}, "y": {"value": -0.8098765432, "rate": 0.0198765432}}
    moved = ask(scene=write_scene(pendulum()), t_end=0.01, initial=initial)["moved"]
    for name in ("value", "rate"):
        assert max(digits(each[name]) for each in moved.values()) == 6


def test_multipliers_stand_in_the_order_of_the_scene() -> None:
    """Those of laws of rates first where they come first, though positions are kept before them."""
    scene = constrained(
        {"x": (0.6, 0.0), "y": (-0.8, 0.0), "u": (0.0, 1.0), "v": (0.0, 0.0), "phi": (0.0, 0.5)},
        {"m": 1.0, "l": 1.0, "g": G},
        [particle("ball", "x", "y"), particle("one", "u + cos(phi)", "v + sin(phi)"), particle("two", "u", "v")],
        [equation("B", "dot(v)*cos(phi) - dot(u)*sin(phi) = 0"), rod("S", "pivot", "ball")],
        points={"pivot": ["0", "0"]},
    )
    told = ask(scene=write_scene(scene), t_end=0.1, samples=2)
    assert list(told["multipliers"]) == list(told["reactions"]) == list(told["error"]["multipliers"]) == ["B", "S"]
    # m g cos φ of a rod that hangs at rest with cos φ = 0.8; the blade holds both on the level against 2 m g at first.
    assert told["multipliers"]["S"][0] == pytest.approx(0.8 * G)


def test_where_the_mass_matrix_has_no_inverse_there_is_no_condition() -> None:
    at_the_pole = {"theta": {"value": 0.0, "rate": 0.0}, "psi": {"value": 0.0, "rate": 1.0}}
    answer = ask(scene="spherical-pendulum", initial=at_the_pole)
    assert (answer["status"], answer["condition"]) == ("singular_mass_matrix", None)


def test_friction_has_no_digits_beyond_what_doubles_hold() -> None:
    """However large it is: 10⁻¹² of the largest is left to rounding, and three digits more are told."""
    floor = {"name": "floor", "kind": "friction", "coordinate": "x", "force": "m*g*(1 + exp(-abs(dot(x))))/3"}
    scene = document({"x": (0.0, 9.0)}, {"m": 7e3, "g": 9.81}, {"block": ("m", ["x", "0"])}, [floor])
    told = ask(scene=scene, include=["loads"], samples=101)["friction"]["floor"]
    places = math.ceil(12 - math.log10(max(map(abs, told["largest"])))) + 3
    for name in ("force", "largest"):
        assert [value for value in told[name] if value != round(value, places)] == []


def test_friction_is_told_beside_what_could_hold() -> None:
    """A block of 2 kg at 3 m/s is stopped by μ m g = 8 N less a pull of 2 N, and held by 2 N from t = 1 s on."""
    loads = [
        {"name": "pull", "kind": "force", "at": "block", "force": ["2", "0"]},
        {"name": "floor", "kind": "friction", "coordinate": "x", "force": "0.4*m*g"},
    ]
    scene = document({"x": (0.0, 3.0)}, {"m": 2.0, "g": 10.0}, {"block": ("m", ["x", "0"])}, loads)
    told = ask(scene=scene, include=["loads"])
    force, largest = (np.array(told["friction"]["floor"][name]) for name in ("force", "largest"))
    t = np.array(told["t"])
    assert set(told["friction"]) == {"floor"}
    np.testing.assert_allclose(largest, 8.0, rtol=1e-12)
    np.testing.assert_allclose(force[t < 0.99], -8.0, rtol=1e-12)
    np.testing.assert_allclose(force[t > 1.01], -2.0, rtol=1e-12)
    assert "friction" not in ask(scene=scene, include=["coordinates"])


def test_reactions_are_told_as_far_as_the_motion_knows_them() -> None:
    """Three cranks carry a beam that two would carry, beside a mass on a rod of its own, hanging at rest."""
    scene = constrained(
        {"u": (0.0, 0.0), "v": (-2.0, 0.0), "x": (0.0, 1.0), "y": (-1.0, 0.0), "phi": (0.0, 0.0)},
        {"m": 1.0, "l": 1.0, "k": 2.0, "b": 1.0, "g": G},
        [
            particle("one", "x - b*cos(phi)", "y - b*sin(phi)"),
            particle("mid", "x", "y"),
            particle("two", "x + b*cos(phi)", "y + b*sin(phi)"),
            particle("ball", "u", "v"),
        ],
        [
            rod("S1", "left", "one"),
            rod("S2", "pivot", "mid"),
            rod("T", "pivot", "ball", "k"),
            rod("S3", "right", "two"),
        ],
        points={"left": ["-b", "0"], "pivot": ["0", "0"], "right": ["b", "0"]},
    )
    told = ask(scene=write_scene(scene), t_end=0.3, samples=4)
    assert (told["undetermined"], told["moved"]) == (["S1", "S2", "S3"], None)
    assert told["multipliers"] == {"T": [G] * 4}
    assert told["reactions"] == {"T": {"unit": "", "of_rod": True}}
    assert told["error"]["multipliers"].keys() == {"T"}
    # φ is zero but for rounding, which is not to have lost its digits.
    assert (told["status"], told["error"]["horizon"]) == ("ok", None)
