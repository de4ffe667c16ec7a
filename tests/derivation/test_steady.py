"""Steady motions with constant momenta: rates, stability and small oscillations as textbooks have them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import pytest
from tests.derivation.model_scenes import gravity, heavy_top, particle, spherical_pendulum
from tests.derivation.textbook_integrals import mass, potential, scene

from deltaq.derivation.rules import relative_equilibrium
from deltaq.derivation.steady import steady_motions
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene


def orbit(energy: str, **parameters: float) -> Scene:
    """A mass in a central field, in polar coordinates, at r = 0.6."""
    return scene(["r", "phi"], {"m": 1.3, **parameters}, [mass("bob", "r*cos(phi)", "r*sin(phi)")], potential(energy))


def test_circular_orbits_of_kepler() -> None:
    """Ω² = k/(m r³), and a disturbed orbit closes after one turn. Goldstein, Poole, Safko, 3rd ed., §3.6."""
    (motion,) = steady_motions(System(orbit("-k/r", k=2)))
    assert motion.number == pytest.approx(math.sqrt(2 / (1.3 * 0.6**3)))
    assert (motion.stability, motion.coordinate, motion.turning) == ("stable", "r", "phi")
    assert motion.frequency == pytest.approx(motion.number)


@pytest.mark.parametrize("power", [-3, -2, -1.5, -1, -0.5, 1, 2, 3])
def test_circular_orbits_in_powers_of_r(power: float) -> None:
    """V = k rⁿ sgn n: stable for n > −2, with ω = Ω √(n + 2). Landau, Lifshitz, Mechanics, §14; Arnold, 2nd ed., §8."""
    sign = 1 if power > 0 else -1
    (motion,) = steady_motions(System(orbit(f"{sign}*k*r^({power})", k=2)))
    assert motion.number == pytest.approx(math.sqrt(abs(power) * 2 * 0.6 ** (power - 2) / 1.3))
    assert motion.stability == ("unstable" if power < -2 else "undecided" if power == -2 else "stable")
    wanted = motion.number * math.sqrt(power + 2) if power > -2 else None
    assert motion.frequency == (None if wanted is None else pytest.approx(wanted))


def test_the_cone_of_the_spherical_pendulum() -> None:
    """Ω² = g/(l cos θ), ω² = Ω² (1 + 3 cos² θ). Kuypers, Klassische Mechanik, §2."""
    (motion,) = steady_motions(System(spherical_pendulum()))
    theta = 0.3
    assert motion.number == pytest.approx(math.sqrt(9.81 / math.cos(theta)))
    assert motion.frequency == pytest.approx(motion.number * math.sqrt(1 + 3 * math.cos(theta) ** 2))


def test_no_cone_above_the_horizon() -> None:
    position = ["l*sin(theta)*cos(psi)", "l*sin(theta)*sin(psi)", "l*cos(theta)"]
    assert steady_motions(System(particle(["theta", "psi"], {"l": 1.0, "g": 9.81}, position, gravity(3)))) == ()


def test_the_two_precessions_of_the_heavy_top() -> None:
    """(A' − C) cos θ Ω² − C φ̇ Ω + m g s = 0. Goldstein, Poole, Safko, 3rd ed., §5.7."""
    document = load_scene("heavy-top")
    found = steady_motions(System(document))
    values: Mapping[str, float] = {p.name: float(p.value) for p in document.parameters}
    start = {c.name: c for c in document.coordinates}
    theta, spin = float(start["theta"].value), float(start["phi"].rate)
    m, g, l, c = (values[name] for name in ("m", "g", "l", "C"))
    a = values["A"] + m * l**2
    assert len(found) == 2
    for motion in found:
        rate = motion.number
        assert (a - c) * math.cos(theta) * rate**2 - c * spin * rate + m * g * l == pytest.approx(
            0, abs=1e-9 * m * g * l
        )
        assert motion.stability == "stable"


def test_a_slow_top_has_no_regular_precession() -> None:
    """Goldstein, Poole, Safko, 3rd ed., eq. 5.76: without spin the discriminant is negative."""
    slow = heavy_top()
    motions = steady_motions(System(slow))
    a, c, m, g, s, theta = 2.0, 1.0, 1.0, 1.0, 1.0, 0.5  # A + m s² = 2; no spin: Ω² = −m g s/((A' − C) cos θ)
    assert -m * g * s / ((a - c) * math.cos(theta)) < 0
    assert motions == ()


def test_uniform_motion_is_no_relative_equilibrium_of_its_own() -> None:
    assert steady_motions(System(load_scene("cart-pendulum"))) == ()
    assert steady_motions(System(load_scene("double-pendulum"))) == ()


def test_the_rate_is_told_in_the_unit_of_what_turns() -> None:
    whole = orbit("-k/r", k=2)
    r, phi = whole.coordinates
    whole = replace(whole, coordinates=(replace(r, unit="m"), replace(phi, unit="rad")))
    (motion,) = steady_motions(System(whole))
    about = relative_equilibrium.apply(System(whole), motion, 1).about
    assert (about["coordinate"], about["rate"], about["unit"]) == ("r", "2.669", "rad")  # √(2/(1.3 · 0.6³))
