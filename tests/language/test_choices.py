"""Where usage is divided: which readings there are, in which order, and which were typed too loosely to be meant."""

from __future__ import annotations

import pytest
from tests.language.scene_names import NAMES, read

from deltaq.language.choices import Choices
from deltaq.language.parser import parse
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy

# Text, its readings in full with the conventional one first, and the number from which on they are loose.
READINGS = [
    ("1/2 m", ["(1/2)*m"], 0),
    ("1/2m", ["(1/2)*m", "1/(2*m)"], 2),
    ("1/2ml", ["(1/2)*m*l", "1/(2*m*l)"], 2),
    ("1/2m l", ["(1/2)*m*l", "l/(2*m)"], 2),
    ("g/l m", ["(g/l)*m", "g/(l*m)"], 1),
    ("g/l m k", ["(g/l)*m*k", "g/(l*m*k)"], 1),
    ("g/lm", ["(g/l)*m", "g/(l*m)"], 2),
    ("g/lm k", ["(g/l)*m*k", "g*k/(l*m)", "g/(l*m*k)"], 2),
    ("g/l x' m", ["(g/l)*dot(x)*m"], 0),
    ("g/l x'^2 m", ["(g/l)*dot(x)^2*m"], 0),
    ("g/lm x' k", ["(g/l)*m*dot(x)*k", "g*dot(x)*k/(l*m)"], 2),
    ("g/l(m+k)", ["(g/l)*(m+k)", "g/(l*(m+k))"], 2),
    ("g/l (m+k)", ["(g/l)*(m+k)"], 0),
    ("g/l m(k+1)", ["(g/l)*m*(k+1)", "g/(l*m*(k+1))"], 1),
    ("g/l sin(phi)", ["(g/l)*sin(phi)"], 0),
    ("g/lm sin(phi)", ["(g/l)*m*sin(phi)", "g*sin(phi)/(l*m)"], 2),
    ("sin phi/2", ["sin(phi)/2", "sin(phi/2)"], 2),
    ("sin 2 phi", ["sin(2*phi)"], 0),
    ("cos phi sin phi", ["cos(phi)*sin(phi)"], 0),
    ("sin phi m", ["sin(phi)*m"], 0),
]


@pytest.mark.parametrize(("text", "readings", "loose"), READINGS)
def test_readings_in_the_order_of_convention(text: str, readings: list[str], loose: int) -> None:
    first = Choices()
    parse(text, NAMES, "plain", first)
    assert list(first.met.values()) == ([(len(readings), loose)] if len(readings) > 1 else [])
    for number, reading in enumerate([*readings, readings[-1]]):  # a number too large is the last
        taken = Choices(dict.fromkeys(first.met, number))
        found = to_sympy(parse(text, NAMES, "plain", taken).tree, Symbols(NAMES))
        assert found - read(reading) == 0, reading


def test_each_place_has_its_own_choice() -> None:
    text, first = "2/3m + g/4k", Choices()
    parse(text, NAMES, "plain", first)
    one, other = sorted(first.met)
    assert (text[one], text[other]) == ("m", "k")
    for place, reading in {one: "2/(3*m) + g/4*k", other: "2/3*m + g/(4*k)"}.items():
        found = to_sympy(parse(text, NAMES, "plain", Choices({place: 1})).tree, Symbols(NAMES))
        assert found - read(reading) == 0
