"""Bifurcations of motions with impacts and dry friction, against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.simulation.scenes import document

from deltaq.errors import InputError, Problem, RequestError
from deltaq.lab.library import get_experiment

GRAVITY, OMEGA = 9.81, math.tau  # a table that moves once in a second


def ask(**fields: Any) -> dict[str, Any]:
    *_, last = get_experiment("bifurcation").run({"crossings": 8, "skip": 12, "folds": 2, **fields})
    return last.result


def ball(restitution: float, low: float, high: float, **fields: Any) -> dict[str, Any]:
    """A request for the rates behind impacts over the table's amplitude, begun near the motion of one bounce a period.

    It leaves with g T/2 when the table moves with (g T/2)(1 − e)/(1 + e).
    """
    leaving = 0.5 * GRAVITY
    cosine = leaving * (1.0 - restitution) / (1.0 + restitution) / (OMEGA * low)
    since = 1.0 - math.acos(cosine) / OMEGA
    height = low * math.sqrt(1.0 - cosine**2) + leaving * since - 0.5 * GRAVITY * since**2
    return {
        "scene": "bouncing-ball",
        "sweep": {"parameter": "a", "from": low, "to": high, "count": 8},
        "parameters": {"e": restitution, "omega": OMEGA, "g": GRAVITY},
        "initial": {"z": {"value": height, "rate": leaving - GRAVITY * since}},
        "plane": "z - a*sin(omega*t)",
        "direction": "rising",
        "vertical": "dot(z)",
        **fields,
    }


@pytest.mark.parametrize("restitution", [0.3, 0.6])
def test_a_ball_that_bounces_once_in_a_period_doubles_where_it_must(restitution: float) -> None:
    """At Γ² = (π (1 − e)/(1 + e))² + (2 (1 + e²)/(1 + e)²)² with Γ = a ω²/g, where the multipliers are −1 and −e².

    Sources: P. J. Holmes, J. Sound and Vibration 84 (1982) 173–189; A. C. J. Luo, R. P. S. Han, Nonlinear Dynamics 10
    (1996) 1–18, who do without his high bounces.
    """
    e = restitution
    gamma = math.hypot(math.pi * (1.0 - e) / (1.0 + e), 2.0 * (1.0 + e**2) / (1.0 + e) ** 2)
    doubles = gamma * GRAVITY / OMEGA**2
    found = ask(**ball(e, 0.99 * doubles, 1.01 * doubles, skip=4, crossings=4, folds=1))
    first = found["bifurcations"][0]
    assert (first["kind"], first["folds"], first["period"]) == ("period-doubling", 1, pytest.approx(1.0, abs=1e-12))
    assert first["value"] == pytest.approx(doubles, abs=1e-9)
    assert first["error"] < 1e-9
    np.testing.assert_allclose(np.array(first["multipliers"])[:, 0], [-1.0, -(e**2)], atol=1e-6)
    np.testing.assert_allclose(first["seen"], 0.5 * GRAVITY, atol=1e-9)
    branch = found["branches"][0]["motions"]
    assert {one["stable"] for one in branch if one["value"] < doubles - 1e-6} == {True}
    assert {one["stable"] for one in branch if one["value"] > doubles + 1e-6} == {False}


def test_an_oscillator_with_dry_friction_swings_as_far_as_den_hartog_has_it() -> None:
    """Without stops x₀ = (P/k) √(V² − (F U/P)²), V = 1/(1 − β²), U = sin(π/β)/(β (1 + cos(π/β))), β = Ω/ω.

    Source: J. P. Den Hartog, Trans. ASME 53 (1931) APM-53-9, 107–115.
    """
    spring = {"kind": "potential", "name": "spring", "energy": "k*x^2/2"}
    rubbing = {"kind": "friction", "name": "rubbing", "coordinate": "x", "force": "F"}
    push = {"kind": "force", "name": "push", "at": "p", "force": ["P*cos(Omega*t)", "0"]}
    values = {"m": 1.0, "k": 1.0, "F": 0.2, "P": 1.0, "Omega": 0.7}
    scene = document({"x": (1.5, 0.0)}, values, {"p": ("m", ["x", "0"])}, [spring, rubbing, push])
    sweep = {"parameter": "Omega", "from": 0.6, "to": 0.8, "count": 8}
    found = ask(scene=scene, sweep=sweep, plane="dot(x)", vertical="x", skip=60, crossings=4, orbits=False)
    for one in (*found["up"], *found["down"]):
        beta = one["value"]
        v, u = 1.0 / (1.0 - beta**2), math.sin(math.pi / beta) / (beta * (1.0 + math.cos(math.pi / beta)))
        assert (one["status"], one["folds"]) == ("ok", 1)
        np.testing.assert_allclose(one["seen"], math.sqrt(v**2 - (0.2 * u) ** 2), rtol=1e-6)


def test_a_hill_thinner_than_a_step_between_impacts_is_seen() -> None:
    """A driven oscillator at a wall with a hill of width 0.005 on its way: what repeats does so by SciPy's small steps.

    Without the hill, whole motions are others.
    """
    width, omega = 5e-3, 1.3
    well = {"kind": "potential", "name": "well", "energy": f"k*x^2/2 + 0.3*exp(-((x - 0.3)/{width})^2)"}
    push = {"kind": "force", "name": "push", "at": "p", "force": ["F*cos(omega*t)", "0"]}
    drag = {"kind": "dissipation", "name": "drag", "function": "0.4*dot(x)^2"}
    values = {"m": 1.0, "k": 1.0, "F": 1.0, "omega": omega}
    scene = document({"x": (0.1, 0.0)}, values, {"p": ("m", ["x", "0"])}, [well, push, drag])
    scene |= {"events": [{"name": "wall", "value": "x + 0.5", "then": "bounce", "restitution": "0.7"}]}
    sweep = {"parameter": "F", "from": 0.95, "to": 1.05, "count": 8}
    found = ask(scene=scene, sweep=sweep, skip=20, crossings=4, orbits=False)
    told = [one for one in found["up"] if one["folds"] == 1]
    assert len(told) >= 4
    for one in told:

        def rates(t: float, y: np.ndarray, drive: float = one["value"]) -> list[float]:
            near = (y[0] - 0.3) / width
            return [y[1], drive * math.cos(omega * t) - y[0] - 0.8 * y[1] + 0.6 / width * near * math.exp(-(near**2))]

        def gap(_t: float, y: np.ndarray) -> float:
            return float(y[0]) + 0.5

        gap.terminal, gap.direction = True, -1  # type: ignore[attr-defined]
        begin = [one["initial"]["x"]["value"], one["initial"]["x"]["rate"]]
        t, state, impacts = 0.0, np.array(begin), 0
        while t < math.tau / omega:
            span, exact = (t, math.tau / omega), {"rtol": 1e-11, "atol": 1e-13, "max_step": 0.5 * width}
            way = solve_ivp(rates, span, state, method="DOP853", events=gap, **exact)
            t, state = float(way.t[-1]), way.y[:, -1]
            if way.status == 1:
                state, impacts = np.array([-0.5, -0.7 * state[1]]), impacts + 1
        assert impacts == 1
        np.testing.assert_allclose(state, begin, atol=1e-8)


def test_what_lies_on_the_table_passes_it_nowhere() -> None:
    """Where a ω² < g the ball comes to rest, and its gap is zero but for rounding."""
    asked = ball(0.3, 0.45, 0.5, initial={"z": {"value": 0.4}}, vertical="z", orbits=False)
    asked["sweep"] = {"parameter": "a", "from": 0.05, "to": 0.2, "count": 8}
    with pytest.raises(RequestError) as caught:
        ask(**asked)
    assert [one.code for one in caught.value.problems] == ["bifurcation-never-met"]
    found = ask(**asked | {"plane": ""})
    assert {(one["status"], one["folds"]) for one in found["up"]} == {("ok", 1)}
    np.testing.assert_allclose([one["seen"] for one in found["up"]], 0.0, atol=1e-9)  # at t = 0 the table is there


REFUSED: dict[str, tuple[dict[str, Any], tuple[str, str]]] = {
    "a start under the table": (
        {"initial": {"z": {"value": -5.0}}},
        ("event-at-start", "/scene/events/0/value"),
    ),
    "too many impacts with any number of values": (
        {"skip": 5000, "crossings": 1000, "t_end": 9000.0},
        ("bifurcation-many-events-each", "/skip"),
    ),
    "a table that stands still at the first value": (
        {"sweep": {"parameter": "omega", "from": 0.0, "to": 6.0, "count": 8}},
        ("bifurcation-drive-at-rest", "/sweep/from"),
    ),
    "a table that stands still at the last value": (
        {"sweep": {"parameter": "omega", "from": -6.0, "to": 0.0, "count": 8}},
        ("bifurcation-drive-at-rest", "/sweep/to"),
    ),
    "a table that stands still in between": (
        {"sweep": {"parameter": "omega", "from": -4.0, "to": 4.0, "count": 9}},
        ("bifurcation-drive-at-rest", "/sweep"),
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_followed_is_told_at_its_field(case: str) -> None:
    fields, (code, pointer) = REFUSED[case]
    with pytest.raises(InputError) as caught:
        ask(**ball(0.3, 0.45, 0.5, **fields))
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]


@pytest.mark.parametrize(
    ("sweep", "skip", "code", "place", "told"),
    [
        # one impact in each period, so that both sweeps follow two for each value and period
        ({"count": 8}, 5000, "bifurcation-many-events-each", "/skip", {"events": 96_000.0, "periods": 3750}),
        ({"count": 40}, 1000, "bifurcation-many-events", "/sweep/count", {"events": 160_000.0, "count": 15}),
    ],
)
def test_how_many_events_are_possible_is_told(
    sweep: dict[str, Any], skip: int, code: str, place: str, told: dict[str, Any]
) -> None:
    asked = ball(0.3, 0.45, 0.5, skip=skip, crossings=1000, t_end=9000.0)
    asked["sweep"] |= sweep
    with pytest.raises(RequestError) as caught:
        ask(**asked)
    assert caught.value.problems == (Problem(code, place, parameters={"each": 1.0, "most": 60_000, **told}),)
