"""The energies of an answer as a caller reads them: what is fed in comes out again, with its sign."""

from __future__ import annotations

import numpy as np
import pytest
from tests.simulation.scenes import OWN

from deltaq.mechanics.library import scene_ids
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.service import run


def pushed(force: str, **parameters: float) -> dict[str, object]:
    """A mass of 2 kg on a line that begins at 0.5 m with 1 m/s."""
    values = {"m": 2.0, **parameters}
    return {
        "format": 1,
        "id": "pushed",
        "dimension": 2,
        "coordinates": [{"name": "x", "value": 0.5, "rate": 1.0}],
        "parameters": [{"name": name, "value": value, "positive": False} for name, value in values.items()],
        "bodies": [{"name": "mass", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
        "loads": [{"kind": "force", "at": "mass", "force": [force, "0"]}],
    }


def energies(scene: object, t_end: float = 4.0) -> dict[str, np.ndarray]:
    answer = run({"scene": scene, "t_end": t_end, "tolerance": 1e-10, "samples": 41})
    assert answer["status"] == "ok"
    told = answer["energy"]
    assert isinstance(told, dict)
    found = {name: np.array(told[name]) for name in ("kinetic", "potential", "power", "work", "balance")}
    return {**found, "x": np.array(answer["coordinates"]["x"]), "t": np.array(answer["t"]), "drift": told["drift"]}


def test_drag_takes_energy_away() -> None:
    """m v̇ = −c v: v = e^(−ct/m), so the work done on the mass is m (e^(−2ct/m) − 1)/2 and the power −c v²."""
    found = energies(pushed("-c*dot(x)", c=0.6))
    decay = np.exp(-2.0 * 0.6 * found["t"] / 2.0)
    np.testing.assert_allclose(found["work"], decay - 1.0, atol=1e-8)
    np.testing.assert_allclose(found["power"], -0.6 * decay, atol=1e-8)
    np.testing.assert_allclose(found["balance"], 1.0, atol=1e-8)


def test_a_drive_feeds_energy_in() -> None:
    """m v̇ = F t: the kinetic energy is m v²/2 with v = 1 + F t²/(2m), all of its gain is work."""
    found = energies(pushed("F*t", F=3.0))
    gain = (1.0 + 0.75 * found["t"] ** 2) ** 2 - 1.0
    np.testing.assert_allclose(found["work"] + found["potential"][0] - found["potential"], gain, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(found["balance"], found["balance"][0], rtol=1e-9)
    assert found["drift"] < 1e-7 * gain.max()


@pytest.mark.parametrize("method", ["dop853", "taylor", "radau-5", "stormer-verlet"])
def test_impacts_take_energy_where_no_force_acts(method: str) -> None:
    """Between walls at 0 and 1 that leave 0.9 of the speed 1: after k impacts the energy is 0.81ᵏ, of 2 kg."""
    walls = [
        {"name": name, "value": gap, "then": "bounce", "restitution": "0.9"}
        for name, gap in (("left", "x"), ("right", "1 - x"))
    ]
    free = {**pushed("0"), "loads": [], "events": walls}
    answer = run({"scene": free, "t_end": 4.5, "tolerance": 1e-10, "samples": 41, "method": method})
    told = answer["energy"]
    assert isinstance(told, dict)
    impacts = len(answer["events"])  # type: ignore[arg-type]
    assert impacts == 4
    assert told["kinetic"][-1] == pytest.approx(0.81**impacts, rel=1e-9)
    assert told["work"][-1] == pytest.approx(0.81**impacts - 1.0, rel=1e-9)
    np.testing.assert_allclose(told["balance"], 1.0, rtol=1e-9)
    assert told["works"] is True
    assert told["drift"] < 1e-9


@pytest.mark.parametrize(
    ("name", "works"),
    [
        pytest.param("bead-on-rotating-hoop", True, id="a hoop that has to be driven"),
        pytest.param("foucault", False, id="a frame that turns about a central force"),
        pytest.param("damped-pendulum", True, id="drag"),
        pytest.param("pendulum", False, id="weight alone"),
        pytest.param("bouncing-ball", True, id="impacts"),
    ],
)
def test_whether_anything_works(name: str, works: bool) -> None:
    answer = run({"scene": name, "t_end": 3.0, "tolerance": 1e-9, "samples": 31})
    assert answer["energy"]["works"] is works  # type: ignore[index]


@pytest.mark.parametrize("name", [*scene_ids(), *OWN])
def test_the_balance_of_every_scene_stays(name: str) -> None:
    """E + V − ∫P dt as it stands in the answer, however much is fed in or taken out."""
    scene = write_scene(OWN[name]()) if name in OWN else name
    answer = run({"scene": scene, "t_end": 3.0, "tolerance": 1e-9, "samples": 3001, "include": ["power"]})
    energy = answer["energy"]
    assert isinstance(energy, dict)
    balance = np.array(energy["balance"])
    scale = np.abs(energy["kinetic"]).max() + np.ptp(energy["potential"]) + np.abs(energy["work"]).max()
    np.testing.assert_allclose(balance, balance[0], atol=1e-6 * scale)
    assert float(energy["drift"]) <= 1e-6 * scale
    fed = np.array(energy["kinetic"]) + np.array(energy["potential"]) - balance
    times, power = np.array(answer["t"]), np.array(energy["power"])
    jumps = np.flatnonzero(times[1:] == times[:-1]) + 1  # what an impact takes is taken at once
    for part in np.split(np.arange(len(times)), jumps):
        if len(part) > 3:
            rate = np.gradient(fed[part], times[part])[1:-1]
            np.testing.assert_allclose(rate, power[part][1:-1], atol=0.02 * np.abs(power).max() + 1e-3 * scale)
