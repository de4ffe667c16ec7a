"""Constrained accelerations solved for in symbols, against the linear system that they solve, by numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import symengine as se
from tests.simulation.constrained import four_bar, parallelogram, particle, scene, sleigh

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.model.compiled import QUICK, compile_expressions
from deltaq.model.equations import equations
from deltaq.model.model import Model, compile_model, of_motion
from deltaq.model.solved import compiled_solution, solved, turned
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

HELD = {name: load_scene(name) for name in scene_ids() if load_scene(name).constraints}
OWN = {"four-bar linkage": four_bar(), "parallelogram": parallelogram(), "sleigh": sleigh()}


@pytest.mark.parametrize("scene", (HELD | OWN).values(), ids=(HELD | OWN).keys())
def test_accelerations_and_projections_solve_their_linear_systems(scene: Scene) -> None:
    """M q̈ − Aᵀλ = f, A q̈ = γ; Δq = M⁻¹Aᵀμ with A Δq = g; and det(A₀M⁻¹Aᵀ), at states anywhere."""
    eqs = equations(scene)
    n, m = len(eqs.forcing), len(eqs.constraints.slips)
    found, gaps = compiled_solution(eqs, QUICK), (*eqs.constraints.gaps, *eqs.constraints.slips)
    assert found is not None
    holonomic = len(eqs.constraints.gaps)
    source = np.random.default_rng(7)
    parameters = [parameter.value for parameter in scene.parameters]
    rows = np.array([[*source.uniform(-1.0, 1.0, 2 * n), 0.3, *parameters] for _ in range(20)])
    told = compile_expressions(eqs.symbols.inputs, of_motion(eqs)).table(rows)
    off = compile_expressions(eqs.symbols.inputs, gaps).table(rows)
    before = source.normal(size=(len(rows), m * n))
    projected = found.projected.table(np.hstack([rows, before]))
    for row, said, motion, off_by, new, rows_before in zip(
        rows, told, found.motion.table(rows), off, projected, before, strict=True
    ):
        place = n * (n + 1) // 2
        mass = np.zeros((n, n))
        mass[np.tril_indices(n)] = said[:place]
        mass += np.tril(mass, -1).T
        rest = said[len(said) - m * (n + 2) :]
        a, bend = rest[: m * n].reshape(m, n), rest[m * n : m * n + m]
        whole = np.block([[mass, -a.T], [a, np.zeros((m, m))]])
        if np.linalg.cond(whole) > 1e8:
            continue
        both = np.linalg.solve(whole, np.concatenate([said[place : place + n], bend]))
        assert motion[place : place + n] == pytest.approx(both[:n], rel=1e-8, abs=1e-8)
        moved, sped = (row[: 2 * n] - new[: 2 * n]).reshape(2, n)
        assert new[2 * n :][: m * n].reshape(m, n) == pytest.approx(a, abs=1e-12)
        crossed = rows_before.reshape(m, n) @ np.linalg.solve(mass, a.T)
        assert new[-4] == pytest.approx(np.linalg.det(crossed), rel=1e-7, abs=1e-9)
        assert a[:holonomic] @ moved == pytest.approx(off_by[:holonomic], rel=1e-8, abs=1e-8)
        assert a @ sped == pytest.approx(off_by[holonomic:], abs=1e-8)
        for change, count in ((moved, holonomic), (sped, m)):
            multiples = np.linalg.lstsq(a[:count].T, mass @ change, rcond=None)[0]
            assert a[:count].T @ multiples == pytest.approx(mass @ change, abs=1e-8)


@pytest.mark.parametrize(
    ("height", "mass", "signs"),
    [
        pytest.param(0.6, 1.0, (True, True, True), id="upright"),
        pytest.param(0.0, 1.0, (True, False, True), id="flat, where it may fold"),
        pytest.param(0.6, -1.0, (True, True, False), id="negative mass"),
    ],
)
def test_signs_tell_where_there_is_no_solution(height: float, mass: float, signs: tuple[bool, ...]) -> None:
    eqs = equations(parallelogram())
    found, along = compiled_solution(eqs, QUICK), np.sqrt(1.0 - height**2)
    assert found is not None
    values = {"m": mass, "l": 1.0, "d": 2.0, "g": 9.81}
    row = [along, height, 2.0 + along, height, *[0.0] * 5, *(values[name] for name in eqs.symbols.parameters)]
    of_mass, of_share, least = found.motion.table(np.array([row]))[0][-3:]
    assert (bool(of_mass > 1e-14), bool(of_share > 1e-11), bool(least > 0.0)) == signs


def test_long_systems_are_left_to_numbers() -> None:
    chain = scene(
        {f"{axis}{k}": (0.0, 0.0) for k in range(12) for axis in "xy"},
        {"m": 1.0, "g": 9.81},
        [particle(f"p{k}", f"x{k} + y{(k + 1) % 12}", f"y{k}") for k in range(12)],
        [{"name": f"c{k}", "kind": "equation", "equation": f"x{k} - y{k} = 0"} for k in range(12)],
    )
    assert solved(equations(chain)) is None


@pytest.mark.parametrize("method", ["dormand-prince-54", "radau-5", "newmark"])
def test_symbols_and_numbers_move_alike(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    problem = problem_of(four_bar(), 2.0, 21)
    by_symbols = simulate(problem, get_method(method), step=1e-3, with_error=False)
    monkeypatch.setattr(Model, "solution", lambda _self, *, is_long: None)
    problem.model.__dict__.pop("phase", None)
    monkeypatch.setattr("deltaq.model.phase.solved", lambda _eqs: None)
    by_numbers = simulate(problem, get_method(method), step=1e-3, with_error=False)
    problem.model.__dict__.pop("phase", None)
    assert np.abs(by_symbols.values - by_numbers.values).max() < 1e-11
    assert by_symbols.reactions is not None
    assert by_numbers.reactions is not None
    assert np.abs(by_symbols.reactions.multipliers - by_numbers.reactions.multipliers).max() < 1e-8


def test_a_distance_is_without_roots_where_its_length_is_positive() -> None:
    """g = l − |r| as (l² − r²)/(2l); where a length may be negative, it stays as it is."""
    pendulum = load_scene("cartesian-pendulum")
    assert "sqrt" not in str(equations(pendulum).constraints)
    signed = replace(pendulum, parameters=tuple(replace(each, positive=False) for each in pendulum.parameters))
    assert "sqrt" in str(equations(signed).constraints)
    assert compile_model(signed) is not None


def test_larger_matrices_tell_by_their_pivots_that_nothing_turned() -> None:
    """A number above zero only where the determinant is: for what is nearly as it was, and for what is not."""
    source = np.random.default_rng(3)
    for _ in range(200):
        near = source.normal(size=(5, 5))
        crossed = near @ near.T + source.uniform(0.0, 3.0) * source.normal(size=(5, 5))
        table = tuple(tuple(se.RealDouble(entry) for entry in row) for row in crossed)
        assert float(turned(table)) <= 0.0 or np.linalg.det(crossed) > 0.0
    assert float(turned(tuple(tuple(se.RealDouble(float(i == k)) for i in range(5)) for k in range(5)))) > 0.0
