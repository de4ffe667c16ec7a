"""The lab of bifurcations against the driven pendulum's cascade, Mathieu's functions, harmonic balance and SciPy."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar, root
from scipy.special import mathieu_a, mathieu_b
from tests.simulation.scenes import document

from deltaq.errors import InputError
from deltaq.lab.charts.words import words
from deltaq.lab.library import get_experiment
from deltaq.narration.catalog import text

DRAG = {"kind": "dissipation", "name": "drag", "function": "c*dot(x)^2/2"}


def line(energy: str, force: str, *loads: dict[str, Any], x: float = 0.1, **values: float) -> dict[str, Any]:
    """A particle of mass 1 on a line in a potential, under a force."""
    well = {"kind": "potential", "name": "well", "energy": energy}
    push = {"kind": "force", "name": "push", "at": "p", "force": [force, "0"]}
    return document({"x": (x, 0.0)}, {"m": 1.0, **values}, {"p": ("m", ["x", "0"])}, [well, push, *loads])


DUFFING = line("k*x^2/2 + b*x^4/4", "F*cos(omega*t)", DRAG, k=1.0, b=0.04, c=0.1, F=1.0, omega=1.0)
MATHIEU = line("(a - 2*q*cos(2*t))*x^2/2", "0*x", x=0.0, a=1.0, q=0.5)
SELF_EXCITED = line("k*x^2/2", "c*(1 - x^2)*dot(x)", x=1.0, k=1.0, c=0.5)
SOFT = line("k*x^2/2 - b*x^4/4", "F*cos(omega*t)", DRAG, k=1.0, b=1.0, c=0.4, F=0.1, omega=0.8)


def swept(parameter: str, start: float, to: float, count: int = 8) -> dict[str, Any]:
    return {"parameter": parameter, "from": start, "to": to, "count": count}


def ask(**fields: Any) -> dict[str, Any]:
    *_, last = get_experiment("bifurcation").run(fields)
    return last.result  # type: ignore[return-value]


def values_of(found: dict[str, Any], kind: str) -> list[float]:
    """Where bifurcations of a kind are, ascending; twins of a symmetric scene once."""
    values = sorted(one["value"] for one in found["bifurcations"] if one["kind"] == kind)
    return [value for i, value in enumerate(values) if i == 0 or value - values[i - 1] > 1e-8]


# The pendulum of Taylor's ch. 12: ω = 2π, ω₀ = 3π/2 · 2 = 3π, β = ω₀/4, with ℓ = g/ω₀² and m = 1/ℓ², so that m ℓ² = 1.
LENGTH = 9.81 / (3.0 * math.pi) ** 2
TAYLOR = {"m": LENGTH**-2, "l": LENGTH, "g": 9.81, "omega": math.tau, "c": 1.5 * math.pi}
OWN = (3.0 * math.pi) ** 2


@cache
def cascade() -> dict[str, Any]:
    sweep = swept("gamma", 1.06, 1.083)
    return ask(scene="driven-pendulum", parameters=TAYLOR, sweep=sweep, crossings=20, skip=200)


def test_doublings_of_the_driven_pendulum_are_those_of_taylor() -> None:
    """Taylor, Classical Mechanics, table 12.1: γ₁ … γ₄ = 1.0663, 1.0793, 1.0821, 1.0827, of periods 1, 2, 4, 8."""
    found = cascade()
    doublings = values_of(found, "period-doubling")
    assert doublings == pytest.approx([1.0663, 1.0793, 1.0821, 1.0827], abs=1e-4)
    assert [one["folds"] for one in sorted(found["bifurcations"], key=lambda one: one["value"])] == [1, 2, 4, 8]
    assert found["feigenbaum"] == pytest.approx([4.6692, 4.6692], abs=0.01)
    assert max(one["error"] for one in found["bifurcations"]) < 1e-8
    assert found["up"][0]["folds"] == 1
    assert found["period"] == pytest.approx(1.0)


def test_the_caption_tells_twins_once() -> None:
    """A symmetric scene has each motion twice; the table has both."""
    found = cascade()
    twice = {**found, "bifurcations": [one for one in found["bifurcations"] for _ in range(2)]}
    say = words(text, "en")
    caption = get_experiment("bifurcation").charts(twice, say)[0]["caption"]
    assert caption == get_experiment("bifurcation").charts(found, say)[0]["caption"]
    assert caption.count("1.0663729 (1)") == 1


def multiplier(gamma: float, start: dict[str, Any], periods: int) -> tuple[complex, float]:
    """By SciPy: the largest Floquet multiplier of the pendulum from a start, and how far it is from closing."""

    def rhs(t: float, y: np.ndarray) -> list[float]:
        bend = -OWN * math.cos(y[0])
        out = [y[1], -1.5 * math.pi * y[1] - OWN * math.sin(y[0]) + gamma * OWN * math.cos(math.tau * t)]
        for column in (2, 4):
            out += [y[column + 1], bend * y[column] - 1.5 * math.pi * y[column + 1]]
        return out

    def end(state: np.ndarray) -> np.ndarray:
        begin = [*state, 1.0, 0.0, 0.0, 1.0]
        return solve_ivp(rhs, (0.0, periods), begin, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]

    state = np.array([start["phi"]["value"], start["phi"]["rate"]])
    begun = state.copy()
    for _ in range(4):
        after = end(state)
        matrix = after[2:].reshape(2, 2).T
        state = state - np.linalg.solve(matrix - np.eye(2), after[:2] - state)
    roots = np.linalg.eigvals(matrix)
    return complex(roots[np.argmax(np.abs(roots))]), float(np.abs(state - begun).max())


@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_doubling_is_where_scipys_multiplier_is_minus_one(place: int) -> None:
    """The value of the parameter is right to 1e-6, by the slope of the multiplier over it."""
    one = sorted(cascade()["bifurcations"], key=lambda each: each["value"])[place]
    here, apart = multiplier(one["value"], one["initial"], one["folds"])
    beside, _ = multiplier(one["value"] + 1e-5, one["initial"], one["folds"])
    slope = (beside.real - here.real) / 1e-5
    assert abs((here.real + 1.0) / slope) < 1e-7
    assert apart < 1e-6
    assert one["multipliers"][0] == pytest.approx([-1.0, 0.0], abs=1e-6)


BILINEAR = line("k*x^2/2 + s*max(x, 0)^2/2", "F*cos(omega*t)", DRAG, k=1.0, s=9.0, c=0.1, F=1.0, omega=1.0)


def bilinear_multiplier(omega: float, start: dict[str, Any]) -> tuple[float, float]:
    """By SciPy, anew wherever x changes its sign: the multiplier next to −1, and how far a period is from closing."""

    def of_side(stiffness: float) -> Any:
        def rhs(t: float, y: np.ndarray) -> list[float]:
            out = [y[1], math.cos(omega * t) - 0.1 * y[1] - stiffness * y[0]]
            for column in (2, 4):
                out += [y[column + 1], -stiffness * y[column] - 0.1 * y[column + 1]]
            return out

        return rhs

    def passes(_t: float, y: np.ndarray) -> float:
        return float(y[0])

    passes.terminal = True  # type: ignore[attr-defined]
    t, y, period = 0.0, np.array([start["x"]["value"], start["x"]["rate"], 1.0, 0.0, 0.0, 1.0]), math.tau / omega
    while t < period:
        passes.direction = -1.0 if (y[0] or y[1]) > 0.0 else 1.0  # type: ignore[attr-defined]
        stiffness = 10.0 if passes.direction < 0.0 else 1.0  # type: ignore[attr-defined]
        part = solve_ivp(of_side(stiffness), (t, period), y, "DOP853", rtol=1e-12, atol=1e-13, events=passes)
        t, y = float(part.t[-1]), part.y[:, -1].copy()
        if part.status == 1:
            y[0] = 0.0
    apart = math.hypot(y[0] - start["x"]["value"], y[1] - start["x"]["rate"])
    roots = np.linalg.eigvals(y[2:].reshape(2, 2).T)
    return float(roots[np.argmin(np.abs(roots + 1.0))].real), apart


def test_forces_with_a_kink_double_their_period_where_scipys_multiplier_is_minus_one() -> None:
    """A spring that is ten times as stiff on one side (Shaw and Holmes, J. Sound Vib. 90 (1983) 129–155)."""
    found = ask(scene=BILINEAR, sweep=swept("omega", 0.98, 1.05), skip=60)
    (one,) = (each for each in found["bifurcations"] if each["kind"] == "period-doubling" and each["folds"] == 1)
    here, apart = bilinear_multiplier(one["value"], one["initial"])
    assert apart < 1e-8
    assert here == pytest.approx(-1.0, abs=1e-6)
    assert found["up"][0]["folds"] == 2
    assert found["up"][-1]["folds"] == 1


def folds_of_duffing() -> list[float]:
    """Saddle-nodes by harmonic balance: over the amplitude of the first harmonic ω is largest, and smallest, there."""
    orders, phase = np.arange(1, 16, 2), np.linspace(0.0, math.tau, 128, endpoint=False)
    cosines, sines = np.cos(np.outer(orders, phase)), np.sin(np.outer(orders, phase))

    def left(unknown: np.ndarray, amplitude: float) -> np.ndarray:
        a, b, omega = unknown[: len(orders)], unknown[len(orders) : -1], unknown[-1]
        x = a @ cosines + b @ sines
        rate = omega * (b * orders @ cosines - a * orders @ sines)
        force = x + 0.04 * x**3 + 0.1 * rate - np.cos(phase)
        parts = [2.0 * (waves @ force) / len(phase) for waves in (cosines, sines)]
        parts = [p - (omega * orders) ** 2 * c for p, c in zip(parts, (a, b), strict=True)]
        return np.concatenate([*parts, [math.hypot(a[0], b[0]) - amplitude]])

    def omega(amplitude: float) -> float:
        # the first harmonic alone: (1 + 3bA²/4 − ω²)² + (cω)² = (F/A)², of which the upper root is the upper branch
        near = np.zeros(2 * len(orders) + 1)
        stiff = 1.0 + 0.03 * amplitude**2
        square = np.roots([1.0, 0.01 - 2.0 * stiff, stiff**2 - amplitude**-2.0])
        near[-1] = math.sqrt(max(square.real))
        angle = math.atan2(0.1 * near[-1], stiff - near[-1] ** 2)
        near[0], near[len(orders)] = amplitude * math.cos(angle), amplitude * math.sin(angle)
        found = root(left, near, args=(amplitude,), tol=1e-14)
        return float(found.x[-1])

    precise = {"method": "bounded", "options": {"xatol": 1e-9}}
    low = minimize_scalar(omega, bounds=(1.5, 4.0), **precise)
    high = minimize_scalar(lambda amplitude: -omega(amplitude), bounds=(5.5, 6.55), **precise)
    return [float(low.fun), -float(high.fun)]


@cache
def duffing() -> dict[str, Any]:
    return ask(scene=DUFFING, sweep=swept("omega", 0.8, 2.0, 25), plane="dot(x)", vertical="x", crossings=8)


def test_duffings_folds_are_those_of_harmonic_balance() -> None:
    assert values_of(duffing(), "saddle-node") == pytest.approx(folds_of_duffing(), abs=1e-6)


ENTRAINED = line("k*x^2/2", "c*(1 - x^2)*dot(x) + F*cos(omega*t)", x=1.0, k=1.0, c=0.5, F=2.2, omega=1.5)


def entrained_determinant(force: float) -> float:
    """By SciPy: the product of the multipliers of van der Pol's oscillator in step with its drive, less 1."""
    period = math.tau / 1.5

    def rhs(t: float, y: np.ndarray) -> list[float]:
        x, v = y[0], y[1]
        out = [v, -x + 0.5 * (1.0 - x * x) * v + force * math.cos(1.5 * t)]
        for column in (2, 4):
            of_x, of_v = y[column], y[column + 1]
            out += [of_v, -of_x - x * v * of_x + 0.5 * (1.0 - x * x) * of_v]
        return out

    state = np.array([-1.4, 0.4])
    for _ in range(12):
        begin = [*state, 1.0, 0.0, 0.0, 1.0]
        after = solve_ivp(rhs, (0.0, period), begin, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
        matrix = after[2:].reshape(2, 2).T
        state = state - np.linalg.solve(matrix - np.eye(2), after[:2] - state)
    assert np.abs(after[:2] - state).max() < 1e-10
    assert np.abs(np.linalg.eigvals(matrix).imag).min() > 0.1  # a pair, that is no double root
    return float(np.linalg.det(matrix)) - 1.0


def test_a_torus_is_born_where_scipys_multipliers_leave_the_circle() -> None:
    """Van der Pol's oscillator falls out of step with a drive that becomes weaker (Neimark and Sacker)."""
    found = ask(scene=ENTRAINED, sweep=swept("F", 1.6, 2.4), crossings=20)
    (born,) = values_of(found, "torus")
    assert born == pytest.approx(brentq(entrained_determinant, 1.7, 2.1, xtol=1e-10), abs=1e-6)
    (one,) = (one for one in found["bifurcations"] if one["kind"] == "torus")
    assert [math.hypot(*pair) for pair in one["multipliers"]] == pytest.approx([1.0, 1.0], abs=1e-6)
    for visit in (*found["up"], *found["down"]):
        assert visit["folds"] == (1 if visit["value"] > born else 0)  # in step; on the torus nothing closes


def test_between_the_folds_both_sweeps_see_unlike_amplitudes() -> None:
    """It jumps up where the lower branch ends, and down where the upper one does: hysteresis, to a grid step."""
    found = duffing()
    low, high = values_of(found, "saddle-node")
    (span,) = found["hysteresis"]
    assert (span["start"], span["end"]) == (pytest.approx(low, abs=0.05), pytest.approx(high, abs=0.05))
    assert low <= span["start"] <= span["end"] <= high
    apart = [up["seen"][0] - down["seen"][0] for up, down in zip(found["up"], reversed(found["down"]), strict=True)]
    assert max(apart) > 2.0
    assert {visit["folds"] for visit in (*found["up"], *found["down"])} == {1}
    (branch,) = found["branches"]
    unstable = [one["value"] for one in branch["motions"] if not one["stable"]]
    assert low - 1e-6 <= min(unstable) <= max(unstable) <= high + 1e-6


def test_mathieus_boundaries_are_multipliers_of_one_and_minus_one() -> None:
    """ẍ + (a − 2q cos 2t) x = 0: μ = 1 at a₀, b₂, a₂ and μ = −1 at b₁, a₁, over the period π."""
    found = ask(scene=MATHIEU, sweep=swept("a", -0.5, 4.5), crossings=2, skip=2, folds=1)
    branching = [mathieu_a(0, 0.5), mathieu_b(2, 0.5), mathieu_a(2, 0.5)]
    assert values_of(found, "branching") == pytest.approx(branching, abs=1e-6)
    assert values_of(found, "period-doubling") == pytest.approx([mathieu_b(1, 0.5), mathieu_a(1, 0.5)], abs=1e-6)


def test_kapitzas_pendulum_stands_from_mathieus_boundary_on() -> None:
    """φ = π + u: ü + (−g/ℓ + (y₀ω²/ℓ) cos ωt) u = 0, that is a = −4g/(ℓω²), q = 2y₀/ℓ, and a₀(q) = a."""
    found = ask(scene="kapitza", sweep=swept("y0", 0.02, 0.1), crossings=2, skip=2, folds=1)
    a, length = -4.0 * 9.81 / (0.5 * 60.0**2), 0.5
    edge = brentq(lambda y0: mathieu_a(0, 2.0 * y0 / length) - a, 0.02, 0.1, xtol=1e-12)
    assert values_of(found, "branching")[0] == pytest.approx(edge, abs=1e-6)


def test_a_limit_cycle_has_the_multiplier_of_liouville() -> None:
    """ẍ − c (1 − x²) ẋ + x = 0, by SciPy: over a period τ the multiplier is exp ∮ c (1 − x²) dt."""
    found = ask(scene=SELF_EXCITED, sweep=swept("c", 0.2, 0.8), crossings=6, skip=10, t_end=400.0)
    assert (found["driven"], found["period"], found["plane"]) == (False, None, "dot(x)")
    one = found["branches"][0]["motions"][-1]
    c, begin, tau = one["value"], one["initial"]["x"], one["period"]

    def rhs(_t: float, y: np.ndarray) -> list[float]:
        return [y[1], c * (1.0 - y[0] ** 2) * y[1] - y[0], c * (1.0 - y[0] ** 2)]

    start = [begin["value"], begin["rate"], 0.0]
    end = solve_ivp(rhs, (0.0, tau), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    assert end[:2] == pytest.approx(start[:2], abs=1e-9)
    assert one["growth"] == pytest.approx(math.exp(end[2]), rel=1e-5)
    assert one["seen"] == pytest.approx([begin["value"]], abs=1e-6)


def test_a_longer_period_by_an_expression_makes_two_cycles_closed() -> None:
    """At γ = 1.07 the pendulum closes after two periods: after one that is twice as long."""
    asked = {"scene": "driven-pendulum", "parameters": TAYLOR, "sweep": swept("gamma", 1.069, 1.071)}
    usual = ask(**asked, crossings=6, orbits=False)
    twice = ask(**asked, crossings=6, orbits=False, period="4*pi/omega")
    assert {visit["folds"] for visit in usual["up"]} == {2}
    assert {visit["folds"] for visit in twice["up"]} == {1}
    assert twice["branches"] == []
    for one, other in zip(usual["up"], twice["up"], strict=True):
        assert other["seen"][0] == pytest.approx(min(one["seen"], key=lambda y: abs(y - other["seen"][0])), abs=1e-4)


def test_where_motions_leave_the_part_before_stays_good() -> None:
    """A soft spring lets go: small forces keep the motion in the well, larger ones drive it over its edge at x = 1."""
    found = ask(scene=SOFT, sweep=swept("F", 0.05, 0.65, 13), crossings=8, orbits=False)
    status = [visit["status"] for visit in found["up"]]
    kept = status.index("diverged")
    assert kept >= 3
    assert set(status[:kept]) == {"ok"}
    assert all(abs(y) < 1.0 for visit in found["up"][:kept] for y in visit["seen"])
    assert status[-1] == "diverged"
    assert found["up"][-1]["initial"] is None


FREE = line("k*x^2/2", "0*x", x=1.0, k=1.0)
STICKING = line("k*x^2/2", "F*cos(omega*t) - c*sign(dot(x))", k=1.0, c=0.3, F=1.0, omega=1.0)
PULSED = line("k*x^2/2", "F*exp(-sin(omega*t^2))", DRAG, k=1.0, c=0.3, F=1.0, omega=1.0)
IDLE = line("k*x^2/2", "F*cos(omega*t)", DRAG, k=1.0, c=0.3, F=1.0, omega=1.0, z=1.0)
GAMMA = swept("gamma", 1.06, 1.07)
REFUSED = [
    pytest.param(
        {"scene": "driven-pendulum", "sweep": swept("z", 0, 1)},
        "unknown-parameter",
        "/sweep/parameter",
        id="no parameter",
    ),
    pytest.param({"scene": "driven-pendulum", "sweep": swept("m", -1, 1)}, "not-positive", "/sweep/from", id="no mass"),
    pytest.param(
        {"scene": IDLE, "sweep": swept("z", 1, 2)},
        "bifurcation-no-influence",
        "/sweep/parameter",
        id="idle",
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "t_end": 9.0}, "bifurcation-too-long", "/t_end", id="too long"
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": swept("gamma", 1, 1.1, 400), "skip": 900},
        "bifurcation-too-large",
        "/sweep/count",
        id="too many",
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "period": "0*m"}, "bifurcation-period", "/period", id="no time"
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "period": "phi"}, "bifurcation-period", "/period", id="a state"
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "period": "2*"}, "unexpected-end", "/period", id="no expression"
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "plane": "m"}, "section-plane-constant", "/plane", id="no plane"
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "plane": "dot(phi) - 50"},
        "bifurcation-never-met",
        "/plane",
        id="far out",
    ),
    pytest.param(
        {"scene": "driven-pendulum", "sweep": GAMMA, "vertical": "zeta"}, "unknown-name", "/vertical", id="no name"
    ),
    pytest.param(
        {"scene": FREE, "sweep": swept("k", 1, 2)}, "bifurcation-conservative", "/scene", id="nothing attracts"
    ),
    pytest.param(
        {"scene": "damped-pendulum", "sweep": swept("c", 1, 2)}, "bifurcation-no-passages", "/plane", id="comes to rest"
    ),
    pytest.param(
        {"scene": "pendulum", "sweep": swept("l", 1, 2)}, "bifurcation-conservative", "/scene", id="free pendulum"
    ),
    pytest.param({"scene": STICKING, "sweep": swept("F", 1, 2)}, "lab-sliding", "/scene", id="friction"),
    pytest.param({"scene": PULSED, "sweep": swept("F", 1, 2)}, "bifurcation-no-period", "/period", id="no period"),
    pytest.param(
        {"scene": line("-k*x^2/2", "F*cos(omega*t)", k=1.0, F=1.0, omega=1.0), "sweep": swept("F", 1, 2), "skip": 200},
        "bifurcation-no-motion",
        "/sweep",
        id="all leave",
    ),
    pytest.param(
        {"scene": "cartesian-pendulum", "sweep": swept("l", 1, 2)},
        "lab-starts-with-constraints",
        "/scene",
        id="constraints",
    ),
]


