"""Forms too long to be planned are arranged: terms gathered, what an energy's terms share in front."""

from __future__ import annotations

import itertools

import pytest
import sympy
from tests.language.scene_names import NAMES, SYMBOLS, read

from deltaq.language.arrangement import Arrangement
from deltaq.language.canonical import display
from deltaq.language.display import size
from deltaq.language.normal_form import Reader
from deltaq.language.order import Order
from deltaq.language.plain_printer import plain

ROWS = [
    pytest.param("m*l*x/2 + m*l*y/2", "m*l*(y + x)/2", id="half of a common factor"),
    pytest.param("-m*x/3 - m*y/4", "-m*(3*y + 4*x)/12", id="common denominator and sign"),
    pytest.param("m*x/13 + m*y/13", "m*(y/13 + x/13)", id="no large denominator in front"),
    pytest.param("m*g*x - k*g*x", "(m - k)*g*x", id="equal coefficients"),
    pytest.param("m*g*x/2 + k*g*x + m1*g*x/2", "(m/2 + m1/2 + k)*g*x", id="coefficients of unequal size"),
    pytest.param("m*g*x/2 + k*g*x/3", "(m/2 + k/3)*g*x", id="coefficients of unequal size that are all fractions"),
    pytest.param("m*g*x/2 - k*g*x/2", "(m - k)*g*x/2", id="coefficients of equal size"),
    pytest.param("m*ddot(x)*dot(x) + m*ddot(y)*dot(y)", "m*dot(y)*ddot(y) + m*dot(x)*ddot(x)", id="nor of powers"),
    pytest.param("m*dot(x)^2/2 + m1*dot(x)^2/2", "(m + m1)*dot(x)^2/2", id="equal rates"),
    pytest.param("m*l*dot(x)^2 + m*g*l*x", "m*l*dot(x)^2 + m*g*l*x", id="an energy beside a potential"),
    pytest.param("m*dot(x)^2 + m*dot(x)*omega + m*omega^2", "m*(dot(x)^2 + omega*dot(x) + omega^2)", id="with a guide"),
    pytest.param("m*dot(x) + m*l*dot(phi)", "m*l*dot(phi) + m*dot(x)", id="momenta stay sums"),
    pytest.param("m*delta(x) + m*l*delta(phi)", "m*l*delta(phi) + m*delta(x)", id="work stays a sum"),
    pytest.param("m*l*ddot(x) - m*l", "m*l*ddot(x) - m*l", id="equations stay sums"),
    pytest.param("m*x^2 + m^2*x^2", "m*(1 + m)*x^2", id="powers of a parameter"),
    pytest.param("m*dot(x)^2 - m*dot(y)^2*(1 - cos(2*phi))/2", "m*(dot(x)^2 - sin(phi)^2*dot(y)^2)", id="squared sine"),
    pytest.param("a*m*x + a*m*y", "m*a*(y + x)", id="several parameters"),
    pytest.param("x*y + x*phi", "y*x + phi*x", id="coordinates are no common factor"),
    pytest.param("m*x*log(l*x) + m*y*log(l*x)", "m*(y*log(l*x) + x*log(l*x))", id="nor functions of them"),
    pytest.param("x*sqrt(m) + y*sqrt(m)", "sqrt(m)*y + sqrt(m)*x", id="roots stay in the sum"),
    pytest.param("m*x/l + m*y/l", "m*(y/l + x/l)", id="so does what is below the line"),
    pytest.param("m*x*log(l) + m*y*log(l)", "m*(y + x)*log(l)", id="but those of parameters are"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "arranged"), ROWS)
def test_arranged_as(text: str, arranged: str) -> None:
    reader = Reader()
    found = Arrangement(reader, Order(NAMES)).expression(reader.form(read(text)))
    assert plain(found, Order(NAMES)) == arranged


@pytest.mark.parametrize(
    ("factor", "in_front"),
    [
        pytest.param("m*l/2", "m*l/2", id="potential"),
        pytest.param("-m*l/2", "-m*l/2", id="negative potential"),
        pytest.param("m*l/13", "m*l", id="large denominator"),
        pytest.param("m*l*dot(x)", "dot(x)", id="momentum"),
        pytest.param("m*l*ddot(x)", "ddot(x)", id="equation"),
        pytest.param("m*l*delta(x)", "delta(x)", id="work"),
    ],
)
def test_what_stands_before_a_long_sum(factor: str, in_front: str) -> None:
    x, y, phi = (SYMBOLS.name(name) for name in ("x", "y", "phi"))
    powers = [(i, j, k) for i, j, k in itertools.product(range(10), repeat=3) if i + j + k <= 9]
    terms = [read(factor) * x**i * y**j * phi**k for i, j, k in powers]
    shown = display(sympy.Add(*terms), SYMBOLS)
    (bracket,) = (part for part in shown.args if part.is_Add)
    assert len(bracket.args) == len(terms) == 220
    assert shown / bracket == read(in_front)
    assert sympy.expand(shown) == sympy.Add(*terms)


def test_a_long_sum_with_a_quotient_keeps_its_value() -> None:
    x, y, phi, m = (SYMBOLS.name(name) for name in ("x", "y", "phi", "m"))
    powers = [(i, j, k) for i, j, k in itertools.product(range(9), repeat=3) if i + j + k <= 8]
    total = sympy.Add(*(x**i * y**j * phi**k for i, j, k in powers)) + 1 / (x + m)
    shown = display(total, SYMBOLS)
    assert sympy.expand((shown - total).subs({x: 3, y: -2, phi: 5, m: 7})) == 0
    assert size(shown) <= size(total)


@pytest.mark.parametrize(("products", "shortened"), [(100, True), (101, False)])
def test_waves_are_written_the_shortest_way_in_sums_that_somebody_reads(products: int, shortened: bool) -> None:
    """sin² is 1/2 − cos 2φ/2: of each product two terms, and 200 at most."""
    powers = list(itertools.product(range(11), repeat=2))[:products]
    given = read("sin(phi)^2") * sympy.Add(*(read(f"dot(x)^{i}*dot(y)^{j}") for i, j in powers))
    reader = Reader()
    found = Arrangement(reader, Order(NAMES)).expression(reader.form(given))
    assert found.has(sympy.cos(2 * SYMBOLS.name("phi"))) is not shortened
    somewhere = {SYMBOLS.name("phi"): 0.7, SYMBOLS.rate("x", 1): 0.9, SYMBOLS.rate("y", 1): 1.1}
    assert float(found.subs(somewhere)) == pytest.approx(float(given.subs(somewhere)))


@pytest.mark.parametrize(("factor", "alike"), [("dot(x)", True), ("m", False)])
def test_a_long_sum_is_shown_alike_however_it_was_given_where_something_moves(factor: str, alike: bool) -> None:
    """A power of a sum is left as it is in a potential alone."""
    given = read(f"{factor}*(1 + x + y + phi)^9")
    shown, expanded = (display(each, SYMBOLS) for each in (given, sympy.expand(given)))
    assert (shown == expanded, shown == given) == (alike, not alike)
