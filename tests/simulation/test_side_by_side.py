"""Two computations at once."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest

from deltaq.simulation.side_by_side import side_by_side


def fails(error: Exception) -> Callable[[], int]:
    def computation() -> int:
        raise error

    return computation


def test_both_results_in_order() -> None:
    assert [side_by_side(lambda k=k: k, lambda k=k: -k) for k in range(200)] == [(k, -k) for k in range(200)]  # type: ignore[misc]


def test_they_run_at_the_same_time() -> None:
    """Each waits for the other: one after the other would never end."""
    meeting = threading.Barrier(2, timeout=30.0)
    assert sorted(side_by_side(meeting.wait, meeting.wait)) == [0, 1]


def refuses(*_: object) -> int:
    raise RuntimeError("can't start new thread")


@pytest.mark.parametrize("start", [pytest.param(lambda *_: 0, id="not yet begun"), pytest.param(refuses, id="none")])
def test_what_no_thread_computes_is_computed_here(start: Callable[..., int], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("_thread.start_new_thread", start)
    assert side_by_side(lambda: "first", threading.get_ident) == ("first", threading.get_ident())


@pytest.mark.parametrize(
    ("first", "second", "told"),
    [
        pytest.param(fails(ValueError("first")), lambda: 1, "first", id="the first"),
        pytest.param(lambda: 1, fails(ValueError("second")), "second", id="the second"),
        pytest.param(fails(ValueError("first")), fails(ValueError("second")), "first", id="both"),
    ],
)
def test_what_one_raises_is_raised(first: Callable[[], int], second: Callable[[], int], told: str) -> None:
    with pytest.raises(ValueError, match=f"^{told}$"):
        side_by_side(first, second)