@pytest.mark.parametrize(("fields", "code", "pointer"), REFUSED)
def test_what_has_no_diagram_is_told_with_what_to_do(fields: dict[str, Any], code: str, pointer: str) -> None:
    with pytest.raises(InputError) as caught:
        ask(**fields)
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]


@pytest.mark.parametrize("stiffer", [0.0, 0.5])
def test_a_hill_that_is_thinner_than_a_step_is_seen(stiffer: float) -> None:
    """A driven oscillator with a hill of width 0.005 on its way: what is told to repeat does so by SciPy's small steps.

    Without the hill, the motions are others by some thousandths. A spring stiffer on one side has a kink.
    """
    width, drive, drag, omega = 5e-3, 1.0, 0.8, 1.3
    hill = "k*x^2/2 + h*exp(-((x - x0)/w)^2)" + (" + s*max(x, 0)^2/2" if stiffer else "")
    values = {"k": 1.0, "c": drag, "F": drive, "omega": omega, "w": width, "x0": 0.3, "h": 0.3}
    scene = line(hill, "F*cos(omega*t)", DRAG, **values, **({"s": stiffer} if stiffer else {}))
    found = ask(scene=scene, sweep=swept("F", 0.95, 1.05), skip=10, crossings=4)
    told = [one for one in found["up"] if one["folds"] == 1]
    assert len(told) >= 4
    for one in told:

        def rates(t: float, y: np.ndarray, force: float = one["value"]) -> list[float]:
            near = (y[0] - 0.3) / width
            push = 0.6 / width * near * math.exp(-(near**2))
            spring = y[0] + stiffer * max(y[0], 0.0)
            return [y[1], force * math.cos(omega * t) - spring - drag * y[1] + push]

        begin = [one["initial"]["x"]["value"], one["initial"]["x"]["rate"]]
        span = (0.0, math.tau / omega)
        end = solve_ivp(rates, span, begin, method="DOP853", rtol=1e-11, atol=1e-13, max_step=0.5 * width).y[:, -1]
        np.testing.assert_allclose(end, begin, atol=1e-7)
