"""Densities: which integrals exist."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from deltaq.mechanics.integrability import is_integrable


def inverse(x: float) -> float:
    return 1 / x if x else math.nan


CASES = [
    pytest.param(lambda s: 1.0, True, id="constant"),
    pytest.param(lambda s: 0.0, True, id="zero"),
    pytest.param(lambda s: s**3, True, id="polynomial"),
    pytest.param(lambda s: math.exp(5 * s * s), True, id="steep"),
    pytest.param(lambda s: math.sin(40 * s), True, id="wave"),
    pytest.param(lambda s: 1 / math.sqrt(s), True, id="inverse root at the end"),
    pytest.param(lambda s: -math.log(s), True, id="logarithm at the end"),
    pytest.param(lambda s: abs(s - 0.3) ** -0.5, True, id="inverse root inside"),
    pytest.param(inverse, False, id="pole at the end"),
    pytest.param(lambda s: inverse(1 - s) ** 2, False, id="double pole at the other end"),
    pytest.param(lambda s: inverse(s - 1 / 3) ** 2, False, id="double pole inside"),
    pytest.param(lambda s: inverse(s - 0.7123), False, id="simple pole inside"),
    pytest.param(lambda s: math.nan if s > 0.5 else 1.0, False, id="undefined on one half"),
]


@pytest.mark.parametrize(("function", "exists"), CASES)
def test_integrable(function: Callable[[float], float], exists: bool) -> None:
    assert is_integrable(function, 0.0, 1.0) is exists
