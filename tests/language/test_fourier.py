"""Forms that would become too large are not made, whichever way they grow."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from deltaq.language import fourier
from deltaq.language.fourier import Form, TooLargeError


def powers(name: str, count: int) -> Form:
    """1 + name + name² + …"""
    return fourier.add(fourier.monomial(name, exponent) for exponent in range(count))


@pytest.mark.parametrize(
    "grow",
    [
        pytest.param(lambda: fourier.add([powers("x", 1000), powers("y", 1000)]), id="terms of a sum"),
        pytest.param(lambda: fourier.multiply(powers("x", 300), powers("x", 300)), id="work of a product"),
        pytest.param(lambda: fourier.multiply(powers("x", 40), powers("y", 40)), id="terms of a product"),
    ],
)
def test_too_large(grow: Callable[[], Form]) -> None:
    with pytest.raises(TooLargeError):
        grow()


def test_large_ones_are_made() -> None:
    product = fourier.multiply(powers("x", 30), powers("y", 40))
    assert len(product) == 1200
    assert set(product.values()) == {1}
