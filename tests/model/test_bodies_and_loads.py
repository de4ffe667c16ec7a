"""Kinds of bodies and loads: the same system described in two ways must move alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.model.equations import equations
from deltaq.model.model import compile_model
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

PARAMETERS = {"m": 1.3, "l": 0.8, "g": 9.81, "c": 0.4, "M0": 0.7, "omega": 3.0, "a": 0.2}
GRAVITY = {"kind": "gravity", "acceleration": ["0", "g"]}
STRAIGHT = ["s*sin(phi)", "s*cos(phi)"]
RIGID = {
    "name": "rod",
    "kind": "rigid",
    "mass": "m",
    "position": ["l/2*sin(phi)", "l/2*cos(phi)"],
    "inertia": "m*l^2/12",
    "angle": "phi",
}
CONTINUUM = {
    "name": "rod",
    "kind": "continuum",
    "material": [{"name": "s", "from": "0", "to": "l"}],
    "density": "m/l",
    "position": STRAIGHT,
}

Described = tuple[Mapping[str, object], Sequence[Mapping[str, object]]]  # and the dimension, if 3


def rod(body: Mapping[str, object], loads: Sequence[Mapping[str, object]], dimension: int = 2) -> Scene:
    """A body that turns by φ; `psi` and `theta` only where it is in space."""
    angles = ["phi"] if dimension == 2 else ["phi", "theta", "psi"]
    return read_scene(
        {
            "format": 1,
            "id": "rod",
            "dimension": dimension,
            "coordinates": [{"name": name, "value": 0.7, "rate": 0.5 + i} for i, name in enumerate(angles)],
            "parameters": [{"name": name, "value": value} for name, value in PARAMETERS.items()],
            "points": [
                {"name": "support", "position": ["a*sin(omega*t)", "-a", "0"][:dimension]},
                {"name": "tip", "position": ["l*sin(phi)", "l*cos(phi)", "0"][:dimension]},
            ],
            "bodies": [body],
            "loads": list(loads),
        }
    )


def outputs(scene: Scene) -> np.ndarray:
    model = compile_model(scene)
    rows = np.random.default_rng(3).uniform(0.3, 1.4, (5, model.motion.inputs))
    seen = model.observe(rows)
    return np.column_stack([model.motion.table(rows)[:, :2], seen.kinetic, seen.potential])


SAME = [
    pytest.param((RIGID, [GRAVITY]), (CONTINUUM, [GRAVITY]), id="rigid rod and continuum"),
    pytest.param(
        (RIGID, [GRAVITY]),
        (RIGID, [{"kind": "potential", "energy": "-m*g*l/2*cos(phi)"}]),
        id="weight and its potential",
    ),
    pytest.param(
        (CONTINUUM, [GRAVITY]),
        (
            CONTINUUM,
            [
                {
                    "kind": "distributed",
                    "material": CONTINUUM["material"],
                    "position": STRAIGHT,
                    "density": ["0", "m/l*g"],
                }
            ],
        ),
        id="weight and force density",
    ),
    pytest.param(
        (RIGID, [{"kind": "moment", "angle": "phi", "moment": "-c*dot(phi)"}]),
        (RIGID, [{"kind": "dissipation", "function": "c*dot(phi)^2/2"}]),
        id="moment and dissipation function",
    ),
    pytest.param(
        (RIGID, [{"kind": "moment", "angle": "phi", "moment": "M0"}]),
        (RIGID, [{"kind": "potential", "energy": "-M0*phi"}]),
        id="constant moment and its potential",
    ),
    pytest.param(
        (RIGID, [{"kind": "force", "at": "tip", "force": ["M0/l*cos(phi)", "-M0/l*sin(phi)"]}, GRAVITY]),
        (RIGID, [{"kind": "moment", "angle": "phi", "moment": "M0 + c*(dot(phi) - dot(phi))"}, GRAVITY]),
        id="follower force and moment",
    ),
    pytest.param(
        (RIGID, [{"kind": "damper", "from": "support", "to": "tip", "coefficient": "c"}]),
        (
            RIGID,
            [
                {
                    "kind": "dissipation",
                    "function": "c/2*((l*sin(phi) - a*sin(omega*t))*(l*cos(phi)*dot(phi) - a*omega*cos(omega*t))"
                    " - (l*cos(phi) + a)*l*sin(phi)*dot(phi))^2"
                    "/((l*sin(phi) - a*sin(omega*t))^2 + (l*cos(phi) + a)^2)",
                }
            ],
        ),
        id="damper to a moving support",
    ),
]


@pytest.mark.parametrize(("one", "other"), SAME)
def test_two_descriptions_of_one_system(one: Described, other: Described) -> None:
    moves = outputs(rod(*one))[:, :3]
    np.testing.assert_allclose(moves, outputs(rod(*other))[:, :3], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(("one", "other"), SAME[:3])
def test_and_of_one_energy(one: Described, other: Described) -> None:
    np.testing.assert_allclose(outputs(rod(*one)), outputs(rod(*other)), rtol=1e-12)


TOP = {
    "name": "top",
    "kind": "rigid",
    "mass": "m",
    "position": ["l*sin(theta)*sin(phi)", "-l*sin(theta)*cos(phi)", "l*cos(theta)"],
    "inertia": ["a", "a", "c"],
    "angular_velocity": [
        "dot(phi)*sin(theta)*sin(psi) + dot(theta)*cos(psi)",
        "dot(phi)*sin(theta)*cos(psi) - dot(theta)*sin(psi)",
        "dot(phi)*cos(theta) + dot(psi)",
    ],
}
SPUN = TOP | {"angular_velocity": [*TOP["angular_velocity"][:2], "dot(phi)*cos(theta) + dot(psi) + omega"]}
FALLING = {"kind": "gravity", "acceleration": ["0", "0", "-g"]}
BALANCED = [
    pytest.param((TOP, [FALLING], 3), id="heavy top"),
    pytest.param((SPUN, [FALLING], 3), id="top on a motor"),
    pytest.param((CONTINUUM, [GRAVITY, {"kind": "dissipation", "function": "c*dot(phi)^2/2"}]), id="damped continuum"),
    pytest.param(
        (RIGID, [GRAVITY, {"kind": "damper", "from": "support", "to": "tip", "coefficient": "c"}]),
        id="damper to a moving support",
    ),
    pytest.param(
        (RIGID | {"angle": "phi + a*sin(omega*t)"}, [{"kind": "moment", "angle": "2*phi", "moment": "M0*sin(phi)"}]),
        id="angle that depends on time",
    ),
]


@pytest.mark.parametrize("described", BALANCED)
def test_energy_balance_holds(described: Described) -> None:
    problem = problem_of(rod(*described), 3.0, 101)
    found = simulate(problem, get_method("dop853"), tolerance=1e-10)
    seen = problem.model.observe(problem.inputs(found.times, np.hstack([found.values, found.rates])))
    assert np.ptp(seen.kinetic + seen.potential - found.work) < 1e-9 * np.abs(seen.kinetic).max()


def test_rod_of_a_continuum_has_the_moment_of_inertia_of_the_textbook() -> None:
    eqs = equations(rod(CONTINUUM, []))
    m, l = (eqs.symbols.values[name] for name in ("m", "l"))
    at = {m: PARAMETERS["m"], l: PARAMETERS["l"], eqs.symbols.values["phi"]: 0.4}
    assert float(eqs.mass_matrix[0][0].subs(at)) == pytest.approx(1.3 * 0.8**2 / 3, rel=1e-14)
