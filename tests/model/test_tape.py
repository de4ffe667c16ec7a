"""Tapes of operations: the same values as machine code, whatever the expression."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
import symengine as se

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.model.functions import FUNCTIONS, Expr
from deltaq.model.model import compile_model
from deltaq.model.tape import CHOICE, INPUT, Tape, tape_of
from deltaq.simulation.kernels.intervals import Ranges, TapeArrays, propagate_bounds
from deltaq.simulation.service import problem_of

X, Y = se.symbols("x y")


def ranges_of(tape: Tape, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bounds of the outputs for inputs between low and high."""
    size = tape.codes.size
    arrays = TapeArrays(tape.codes, tape.a, tape.b, tape.c, tape.constants, tape.outputs)
    ranges = Ranges(low, high, np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(tape.outputs.size))
    propagate_bounds(arrays, ranges)
    return ranges.low[tape.outputs], ranges.high[tape.outputs]


@pytest.mark.parametrize("name", scene_ids())
def test_a_tape_computes_what_the_machine_code_does(name: str) -> None:
    problem = problem_of(load_scene(name), 1.0)
    n, model = problem.degrees, compile_model(load_scene(name))
    row = problem.inputs(np.array([0.3]), problem.state[None, :] + 0.05)[0]
    low, high = ranges_of(model.tape, row, row)
    count = n * (n + 1) // 2 + n
    expected = model.motion.table(row[None, :])[0][:count]
    np.testing.assert_allclose(low[:count], expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())
    np.testing.assert_allclose(high[:count], expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_bounds_hold_every_value_inside(name: str) -> None:
    """Random boxes, random points in them, against SymEngine's own evaluation."""
    source = Random(name)
    function = FUNCTIONS[name]
    expression = function(X, Y) if name in {"atan2", "max", "min"} else function(X) * Y + function(X) ** 2
    value = se.Lambdify([X, Y], [expression], backend="llvm")
    tape = tape_of([X, Y], [expression])
    start = 1.0 if name == "acosh" else -0.99 if name in {"asin", "acos", "atanh"} else 1e-3
    reach = 4.0 if start > 0.0 else 0.9
    for _ in range(200):
        low = np.array([start + source.uniform(0.0, reach), source.uniform(-2.0, 2.0)])
        high = low + np.array([source.uniform(0.0, 1.0), source.uniform(0.0, 1.0)])
        high[0] = min(high[0], 0.99) if start < 0.0 else high[0]
        below, above = ranges_of(tape, low, high)
        places = [[source.uniform(a, b) for a, b in zip(low, high, strict=True)] for _ in range(20)]
        found = np.array([value(place)[0] for place in places])
        grain = 1e-12 * (1.0 + np.abs(found))
        assert (found >= below - grain).all()
        assert (found <= above + grain).all()


@pytest.mark.parametrize(
    ("expression", "low", "high", "expected"),
    [
        pytest.param(se.sin(X), 1.0, 2.0, (np.sin(1.0), 1.0), id="a crest inside"),
        pytest.param(se.sin(X), 0.0, 7.0, (-1.0, 1.0), id="more than a period"),
        pytest.param(X**2, -1.0, 2.0, (0.0, 4.0), id="an even power"),
        pytest.param(X**3, -1.0, 2.0, (-1.0, 8.0), id="an odd power"),
        pytest.param(1 / X, -1.0, 2.0, (-np.inf, np.inf), id="a pole inside"),
        pytest.param(FUNCTIONS["sign"](X), 0.5, 2.0, (1.0, 1.0), id="a decided choice"),
        pytest.param(FUNCTIONS["sign"](X), -0.5, 2.0, (-1.0, 1.0), id="an undecided choice"),
        pytest.param(FUNCTIONS["abs"](X), -0.5, 2.0, (-2.0, 2.0), id="both branches of a choice"),
        pytest.param(se.tan(X), 1.0, 2.0, (-np.inf, np.inf), id="a pole of the tangent"),
    ],
)
def test_bounds_are_tight(expression: Expr, low: float, high: float, expected: tuple[float, float]) -> None:
    below, above = ranges_of(tape_of([X], [expression]), np.array([low]), np.array([high]))
    assert (below[0], above[0]) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("outputs", "is_used"),
    [
        pytest.param([X, se.sin(X) + 1], False, id="not at all"),
        pytest.param([Y], True, id="as it is"),
        pytest.param([X + 2 * Y], True, id="in a sum"),
        pytest.param([se.sin(Y)], True, id="in a function"),
        pytest.param([X, FUNCTIONS["sign"](Y)], True, id="in a condition"),
        pytest.param([se.Piecewise((X, X > 0), (Y, True))], True, id="in the other case"),
        pytest.param([X + Y - Y], False, id="where it cancels"),
    ],
)
def test_a_tape_knows_which_inputs_matter(outputs: list[Expr], is_used: bool) -> None:
    assert tape_of([X, Y], outputs).uses(1) == is_used


def test_equal_parts_stand_once() -> None:
    tape = tape_of([X, Y], [se.sin(X + Y), se.sin(X + Y) * se.cos(X + Y)])
    assert len(tape.codes) == 2 + 4  # the inputs; the sum, its sine and cosine, their product


def test_a_sign_hangs_on_one_number() -> None:
    """x > 0 and x < 0 are decided by the same place, so that a change of sign is one event."""
    tape = tape_of([X], [FUNCTIONS["sign"](X)])
    assert {int(tape.a[tape.a[i]]) for i in np.flatnonzero(tape.codes == CHOICE)} == {0}
    assert tape.codes[0] == INPUT
