"""Numbers as short as their error allows."""

from __future__ import annotations

import numpy as np

from .problem import Floats

GUARD_DIGITS = 3  # below the first digit in doubt
MOST_DIGITS = 15
EXACT = 22  # powers of ten up to this one are doubles


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


def significant(values: Floats, digits: int) -> Floats:
    """So many digits of each value; zero as it is, and as many as there are where a power of ten is not exact."""
    sizes = np.abs(values)
    leading = np.floor(np.log10(sizes, out=np.zeros(len(sizes)), where=sizes > 0.0))
    found = np.array(values, dtype=np.float64)
    for place in np.unique(leading):
        chosen, decimals = leading == place, digits - 1 - int(place)
        found[chosen] = np.round(found[chosen], decimals) if decimals <= EXACT else found[chosen]
    return found
