"""Traces name kinds and lines of code, never what an exception says."""

from __future__ import annotations

import pytest

from deltaq.api.workers.traces import LONGEST, LONGEST_CHAIN, trace_of


def chained(length: int) -> Exception:
    error = ValueError("secret 0")
    for number in range(1, length):
        try:
            raise ValueError(f"secret {number}") from error
        except ValueError as caught:
            error = caught
    return error


def in_context(*, suppressed: bool) -> Exception:
    try:
        try:
            raise KeyError("secret")
        except KeyError:
            if suppressed:
                raise ValueError("secret") from None
            raise ValueError("secret")  # noqa: B904  its context is what is looked at
    except ValueError as error:
        return error


@pytest.mark.parametrize(
    ("error", "kinds"),
    [
        pytest.param(ValueError("secret"), ["ValueError"], id="alone"),
        pytest.param(chained(3), ["ValueError"] * 3, id="with its causes"),
        pytest.param(chained(50), ["ValueError"] * LONGEST_CHAIN, id="with many causes"),
        pytest.param(in_context(suppressed=False), ["KeyError", "ValueError"], id="while another was handled"),
        pytest.param(in_context(suppressed=True), ["ValueError"], id="instead of another"),
    ],
)
def test_trace(error: Exception, kinds: list[str]) -> None:
    trace = trace_of(error)
    assert [part.splitlines()[-1] for part in trace.split("\n\n")] == kinds
    assert all('"secret' not in line or "raise" in line for line in trace.splitlines())


def test_trace_is_bounded() -> None:
    def one(levels: int) -> None:
        other(levels - 1) if levels else int("secret")

    def other(levels: int) -> None:  # a line that comes again and again would not be repeated
        one(levels)

    with pytest.raises(ValueError, match="secret") as caught:
        one(300)
    trace = trace_of(caught.value)
    assert len(trace) == LONGEST
    assert trace.endswith("ValueError")
