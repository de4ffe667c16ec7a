"""Constrained accelerations solved for in symbols, against the linear system that they solve, by numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pytest
import symengine as se
from tests.simulation.constrained import four_bar, parallelogram, particle, pendulum, scene, sleigh

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.model.compiled import QUICK, Compiled, Floats, compile_expressions
from deltaq.model.equations import Equations, equations
from deltaq.model.model import Model, build, compile_model, of_motion
from deltaq.model.solved import compiled_solution, solved, turned
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

HELD = {name: load_scene(name) for name in scene_ids() if load_scene(name).constraints}
OWN = {
    "four-bar linkage": four_bar(),
    "parallelogram": parallelogram(),
    "sleigh": sleigh(),
    "pivot on the move": pendulum(pivot=("a*sin(Omega*t)", "a*cos(2*Omega*t)")),
}


@dataclass(frozen=True)
class Numbers:
    """A model's own numbers at states anywhere, for systems that are solved by NumPy."""

    eqs: Equations

    @cached_property
    def _motion(self) -> Compiled:
        return compile_expressions(self.eqs.symbols.inputs, of_motion(self.eqs))

    @cached_property
    def _gaps(self) -> Compiled:
        held = self.eqs.constraints
        return compile_expressions(self.eqs.symbols.inputs, (*held.gaps, *held.slips))

    @property
    def n(self) -> int:
        return len(self.eqs.forcing)

    @property
    def m(self) -> int:
        return len(self.eqs.constraints.slips)

    def off(self, row: Floats) -> tuple[Floats, Floats]:
        """g and w."""
        found = self._gaps.table(row[None])[0]
        return found[: -self.m], found[-self.m :]

    def parts(self, row: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """M, f, A and γ."""
        said, n, m = self._motion.table(row[None])[0], self.n, self.m
        place = n * (n + 1) // 2
        mass = np.zeros((n, n))
        mass[np.tril_indices(n)] = said[:place]
        mass += np.tril(mass, -1).T
        rest = said[len(said) - m * (n + 2) :]
        return mass, said[place : place + n], rest[: m * n].reshape(m, n), rest[m * n : m * n + m]

    def power(self, row: Floats) -> float:
        """P₀ + p₁·q̈ − λ·b."""
        (mass, force, a, bend), said, n, m = self.parts(row), self._motion.table(row[None])[0], self.n, self.m
        both = np.linalg.solve(whole(mass, a), np.concatenate([force, bend]))
        place = n * (n + 1) // 2 + n
        return float(said[place] + said[place + 1 : place + 1 + n] @ both[:n] - both[n:] @ said[len(said) - m :])


def whole(mass: Floats, a: Floats) -> Floats:
    """The matrix of M q̈ − Aᵀλ = f, A q̈ = γ."""
    return np.block([[mass, -a.T], [a, np.zeros((len(a), len(a)))]])


def assert_nearest(change: Floats, off: Floats, mass: Floats, a: Floats) -> None:
    """A Δ = what is off, and Δ = M⁻¹Aᵀμ."""
    assert a @ change == pytest.approx(off, rel=1e-8, abs=1e-8)
    multiples = np.linalg.lstsq(a.T, mass @ change, rcond=None)[0]
    assert a.T @ multiples == pytest.approx(mass @ change, abs=1e-8)


def states_of(scene: Scene) -> Floats:
    """Twenty anywhere, with the parameters."""
    n, parameters = len(equations(scene).forcing), [parameter.value for parameter in scene.parameters]
    source = np.random.default_rng(7)
    return np.array([[*source.uniform(-1.0, 1.0, 2 * n), 0.3, *parameters] for _ in range(20)])


@pytest.mark.parametrize("scene", (HELD | OWN).values(), ids=(HELD | OWN).keys())
def test_accelerations_and_projections_solve_their_linear_systems(scene: Scene) -> None:
    """M q̈ − Aᵀλ = f, A q̈ = γ; Δq = M⁻¹Aᵀμ with A Δq = g; and det(A₀M⁻¹Aᵀ), at states anywhere."""
    eqs = equations(scene)
    numbers, found, rows = Numbers(eqs), compiled_solution(eqs, QUICK), states_of(scene)
    n, m = numbers.n, numbers.m
    assert found is not None
    holonomic, place = len(eqs.constraints.gaps), n * (n + 1) // 2
    before = np.random.default_rng(8).normal(size=(len(rows), m * n))
    given = np.hstack([rows, before])
    for row, rows_before, motion, new, landed in zip(
        rows, before, found.motion.table(rows), found.projected.table(given), found.landed.table(given), strict=True
    ):
        mass, force, a, bend = numbers.parts(row)
        if np.linalg.cond(whole(mass, a)) > 1e8:
            continue
        both = np.linalg.solve(whole(mass, a), np.concatenate([force, bend]))
        assert motion[place : place + n] == pytest.approx(both[:n], rel=1e-8, abs=1e-8)
        gaps, slips = numbers.off(row)
        determinant = np.linalg.det(rows_before.reshape(m, n) @ np.linalg.solve(mass, a.T))
        moved, sped = (row[: 2 * n] - new[: 2 * n]).reshape(2, n)
        assert_nearest(moved, gaps, mass, a[:holonomic])
        assert_nearest(sped, slips, mass, a)
        assert_nearest(landed[:n], slips, mass, a)
        for told in (new, landed):
            assert told[2 * n :][: m * n].reshape(m, n) == pytest.approx(a, abs=1e-12)
            assert told[2 * n + m * n] == pytest.approx(determinant, rel=1e-7, abs=1e-9)
        kept = np.concatenate([row[:n], row[n : 2 * n] - landed[:n], row[2 * n :]])
        mass, force, a, bend = numbers.parts(kept)
        both = np.linalg.solve(whole(mass, a), np.concatenate([force, bend]))
        assert landed[n : 2 * n] == pytest.approx(both[:n], rel=1e-8, abs=1e-8)
        assert landed[-m:] == pytest.approx((a * a).sum(axis=1), rel=1e-12)
        if eqs.is_powered:
            assert landed[-m - 1] == pytest.approx(numbers.power(kept), rel=1e-8, abs=1e-8)


@pytest.mark.parametrize("scene", (HELD | OWN).values(), ids=(HELD | OWN).keys())
def test_places_tell_what_they_are_off_by_and_per_unit(scene: Scene) -> None:
    """A Δ = g, and the same for each unit of g, in the metric of M; nothing where no constraint is holonomic."""
    eqs = equations(scene)
    numbers, found, rows = Numbers(eqs), compiled_solution(eqs, QUICK), states_of(scene)
    n, holonomic = numbers.n, len(eqs.constraints.gaps)
    assert found is not None
    if found.placed is None:
        assert not holonomic
        return
    for row, told in zip(rows, found.placed.table(rows), strict=True):
        mass, _, a, _ = numbers.parts(row)
        if np.linalg.cond(whole(mass, a)) > 1e8:
            continue
        offs = (numbers.off(row)[0], *np.eye(holonomic))
        for change, off in zip(told.reshape(1 + holonomic, n), offs, strict=True):
            assert_nearest(change, off, mass, a[:holonomic])


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


def by_symbols_and_numbers(
    monkeypatch: pytest.MonkeyPatch, method: str, t_end: float, step: float, *, is_long: bool
) -> tuple[Trajectory, Trajectory]:
    """A four-bar linkage as it moves by what is solved for in symbols, and by loops over numbers."""
    scene = four_bar()
    problem = replace(problem_of(scene, t_end, 21), model=build(equations(scene), scene))
    if is_long:
        problem.model.settle()
    symbols = simulate(problem, get_method(method), step=step, with_error=False)
    with monkeypatch.context() as without:
        without.setattr(Model, "solution", lambda _self, *, is_long: None)
        without.setattr("deltaq.model.phase.solved", lambda _eqs: None)
        problem.model.__dict__.pop("phase", None)
        return symbols, simulate(problem, get_method(method), step=step, with_error=False)


@pytest.mark.parametrize("is_long", [False, True], ids=["short", "long"])
@pytest.mark.parametrize("method", ["dormand-prince-54", "radau-5", "newmark"])
def test_symbols_and_numbers_move_alike(method: str, monkeypatch: pytest.MonkeyPatch, *, is_long: bool) -> None:
    symbols, numbers = by_symbols_and_numbers(monkeypatch, method, 2.0, 1e-3, is_long=is_long)
    assert np.abs(symbols.values - numbers.values).max() < 1e-11
    assert symbols.reactions is not None
    assert numbers.reactions is not None
    assert np.abs(symbols.reactions.multipliers - numbers.reactions.multipliers).max() < 1e-8


@pytest.mark.parametrize("is_long", [False, True], ids=["short", "long"])
def test_steps_far_off_land_alike(monkeypatch: pytest.MonkeyPatch, *, is_long: bool) -> None:
    """Euler's steps leave g and w by h², where A has turned by h²: of both h⁴ is left in each step, h³ in all."""
    steps = (1e-3, 2e-4)
    runs = (by_symbols_and_numbers(monkeypatch, "explicit-euler", 0.5, step, is_long=is_long) for step in steps)
    apart = [float(np.abs(symbols.values - numbers.values).max()) for symbols, numbers in runs]
    assert apart[0] < steps[0] ** 3
    assert apart[1] < apart[0] / 60.0


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
