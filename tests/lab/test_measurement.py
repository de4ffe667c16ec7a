"""How often a run is repeated."""

from __future__ import annotations

import pytest

from deltaq.lab.measurement import repeated


@pytest.mark.parametrize(
    ("first", "later", "repeats", "seconds"),
    [
        pytest.param(0.004, (0.001,) * 7, 7, (0.001,) * 7, id="short: many, the first left out"),
        pytest.param(0.05, (0.04, 0.06), 7, (0.05, 0.04, 0.06), id="longer: three"),
        pytest.param(2.0, (2.1,), 7, (2.0, 2.1), id="slow twice: enough"),
        pytest.param(34.0, (0.0002, 0.0003), 7, (34.0, 0.0002, 0.0003), id="slow once: it was interrupted"),
        pytest.param(0.004, (), 1, (0.004,), id="once"),
        pytest.param(0.5, (0.001,), 1, (0.5, 0.001), id="once, but interrupted"),
    ],
)
def test_a_run_is_repeated(first: float, later: tuple[float, ...], repeats: int, seconds: tuple[float, ...]) -> None:
    remaining = iter(later)
    assert repeated(lambda: next(remaining), first, repeats) == seconds
    assert list(remaining) == []
