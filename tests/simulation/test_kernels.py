"""The compiled kernels, piece by piece."""

from __future__ import annotations

import errno
import shutil
import sys
from dataclasses import replace
from pathlib import Path
from pickle import UnpicklingError
from types import ModuleType

import numpy as np
import pytest
from tests.simulation.called import called
from tests.simulation.scenes import oscillator

import deltaq
from deltaq.api.workers.kernels import are_compiled
from deltaq.model.model import compile_model
from deltaq.simulation.driver import simulate
from deltaq.simulation.kernels import explicit_runge_kutta, motion
from deltaq.simulation.kernels.compiler import kernel
from deltaq.simulation.kernels.explicit_runge_kutta import integrate
from deltaq.simulation.kernels.machine import OwnFiles
from deltaq.simulation.kernels.marks import source_stamp
from deltaq.simulation.kernels.motion import SMALLEST_PIVOT
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

factor, solve, solve_small = called(motion.factor), called(motion.solve), called(motion.solve_small)
PACKAGE = Path(deltaq.__file__).parent


def packed(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    return np.concatenate([matrix[np.tril_indices(len(matrix))], right])


@pytest.mark.parametrize("n", [1, 2, 3, 7, 20])
def test_cholesky_solves(n: int) -> None:
    random = np.random.default_rng(n)
    square = random.normal(size=(n, n))
    matrix, right = square @ square.T + n * np.eye(n), random.normal(size=n)
    numbers = packed(matrix, right)
    assert factor(numbers, n) > SMALLEST_PIVOT
    solve(numbers, n)
    np.testing.assert_allclose(numbers[-n:], np.linalg.solve(matrix, right), rtol=1e-12)


@pytest.mark.parametrize(
    "matrix",
    [
        pytest.param([[0.0]], id="nothing"),
        pytest.param([[1.0, 1.0], [1.0, 1.0]], id="rank one"),
        pytest.param([[1.0, 0.0], [0.0, 0.0]], id="no mass at all in one coordinate"),
        pytest.param([[1.0, 1.0], [1.0, 1.0 + 1e-15]], id="a difference that is rounding"),
        pytest.param([[1.0, 2.0], [2.0, 1.0]], id="indefinite"),
        pytest.param([[-1.0]], id="negative"),
    ],
)
def test_singular_matrices_are_found(matrix: list[list[float]]) -> None:
    square = np.array(matrix)
    assert factor(packed(square, np.zeros(len(square))), len(square)) <= SMALLEST_PIVOT


@pytest.mark.parametrize("unit", [1e-150, 1e-9, 1.0, 1e9, 1e150])
@pytest.mark.parametrize("n", [2, 3])
def test_no_unit_makes_a_matrix_singular(n: int, unit: float) -> None:
    scales = np.diag([1.0] * (n - 1) + [unit])
    matrix = scales @ (0.5 * np.ones((n, n)) + np.eye(n)) @ scales
    ratio = factor(packed(matrix, np.zeros(n)), n)
    assert ratio == pytest.approx(factor(packed(0.5 * np.ones((n, n)) + np.eye(n), np.zeros(n)), n), rel=1e-9)
    if n == 2:
        assert solve_small(packed(matrix, np.zeros(n)), n, 1.0, np.zeros(4)) == pytest.approx(ratio, rel=1e-9)


def test_nan_is_told_from_singular() -> None:
    assert np.isnan(factor(np.array([np.nan, 0.0]), 1))


def test_a_cached_kernel_is_valid_for_the_code_it_is_made_of(tmp_path: Path) -> None:
    """Numba by itself would look at one file only and run a kernel whose inner functions have changed since."""
    stamp = source_stamp(Path(explicit_runge_kutta.__file__))
    assert integrate.compiled._cache._cache_file._source_stamp == stamp
    assert len(stamp) == 64
    shutil.copytree(PACKAGE, tmp_path / "deltaq", ignore=shutil.ignore_patterns("__pycache__", "static"))
    copy = tmp_path / "deltaq" / "simulation" / "kernels"
    for changed in ("motion.py", "step.py", "plan.py"):
        before = source_stamp.__wrapped__(copy / "explicit_runge_kutta.py")
        (copy / changed).write_text((copy / changed).read_text() + "\n# changed\n")
        assert source_stamp.__wrapped__(copy / "explicit_runge_kutta.py") != before
    before = source_stamp.__wrapped__(copy / "audit.py")
    tape = copy.parents[1] / "model" / "tape.py"
    tape.write_text(tape.read_text() + "\n# changed\n")
    assert source_stamp.__wrapped__(copy / "audit.py") != before


@pytest.mark.parametrize("n", [1, 2])
def test_small_systems_are_solved_alike(n: int) -> None:
    for seed in range(50):
        random = np.random.default_rng(seed)
        square = random.normal(size=(n, n))
        matrix, right = square @ square.T + 1e-3 * np.eye(n), random.normal(size=n)
        numbers, slope = packed(matrix, right), np.zeros(2 * n)
        assert solve_small(packed(matrix, right), n, np.inf, slope) == pytest.approx(factor(numbers, n), rel=1e-9)
        solve(numbers, n)
        np.testing.assert_allclose(slope[n:], numbers[-n:], rtol=1e-9)


@pytest.mark.parametrize(
    "matrix", [[[0.0]], [[-1.0]], [[1.0, 1.0], [1.0, 1.0]], [[1.0, 2.0], [2.0, 1.0]], [[0.0, 0.0], [0.0, 1.0]]]
)
def test_small_singular_matrices_are_found(matrix: list[list[float]]) -> None:
    square = np.array(matrix)
    assert solve_small(packed(square, np.ones(len(square))), len(square), np.inf, np.zeros(4)) <= SMALLEST_PIVOT


@pytest.mark.parametrize("numbers", [[np.nan, 1.0], [1.0, np.nan, 1.0, 0.0, 0.0], [1.0, 0.0, np.nan, 0.0, 0.0]])
def test_nan_in_small_systems_is_told_from_singular(numbers: list[float]) -> None:
    assert np.isnan(solve_small(np.array(numbers), 1 if len(numbers) == 2 else 2, np.inf, np.zeros(4)))


def test_thorough_code_is_made_for_long_runs_only() -> None:
    """The model of a scene that nobody else has, so that it is new."""
    model = compile_model(oscillator("-k*x*0.987654321"))
    problem = replace(problem_of(oscillator("-k*x*0.987654321"), 10.0), model=replace(model))
    brief = simulate(problem, get_method("dop853"), tolerance=1e-9)
    assert not problem.model.is_thorough
    simulate(replace(problem, t_end=3000.0), get_method("bogacki-shampine-32"), tolerance=1e-9, with_error=False)
    assert problem.model.is_thorough
    again = simulate(problem, get_method("dop853"), tolerance=1e-9)
    np.testing.assert_array_equal(again.values, brief.values)
    assert again.cost.rhs_evaluations == brief.cost.rhs_evaluations


def test_thorough_code_is_made_when_many_short_runs_would_have_paid_for_it() -> None:
    problem = problem_of(oscillator(), 10.0)
    problem = replace(problem, model=replace(problem.model))
    first = simulate(problem, get_method("rk4"), step=1e-3, with_error=False)
    runs = 1
    while not problem.model.is_thorough and runs < 10:
        again = simulate(problem, get_method("rk4"), step=1e-3, with_error=False)
        np.testing.assert_array_equal(again.values, first.values)
        runs += 1
    assert runs == 4  # each of them 40,000 right-hand sides


def test_fixed_steps_are_known_to_be_many_beforehand() -> None:
    problem = problem_of(oscillator(), 10.0)
    problem = replace(problem, model=replace(problem.model))
    found = simulate(problem, get_method("rk4"), step=1e-4, with_error=False)
    assert problem.model.is_thorough
    assert (found.outcome.status, found.cost.steps) == ("ok", 100_000)


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "full"), PermissionError(), EOFError(), UnpicklingError()])
def test_a_kernel_that_cannot_be_kept_is_run_all_the_same(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    """The disk is full, or what it has is damaged: that costs a compilation, not the simulation."""

    def twice(x: float) -> float:
        return 2.0 * x

    compiled = kernel(twice)

    def fails(*_: object) -> None:
        raise error

    for name in ("save", "load"):
        monkeypatch.setattr(compiled.compiled._cache._cache_file, name, fails)
    assert compiled(2.5) == 5.0


@pytest.mark.parametrize("gone", ["class", "module"])
def test_kernels_kept_of_classes_that_are_no_more_are_compiled_anew(
    tmp_path: Path, gone: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An index names the classes of a kernel's arguments, which another version may call otherwise."""
    module = ModuleType("gone_module")
    module.Gone = type("Gone", (), {"__module__": "gone_module"})  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "gone_module", module)
    OwnFiles(str(tmp_path), "kernel", "old").save((module.Gone,), "code")  # type: ignore[attr-defined]
    if gone == "class":
        del module.Gone  # type: ignore[attr-defined]
    else:
        monkeypatch.delitem(sys.modules, "gone_module")
    files = OwnFiles(str(tmp_path), "kernel", "new")
    assert files.load("signature") is None
    files.save("signature", "new code")
    assert files.load("signature") == "new code"


def test_all_kernels_are_there_before_anything_moves(request: pytest.FixtureRequest) -> None:
    """One process has compiled them; else each worker and each service of a run would do so."""
    assert "kernels" in request.fixturenames
    assert are_compiled()
