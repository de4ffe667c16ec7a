"""Where motions cross a plane: against closed forms, SciPy's events, and each other."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq
from tests.simulation.scenes import scene

from deltaq.language.parser import parse
from deltaq.mechanics.scene import Scene
from deltaq.model.observables import Observables
from deltaq.simulation.kernels.motion import FINE, NOT_FINITE, TOO_LARGE
from deltaq.simulation.march import GOES_ON
from deltaq.simulation.problem import Floats
from deltaq.simulation.run import Steps
from deltaq.simulation.section import ORDER, TOLERANCE, Crossings, Standing, Surface, follow
from deltaq.simulation.service import problem_of

STEPS = Steps(10.0, TOLERANCE, order=ORDER)


def plane(energy: str) -> Scene:
    """A particle of mass m in the plane, in a potential."""
    load = {"kind": "potential", "name": "well", "energy": energy}
    return scene({"x": (0.0, 0.0), "y": (0.0, 0.0)}, {"m": 1.0, "a": 2.0}, {"p": ("m", ["x", "y"])}, [load])


def crossings(
    of: Scene, cut: str, starts: Floats, t_end: float, direction: int = 1, most: int = 10_000, turn: float = math.inf
) -> tuple[Crossings, Standing]:
    """All crossings together, and where the motions stand at the end."""
    surface = Surface(Observables(of).observable(parse(cut, of.names)).jet.table, direction, turn)
    found = list(follow(problem_of(of, t_end), surface, starts, STEPS, most, np.zeros(1, dtype=np.int64)))
    parts = [np.concatenate([getattr(part, name) for part, _ in found]) for name in ("motions", "times", "states")]
    order = np.lexsort((parts[1], parts[0]))
    speeds = np.concatenate([part.speeds for part, _ in found])
    return Crossings(parts[0][order], parts[1][order], parts[2][order], speeds[order]), found[-1][1]


def test_points_of_two_oscillators_lie_on_their_ellipse() -> None:
    """x = X sin t, y = Y cos(a t + β): where x rises through 0, (y, ẏ) is at the angles 2πak + β of an ellipse."""
    a, beta = math.sqrt(2.0), 0.3
    sizes = np.linspace(0.2, 1.4, 5)
    zero = np.zeros(5)
    starts = np.column_stack([zero, sizes * math.cos(beta), 1.0 + zero, -sizes * a * math.sin(beta)])
    found, standing = crossings(plane("m*x^2/2 + m*a*y^2/2"), "x", starts, 200.0)
    for number, size in enumerate(sizes):
        mine = found.motions == number
        times, (_, y, u, v) = found.times[mine], found.states[mine].T
        np.testing.assert_allclose(times, math.tau * np.arange(32), atol=1e-11)
        np.testing.assert_allclose(y, size * np.cos(a * times + beta), atol=1e-10)
        np.testing.assert_allclose(v, -size * a * np.sin(a * times + beta), atol=1e-10)
        np.testing.assert_allclose(u, 1.0, atol=1e-11)
    assert standing.outcomes.tolist() == [FINE] * 5
    np.testing.assert_array_equal(standing.reached, 200.0)


@pytest.mark.parametrize("beside", ["", " + m*max(0, x - 50)"], ids=["smooth", "a kink elsewhere"])
@pytest.mark.parametrize("width", [0.05, 5e-3, 1e-3])
def test_a_hill_that_is_thinner_than_a_step_is_seen(width: float, beside: str) -> None:
    """U = e^(−(x/w)²)/8 on the way, ÿ = −y: at 2πk, x is behind by ∫ 1/√(u² − 2U) − 1/u dx where it came with u = 1."""
    hill = plane(f"m*y^2/2 + m*exp(-(x/{width})^2)/8{beside}")
    starts = np.column_stack([np.linspace(-1.4, -0.6, 5), np.zeros(5), np.ones(5), np.ones(5)])
    found, _ = crossings(hill, "y", starts, 20.0)
    delay = width * quad(lambda y: 1.0 / math.sqrt(1.0 - 0.25 * math.exp(-(y**2))) - 1.0, -9.0, 9.0)[0]
    for number, begin in enumerate(starts[:, 0]):
        mine = found.motions == number
        turns = math.tau * np.arange(1, 4)
        np.testing.assert_allclose(found.times[mine][-3:], turns, atol=1e-11)
        np.testing.assert_allclose(found.states[mine][-3:, 0], begin + turns - delay, atol=1e-10)


@pytest.mark.parametrize(("direction", "first"), [(1, 2.0 * math.pi), (-1, math.pi), (0, math.pi)])
def test_only_crossings_in_the_direction_count(direction: int, first: float) -> None:
    found, _ = crossings(plane("m*x^2/2 + m*y^2/2"), "y", np.array([[0.0, 0.0, 0.0, 1.0]]), 20.0, direction)
    step = math.pi if direction == 0 else math.tau
    expected = np.arange(first, 20.0, step)
    expected = expected if direction < 0 else np.array([0.0, *expected])
    np.testing.assert_allclose(found.times, expected, atol=1e-11)
    assert np.all(np.sign(found.speeds) == (direction or np.sign(found.speeds)))


def test_kepler_passes_its_pericentre_once_in_a_period() -> None:
    """r ṙ = x ẋ + y ẏ rises through zero at the pericentre alone: there r = a (1 − e), after each period 2π a^(3/2)."""
    e = 0.9
    start = np.array([[1.0 + e, 0.0, 0.0, math.sqrt((1.0 - e) / (1.0 + e))]])
    found, _ = crossings(plane("-m/sqrt(x^2 + y^2)"), "x*dot(x) + y*dot(y)", start, 60.0)
    np.testing.assert_allclose(found.times, math.pi + math.tau * np.arange(10), rtol=1e-11)
    np.testing.assert_allclose(np.hypot(*found.states[:, :2].T), 1.0 - e, atol=1e-10)


def test_a_drive_is_looked_at_once_in_each_period() -> None:
    """ẍ + x = cos 2t from rest at x₀: x = (x₀ + 1/3) cos t − cos(2t)/3; at t = kπ the plane sin 2t rises."""
    driven = scene(
        {"x": (0.0, 0.0)},
        {"m": 1.0, "k": 1.0},
        {"p": ("m", ["x", "0"])},
        [{"kind": "force", "name": "pull", "at": "p", "force": ["-k*x + cos(2*t)", "0"]}],
    )
    starts = np.array([[0.5, 0.0], [-1.0, 0.0]])
    found, _ = crossings(driven, "sin(2*t)", starts, 50.0)
    for number in (0, 1):
        mine = found.motions == number
        np.testing.assert_allclose(found.times[mine], math.pi * np.arange(16), atol=1e-11)
        expected = (starts[number, 0] + 1.0 / 3.0) * np.cos(found.times[mine]) - 1.0 / 3.0
        np.testing.assert_allclose(found.states[mine, 0], expected, atol=1e-11)


HENON_HEILES = "m*(x^2 + y^2)/2 + x^2*y - y^3/3"


def test_points_of_henon_and_heiles_are_those_of_scipys_events() -> None:
    start = np.array([0.0, 0.1, math.sqrt(2.0 / 12.0 - 0.1**2 + 2.0 * 0.1**3 / 3.0 - 0.05**2), 0.05])

    def flow(_t: float, s: Floats) -> list[float]:
        return [s[2], s[3], -s[0] - 2.0 * s[0] * s[1], -s[1] - s[0] ** 2 + s[1] ** 2]

    def rises(_t: float, s: Floats) -> float:
        return float(s[0])

    rises.direction = 1.0  # type: ignore[attr-defined]
    true = solve_ivp(flow, (0.0, 100.0), start, method="DOP853", rtol=1e-13, atol=1e-14, events=rises)
    found, _ = crossings(plane(HENON_HEILES), "x", start[None, :], 100.0)
    expected = true.t_events[0][true.t_events[0] > 1e-6]
    np.testing.assert_allclose(found.times[1:], expected, atol=1e-9)
    np.testing.assert_allclose(found.states[1:], true.y_events[0][-len(expected) :], atol=1e-9)
    np.testing.assert_allclose(found.states[:, 0], 0.0, atol=1e-15)


def test_orbits_do_not_depend_on_their_neighbours() -> None:
    starts = np.column_stack([np.zeros(20), np.linspace(-0.2, 0.3, 20), np.full(20, 0.3), np.full(20, 0.1)])
    together, _ = crossings(plane(HENON_HEILES), "x", starts, 60.0)
    alone, _ = crossings(plane(HENON_HEILES), "x", starts[13:14], 60.0)
    np.testing.assert_array_equal(together.states[together.motions == 13], alone.states)


@pytest.mark.parametrize(("level", "count"), [(1.0 - 1e-9, 2), (1.0 + 1e-9, 0)])
def test_a_plane_that_is_nearly_touched_is_crossed_twice_or_never(level: float, count: int) -> None:
    """x = sin t comes as high as 1, in between two looks at it."""
    found, _ = crossings(plane("m*(x^2 + y^2)/2"), f"x - {level!r}", np.array([[0.0, 0.0, 1.0, 0.0]]), 3.0, 0)
    assert len(found.times) == count
    apart = math.acos(level) if count else 0.0
    np.testing.assert_allclose(found.times, [math.pi / 2 - apart, math.pi / 2 + apart][:count], atol=1e-9)


def test_a_plane_that_turns_faster_than_the_motion_is_seen() -> None:
    """A free particle takes steps as long as it likes; sin 40t goes through zero 40 times in 2π."""
    found, _ = crossings(plane("0*x"), "sin(40*t)", np.array([[0.0, 0.0, 1.0, 0.0]]), 10.0)
    np.testing.assert_allclose(found.times, math.tau / 40.0 * np.arange(64), atol=1e-12)


def test_an_angle_crosses_anew_after_each_turn() -> None:
    """A pendulum without weight turns evenly: φ = 3t passes 0, 2π, 4π … where a turn leaves it the same."""
    arm = scene(
        {"phi": (0.0, 3.0), "y": (0.0, 0.0)},
        {"m": 1.0, "l": 1.0},
        {"bob": ("m", ["l*sin(phi)", "l*cos(phi)"]), "other": ("m", ["0", "y"])},
    )
    found, _ = crossings(arm, "phi", np.array([[0.0, 0.0, 3.0, 0.0]]), 10.0, turn=math.tau)
    np.testing.assert_allclose(found.times, math.tau / 3.0 * np.arange(5), atol=1e-12)


def test_forces_with_kinks_are_met_where_they_bend() -> None:
    """ẍ = −sign x: parabolas, from x = 1/2 back through zero at t = 1, 3, 5 …, rising at t = 3, 7 …"""
    found, _ = crossings(plane("m*abs(x) + m*y^2/2"), "x", np.array([[0.5, 0.0, 0.0, 0.0]]), 12.0)
    np.testing.assert_allclose(found.times, [3.0, 7.0, 11.0], atol=1e-9)
    np.testing.assert_allclose(found.states[:, 2], 1.0, atol=1e-9)


def test_a_motion_that_runs_away_ends_and_the_others_go_on() -> None:
    """ẍ = x³ from far out is infinite in a finite time; y swings on beside it in another motion."""
    starts = np.array([[2.0, 0.0, 3.0, 1.0], [0.0, 0.0, 0.0, 1.0]])
    found, standing = crossings(plane("-m*x^4/4 + m*y^2/2"), "y", starts, 13.0)
    assert standing.outcomes[0] in (TOO_LARGE, NOT_FINITE) or standing.outcomes[0] not in (FINE, GOES_ON)
    assert standing.reached[0] < 1.0
    np.testing.assert_allclose(found.times[found.motions == 1], [0.0, math.tau, 2.0 * math.tau], atol=1e-11)


def test_an_orbit_ends_with_the_points_wanted() -> None:
    found, standing = crossings(plane("m*(x^2 + y^2)/2"), "y", np.array([[0.0, 0.0, 0.0, 1.0]]), 1e4, most=5)
    np.testing.assert_allclose(found.times[:5], math.tau * np.arange(5), atol=1e-11)
    assert (len(found.times), standing.outcomes[0]) == (5, FINE)
    assert standing.reached[0] < 40.0


def test_orbits_that_end_one_after_the_other_have_the_points_they_have_alone() -> None:
    """x = vt, y = 0.3 cos t: sin x rises at t = 2πk/v; the fastest of 21, three blocks of lanes, are first."""
    speeds = np.linspace(0.4, 2.5, 21)
    starts = np.column_stack([0.0 * speeds, np.full(21, 0.3), speeds, 0.0 * speeds])
    found, standing = crossings(plane("m*y^2/2"), "sin(x)", starts, 200.0, most=7)
    assert standing.outcomes.tolist() == [FINE] * 21
    np.testing.assert_array_equal(standing.crossed, 7)
    assert np.all(standing.reached < 6.0 * math.tau / speeds + 10.0)
    for number, speed in enumerate(speeds):
        mine, times = found.motions == number, math.tau * np.arange(7) / speed
        np.testing.assert_allclose(found.times[mine], times, atol=1e-11)
        np.testing.assert_allclose(found.states[mine, 1], 0.3 * np.cos(times), atol=1e-11)


def test_a_step_that_hides_a_crossing_is_gone_back_to_and_the_others_stay() -> None:
    """h = cos t + 3 exp(−2(t − 9)²), whatever the motion does: its zeros by Brent's method."""

    def h(t: float) -> float:
        return math.cos(t) + 3.0 * math.exp(-2.0 * (t - 9.0) ** 2)

    places = np.linspace(0.0, 40.0, 4001)
    rising = [(a, b) for a, b in pairwise(places) if h(a) < 0.0 <= h(b)]
    true = [brentq(h, a, b, xtol=1e-14, rtol=1e-14) for a, b in rising]
    starts = np.column_stack([np.zeros(3), np.zeros(3), np.full(3, 1.0), np.linspace(0.1, 0.5, 3)])
    found, _ = crossings(plane("m*(x^2 + y^2)/2"), "cos(t) + 3*exp(-2*(t - 9)^2)", starts, 40.0)
    for number in range(3):
        np.testing.assert_allclose(found.times[found.motions == number], true, atol=1e-12)


