"""Forms that would become too large are not made, whichever way they grow."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from deltaq.language import fourier
from deltaq.language.fourier import Form, TooLargeError
from deltaq.language.generators import Generators


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


@pytest.mark.parametrize(
    ("grow", "most"),
    [
        pytest.param(lambda n: fourier.add([powers("x", n)]), fourier.MAX_TERMS, id="terms of a sum"),
        pytest.param(lambda n: fourier.multiply(powers("x", n), powers("x", 1)), fourier.MAX_TERMS, id="of a product"),
        pytest.param(lambda n: fourier.multiply(powers("x", n), powers("x", 240)), 250, id="work of a product"),
        pytest.param(lambda n: Generators().multiply(powers("x", n), powers("x", 240)), 250, id="work altogether"),
    ],
)
def test_the_largest_that_are_made(grow: Callable[[int], Form], most: int) -> None:
    assert len(grow(most)) >= most
    with pytest.raises(TooLargeError):
        grow(most + 1)


def test_all_products_of_one_reader_count_together() -> None:
    reader = Generators()
    for _ in range(6):
        reader.multiply(powers("x", 100), powers("x", 100))
    with pytest.raises(TooLargeError):
        reader.multiply(powers("x", 1), powers("x", 1))
    reader.begin()
    reader.multiply(powers("x", 240), powers("x", 250))
    with pytest.raises(TooLargeError):
        reader.multiply(powers("x", 1), powers("x", 1))


def test_products_count_four_times_where_roots_may_be_in_them() -> None:
    reader = Generators()
    reader.root(2, fourier.HALF)
    reader.multiply(powers("x", 125), powers("x", 120))
    with pytest.raises(TooLargeError):
        reader.multiply(powers("x", 1), powers("x", 1))


def test_large_ones_are_made() -> None:
    product = fourier.multiply(powers("x", 30), powers("y", 40))
    assert len(product) == 1200
    assert set(product.values()) == {1}
