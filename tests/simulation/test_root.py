"""Where a watched value falls through zero within a step, against roots in closed form."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import symengine as se
from tests.simulation.called import called

from deltaq.model.compiled import Compiled, compile_expressions
from deltaq.simulation.kernels.root import NONE, UNSEEN, find_fall, find_root
from deltaq.simulation.kernels.switch import make_switch
from deltaq.simulation.kernels.watch import NODES, NODES_OF_SERIES, Watch, make_watch

X, V, T = se.symbols("x v t")
START, SIZE = 3.0, 0.25
NEAR = 2.0**-50  # of the step
FIND_ROOT = called(find_root)
Motion = Callable[[float], float]  # x by the part of the step that is over
# The values watched, the motion, the part of the step at which the last of them falls, and what rounding leaves of it.
ROOTS = [
    pytest.param([X], lambda s: 0.3 - s, 0.3, 4e-15, id="straight"),
    pytest.param([X], lambda s: 1e9 * (0.7 - s), 0.7, 4e-15, id="steep"),
    pytest.param([X], lambda s: 1e-9 * (0.7 - s), 0.7, 4e-15, id="hardly falls"),
    pytest.param([X], lambda s: 0.3 - s * s, math.sqrt(0.3), 4e-15, id="bent"),
    pytest.param([X], lambda s: (0.6 - s) ** 3, 0.6, 2e-5, id="flat where it falls"),
    pytest.param([X], lambda s: 2.0 - s**7 - s, 1.0, 4e-15, id="at the end of the step"),
    pytest.param(
        [X**2 - 4.0], lambda s: 1.0 + 3.0 * (1.0 - s) ** 2, 1.0 - math.sqrt(1.0 / 3.0), 4e-15, id="a parabola"
    ),
    pytest.param([0.4 - V], lambda _: 1.0, 0.4, 4e-15, id="by a rate"),
    pytest.param([START + SIZE / 3.0 - T], lambda _: 1.0, 1.0 / 3.0, 4e-15, id="by the time alone"),
    pytest.param([se.cos(X)], lambda s: 2.0 * s, math.pi / 4.0, 4e-15, id="no polynomial"),
    pytest.param([X + 1.0, X], lambda s: 0.3 - s, 0.3, 4e-15, id="the second of two"),
]


def watched(values: list[se.Expr], motion: Motion, count: int) -> tuple[Watch, Compiled]:
    """What a kernel leaves of a step from START on, in which x moves so and v is the part of the step; and the code."""
    function, switch = compile_expressions([X, V, T], values), make_switch((0, 0), 0, np.zeros(1), 0)
    flag = np.zeros(1, dtype=np.int64)
    watch = make_watch(flag, function.addresses, len(values), np.zeros(3), 2, switch, count)
    watch.times[:] = START + SIZE * watch.nodes
    watch.states[:] = [[motion(part), part] for part in watch.nodes.tolist()]
    watch.values[:] = function.table(np.column_stack([watch.states, watch.times]))
    return watch, function


@pytest.mark.parametrize("count", [NODES, NODES_OF_SERIES])
@pytest.mark.parametrize(("values", "motion", "root", "doubt"), ROOTS)
def test_a_value_falls_where_it_does(
    values: list[se.Expr], motion: Motion, root: float, doubt: float, count: int
) -> None:
    watch, function = watched(values, motion, count)
    place, index = int(np.argmax((watch.values <= 0.0).any(axis=1))), len(values) - 1
    state = np.empty(2)
    x = FIND_ROOT(watch, 1, index, place, NEAR, state, np.empty(len(values)))
    assert x == pytest.approx(root, abs=doubt)
    np.testing.assert_allclose(state, [motion(x), x], rtol=1e-13, atol=1e-15 * max(1.0, abs(motion(0.0))))
    places = np.array([x, x - doubt])
    rows = np.column_stack([[state[0], motion(places[1])], places, START + SIZE * places])
    here, before = function.table(rows)[:, index]
    assert here <= 0.0 < before


# The values watched, the motion, whether one came below zero before, which falls first, and at what part of the step.
FALLS = [
    pytest.param([X], lambda s: 0.3 - s, False, 0, 0.3, id="the only one"),
    pytest.param([X, X - 0.1], lambda s: 0.3 - s, False, 1, 0.2, id="the second, before the first"),
    pytest.param([X - 0.001, X], lambda s: 0.3 - s, False, 0, 0.299, id="between the same places as the second"),
    pytest.param([X, X], lambda s: 0.3 - s, False, 0, 0.3, id="both at once"),
    pytest.param([X, X - 0.5], lambda s: 1.1 - s, False, 1, 0.6, id="one that does not fall beside it"),
    pytest.param([X], lambda s: 1.1 - s, False, NONE, 0.0, id="none"),
    pytest.param([X], lambda s: 1.1 - s, True, UNSEEN, 0.0, id="one before, which has come back"),
    pytest.param([X - 1.0, X], lambda s: 1.0 - s, False, UNSEEN, 0.0, id="at the start of the step"),
]


@pytest.mark.parametrize("count", [NODES, NODES_OF_SERIES])
@pytest.mark.parametrize(("values", "motion", "was_below", "first", "root"), FALLS)
def test_the_first_of_several_values_that_fall_is_found(
    values: list[se.Expr], motion: Motion, was_below: bool, first: int, root: float, count: int
) -> None:
    watch, _ = watched(values, motion, count)
    watch.least[:] = np.where(was_below, -1.0, watch.values.min(axis=0))
    state = np.empty(2)
    index, x = find_fall(watch, 1, state, np.empty(2), np.empty(len(values)))
    assert index == first
    assert x == pytest.approx(root, abs=4e-15) or first < 0
    np.testing.assert_allclose(state[: 2 if first >= 0 else 0], [motion(x), x][: 2 if first >= 0 else 0], atol=1e-15)