def test_steps_that_do_not_see_the_plane_are_gone_back_to() -> None:
    """Free particles take steps as long as they like; sin t² rises through zero where t² = 2πk, ever faster."""
    starts = np.column_stack([np.zeros(9), np.zeros(9), np.linspace(0.5, 2.0, 9), np.zeros(9)])
    found, standing = crossings(plane("0*x"), "sin(t^2)", starts, 12.0)
    for number in range(9):
        mine = found.motions == number
        times = np.sqrt(math.tau * np.arange(1, 23))
        np.testing.assert_allclose(found.times[mine], times, atol=1e-12)
        np.testing.assert_allclose(found.states[mine, 0], starts[number, 2] * times, rtol=1e-13)
    assert standing.outcomes.tolist() == [FINE] * 9


@pytest.mark.parametrize(
    ("cut", "roots"),
    [
        pytest.param("1/(x - 0.2) - 1", [(1.2, -1.0)], id="a pole"),
        pytest.param("tan(3*x)", [(0.0, 1.0), (math.pi / 3.0, 1.0), (-math.pi / 3.0, 1.0)], id="poles all along"),
        pytest.param("1/x", [], id="a pole alone"),
        pytest.param("sqrt(x) - 0.5", [(0.25, 1.0)], id="no value on one side"),
        pytest.param("log(x - 0.3)", [(1.3, 1.0)], id="no value on most of the way"),
        pytest.param("sign(x - 0.3)", [(0.3, 1.0)], id="a jump"),
        pytest.param("abs(x) - 0.3", [(0.3, 1.0), (-0.3, -1.0)], id="a kink"),
        pytest.param("max(x, 0) - 0.3", [(0.3, 1.0)], id="a part at rest"),
    ],
)
def test_planes_with_poles_jumps_and_without_values_are_crossed_where_they_are_zero(
    cut: str, roots: list[tuple[float, float]]
) -> None:
    """x = a sin t with a = 1.58; each root is crossed once in a period, in the direction in which h rises."""
    a, most = 1.58, 9
    begin = np.array([[a * math.sin(0.1), 0.0, a * math.cos(0.1), 0.0]])
    found, _ = crossings(plane("m*x^2/2 + m*a*y^2/2"), cut, begin, 40.0, most=most)
    once = [math.asin(x / a) if rate > 0.0 else math.pi - math.asin(x / a) for x, rate in roots]
    times = sorted(each + math.tau * k - 0.1 for each in once for k in range(-1, 8))
    expected = [time for time in times if 0.0 < time < 40.0][:most]
    np.testing.assert_allclose(found.times, expected, atol=1e-9)
