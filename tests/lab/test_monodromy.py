"""Stability maps against Mathieu's known boundaries, Liouville's theorem, and Kapitza's condition."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import mathieu_a, mathieu_b

from deltaq.lab.monodromy import Axis, Plane
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.service import problem_of


def hill(energy: str, damping: float = 0.0) -> Scene:
    """A particle on a line in a potential that changes with the time."""
    values = {"m": 1.0, "a": 1.0, "q": 0.5, "c": damping}
    return read_scene(
        {
            "id": "hill",
            "coordinates": [{"name": "x", "value": 0.0}],
            "parameters": [{"name": name, "value": value, "positive": name == "m"} for name, value in values.items()],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
            "loads": [
                {"kind": "potential", "name": "well", "energy": energy},
                {"kind": "dissipation", "name": "drag", "function": "c*dot(x)^2/2"},
            ],
        }
    )


MATHIEU = hill("(a - 2*q*cos(2*t))*x^2/2")  # ẍ + (a − 2q cos 2t) x = 0


def plane(scene: Scene, a: np.ndarray, q: np.ndarray, seconds: float = math.pi) -> Plane:
    axes = Axis("a", tuple(map(float, a))), Axis("q", tuple(map(float, q)))
    return Plane(problem_of(scene, 1.0), *axes, np.full((len(q), len(a)), seconds))


@pytest.mark.parametrize("q", [0.1, 0.7, 2.0, 5.0])
def test_on_the_boundaries_of_mathieu_the_trace_is_two(q: float) -> None:
    even, odd = [mathieu_a(k, q) for k in range(4)], [mathieu_b(k, q) for k in range(1, 4)]
    boundaries = np.array(sorted([*even, *odd]))
    found = plane(MATHIEU, boundaries, np.array([q, q + 1.0])).map()
    traces = np.abs(found.multipliers[0].sum(axis=-1))
    assert traces == pytest.approx(2.0, abs=1e-6)


@pytest.mark.parametrize("q", [0.1, 0.7, 2.0, 5.0])
def test_tongues_lie_between_the_boundaries_of_mathieu(q: float) -> None:
    """Between b₁ and a₁, b₂ and a₂ … the rest is unstable, elsewhere above a₀ it is stable."""
    a = np.linspace(-3.0, 9.0, 241)
    found = plane(MATHIEU, a, np.array([q, q + 1.0])).map().is_stable[0]
    edges = [mathieu_a(0, q), *(edge for k in range(1, 5) for edge in (mathieu_b(k, q), mathieu_a(k, q)))]
    expected = np.searchsorted(edges, a) % 2 == 1
    away = np.min(np.abs(a[:, None] - np.array(edges)), axis=1) > 1e-3
    assert (found == expected)[away].all()


@pytest.mark.parametrize("way", [1.0, 1e-2, 1e-4, 1e-6, 1e-8])
def test_small_motions_are_those_of_mathieu_however_soon_a_spring_stiffens(way: float) -> None:
    """At rest x³ says nothing; from there neighbours move far less than the `way` after which it is as large as x."""
    boundaries = np.array(sorted([*(mathieu_a(k, 0.7) for k in range(4)), *(mathieu_b(k, 0.7) for k in range(1, 4))]))
    scene = hill(f"(a - 2*q*cos(2*t))*x^2/2 + {way**-2:.0f}*x^4/4")
    found = plane(scene, boundaries, np.array([0.7, 1.7])).map()
    assert np.abs(found.multipliers[0].sum(axis=-1)) == pytest.approx(2.0, abs=3e-6)


PULSES = hill("a*sqrt(pi)/q*exp(-(sin(pi*t)/q)^2)*x^2/2")  # once a second, a push of −a x within q/π s


@pytest.mark.parametrize("width", [1e-3, 1e-2, 0.03, 0.06, 0.3])
def test_pulses_thinner_than_a_step_are_met(width: float) -> None:
    """The same by SciPy, in steps of a sixth of the pulse; some of these motions are stable, some are not."""
    strengths = np.array([1.0, 2.2, 3.4, 4.6, 5.8])
    found = plane(PULSES, strengths, np.array([width, 2.0 * width]), 1.0).map()

    def columns(t: float, y: np.ndarray, strength: float) -> list[float]:
        pull = -strength * math.sqrt(math.pi) / width * math.exp(-((math.sin(math.pi * t) / width) ** 2))
        return [y[1], pull * y[0], y[3], pull * y[2]]

    options = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-11, "max_step": width / 6.0}
    for strength, multipliers in zip(strengths, found.multipliers[0], strict=True):
        end = solve_ivp(columns, (0.0, 1.0), [1.0, 0.0, 0.0, 1.0], args=(strength,), **options).y[:, -1]
        assert multipliers.sum().real == pytest.approx(end[0] + end[3], abs=1e-5)
        assert np.prod(multipliers) == pytest.approx(1.0, abs=1e-5)
    assert sorted(set(found.is_stable[0].tolist())) == [False, True]


def test_multipliers_come_in_pairs_or_shrink_with_the_damping() -> None:
    """Liouville: the product of the multipliers is e^(−cT)."""
    a, q = np.linspace(0.2, 3.0, 7), np.linspace(0.1, 1.0, 5)
    for damping in (0.0, 0.3):
        found = plane(hill("(a - 2*q*cos(2*t))*x^2/2", damping), a, q).map()
        assert found.multipliers.prod(axis=-1) == pytest.approx(math.exp(-damping * math.pi), rel=1e-7)


def test_a_periodic_motion_is_found_from_a_state_nearby() -> None:
    """ẍ + 5x = cos 2t has x = cos 2t, from x = 1 and ẋ = 0."""
    scene = hill("a*x^2/2 - q*x*cos(2*t)")
    found = plane(scene, np.array([5.0, 8.0]), np.array([1.0, 4.0])).map()
    assert found.states[0, 0] == pytest.approx([1.0, 0.0], abs=1e-8)
    assert found.states[1, 1] == pytest.approx([1.0, 0.0], abs=1e-8)


def test_where_nothing_is_periodic_there_is_no_number() -> None:
    """Resonance: the free particle pushed by a constant force has no periodic motion."""
    found = plane(hill("-a*x - q*x"), np.array([1.0, 2.0]), np.array([1.0, 2.0])).map()
    assert np.isnan(found.growth).all()
    assert not found.is_stable.any()


def test_what_is_cancelled_is_not_called_stable() -> None:
    found = plane(MATHIEU, np.array([2.0, 3.0]), np.array([0.1, 0.2])).map(np.ones(1, dtype=np.int64))
    assert np.isnan(found.growth).all()


def test_refinement_ends_with_the_whole_map() -> None:
    whole = plane(MATHIEU, np.linspace(0.0, 4.0, 17), np.linspace(0.1, 2.0, 9))
    shapes = [each.growth.shape for each in whole.refined()]
    assert shapes == [(2, 3), (3, 5), (5, 9), (9, 17)]
    *_, last = whole.refined()
    assert np.array_equal(last.growth, whole.map().growth)


def test_angles_may_wind() -> None:
    """The pendulum with its pivot held: upright unstable, hanging stable."""
    problem = problem_of(hill("-a*cos(x) - q*cos(2*t)"), 1.0)
    axes = Axis("a", (1.0, 4.0)), Axis("q", (0.0, 1.0))
    for angle, is_stable in ((0.0, True), (math.pi, False), (math.tau, True)):
        start = replace(problem, values=(angle,))
        found = Plane(start, *axes, np.full((2, 2), math.pi * 0.9)).map()
        assert found.is_stable.all() == is_stable
