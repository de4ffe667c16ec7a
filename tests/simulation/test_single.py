"""What one motion does besides finding its coefficients, against fifty digits: states of all widths, any neighbours."""

from __future__ import annotations

import ctypes

import mpmath as mp
import numpy as np
import pytest

from deltaq.simulation.kernels import taylor as t
from deltaq.simulation.series.single import single, told_of

ORDERS, WIDTHS = (4, 15, 38), (1, 3, 4, 5, 8, 13)
THETA, UNIT, TOLERANCE = 0.7, 0.125, 1e-13


def some(order: int, width: int, behind: float) -> t.Series:
    """A series of random coefficients that fall with their order; behind each row stand two numbers more."""
    random = np.random.default_rng(100 * order + width)
    judged = width - 1 if width % 2 and width > 1 else width
    addresses = t.Addresses(0, single().addresses["advance"], single().addresses["measure"])
    series = t.make_series(addresses, (order,), width, 0, (judged, 2, width + 2, 0))
    t.begin_series(series, told_of(order, TOLERANCE), random.normal(scale=2.0, size=width), np.zeros(0))
    falling = 0.6 ** np.arange(order + 1)[:, None]
    for row in (0, 1):
        series.coefficients[row, :, :width] = falling * random.normal(size=(order + 1, width))
    series.coefficients[:, :, width:] = behind
    series.states[:, width:] = behind
    series.states[t.OLD_REST, :width] = 1e-17 * random.normal(size=width)
    series.told[[t.THETA, t.GONE, t.UNIT]] = THETA, 0.5 * THETA, UNIT
    return series


def called(address: int, series: t.Series, row: int) -> None:
    """A function of the code, with the coefficients of a row."""
    arrays = (series.coefficients[row], series.states, series.told, series.plan)
    ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)(address)(*(array.ctypes.data for array in arrays))


@pytest.mark.parametrize("behind", [0.0, np.nan])
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("order", ORDERS)
def test_a_step_is_the_sum_of_its_series(order: int, width: int, behind: float) -> None:
    """The new state with its rest has more digits than a number; h ẋ has as many as one; what stands behind is nothing.

    The rounding of Horner's rule is some units in the last place of the largest term.
    """
    series = some(order, width, behind)
    called(series.code.step, series, 0)
    with mp.workdps(50):
        for d in range(width):
            row = [mp.mpf(c) for c in series.coefficients[0, :, d]]
            size = mp.mpf(2.0**-52) * sum(k * abs(c) * mp.mpf(THETA) ** k for k, c in enumerate(row))
            grows = sum(c * mp.mpf(THETA) ** k for k, c in enumerate(row) if k)
            rises = sum(k * c * mp.mpf(THETA) ** k for k, c in enumerate(row))
            old, rest = (mp.mpf(series.states[place, d]) for place in (t.OLD, t.OLD_REST))
            new, left = (mp.mpf(series.states[place, d]) for place in (t.NEW, t.NEW_REST))
            assert abs(new + left - (old + rest + grows)) <= size + mp.mpf(2.0) ** -100
            assert new == mp.mpf(float(new + left))  # the rest is below rounding
            assert abs(mp.mpf(series.states[t.SLOPES, d]) - rises) <= 2 * size
    assert series.told[t.FITS] == 1.0


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("value", [np.nan, np.inf, -1e301])
def test_each_component_may_be_what_does_not_fit(width: int, value: float) -> None:
    """Places and rates fit up to a bound; the work behind them, where there is an odd one, whatever number it is."""
    for d in range(width):
        series = some(6, width, 0.0)
        series.states[t.OLD, d] = value
        called(series.code.step, series, 0)
        is_work = width % 2 == 1 and d == width - 1 > 0
        assert series.told[t.FITS] == float(is_work and np.isfinite(value))


@pytest.mark.parametrize("behind", [0.0, np.nan])
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("order", ORDERS)
def test_a_step_is_judged_and_the_next_one_chosen(order: int, width: int, behind: float) -> None:
    """By the laws of Jorba and Zou (§3.2), in fifty digits; of 2n + 1 components the last, ∫P dt, has no say."""
    series = some(order, width, behind)
    judged = int(series.plan[t.JUDGED])
    called(series.code.step, series, 0)
    if judged < width:
        series.coefficients[1, :, judged] = 1e30
    called(series.code.measure, series, 1)
    with mp.workdps(50):
        c = [[mp.mpf(each) for each in row[:judged]] for row in series.coefficients[1]]
        scale = [max(mp.mpf(1), abs(mp.mpf(each))) for each in series.states[t.NEW, :judged]]
        slopes = [mp.mpf(each) for each in series.states[t.SLOPES, :judged]]
        apart = [abs(s - mp.mpf(0.5 * THETA) * one) / w for s, one, w in zip(slopes, c[1], scale, strict=True)]
        last, before = (max(abs(a) / w for a, w in zip(c[k], scale, strict=True)) for k in (order, order - 1))
        radius = min(each ** (-1 / mp.mpf(k)) for each, k in ((last, order), (before, order - 1)))
        wanted = UNIT * radius * (mp.mpf(TOLERANCE) * mp.exp(mp.mpf(-7) / 10)) ** (1 / mp.mpf(order - 1))
        size = sum(abs(one) + abs(p) for one, p in zip(c[1], c[order], strict=True))
    for place, true, error in ((t.DEFECT, max(apart), 1e-15), (t.WANTED, wanted, 1e-10), (t.SIZE, size, 1e-15)):
        assert series.told[place] == pytest.approx(float(true), rel=8 * error)


def test_a_series_that_ends_wants_a_long_step() -> None:
    series = some(15, 4, 0.0)
    series.coefficients[1, 2:] = 0.0
    called(series.code.measure, series, 1)
    assert 1e12 < series.told[t.WANTED] < np.inf
