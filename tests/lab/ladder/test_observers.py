"""What an error is measured against does not depend on who looks on: free systems that drift, in closed form."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from tests.lab.ladder.climbing import climbed
from tests.lab.ladder.observers import Observer, Verdict

from deltaq.lab.ladder.distance import Yardstick
from deltaq.lab.ladder.measurement import full_run, yardstick
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene

SPRING = {"kind": "potential", "name": "spring", "energy": "k*(x2 - x1 - 1)^2/2"}


def measured(scene: Scene, span: float) -> Yardstick:
    return yardstick(full_run(scene, span, np.zeros(1, dtype=np.int64)))


def moving(scene: Scene, **rates: float) -> Scene:
    found = (replace(each, rate=rates.get(each.name, each.rate)) for each in scene.coordinates)
    return replace(scene, coordinates=tuple(found))


def particles(
    coordinates: Mapping[str, float], parameters: Mapping[str, float], bodies: object, loads: object
) -> Scene:
    return read_scene(
        {
            "coordinates": [{"name": name, "value": value, "unit": "m"} for name, value in coordinates.items()],
            "parameters": [{"name": name, "value": value} for name, value in parameters.items()],
            "bodies": bodies,
            "loads": loads,
        }
    )


def free_pair(m1: float, m2: float, k: float, stretch: float) -> Scene:
    bodies = [{"name": f"b{i}", "kind": "particle", "mass": f"m{i}", "position": [f"x{i}", "0"]} for i in (1, 2)]
    return particles({"x1": 0.0, "x2": 1.0 + stretch}, {"m1": m1, "m2": m2, "k": k}, bodies, [SPRING])


@pytest.mark.parametrize("seed", range(4))
def test_the_extent_of_two_free_masses_is_that_of_their_oscillation(seed: int) -> None:
    """d = s √(μ/M), from s₀ to −s₀, however fast the centre of mass goes (Landau, Lifshitz, §13)."""
    source = random.Random(seed)
    m1, m2, k, stretch = (source.uniform(*limits) for limits in ((0.3, 3.0), (0.3, 3.0), (5.0, 50.0), (0.01, 0.3)))
    speed = source.uniform(-30.0, 30.0)
    scene = moving(free_pair(m1, m2, k, stretch), x1=speed, x2=speed)
    reduced, mass = m1 * m2 / (m1 + m2), m1 + m2
    span = 2.3 * math.tau * math.sqrt(reduced / k)
    assert measured(scene, span).extent == pytest.approx(2.0 * stretch * math.sqrt(reduced / mass), rel=1e-4)


def test_the_extent_of_a_charge_in_crossed_fields_is_that_of_its_circles() -> None:
    """m ẍ = b ẏ, m ÿ = e − b ẋ from rest: circles of radius m e/b² that drift by e/b (Landau, Lifshitz 2, §22)."""
    bodies = [{"name": "charge", "kind": "particle", "mass": "m", "position": ["x", "y"]}]
    force = {"kind": "force", "name": "lorentz", "at": "charge", "force": ["b*dot(y)", "e - b*dot(x)"]}
    scene = particles({"x": 0.0, "y": 0.0}, {"m": 0.5, "b": 2.0, "e": 3.0}, bodies, [force])
    turn = math.tau * 0.5 / 2.0
    extents = [measured(scene, turns * turn).extent for turns in (3, 30)]
    assert extents == pytest.approx([2.0 * 0.5 * 3.0 / 2.0**2] * 2, rel=1e-3)


def test_a_spinning_rotor_does_not_make_the_rest_small() -> None:
    """A flywheel on a mass on a spring: its even turning is no extent, the spring's 0.01 m to both sides is."""
    rotor = {
        "name": "rotor",
        "kind": "rigid",
        "mass": "m",
        "inertia": "J",
        "angle": "phi",
        "position": ["x", "0"],
    }
    scene = read_scene(
        {
            "coordinates": [{"name": "x", "value": 0.01, "unit": "m"}, {"name": "phi", "rate": 50.0, "unit": "rad"}],
            "parameters": [{"name": "m", "value": 2.0}, {"name": "J", "value": 9.0}, {"name": "k", "value": 30.0}],
            "bodies": [rotor],
            "loads": [{"kind": "potential", "name": "spring", "energy": "k*x^2/2"}],
        }
    )
    assert measured(scene, 5.0).extent == pytest.approx(0.02, rel=1e-3)
    assert climbed(scene, 5.0).relative("frozen:x") == pytest.approx(1.0, rel=1e-3)


def test_turning_that_is_felt_is_extent() -> None:
    """A conical pendulum goes round a circle of radius ℓ sin ϑ: no frame that moves evenly takes that away."""
    scene = load_scene("conical-pendulum")
    length = next(each.value for each in scene.parameters if each.name == "l")
    assert measured(scene, 5.0).extent == pytest.approx(2.0 * length * math.sin(0.6), rel=1e-3)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("angle", [pytest.param(1.2, id="wide"), pytest.param(0.05, id="small")])
@pytest.mark.parametrize("speed", [pytest.param(10.0, id="10 m/s"), pytest.param(-300.0, id="300 m/s")])
def test_a_cart_may_roll_as_fast_as_it_likes(speed: float, angle: float) -> None:
    """Held evenly in one frame is held in another: there `guided:x` is called `frozen:x`."""
    cart = load_scene("cart-pendulum")
    start = tuple(replace(each, value=angle) if each.name == "phi" else each for each in cart.coordinates)
    still = replace(cart, coordinates=start)
    one, other = climbed(still, 20.0), climbed(moving(still, x=speed), 20.0)
    assert one.least.rung == other.least.rung
    names = {rung: rung for rung in one.measured} | {"frozen:x": "guided:x"}
    for rung, called in names.items():
        assert other.relative(called) == pytest.approx(one.relative(rung), rel=1e-3, abs=1e-6)


def test_free_masses_say_the_same_in_a_moving_frame() -> None:
    scene = free_pair(1.0, 2.0, 20.0, 0.1)
    seen = Observer("carried", carried={"x1": 5.0, "x2": 5.0}, origins=(3.0, -2.0)).sees(
        moving(scene, x1=0.01, x2=-0.02)
    )
    one, other = (Verdict.of(climbed(each, 6.0)) for each in (moving(scene, x1=0.01, x2=-0.02), seen))
    assert one.least == other.least
    assert one.errors["rigid:spring"] == pytest.approx(other.errors["rigid:spring"], rel=1e-3)


def test_small_numbers_are_as_good_as_large_ones() -> None:
    """Amplitudes of nanometres, told in metres: what integration errs by is a part of the motion, not of a metre."""
    scene = free_pair(1.0, 2.0, 20.0, 0.1)
    tiny = Observer("kilometres of kilometres", metre=1e-6).sees(scene)
    found = climbed(tiny, 6.0)
    assert found.relative("rigid:spring") == pytest.approx(climbed(scene, 6.0).relative("rigid:spring"), rel=1e-3)
    deviation = found.measured["full"].deviation
    assert deviation is not None
    assert deviation.floor < 1e-3
