"""Motions along kinks where a force jumps with the sign of rates: closed forms, and Filippov's rule in SciPy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests.simulation.filippov import Filippov, Floats
from tests.simulation.scenes import document

from deltaq.mechanics.document import read_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import problem_of, run
from deltaq.simulation.trajectory import Trajectory

EVERY = pytest.mark.parametrize("method", method_ids())
FEW = pytest.mark.parametrize("method", ["dop853", "taylor", "radau-5"])
LOW = ("explicit-euler", "symplectic-euler", "heun", "newmark", "stormer-verlet", "variational-midpoint")


def moving(forces: Sequence[str], starts: Sequence[tuple[float, float]], **values: float) -> dict[str, Any]:
    """Unit masses on lines, x, y and z, each pushed along its own."""
    axes = "xyz"[: len(forces)]
    bodies = {f"p{axis}": ("m", [axis, "0"]) for axis in axes}
    loads = [
        {"kind": "force", "name": f"f{axis}", "at": f"p{axis}", "force": [force, "0"]}
        for axis, force in zip(axes, forces, strict=True)
    ]
    return document(dict(zip(axes, starts, strict=True)), {"m": 1.0, **values}, bodies, loads)


def motion(asked: dict[str, Any], t_end: float, method: str = "dop853", tolerance: float = 1e-9) -> Trajectory:
    return simulate(problem_of(read_scene(asked), t_end, 101), get_method(method), tolerance=tolerance)


def told(found: Trajectory) -> list[tuple[str, str]]:
    return [(each.kind, each.name) for each in found.transitions]


def errors_claimed(found: Trajectory) -> Floats:
    assert found.estimate is not None
    return found.estimate.errors


BRAKES = [
    pytest.param("-x - F*sign(dot(x))", id="sign"),
    pytest.param("-x + F - 2*F*step(dot(x))", id="step"),
    pytest.param("-x - F*abs(dot(x))/dot(x)", id="modulus over rate"),
    pytest.param("-x - F*max(sign(dot(x)), -1)", id="sign in a maximum"),
    pytest.param("-x + F*sign(-3*dot(x))", id="turned round"),
]


def swing(times: Floats, start: float, grip: float) -> tuple[Floats, float]:
    """x″ = −x ∓ F from rest: half swings that lose 2F each, until one ends within F; and when it does (Den Hartog)."""
    truth, half = np.empty(len(times)), 0
    while abs(start) > grip:
        side = math.copysign(grip, start)
        inside = times >= half * math.pi
        truth[inside] = side + (start - side) * np.cos(times[inside] - half * math.pi)
        start, half = 2.0 * side - start, half + 1
    truth[times >= half * math.pi] = start
    return truth, half * math.pi


@EVERY
def test_a_brake_stops_a_swing_and_holds_it(method: str) -> None:
    tolerance = 1e-3 if method in LOW else 1e-7
    found = motion(moving(["-x - F*sign(dot(x))"], [(2.0, 0.0)], F=0.3), 20.0, method, tolerance)
    truth, stop = swing(found.times, 2.0, 0.3)
    assert found.outcome.status == "ok"
    assert told(found) == [("slide", "dot(x)")]
    assert found.transitions[0].time == pytest.approx(stop, abs=10.0 * tolerance)
    assert (np.abs(found.values[:, 0] - truth) <= errors_claimed(found) + 1e-6 * tolerance).all()
    late = found.times > found.transitions[0].time
    assert np.abs(found.rates[late]).max() < 1e-15
    assert np.ptp(found.values[late]) < 1e-14


@FEW
@pytest.mark.parametrize("force", BRAKES)
def test_a_brake_may_be_written_in_many_ways(force: str, method: str) -> None:
    if "abs" in force and method == "taylor":
        force = force.replace("abs(dot(x))/dot(x)", "sign(dot(x))")
    found = motion(moving([force], [(2.0, 0.0)], F=0.3), 20.0, method)
    assert found.outcome.status == "ok"
    assert [kind for kind, _ in told(found)] == ["slide"]
    assert np.abs(found.values[:, 0] - swing(found.times, 2.0, 0.3)[0]).max() < 1e-9


@FEW
def test_what_pulls_harder_and_harder_starts_from_rest_when_it_can(method: str) -> None:
    """P t against F sign(ẋ − v), both at the rate v: ẋ = v until P t = F, then x is a cubic in what is over."""
    found = motion(moving(["P*t - F*sign(dot(x) - v)"], [(0.0, 0.5)], P=0.4, F=1.0, v=0.5), 6.0, method, 1e-10)
    assert told(found) == [("leave", "dot(x) - v")]
    over = np.maximum(found.times - 2.5, 0.0)
    assert found.transitions[0].time == pytest.approx(2.5, abs=1e-9)
    assert np.abs(found.values[:, 0] - 0.5 * found.times - 0.4 * over**3 / 6.0).max() < 1e-9
    assert np.ptp(_energy(found) - found.work) < 1e-9


@FEW
def test_a_motion_slides_down_an_oblique_line(method: str) -> None:
    """x″ = −x − F sign(x + 2ẋ) comes to x + 2ẋ = 0, and with |5x/4| < F goes on along it: x falls as e^(−t/2)."""
    found = motion(moving(["-x - F*sign(x + 2*dot(x))"], [(0.5, 0.0)], F=1.0), 10.0, method, 1e-10)
    (slide,) = found.transitions
    (x, v), late = slide.after[:2], found.times >= slide.time
    assert x + 2.0 * v == pytest.approx(0.0, abs=1e-14)
    assert slide.time == pytest.approx(math.acos(1.0 / math.sqrt(11.25)) - math.atan2(3.0, 1.5), abs=1e-10)
    assert (x + 1.0) ** 2 + v**2 == pytest.approx(2.25, abs=1e-9)  # about −F
    assert found.values[late, 0] == pytest.approx(x * np.exp(-(found.times[late] - slide.time) / 2.0), abs=1e-10)
    assert np.ptp(_energy(found) - found.work) < 1e-9


def _energy(found: Trajectory) -> Floats:
    """Of unit masses whose forces all count as work."""
    return np.asarray((found.rates**2).sum(axis=1) / 2.0)


@FEW
def test_two_bodies_that_rub_on_each_other_go_on_together(method: str) -> None:
    """One thrown on the other: both rates meet after v/(2μ), and what they had together stays."""
    rubbing = [f"{way}*F*sign(dot(x) - dot(y))" for way in (-1, 1)]
    found = motion(moving(rubbing, [(0.0, 3.0), (0.0, 1.0)], F=0.5), 5.0, method, 1e-10)
    assert told(found) == [("slide", "dot(x) - dot(y)")]
    meet = found.transitions[0].time
    assert meet == pytest.approx(2.0, abs=1e-10)
    late = found.times > meet
    assert np.abs(found.rates[late] - 2.0).max() < 1e-13
    assert found.values[-1] == pytest.approx([0.0 + 3.0 * 2.0 - 1.0 + 6.0, 2.0 + 1.0 + 6.0], abs=1e-9)
    assert np.ptp(_energy(found) - found.work) < 1e-11


@FEW
def test_what_drives_instead_of_braking_is_gone_through(method: str) -> None:
    """x″ = −x + F sign(ẋ): with each half swing the amplitude grows by 2F; at rest in the middle it stays."""
    found = motion(moving(["-x + F*sign(dot(x))"], [(2.0, 0.0)], F=0.3), 12.0, method, 1e-9)
    assert (found.outcome.status, found.transitions) == ("ok", ())
    half = np.minimum(found.times // math.pi, 3.0)
    start = (2.0 + 0.6 * half) * (-1.0) ** half
    side = -0.3 * np.sign(start)
    truth = side + (start - side) * np.cos(found.times - half * math.pi)
    assert np.abs(found.values[:, 0] - truth).max() < 1e-8
    still = motion(moving(["-x + F*sign(dot(x))"], [(0.0, 0.0)], F=0.3), 12.0, method, 1e-9)
    assert not still.values.any()
    assert still.outcome.status == "ok"


@FEW
def test_a_drag_that_only_bends_is_no_switch(method: str) -> None:
    """m v v̇ = −c v |v| − …: v² falls as e^(−2cx) on the way, and nothing is told where it turns."""
    found = motion(moving(["1 - c*dot(x)^2*sign(dot(x))"], [(0.0, -1.0)], c=0.5), 8.0, method, 1e-9)
    assert (found.outcome.status, found.transitions) == ("ok", ())
    full = math.sqrt(2.0)  # the rate at which drag and push balance
    turn = math.atan(1.0 / full) * full  # v = −V tan((t₁ − t)/V) while it comes back
    late = found.times > turn
    assert found.rates[late, 0] == pytest.approx(full * np.tanh((found.times[late] - turn) / full), abs=1e-8)
    assert found.rates[~late, 0] == pytest.approx(-full * np.tan((turn - found.times[~late]) / full), abs=1e-8)


SPANS = {
    "kx": (1.0, 4.0), "ky": (1.0, 4.0), "k": (-0.9, 0.9), "c": (0.0, 0.3), "drive": (0.0, 1.5), "pace": (0.5, 2.0),
    "ax": (-1.0, 1.0), "ay": (-1.0, 1.0), "cx": (-1.0, 1.0), "cy": (-1.0, 1.0), "belt": (0.0, 0.3),
    "jx": (-2.0, 2.0), "jy": (-2.0, 2.0),
}  # fmt: skip


@pytest.mark.parametrize("seed", range(12))
def test_slides_are_those_of_filippov_in_scipy(seed: int) -> None:
    """Two coupled masses, driven; the sign is that of any combination, and pushes in any direction that holds it."""
    source = Random(seed)
    values = {name: source.uniform(*span) for name, span in SPANS.items()}
    along = math.copysign(1.0, -values["jx"] * values["cx"] - values["jy"] * values["cy"])
    values |= {name: along * values[name] for name in ("jx", "jy")}
    x, u, y, v = (source.uniform(-1.5, 1.5) for _ in range(4))

    def field_of(t: float, at: Floats, sigma: float) -> Floats:
        g = SimpleNamespace(**values)
        x, y, u, v = at
        push = g.drive * math.cos(g.pace * t)
        return np.array(
            [u, v, -g.kx * x + g.k * y - g.c * u + push + sigma * g.jx, g.k * x - g.ky * y - g.c * v + sigma * g.jy]
        )

    slopes = np.array([values[name] for name in ("ax", "ay", "cx", "cy")])
    belt = values["belt"]
    truth = Filippov(field_of, slopes, lambda t: belt * math.sin(t), lambda t: belt * math.cos(t))
    at = truth.follow(np.array([x, y, u, v]), 12.0)
    w = "ax*x + ay*y + cx*dot(x) + cy*dot(y) - belt*sin(t)"
    forces = [
        f"-kx*x + k*y - c*dot(x) + drive*cos(pace*t) + jx*sign({w})",
        f"k*x - ky*y - c*dot(y) + jy*(2*step({w}) - 1)",
    ]
    for method in ("dop853", "taylor", "gauss-6"):
        found = motion(moving(forces, [(x, u), (y, v)], **values), 12.0, method, 1e-9)
        assert found.outcome.status == "ok"
        assert [each.kind for each in found.transitions] == [kind for kind, _ in truth.events]
        assert [each.time for each in found.transitions] == pytest.approx([t for _, t in truth.events], abs=1e-7)
        exact = np.array([at(t)[:2] for t in found.times])
        claimed = errors_claimed(found)[:, None]
        assert (np.abs(found.values - exact) <= claimed + 1e-10).all()
        assert np.ptp(_energy(found) - found.work) < 1e-9 * (1.0 + _energy(found).max())


@pytest.mark.parametrize(("method", "accuracy"), [("dop853", {"tolerance": 1e-8}), ("rk4", {"step": 0.01})])
def test_a_sign_is_followed_as_dry_friction_is(method: str, accuracy: dict[str, float]) -> None:
    """A driven block sticks and slips: once by its own kind of load, once by a sign in a force."""
    drive = "-x + P*cos(w*t)"
    values = {"P": 0.5, "w": 0.3, "F": 0.3}
    by_sign = moving([f"{drive} - F*sign(dot(x) - 0.05)"], [(2.0, 0.0)], **values)
    by_load = moving([drive], [(2.0, 0.0)], **values)
    rubs = {"kind": "friction", "name": "rubs", "coordinate": "x", "force": "F", "surface_rate": "0.05"}
    by_load["loads"] = [*by_load["loads"], rubs]
    one, other = (
        simulate(problem_of(read_scene(each), 40.0, 101), get_method(method), **accuracy) for each in (by_sign, by_load)
    )
    names = {"stick": "slide", "slip": "leave"}
    expected = [names[each.kind] for each in other.transitions if each.kind in names]
    assert len(expected) >= 4
    assert [each.kind for each in one.transitions] == expected
    shared = np.isin(one.times, np.linspace(0.0, 40.0, 101)), np.isin(other.times, np.linspace(0.0, 40.0, 101))
    apart = np.abs(one.values[shared[0], 0] - other.values[shared[1], 0])
    assert apart.max() <= 1e-7 if method == "dop853" else 1e-6
    assert one.work[-1] == pytest.approx(other.work[-1], abs=1e-6)


@EVERY
def test_with_a_step_as_given_the_estimate_covers_the_rest(method: str) -> None:
    found = simulate(
        problem_of(read_scene(moving(["-x - F*sign(dot(x))"], [(2.0, 0.0)], F=0.37)), 20.0, 101),
        get_method(method),
        step=0.01,
    )
    truth, _ = swing(found.times, 2.0, 0.37)
    assert told(found) == [("slide", "dot(x)")]
    assert (np.abs(found.values[:, 0] - truth) <= errors_claimed(found) + 1e-9).all()


def test_what_holds_is_drawn_as_strong_as_it_is() -> None:
    """Between both sides the force is what it takes, −P t here, and no jump back and forth."""
    asked = moving(["-F*sign(dot(x))", "0"], [(0.0, 0.0), (0.0, 1.0)], F=1.0, P=0.2)
    pull = {"kind": "force", "name": "pull", "at": "px", "force": ["P*t", "0"]}
    answer: Any = run({"scene": {**asked, "loads": [*asked["loads"], pull]}, "t_end": 10, "samples": 51})
    assert [each["kind"] for each in answer["events"]] == ["leave"]
    t, drawn = np.array(answer["t"]), np.array(answer["loads"]["fx"])[:, 0]
    assert drawn == pytest.approx(-np.minimum(0.2 * t, 1.0), abs=1e-9)
    assert np.abs(np.array(answer["energy"]["balance"]) - answer["energy"]["balance"][0]).max() < 1e-9


TOGETHER = {
    "the jumps have a product": ["-2*sign(dot(x)) - sign(dot(x))*sign(dot(y))", "-3*sign(dot(y))"],
    "more than one way to go on": ["-sign(dot(x)) - 2*sign(dot(y))", "-2*sign(dot(x)) - sign(dot(y))"],
}


@pytest.mark.parametrize("forces", TOGETHER.values(), ids=TOGETHER)
@pytest.mark.parametrize("begins", [0.0, 1.0])
def test_where_two_slides_at_once_are_not_certain_it_is_said(forces: list[str], begins: float) -> None:
    """Both come to rest at once; what came before is right."""
    asked = moving(forces, [(0.0, begins), (0.0, begins)])
    answer: Any = run({"scene": asked, "t_end": 3, "tolerance": 1e-9})
    assert (answer["status"], answer["reason"]["code"]) == ("unresolved", "slides_along_kinks")
    assert answer["reason"]["parameters"]["name"] in {"dot(x)", "dot(y)"}
    assert answer["t_reached"] == pytest.approx(begins / 3.0, abs=1e-9)
    t = np.array(answer["t"])
    assert answer["coordinates"]["x"] == pytest.approx(begins * t - 1.5 * t**2, abs=1e-9)


def test_several_that_add_up_are_followed() -> None:
    """Three in a row, each rubbing on the next and the last on the floor: it stops first, then two go on as one."""
    rub = ["sign(dot(x) - dot(y))", "sign(dot(y) - dot(z))", "sign(dot(z))"]
    forces = [f"-2*{rub[0]}", f"2*{rub[0]} - 3*{rub[1]}", f"3*{rub[1]} - 4*{rub[2]}"]
    found = motion(moving(forces, [(0.0, 6.0), (0.0, 4.0), (0.0, 1.0)]), 5.0)
    assert found.outcome.status == "ok"
    names = ["dot(z)", "dot(x) - dot(y)", "dot(y) - dot(z)"]
    assert told(found) == [("slide", name) for name in names]
    assert [each.time for each in found.transitions] == pytest.approx([1.0, 2.0, 10.0 / 3.0], abs=1e-10)
    assert found.values[-1] == pytest.approx([8.0 + 4.0 / 3.0, 6.0 + 4.0 / 3.0, 0.5], abs=1e-9)
    assert np.abs(found.rates[-1]).max() < 1e-14
    assert np.ptp(_energy(found) - found.work) < 1e-9


@FEW
def test_where_no_rate_changes_what_the_sign_is_of_nothing_is_held(method: str) -> None:
    """sign(x ẋ) brakes what moves away from the middle, and is gone through there, where its slope in ẋ is zero."""
    found = motion(moving(["-x - F*sign(x*dot(x))"], [(1.0, 0.0)], F=0.3), 20.0, method)
    assert (found.outcome.status, found.transitions) == ("ok", ())
    assert np.ptp(_energy(found) - found.work) < 1e-9
    middle = math.acos(-0.3 / 0.7)  # about 0.3 with x = 0.3 + 0.7 cos t, then about −0.3
    t = found.times[found.times < middle]
    assert found.values[: len(t), 0] == pytest.approx(0.3 + 0.7 * np.cos(t), abs=1e-8)


@FEW
def test_a_rate_is_kept_that_is_no_linear_function(method: str) -> None:
    """ẋ² = 1 is reached from rest, after what cos t + 2 takes for it, and kept: |cos t| < 2."""
    found = motion(moving(["cos(t) - F*sign(dot(x)^2 - 1)"], [(0.0, 0.0)], F=2.0), 10.0, method)
    assert told(found) == [("slide", "1 - dot(x)^2")]
    (slide,) = found.transitions
    assert math.sin(slide.time) + 2.0 * slide.time == pytest.approx(1.0, abs=1e-9)
    late = found.times >= slide.time
    reached = 1.0 - math.cos(slide.time) + slide.time**2
    assert found.values[late, 0] == pytest.approx(reached + found.times[late] - slide.time, abs=1e-8)


@pytest.mark.parametrize("method", ["dop853", "radau-5", "rk4", "gauss-6"])
def test_constraints_keep_what_slides_as_angles_do(method: str) -> None:
    """A pendulum with friction in its hinge: as an angle, and as x and y on a circle, where the sign is of a moment."""
    turn = "sign(x*dot(y) - y*dot(x))"
    weight = {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}
    hinge = {"kind": "force", "name": "hinge", "at": "p", "force": [f"c*y*{turn}", f"-c*x*{turn}"]}
    values = {"m": 1.0, "g": 9.81, "c": 2.0}
    free = document({"x": (1.0, 0.0), "y": (0.0, 0.0)}, values, {"p": ("m", ["x", "y"])}, [weight, hinge])
    free["constraints"] = [{"kind": "equation", "name": "circle", "equation": "x^2 + y^2 = 1"}]
    moment = {"kind": "moment", "name": "hinge", "angle": "q", "moment": "-c*sign(dot(q))"}
    angle = document({"q": (math.pi / 2.0, 0.0)}, values, {"p": ("m", ["sin(q)", "-cos(q)"])}, [weight, moment])
    found, other = (motion(asked, 8.0, method, 1e-9) for asked in (free, angle))
    assert [kind for kind, _ in told(found)] == [kind for kind, _ in told(other)] == ["slide"]
    assert found.transitions[0].time == pytest.approx(other.transitions[0].time, abs=1e-8)
    assert found.values[-1, 0] == pytest.approx(math.sin(other.values[-1, 0]), abs=1e-8)
    assert abs(found.values[-1, 0]) * 9.81 < 2.0  # where the weight is too weak for the hinge


def test_coupled_masses_slide_in_each_of_their_signs_as_with_dry_friction() -> None:
    """Three links with a brake at each angle, so that what holds one loads the others."""
    links = range(3)
    places = [[" + ".join(f"{f}(p{i})" for i in range(k + 1)) for f in ("sin", "-cos")] for k in links]
    bodies = {f"b{k}": ("m", [x, y.replace("+ -", "- ")]) for k, (x, y) in zip(links, places, strict=True)}
    weight = {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}
    starts = {f"p{k}": (0.6 + 0.3 * k, 0.0) for k in links}
    signs = [{"kind": "moment", "name": f"c{k}", "angle": f"p{k}", "moment": f"-c*sign(dot(p{k}))"} for k in links]
    rubs = [{"kind": "friction", "name": f"c{k}", "coordinate": f"p{k}", "force": "c"} for k in links]
    values = {"m": 1.0, "g": 9.81, "c": 2.5}
    one, other = (motion(document(starts, values, bodies, [weight, *loads]), 6.0) for loads in (signs, rubs))
    names = {"stick": "slide", "slip": "leave"}
    told_there = [(names[each.kind], each.time) for each in other.transitions if each.kind in names]
    assert len(told_there) > 6
    assert [each.kind for each in one.transitions] == [kind for kind, _ in told_there]
    assert [each.time for each in one.transitions] == pytest.approx([time for _, time in told_there], abs=1e-9)
    assert one.values[-1] == pytest.approx(other.values[-1], abs=1e-9)


@FEW
@pytest.mark.parametrize("middle", [0.0, 1.0, -4.0, 100.0])
def test_swings_that_pile_up_in_a_kink_end_in_it(middle: float, method: str) -> None:
    """Back with 3/2 and off with 5/2, each swing goes 3/5 as far as the one before: all of them last 8.2 s."""
    forces = ["-2*sign(x - a) - sign(dot(x))/2"]
    found = motion(moving(forces, [(1.0 + middle, 0.0)], a=middle), 20.0, method)
    assert found.outcome.status == "ok"
    assert [kind for kind, _ in told(found)] == ["slide"]
    assert found.transitions[0].error is None  # of the swings that were not followed nothing is known
    every = (math.sqrt(4.0 / 3.0) + math.sqrt(12.0 / 25.0)) / (1.0 - math.sqrt(0.6))
    assert found.transitions[0].time == pytest.approx(every, abs=2e-6 * math.sqrt(max(1.0, abs(middle))))
    late = found.times > every
    assert np.abs(found.values[late, 0] - middle).max() <= 1e-14 * max(1.0, abs(middle))
    assert not found.rates[late].any()
    assert np.ptp(_energy(found) - found.work) < 1e-9


@FEW
@pytest.mark.parametrize("energy", ["k*max(x, -x)", "k*abs(x) + 0*max(x, 1)", "-k*min(x, -x)"])
def test_what_rests_in_a_kink_is_pulled_out_by_more_than_it_holds(energy: str, method: str) -> None:
    """V = k|x| holds up to k: P t pulls it out at t = k/P, and x is a cubic in what is over."""
    asked = moving(["P*t"], [(0.0, 0.0)], k=2.0, P=1.0)
    asked["loads"] = [*asked["loads"], {"kind": "potential", "name": "groove", "energy": energy}]
    found = motion(asked, 5.0, method, 1e-10)
    assert (found.outcome.status, told(found)) == ("ok", [("leave", "x")])
    assert found.transitions[0].time == pytest.approx(2.0, abs=1e-10)
    assert found.values[:, 0] == pytest.approx(np.maximum(found.times - 2.0, 0.0) ** 3 / 6.0, abs=1e-9)


def test_a_force_that_switches_too_often_ends_a_motion_soon_and_it_is_said() -> None:
    """A hundred thousand swings of a billionth of a millimetre, in k|x| without loss."""
    asked = moving(["0"], [(1e-12, 0.0)], k=2.0)
    asked["loads"] = [{"kind": "potential", "name": "groove", "energy": "k*max(x, -x)"}]
    answer: Any = run({"scene": asked, "t_end": 10, "tolerance": 1e-6})
    assert (answer["status"], answer["reason"]["code"]) == ("unresolved", "switches_to_and_fro")
    assert answer["reason"]["parameters"]["name"] == "x"
    assert max(map(abs, answer["coordinates"]["x"])) < 2e-12
