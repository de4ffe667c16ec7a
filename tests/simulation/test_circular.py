"""Sine and cosine of many numbers at once: within a unit in the last place of mpmath's, the same in all lanes."""

from __future__ import annotations

import ctypes
import math

import mpmath as mp
import numpy as np
import pytest

from deltaq.simulation.series.circular import LARGEST, sine_and_cosine
from deltaq.simulation.series.code import Code, compiled

Floats = np.ndarray


def circular(numbers: Floats, lanes: int) -> Floats:
    """Sine and cosine of numbers, shape (2, numbers), by code for so many at once."""
    code = Code(lanes)
    code.label("entry")
    for place, value in enumerate(sine_and_cosine(code, code.load("%given", 0))):
        code.store(value, "%out", place)
    code.do("ret void")
    machine = compiled({"circular_of": code})
    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)(machine.address)
    given = np.ascontiguousarray(numbers.reshape(-1, lanes))
    out = np.zeros((len(given), 2, lanes))
    for row, told in zip(given, out, strict=True):
        function(told.ctypes.data, row.ctypes.data, None, None)
    return out.transpose(1, 0, 2).reshape(2, -1)


def hostile() -> Floats:
    """Numbers of all sizes, and next to where sine or cosine vanish or the reduction takes the other quarter."""
    random = np.random.default_rng(7)
    turns = np.concatenate([np.arange(1.0, 500.0), np.floor(LARGEST * random.random(500) ** 3)])
    zeros, halves = turns * (math.pi / 2), (turns + 0.5) * (math.pi / 2)
    with mp.workprec(200):
        exact = np.array([float(int(n) * mp.pi / 2) for n in turns])
    sizes = random.uniform(-1.0, 1.0, 2000) * 2.0 ** random.integers(-1070, 29, 2000)
    places = [random.uniform(-10.0, 10.0, 2000), sizes, zeros, halves]
    places += [exact, np.nextafter(exact, 0.0), np.nextafter(exact, np.inf), -exact, [0.0, -0.0, 1e-300, LARGEST]]
    found = np.concatenate(places)
    return found[: len(found) // 8 * 8]


def test_hostile_numbers_are_right_to_a_unit_in_the_last_place() -> None:
    numbers = hostile()
    found = circular(numbers, 8)
    np.testing.assert_array_equal(circular(numbers, 1), found)
    with mp.workprec(400):
        for function, values in zip((mp.sin, mp.cos), found, strict=True):
            true = [function(mp.mpf(float(x))) for x in numbers]
            units = np.spacing(np.abs(np.array([float(t) for t in true])))
            errors = [abs(mp.mpf(float(v)) - t) / mp.mpf(float(u)) for v, t, u in zip(values, true, units, strict=True)]
            assert max(errors) < 0.8


def test_numbers_far_out_do_not_touch_their_neighbours() -> None:
    numbers = np.array([1e300, 0.5, -1e22, 2.0 * LARGEST, math.inf, math.nan, -0.7, 3.0])
    found = circular(numbers, 8)
    with np.errstate(invalid="ignore"):
        np.testing.assert_allclose(found, [np.sin(numbers), np.cos(numbers)], rtol=2e-16)
    near = np.array([0.5, -0.7, 3.0] + [1.0] * 5)
    np.testing.assert_array_equal(found[:, [1, 6, 7]], circular(near, 8)[:, :3])


@pytest.mark.parametrize("lanes", [2, 4, 16])
def test_any_number_of_lanes_gives_the_same_digits(lanes: int) -> None:
    numbers = np.linspace(-30.0, 30.0, 64)
    np.testing.assert_array_equal(circular(numbers, lanes), circular(numbers, 8))
