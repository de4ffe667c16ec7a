"""A correction of a stage and its kick in symbols, against the linear system that it solves, by numbers."""

from __future__ import annotations

import numpy as np
import pytest
from tests.model.test_pushes import numbers
from tests.simulation.constrained import equation, four_bar, particle, pendulum, scene, sleigh
from tests.simulation.test_rattle import incline, loop, rods, string, wire

from deltaq.mechanics.scene import Scene
from deltaq.model.compiled import QUICK, Floats, compile_expressions
from deltaq.model.equations import Equations, equations
from deltaq.model.kicks import KickPlaces, compiled_kicks
from deltaq.model.model import of_motion
from deltaq.model.phase import phase_space

SCENES = {
    "two rods": rods(),
    "coupled masses": loop(),
    "four-bar by angles": four_bar(),
    "turning wire": wire(),
    "string": string(),
    "incline": incline(),
    "moving pivot": pendulum(pivot=("0", "a*sin(Omega*t)")),
}
H, A, AHAT, C = 0.05, 0.4, 0.7, 0.3


def rows_of(eqs: Equations, row: Floats, n: int, m: int) -> Floats:
    """A at a state."""
    said: Floats = compile_expressions(eqs.symbols.inputs, of_motion(eqs), QUICK).table(row[None])[0]
    rows: Floats = said[len(said) - m * (n + 2) :][: m * n].reshape(m, n)
    return rows


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_a_correction_solves_its_linear_system(scene: Scene) -> None:
    """W δV + A₀ᵀδν = p₀ − p + hâ r and g + hA δV = 0, at the end of the step; the kicked momenta are p₀ − A₀ᵀδν."""
    eqs, source = equations(scene), np.random.default_rng(11)
    n, m, inputs = len(eqs.forcing), len(eqs.constraints.gaps), len(eqs.symbols.inputs)
    places, found, phase = KickPlaces(n, m), compiled_kicks(eqs), phase_space(eqs).function
    assert found is not None
    missed = compile_expressions(eqs.symbols.inputs, [*eqs.constraints.gaps], QUICK)
    for _ in range(20):
        row, before, w = numbers(scene, source, 0), source.normal(size=(m, n)), source.normal(size=(n, n))
        momenta, q, v, t = source.normal(size=n), row[:n], row[n : 2 * n], row[2 * n]
        given = np.concatenate(
            [row, [H, H * A, H * AHAT, t + H * (1.0 - C)], momenta, before.ravel(), np.linalg.inv(w).ravel()]
        )
        assert len(given) == inputs + places.size == found.inputs
        told = found.table(given[None])[0]
        change, kicked, stage, forces = told[: 4 * n].reshape(4, n)
        inside, end = row.copy(), row.copy()
        inside[:n] += H * A * v
        end[:n], end[2 * n] = q + H * v, t + H * (1.0 - C)
        of_phase = phase.table(inside[None])[0]
        place = n * (n + 1) // 2
        assert stage == pytest.approx(inside[:n], abs=1e-14)
        assert forces == pytest.approx(of_phase[place + n :], abs=1e-11)
        a, gap = rows_of(eqs, end, n, m), missed.table(end[None])[0]
        crossed = a @ np.linalg.solve(w, before.T)
        scale = np.linalg.cond(crossed) * np.linalg.cond(w) * (1.0 + np.abs(change).max())
        residual = momenta - of_phase[place : place + n] + H * AHAT * forces
        assert w @ change == pytest.approx(residual + kicked - momenta, abs=1e-13 * scale)
        assert gap + H * a @ change == pytest.approx(np.zeros(m), abs=1e-13 * scale)
        push = momenta - kicked
        multiples = np.linalg.lstsq(before.T, push, rcond=None)[0]
        assert before.T @ multiples == pytest.approx(push, abs=1e-13 * scale)
        assert told[-2] == pytest.approx(np.linalg.det(crossed), rel=1e-9, abs=1e-13 * scale)
        assert told[-1] == pytest.approx(np.prod(np.diag(crossed)), rel=1e-9, abs=1e-13 * scale)


def test_what_has_no_gap_or_many_coordinates_is_left_to_numbers() -> None:
    long = scene(
        {f"x{k}": (0.0, 0.0) for k in range(11)},
        {"m": 1.0, "g": 9.81},
        [particle(f"p{k}", f"x{k}", "0") for k in range(11)],
        [equation("c", "x0 = x1")],
    )
    assert compiled_kicks(equations(long)) is None
    assert compiled_kicks(equations(sleigh())) is None
