"""Scenes of the library against what textbooks say of their motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from deltaq.mechanics.library import load_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

Floats = NDArray[np.float64]
SECONDS, TOLERANCE = 6.0, 1e-9


@dataclass(frozen=True)
class Motion:
    """A motion at `t`: q and q̇ by the name of the coordinate; the parameters' values."""

    t: Floats
    q: Mapping[str, Floats]
    rate: Mapping[str, Floats]
    value: Mapping[str, float]


def motion_of(name: str) -> Motion:
    scene = load_scene(name)
    found = simulate(problem_of(scene, SECONDS, 301), get_method("dop853"), tolerance=TOLERANCE)
    assert found.outcome.status == "ok"
    free = [coordinate.name for coordinate in scene.free]
    return Motion(
        found.times,
        dict(zip(free, found.values.T, strict=True)),
        dict(zip(free, found.rates.T, strict=True)),
        {parameter.name: parameter.value for parameter in scene.parameters},
    )


def conical(m: Motion) -> Floats:
    """The steady circle keeps its angle."""
    return m.q["theta"] - m.q["theta"][0]


def rolling(m: Motion) -> Floats:
    """s̈ = ⅔ g sin α"""
    acceleration = 2 / 3 * m.value["g"] * np.sin(m.value["alpha"])
    return m.q["s"] - (m.q["s"][0] + m.rate["s"][0] * m.t + acceleration * m.t**2 / 2)


def double_atwood(m: Motion) -> Floats:
    """The movable pulley weighs like 4 m₂m₃/(m₂ + m₃); inside it Atwood's machine runs under g + ẍ."""
    m1, m2, m3, g = (m.value[name] for name in ("m1", "m2", "m3", "g"))
    apparent = 4 * m2 * m3 / (m2 + m3)
    first = g * (m1 - apparent) / (m1 + apparent)
    second = (m2 - m3) / (m2 + m3) * (g + first)
    return np.hypot(
        m.q["x"] - m.q["x"][0] - first * m.t**2 / 2,
        m.q["y"] - m.q["y"][0] - second * m.t**2 / 2,
    )


def foucault(m: Motion) -> Floats:
    """Seen from inertial space, an ellipse that stands still: X = x₀ cos ωt, Y = (Ω_z/ω) x₀ sin ωt."""
    omega = np.sqrt(m.value["g"] / m.value["l"])
    turning = m.value["Omega"] * np.sin(m.value["beta"])
    x0, turned = m.q["x"][0], turning * m.t
    ahead, aside = x0 * np.cos(omega * m.t), turning / omega * x0 * np.sin(omega * m.t)
    return np.hypot(
        m.q["x"] - (ahead * np.cos(turned) + aside * np.sin(turned)),
        m.q["y"] - (aside * np.cos(turned) - ahead * np.sin(turned)),
    )


def wilberforce(m: Motion) -> Floats:
    """At resonance z = z₀ cos(Δt/2) cos(ω̄t) with the two eigenfrequencies' mean ω̄ and difference Δ."""
    mass, inertia, k, epsilon = (m.value[name] for name in ("m", "J", "k", "epsilon"))
    coupling = epsilon / (2 * np.sqrt(mass * inertia))
    fast, slow = np.sqrt(k / mass + coupling), np.sqrt(k / mass - coupling)
    return m.q["z"] - m.q["z"][0] * np.cos((fast - slow) / 2 * m.t) * np.cos((fast + slow) / 2 * m.t)


def heavy_top(m: Motion) -> Floats:
    """The momenta p_ψ and p_φ are conserved."""
    spin = m.rate["psi"] * np.cos(m.q["theta"]) + m.rate["phi"]
    transverse = m.value["A"] + m.value["m"] * m.value["l"] ** 2
    about_vertical = transverse * m.rate["psi"] * np.sin(m.q["theta"]) ** 2
    momentum = about_vertical + m.value["C"] * spin * np.cos(m.q["theta"])
    return np.hypot(spin - spin[0], momentum - momentum[0])


def free_hoop(m: Motion) -> Floats:
    """The angular momentum (m R² sin²ϑ + M R²/2) ψ̇ is conserved."""
    bead, hoop = m.value["m"] * np.sin(m.q["theta"]) ** 2, m.value["M"] / 2
    momentum = (bead + hoop) * m.value["R"] ** 2 * m.rate["psi"]
    return np.asarray(momentum - momentum[0])


KNOWN = [
    pytest.param("conical-pendulum", conical, 1e-9, id="conical pendulum: the cone"),
    pytest.param("rolling-disc", rolling, 1e-9, id="rolling disc: ⅔ g sin α"),
    pytest.param("double-atwood", double_atwood, 1e-9, id="double Atwood machine: both accelerations"),
    pytest.param("foucault", foucault, 1e-8, id="Foucault: the plane turns by −Ω sin β"),
    pytest.param("wilberforce", wilberforce, 1e-8, id="Wilberforce: beats"),
    pytest.param("heavy-top", heavy_top, 1e-6, id="heavy top: two momenta"),
    pytest.param("bead-on-free-hoop", free_hoop, 1e-7, id="free hoop: angular momentum"),
]


@pytest.mark.parametrize(("name", "deviation", "bound"), KNOWN)
def test_motion_is_that_of_the_textbook(name: str, deviation: Callable[[Motion], Floats], bound: float) -> None:
    assert np.abs(deviation(motion_of(name))).max() <= bound


def test_a_pendulum_on_a_fast_pivot_stands_upright() -> None:
    """Kapitza: about φ = π the pendulum swings with √((y₀ω/ℓ)²/2 − g/ℓ), to leading order in y₀/ℓ."""
    m = motion_of("kapitza")
    slow = np.sqrt((m.value["y0"] * m.value["omega"] / m.value["l"]) ** 2 / 2 - m.value["g"] / m.value["l"])
    assert np.abs(m.q["phi"] - np.pi).max() < 0.4
    crossings = m.t[1:][np.diff(np.sign(m.q["phi"] - np.pi)) != 0]
    gaps = np.diff(crossings)
    assert np.median(gaps[gaps > 0.2]) == pytest.approx(np.pi / slow, rel=0.15)
