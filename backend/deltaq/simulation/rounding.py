"""Numbers as short as their error allows."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .problem import Floats

GUARD_DIGITS = 3  # below the first digit in doubt
MOST_DIGITS = 15  # decimals; of numbers that are all small, behind the leading zeros of the largest
GUARD_BITS, SMALLEST_ERROR = 8, 1e-15  # the same for numbers that are rounded by bits
EXACT = 22  # powers of ten up to this one are doubles
TENS = np.array([10.0**count for count in range(EXACT + 1)])
WHOLE = 2.0**52  # from here on doubles are whole numbers, and without decimals


def rounded(values: Floats, errors: Floats) -> Floats:
    """Values, each rounded to a few digits beyond its error; those without an error as they are.

    `values` has shape (samples, …), `errors` shape (samples,); returns the shape of `values`.
    """
    return _to_decimals(values, _decimals(errors, MOST_DIGITS + _zeros(values)))


def rounded_alone(values: Floats, errors: Floats) -> Floats:
    """The same of numbers of which none is measured by the others: shape (numbers,) each."""
    most = np.array([MOST_DIGITS + _zeros_of(size) for size in np.abs(values).tolist()])
    return _to_decimals(values, _decimals(errors, most))


def _to_decimals(values: Floats, decimals: Floats) -> Floats:
    """Each value of shape (samples, …) with so many decimals, shape (samples,); what has none of them as it is."""
    counts = decimals.reshape(-1, *(1,) * (values.ndim - 1))
    is_exact = counts <= EXACT
    scales = TENS[np.where(is_exact, counts, 0.0).astype(np.intp)]
    with np.errstate(over="ignore", invalid="ignore"):
        found = np.rint(values * scales) / scales
    has_decimals = is_exact & (np.abs(values) < WHOLE)
    return np.where(has_decimals, found, values) + 0.0  # no negative zero


def rounded_to_bits(values: Floats, errors: Floats) -> Floats:
    """The same by bits: multiples of a power of two a few digits below the error, whose last bytes are zero.

    `values` has shape (samples, …), `errors` shape (samples,); returns the shape of `values`.
    """
    _, exponents = np.frexp(np.maximum(np.abs(errors), SMALLEST_ERROR * 10.0 ** -_zeros(values)))
    units = np.ldexp(1.0, exponents - GUARD_BITS).reshape(-1, *(1,) * (values.ndim - 1))
    with np.errstate(over="ignore"):
        return _in_range(np.round(values / units) * units, values) + 0.0


def short(value: float, digits: int = 3) -> float:
    """So many digits of a number for people; of one so large that rounding it up gives none, all."""
    found = float(f"{value:.{digits}g}")
    return found if math.isfinite(found) else float(value)


def _in_range(found: Floats, values: Floats) -> Floats:
    """What was found by rounding, or the values as they are where rounding has left the range of doubles."""
    return np.where(np.isfinite(found), found, values)


def _decimals(errors: Floats, most: int | NDArray[np.int64]) -> Floats:
    with np.errstate(divide="ignore"):
        places = np.ceil(-np.log10(np.abs(errors))) + GUARD_DIGITS
    return np.asarray(np.clip(places, 0, most))


def _zeros(values: Floats) -> int:
    """How many zeros stand behind the decimal point of the largest: 2 for 0.004, 0 from 0.1 on and for zero."""
    return _zeros_of(float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values))))


def _zeros_of(size: float) -> int:
    """The same of one size; none of an infinite one."""
    return max(0, -math.floor(math.log10(size)) - 1) if 0.0 < size < math.inf else 0


def significant(values: Floats, digits: int) -> Floats:
    """So many significant digits of each value, shape (count,); zero as it is.

    Where a power of ten is no exact double, all digits stay.
    """
    sizes = np.abs(values)
    leading = np.floor(np.log10(sizes, out=np.zeros(len(sizes)), where=sizes > 0.0))
    decimals = digits - 1 - leading.astype(np.int64)
    scales = TENS[np.minimum(np.abs(decimals), EXACT)]
    with np.errstate(over="ignore"):
        found = np.where(decimals < 0, np.rint(values / scales) * scales, np.rint(values * scales) / scales)
    return np.where(np.abs(decimals) <= EXACT, _in_range(found, values), values)
