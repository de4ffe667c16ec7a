"""Numbers as short as their error allows."""

from __future__ import annotations

import numpy as np

from .problem import Floats

GUARD_DIGITS = 3  # below the first digit in doubt
MOST_DIGITS = 15


def rounded(values: Floats, errors: Floats) -> Floats:
    """Values, first axis as `errors`, each rounded to a few digits beyond its error; without error as they are."""
    decimals = _decimals(errors)
    result = np.array(values, dtype=np.float64)
    for count in np.unique(decimals):
        chosen = decimals == count
        result[chosen] = np.round(result[chosen], int(count))
    return result + 0.0  # no negative zero


def _decimals(errors: Floats) -> Floats:
    with np.errstate(divide="ignore"):
        places = np.ceil(-np.log10(np.abs(errors))) + GUARD_DIGITS
    return np.asarray(np.clip(places, 0, MOST_DIGITS))


def short(values: Floats) -> list[float]:
    """Three digits of each, for estimates."""
    return [float(f"{value:.3g}") for value in values]
