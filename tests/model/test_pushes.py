"""What RATTLE is told in symbols, against the linear systems that it solves, by numbers."""

from __future__ import annotations

import numpy as np
import pytest
from tests.simulation.test_rattle import incline, loop, rods, string, wire

from deltaq.mechanics.scene import Scene
from deltaq.model.compiled import QUICK, Floats, compile_expressions
from deltaq.model.equations import equations
from deltaq.model.model import of_motion
from deltaq.model.pushes import Places, compiled_pushes

SCENES = {
    "two rods": rods(),
    "coupled masses": loop(),
    "turning wire": wire(),
    "string": string(),
    "incline": incline(),
}
KICK = 0.05


def numbers(scene: Scene, source: np.random.Generator, extra: int) -> Floats:
    """Inputs of a model anywhere, and then as many numbers."""
    n = len(scene.coordinates)
    parameters = [parameter.value for parameter in scene.parameters]
    return np.array([*source.uniform(-1.0, 1.0, 2 * n), 0.3, *parameters, *np.zeros(extra)])


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_pushes_solve_their_linear_systems(scene: Scene) -> None:
    """M Rᵀ = Aᵀ, S⁻¹ A Rᵀ = 1; A (v + Δv) + b = 0 with Δv − κa along R; Rᵀμ with A Rᵀμ = g, twice."""
    eqs, source = equations(scene), np.random.default_rng(5)
    n, m, inputs = len(eqs.forcing), len(eqs.constraints.gaps), len(eqs.symbols.inputs)
    places, found = Places(n, m), compiled_pushes(eqs)
    assert found is not None
    motion = compile_expressions(eqs.symbols.inputs, of_motion(eqs), QUICK)
    missed = compile_expressions(eqs.symbols.inputs, [*eqs.constraints.gaps, *eqs.constraints.slips], QUICK)
    for _ in range(20):
        row, before = numbers(scene, source, places.size), source.normal(size=(m, n))
        row[inputs] = KICK
        row[inputs + 1 : inputs + places.told] = before.ravel()
        told = found.ends.table(row[None, : found.ends.inputs])[0]
        said = motion.table(row[None, :inputs])[0]
        mass = np.zeros((n, n))
        mass[np.tril_indices(n)] = said[: n * (n + 1) // 2]
        mass += np.tril(mass, -1).T
        a = said[len(said) - m * (n + 2) :][: m * n].reshape(m, n)
        force = said[n * (n + 1) // 2 :][:n]
        r, rest = told[: m * n].reshape(m, n), told[m * n + places.inverse :]
        assert r @ mass == pytest.approx(a, abs=1e-12)
        share, inverse = a @ r.T, np.zeros((m, m))
        inverse[np.tril_indices(m)] = told[m * n :][: places.inverse]
        inverse += np.tril(inverse, -1).T
        assert inverse @ share == pytest.approx(np.eye(m), abs=1e-11 * np.linalg.cond(share))
        free, change, rows = rest[:n], rest[n : 2 * n], rest[2 * n :][: m * n].reshape(m, n)
        assert mass @ free == pytest.approx(force, abs=1e-11)
        assert rows == pytest.approx(a, abs=1e-14)
        assert rest[-3] == pytest.approx(np.linalg.det(before @ r.T), rel=1e-9, abs=1e-12)
        assert 0.0 < rest[-1] <= 1.0
        slid = row[:inputs].copy()
        slid[n : 2 * n] += change
        assert missed.table(slid[None])[0][m:] == pytest.approx(np.zeros(m), abs=1e-8 * (1.0 + np.abs(change).max()))
        along = change - KICK * free
        assert r.T @ np.linalg.lstsq(r.T, along, rcond=None)[0] == pytest.approx(along, rel=1e-8, abs=1e-9)
        row[inputs + places.told : inputs + places.told + len(told)] = told
        moves = found.shifts.table(row[None, : found.shifts.inputs])[0]
        first = np.linalg.solve(share, missed.table(row[None, :inputs])[0][:m])
        there = row[:inputs].copy()
        there[:n] -= r.T @ first
        second = np.linalg.solve(share, missed.table(there[None])[0][:m])
        assert moves[:m] == pytest.approx(first + second, rel=1e-7, abs=1e-9)
        assert moves[m : m + n] == pytest.approx(r.T @ first, rel=1e-7, abs=1e-9)
        assert moves[m + n :] == pytest.approx(r.T @ second, rel=1e-6, abs=1e-9)
