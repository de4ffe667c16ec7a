"""How long a formula is on paper, counted by hand: signs in front and dots cost nothing, a fraction is one number."""

from __future__ import annotations

import pytest
from tests.language.scene_names import NAMES, read

from deltaq.language.kernel_reader import KernelReader
from deltaq.language.operations import operations
from deltaq.language.order import Order
from deltaq.language.textbook import Textbook

COUNTED = [
    ("m", 0), ("-m", 0), ("3/2", 0), ("dot(phi)", 0), ("m*l", 1), ("m - l", 1), ("-m - l", 1), ("2.5*m", 1),
    ("3*m/2", 1), ("m*x^2/2", 3), ("-m*g*l*cos(phi)", 4), ("m*delta(phi)", 1),
    ("1/m", 1), ("2/m", 1), ("-1/m", 1), ("x/m", 1), ("x/(m*l)", 2), ("1/(m*l)", 2), ("x/2 + y/3", 3),
    ("x^2", 1), ("1/x^2", 2), ("sqrt(x)", 1), ("1/sqrt(x)", 2), ("x^(3/2)", 1),
    ("sin(phi)", 1), ("sin(phi)^2", 2), ("sin(2*phi)", 2), ("exp(-c*t)", 2), ("atan2(y, x)", 1), ("abs(x)/2", 2),
    ("m*(x + y)", 2), ("k*(x - y)^2/2", 4), ("1/(x + y)", 2), ("m/(x + y)^2", 3), ("1/2/(x + y)", 3),
]  # fmt: skip


@pytest.mark.parametrize(("text", "count"), COUNTED, ids=[text for text, _ in COUNTED])
def test_counted(text: str, count: int) -> None:
    assert operations(read(text)) == count


PRICED = ["m", "3*m/2", "m*x^2/2", "-m*g*l*cos(phi)", "m*delta(phi)", "1/m", "2/m", "-1/m", "x/m", "x/(m*l)", "1/(m*l)",
          "m/(l*x)", "1/x^2", "sqrt(x)", "1/sqrt(x)", "sin(phi)^2", "sin(2*phi)", "dot(x)^2/2", "log(m)/2"]  # fmt: skip


@pytest.mark.parametrize("text", PRICED)
def test_the_price_of_a_term_is_the_number_of_its_operations(text: str) -> None:
    reader = KernelReader()
    (term,) = Textbook(reader, Order(NAMES), frozenset()).summands(reader.read(read(text)), apart=False).terms
    assert term.plan.price == operations(read(text))
