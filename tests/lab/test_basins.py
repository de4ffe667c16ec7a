"""The lab of basins against symmetry, closed forms and SciPy's runs of the same starts; and what it refuses."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.simulation.scenes import document

from deltaq.errors import InputError
from deltaq.lab.attractors import IN_VAIN, Stroboscope
from deltaq.lab.library import get_experiment
from deltaq.lab.uncertain_boundary import DISTANCES, boundary_of, wilson


def line(energy: str, *loads: dict[str, Any], **values: float) -> dict[str, Any]:
    """A particle on a line, damped by −c ẋ."""
    well = {"kind": "potential", "name": "well", "energy": energy}
    drag = {"kind": "dissipation", "name": "drag", "function": "c*dot(x)^2/2"}
    given = {"m": 1.0, "c": 0.25, "F": 0.0, "w": 1.0, **values}
    return document({"x": (1.0, 0.0)}, given, {"p": ("m", ["x", "0"])}, [well, drag, *loads])


DUFFING = line("m*(x^4/4 - x^2/2)")
SQUARE = {"x_from": -2.0, "x_to": 2.0, "y_from": -2.0, "y_to": 2.0}


def ask(**fields: Any) -> dict[str, Any]:
    *_, last = get_experiment("basins").run({"count": 16, "pairs": 0, **fields})
    return last.result  # type: ignore[return-value]


@cache
def of_duffing() -> dict[str, Any]:
    return ask(scene=DUFFING, **SQUARE, t_end=40.0, count=24, pairs=300)


def test_both_wells_of_duffing_have_half_of_the_plane() -> None:
    """ẍ = x − x³ − c ẋ: rests at ±1, λ = −c/2 ± i√(2 − c²/4); a point reflection changes one basin into the other."""
    found = of_duffing()
    places = sorted(one["state"]["x"]["value"] for one in found["attractors"])
    assert places == pytest.approx([-1.0, 1.0], abs=1e-6)
    basins = np.array(found["basins"])
    np.testing.assert_array_equal(basins, 1 - basins[::-1, ::-1])
    for one in found["attractors"]:
        assert one["period"] is None
        assert one["share"] == 0.5
        assert one["interval"][0] < 0.5 < one["interval"][1]
        assert one["contraction"] == pytest.approx(math.exp(-0.125), rel=1e-3)
    assert (found["unsettled"], found["unsure"], found["driven"]) == (0.0, 0.0, False)


def test_a_rest_that_nothing_comes_to_is_no_attractor() -> None:
    """A start in the saddle of Duffing stays there for ever, and comes to no attractor."""
    found = ask(scene=DUFFING, **SQUARE, t_end=40.0, count=9)
    assert sorted(round(one["state"]["x"]["value"], 5) for one in found["attractors"]) == [-1.0, 1.0]
    assert found["basins"][4][4] == -1
    assert found["unsettled"] == pytest.approx(1.0 / 81.0, abs=1e-4)


def test_the_boundary_of_duffing_without_a_drive_is_a_curve() -> None:
    """It is the stable manifold of the saddle: its dimension is 1."""
    boundary = of_duffing()["boundary"]
    assert boundary["interval"][0] <= 1.0 <= boundary["interval"][1]
    assert boundary["interval"][1] - boundary["interval"][0] < 0.8


def test_basins_of_duffing_are_those_of_scipys_runs() -> None:
    found = of_duffing()
    basins, x, y = np.array(found["basins"]), found["x"]["values"], found["y"]["values"]
    for row, column in np.ndindex(4, 4):
        i, j = 1 + 6 * row, 4 + 5 * column
        run = solve_ivp(
            lambda _t, s: [s[1], s[0] - s[0] ** 3 - 0.25 * s[1]],
            (0, 80),
            [x[j], y[i]],
            "DOP853",
            rtol=1e-10,
            atol=1e-10,
        )
        rest = found["attractors"][basins[i, j]]["state"]["x"]["value"]
        assert rest == pytest.approx(run.y[0, -1], abs=1e-2)


@cache
def of_magnets() -> dict[str, Any]:
    return ask(scene="magnetic-pendulum", count=24, pairs=150)


def test_three_equal_magnets_have_equal_basins_over_a_symmetric_place() -> None:
    """Each a third by symmetry; the rests are turned by 120°, where the forces of the model vanish."""
    found = of_magnets()
    assert len(found["attractors"]) == 3
    x, y = np.meshgrid(found["x"]["values"], found["y"]["values"])
    inside = np.array(found["basins"])[np.hypot(x, y) < 0.2]  # the disc is turned into itself, the square is not
    radii = []
    for number, one in enumerate(found["attractors"]):
        low, high = wilson(int((inside == number).sum()), len(inside))
        assert low < 1.0 / 3.0 < high
        at = [one["state"][name]["value"] for name in "xy"]
        radii.append(math.hypot(*at))
        assert math.atan2(at[1], at[0]) * 6.0 / math.pi % 4.0 == pytest.approx(3.0, abs=1e-4)  # 90°, 210°, 330°
        assert one["contraction"] == pytest.approx(math.exp(-0.6), rel=1e-3)  # e^(−c/2m)
    assert np.ptp(radii) < 1e-6
    basins = np.array(found["basins"])
    by_place = {number: one["state"]["x"]["value"] for number, one in enumerate(found["attractors"])}
    ends = np.vectorize(by_place.get)(basins)
    assert np.mean(np.abs(ends + ends[:, ::-1]) < 1e-4) > 0.98  # mirrored left and right


def test_the_boundary_of_the_magnets_is_no_curve_at_these_distances() -> None:
    low, high = of_magnets()["boundary"]["interval"]
    assert 1.0 < low < high < 2.0


def test_a_driven_motion_comes_to_its_forced_vibration() -> None:
    """ẍ + c ẋ + x = F cos 2t: the state at t = 0 of F (−3 cos 2t + 2c sin 2t)/(9 + 4c²), from every start."""
    force = {"kind": "force", "name": "drive", "at": "p", "force": ["F*cos(w*t)", "0"]}
    scene = line("m*x^2/2", force, F=1.0, w=2.0, c=1.0)
    found = ask(scene=scene, **SQUARE, t_end=20.0, count=8)
    (one,) = found["attractors"]
    assert found["driven"]
    assert one["period"] == pytest.approx(math.pi, rel=1e-5)
    assert one["state"]["x"]["value"] == pytest.approx(-3.0 / 13.0, abs=1e-5)
    assert one["state"]["x"]["rate"] == pytest.approx(4.0 / 13.0, abs=1e-5)
    assert (one["share"], found["boundary"]) == (1.0, None)


def test_basins_of_the_driven_duffing_are_those_of_other_series() -> None:
    """ẍ = x − x³ − ẋ/4 + cos(t)/5 comes to a vibration in either well; true are heyoka's ends, where it is installed.

    They are so many that they have to go side by side, though something drives them.
    """
    heyoka = pytest.importorskip("heyoka")
    force = {"kind": "force", "name": "drive", "at": "p", "force": ["F*cos(w*t)", "0"]}
    scene = line("m*(x^4/4 - x^2/2)", force, F=0.2)
    found = ask(scene=scene, **SQUARE, t_end=25.0, count=26)
    x, v = heyoka.make_vars("x", "v")
    pull = x - x**3 - 0.25 * v + 0.2 * heyoka.cos(heyoka.time)
    motion = heyoka.taylor_adaptive([(x, v), (v, pull)], state=[0.0, 0.0])
    known = 0
    for i, row in enumerate(found["basins"]):
        for j, basin in enumerate(row):
            motion.time, motion.state[:] = 0.0, [4.0 * (each + 0.5) / 26.0 - 2.0 for each in (j, i)]
            motion.propagate_until(200.0 * math.pi)
            if basin >= 0:
                known += 1
                assert found["attractors"][basin]["state"]["x"]["value"] == pytest.approx(motion.state[0], abs=1e-3)
    assert known >= 500


def driven_by_itself(force: str, **values: float) -> dict[str, Any]:
    """A particle on a line under a force that may feed energy in."""
    load = {"kind": "force", "name": "force", "at": "p", "force": [force, "0"]}
    return document({"x": (1.0, 0.0)}, {"m": 1.0, **values}, {"p": ("m", ["x", "0"])}, [load])


def test_the_limit_cycle_of_van_der_pol() -> None:
    """For µ = 1 its amplitude is 2.008619861, its period 6.663286859 (Andersen, Geer, SIAM J. Appl. Math. 42, 1982)."""
    scene = driven_by_itself("mu*(1 - x^2)*dot(x) - x", mu=1.0)
    square = {"x_from": -4.0, "x_to": 4.0, "y_from": -4.0, "y_to": 4.0}
    found = ask(scene=scene, **square, t_end=30.0, count=8)
    (one,) = found["attractors"]
    assert one["period"] == pytest.approx(6.663286859, rel=1e-5)
    assert one["state"]["x"]["value"] == pytest.approx(2.008619861, rel=1e-5)
    assert (one["share"], found["unsettled"], found["driven"]) == (1.0, 0.0, False)


def test_a_rest_inside_of_a_limit_cycle_has_the_disc_between_them() -> None:
    """ẍ = −x − b ẋ (r² − 1)(r² − 4): r = 1 parts the basins, r = 2 attracts with e^(−12bt), the rest with e^(−2bt)."""
    scene = driven_by_itself("-x - b*dot(x)*(x^2 + dot(x)^2 - 1)*(x^2 + dot(x)^2 - 4)", b=0.02)
    square = {"x_from": -3.0, "x_to": 3.0, "y_from": -3.0, "y_to": 3.0}
    found = ask(scene=scene, **square, t_end=60.0, count=16)
    kinds = [one["orbit"] is not None for one in found["attractors"]]
    assert sorted(kinds) == [False, True]
    cycle, rest = found["attractors"][kinds.index(True)], found["attractors"][kinds.index(False)]
    x, y = np.meshgrid(found["x"]["values"], found["y"]["values"])
    np.testing.assert_array_equal(np.array(found["basins"]) == kinds.index(True), np.hypot(x, y) > 1.0)
    assert cycle["period"] == pytest.approx(math.tau, rel=1e-5)
    np.testing.assert_allclose(np.hypot(*cycle["orbit"]["x"].values()), 2.0, rtol=1e-4)
    assert cycle["contraction"] == pytest.approx(math.exp(-12.0 * 0.02), rel=1e-3)
    assert rest["contraction"] == pytest.approx(math.exp(-2.0 * 0.02), rel=1e-3)
    assert (found["unsettled"], rest["period"]) == (0.0, None)
    assert rest["state"]["x"] == {"value": 0.0, "rate": 0.0}  # and not what is left of it after so many seconds


@pytest.mark.parametrize(("torque", "kinds"), [(0.35, {False, True}), (0.2, {False})])
def test_a_pendulum_that_is_turned_rotates_or_rests(torque: float, kinds: set[bool]) -> None:
    """φ̈ = b − sin φ − c φ̇ for c = 0.2: above b = 4c/π it may go round for ever (Strogatz, §8.5); the time by SciPy."""
    turn = {"kind": "moment", "name": "motor", "angle": "phi", "moment": "b"}
    drag = {"kind": "dissipation", "name": "drag", "function": "c*dot(phi)^2/2"}
    weight = {"kind": "potential", "name": "weight", "energy": "-m*cos(phi)"}
    values = {"m": 1.0, "l": 1.0, "c": 0.2, "b": torque}
    bob = {"p": ("m", ["l*sin(phi)", "-l*cos(phi)"])}
    scene = document({"phi": (0.0, 0.0)}, values, bob, [turn, drag, weight])
    found = ask(scene=scene, vertical="dot(phi)", y_from=-3.0, y_to=3.0, t_end=60.0, count=10)
    assert {one["orbit"] is not None for one in found["attractors"]} == kinds
    for one in (each for each in found["attractors"] if each["orbit"]):
        run = solve_ivp(
            lambda _t, s: [s[1], torque - math.sin(s[0]) - 0.2 * s[1]],
            (0.0, 400.0),
            [0.0, 3.0],
            "DOP853",
            rtol=1e-11,
            atol=1e-11,
            events=lambda _t, s: math.sin(s[0] / 2.0),
        )
        assert one["period"] == pytest.approx(run.t_events[0][-1] - run.t_events[0][-2], rel=1e-5)


def test_motions_too_slow_to_settle_are_not_all_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """In a tenth of a second nothing moves far: each of 1,024 motions seems to rest where it is, in each of 4 spans."""
    tried: list[object] = []
    monkeypatch.setattr(Stroboscope, "attractor", lambda self, start, periods: tried.append(start))
    monkeypatch.setattr(Stroboscope, "cycle", lambda self, start: None)
    with pytest.raises(InputError, match="basins-none"):
        ask(scene=line("0*x", c=0.0), **SQUARE, t_end=0.1, count=32)
    stages, spans = 4, 4
    assert IN_VAIN < len(tried) <= stages * spans * IN_VAIN


def test_an_angle_is_the_same_after_a_turn() -> None:
    found = ask(scene="damped-pendulum", vertical="dot(phi)", y_from=-12.0, y_to=12.0, t_end=60.0, count=10)
    (one,) = found["attractors"]
    assert math.sin(one["state"]["phi"]["value"] / 2.0) == pytest.approx(0.0, abs=1e-6)


def test_the_exponent_of_drawn_hits_is_found_and_its_interval_covers() -> None:
    """f = 2 ε^α for given α, hits of one start following one another as they do: nearer neighbours are hit less."""
    covered = 0
    for alpha in (0.2, 0.6, 1.0):
        for seed in range(10):
            draws = np.random.default_rng([int(10 * alpha), seed]).uniform(size=(300, 1))
            hits = draws < 2.0 * DISTANCES[None, :] ** alpha / (1.0 if alpha > 0.5 else 4.0)
            found = boundary_of(hits, np.ones_like(hits), seed)
            assert found is not None
            covered += found.low <= alpha <= found.high
    assert covered >= 25  # 95 % of 30 are 28.5


def test_intervals_of_parts_cover() -> None:
    for part in (0.05, 1.0 / 3.0, 0.5):
        hits = np.random.default_rng(3).binomial(200, part, 2000)
        covered = [low <= part <= high for low, high in (wilson(int(one), 200) for one in hits)]
        assert np.mean(covered) == pytest.approx(0.95, abs=0.025)


REFUSED = [
    pytest.param({"scene": line("m*x^2/2", c=0.0)}, "basins-none", "/t_end", id="no damping"),
    pytest.param({"count": 150, "t_end": 100.0}, "basins-too-large", "/count", id="too long"),
    pytest.param({"scene": line("abs(x)"), "count": 60}, "basins-too-large-singly", "/count", id="too long singly"),
    pytest.param({"horizontal": "z"}, "ensemble-quantity", "/horizontal", id="no such coordinate"),
    pytest.param({"horizontal": "x", "vertical": "x"}, "basins-same-axes", "/vertical", id="one axis twice"),
    pytest.param({"x_from": 1.0, "x_to": 1.0}, "basins-no-side", "/x_to", id="no side"),
    pytest.param({"y_to": 1e308}, "request-outside", "/y_to", id="as far as numbers go"),
    pytest.param({"x_from": math.inf}, "request-not-finite", "/x_from", id="not finite"),
    pytest.param({"scene": "cartesian-pendulum"}, "lab-starts-with-constraints", "/scene", id="constraints"),
    pytest.param({"scene": "stick-slip"}, "lab-friction", "/scene", id="dry friction"),
]


@pytest.mark.parametrize(("fields", "code", "pointer"), REFUSED)
def test_what_has_no_basins_is_told_with_what_to_do(fields: dict[str, Any], code: str, pointer: str) -> None:
    with pytest.raises(InputError) as caught:
        ask(**{"scene": DUFFING, **fields})
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]
