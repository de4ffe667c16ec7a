"""Results are shown in the form in which a person writes them."""

from __future__ import annotations

import pytest
import sympy
from tests.language.scene_names import DOUBLE, DOUBLE_KINETIC_ENERGY, NAMES, SYMBOLS, Symbols, read

from deltaq.language.canonical import display, is_zero
from deltaq.language.display import size
from deltaq.language.names import Names
from deltaq.language.order import Order
from deltaq.language.plain_printer import plain

ROWS = [
    pytest.param(
        "[F0*cos(phi), -F0*sin(phi)]*[l*cos(phi)*delta(phi), delta(y) - l*sin(phi)*delta(phi)]",
        "-F0*sin(phi)*delta(y) + F0*l*delta(phi)",
        id="the lecture's virtual work",
    ),
    pytest.param(
        "m*((l*cos(phi)*dot(phi))^2 + (dot(y) - l*sin(phi)*dot(phi))^2)/2",
        "m*(dot(y)^2 - 2*l*sin(phi)*dot(y)*dot(phi) + l^2*dot(phi)^2)/2",
        id="kinetic energy of the elastic pendulum",
    ),
    pytest.param(
        "m*((l*cos(phi)*dot(phi))^2 + (y0*omega*cos(omega*t) - l*sin(phi)*dot(phi))^2)/2",
        "m*(l^2*dot(phi)^2 - 2*l*y0*omega*sin(phi)*cos(omega*t)*dot(phi) + y0^2*omega^2*cos(omega*t)^2)/2",
        id="kinetic energy of the guided pendulum",
    ),
    pytest.param("k*y^2/2 - m*g*(y + l*cos(phi))", "k*y^2/2 - m*g*(y + l*cos(phi))", id="potential"),
    pytest.param(
        "d/dt (m*l^2*dot(phi) - m*l*sin(phi)*dot(y)) + m*l*cos(phi)*dot(y)*dot(phi) + m*g*l*sin(phi)",
        "m*l^2*ddot(phi) - m*l*sin(phi)*ddot(y) + m*g*l*sin(phi)",
        id="equation of the pendulum",
    ),
    pytest.param("-k*y*delta(y) + m*g*delta(y)", "(m*g - k*y)*delta(y)", id="terms of one virtual displacement"),
    pytest.param("-l*sin(phi)*d(phi) + y0*omega*cos(omega*t)*d(t)",
                 "-l*sin(phi)*d(phi) + y0*omega*cos(omega*t)*d(t)", id="differential"),
    pytest.param("sin(phi)^2", "sin(phi)^2", id="square of a sine"),
    pytest.param("1 - cos(phi)^2", "sin(phi)^2", id="hidden square of a sine"),
    pytest.param("sin(phi)*cos(phi)", "sin(phi)*cos(phi)", id="product"),
    pytest.param("sin(phi)*sin(x)", "sin(phi)*sin(x)", id="product of two angles"),
    pytest.param("cos(phi)*cos(x) + sin(phi)*sin(x)", "cos(phi - x)", id="difference of two angles"),
    pytest.param("tan(phi)*cos(phi)", "sin(phi)", id="tangent"),
    pytest.param("k*(x - y)^2/2", "k*(x - y)^2/2", id="a square stays a square"),
    pytest.param("k*(sqrt(x^2 + y^2) - l)^2/2", "k*(sqrt(y^2 + x^2) - l)^2/2", id="spring"),
    pytest.param("k*(sqrt((a + l*sin(phi))^2 + l^2*cos(phi)^2) - l)^2/2",
                 "k*(sqrt(a^2 + l^2 + 2*a*l*sin(phi)) - l)^2/2", id="squares under a root"),
    pytest.param("(a*cos(phi))^2 + (a*sin(phi) + l)^2", "a^2 + l^2 + 2*a*l*sin(phi)", id="a length at rest"),
    pytest.param("m*(log(m)*l*dot(phi)*sin(phi))^2 + m*(log(m)*l*cos(phi)*dot(phi) + dot(y))^2",
                 "m*(dot(y)^2 + 2*l*log(m)*cos(phi)*dot(y)*dot(phi) + l^2*log(m)^2*dot(phi)^2)", id="with a logarithm"),
    pytest.param("m*dot(x)^2/2 + m1*dot(x)^2/2", "(m + m1)*dot(x)^2/2", id="a half before a sum"),
    pytest.param("m*g*x + m*k*x", "m*(k + g)*x", id="a common factor that leaves no sum"),
    pytest.param("m*l^2 + m1*l^2", "(m + m1)*l^2", id="equal factors"),
    pytest.param("m*g - m*g", "0", id="nothing left"),
    pytest.param("abs(x - y)*sign(x - y)", "x - y", id="size times sign"),
    pytest.param("(x - y)*sign(x - y)", "abs(x - y)", id="a sum times its sign"),
    pytest.param("diff(abs(x)^3, x)", "3*x*abs(x)", id="slope of a cube"),
    pytest.param("diff(k*(abs(y - x) - l)^2/2, x)", "k*(x - y - l*sign(x - y))", id="spring on a line"),
    pytest.param("m*((cos(l*t*sin(k))*x - sin(l*t*sin(k))*y)^2 + (sin(l*t*sin(k))*x + cos(l*t*sin(k))*y)^2)",
                 "m*(y^2 + x^2)", id="unity of an angle with a wave in it"),
    pytest.param("m*((dot(x) - k*y)^2 + (dot(y) + k*x)^2)", "m*((dot(x) - k*y)^2 + (dot(y) + k*x)^2)",
                 id="completed squares"),
    pytest.param("m*(dot(x)^2 - 2*k*y*dot(x) + k^2*y^2 + dot(y)^2 + 2*k*x*dot(y) + k^2*x^2)",
                 "m*((dot(x) - k*y)^2 + (dot(y) + k*x)^2)", id="squares to be completed"),
    pytest.param("m*(l + y)^2*dot(phi)^2/2", "m*(y + l)^2*dot(phi)^2/2", id="a length that changes"),
    pytest.param("diff(k*(sqrt(x^2 + l^2) - g)^2/2, x)", "k*x*(1 - g/sqrt(x^2 + l^2))", id="slope of a spring"),
    pytest.param("diff(-k/sqrt(x^2 + y^2), x)", "k*x/(y^2 + x^2)^(3/2)", id="gravitation"),
    pytest.param("k*y^2/2 + m*g*y*phi + k*phi^2/2", "m*g*y*phi + k*(y^2 + phi^2)/2", id="nothing nested"),
    pytest.param("cosh(x)^2 - sinh(x)^2", "1", id="hyperbolic unity"),
    pytest.param("k*cosh(x/k)", "k*cosh(x/k)", id="catenary"),
    pytest.param("9.81*m*(1 + 1)", "19.62*m", id="decimal"),
    pytest.param("y*abs(x) + sign(x)", "y*abs(x) + sign(x)", id="size and sign apart"),
    pytest.param("y*abs(x)^2", "y*x^2", id="square of a size"),
    pytest.param("y*abs(x)^3", "y*x^2*abs(x)", id="cube of a size"),
    pytest.param("x^3*sign(x)", "x^2*abs(x)", id="a power times its sign"),
    pytest.param("x*sin(phi)*sign(x)", "sin(phi)*abs(x)", id="a coordinate beside a wave times its sign"),
    pytest.param("x*sign(x)/y", "abs(x)/y", id="a coordinate over another times its sign"),
    pytest.param("x*sign(2*x - y)", "x*sign(2*x - y)", id="the sign of another sum"),
    pytest.param("x*y*sign(x)*sign(y)", "abs(y)*abs(x)", id="two signs"),
    pytest.param("abs(x)*abs(y)*sign(x)", "x*abs(y)", id="one sign of two sizes"),
    pytest.param("abs(x)*sign(y)", "sign(y)*abs(x)", id="sign of another"),
    pytest.param("abs(-2*m*x) + abs(m)", "m*(1 + 2*abs(x))", id="positive factors leave the bars"),
    pytest.param("y*sign(-2*m*x)", "-y*sign(x)", id="positive factors leave the sign"),
    pytest.param("x*sign(m) + sign(x - x)", "x", id="signs that are known"),
    pytest.param("step(2*m*x)", "step(x)", id="positive factors leave a step"),
    pytest.param("step(m) + step(-m) + step(x - x)", "3/2", id="steps that are known"),
    pytest.param("y*step(-m*(sin(phi)^2 + cos(phi)^2)) + x", "x", id="a step that turns out to be before its place"),
    pytest.param("y*step(m*(sin(phi)^2 + cos(phi)^2)) + x", "y + x", id="a step that turns out to be done"),
    pytest.param("y*step(1 - sin(phi)^2 - cos(phi)^2)", "y/2", id="a step that turns out to be at its place"),
    pytest.param("y*sign(-m*(sin(phi)^2 + cos(phi)^2))", "-y", id="a sign that turns out to be known"),
    pytest.param("y*abs(-3*m*(sin(phi)^2 + cos(phi)^2))", "3*m*y", id="a size that turns out to be known"),
    pytest.param("y*abs(1 - sin(phi)^2 - cos(phi)^2) + sign(1 - sin(phi)^2 - cos(phi)^2)", "0", id="of nothing"),
    pytest.param("step(y - x) + step(x - y)", "1", id="a step and its opposite"),
    pytest.param("y*step(x)^2", "y*step(x)^2", id="a power of a step"),
    pytest.param("2*max(x, y) - x - y", "2*max(x, y) - y - x", id="the larger stays what it is"),
    pytest.param("diff(max(x, y), x)", "step(x - y)", id="slope of the larger"),
    pytest.param("diff(min(x, y)^2, x)", "2*step(y - x)*min(x, y)", id="slope of the square of the smaller"),
    pytest.param("abs(1 - x)", "abs(x - 1)", id="size of a difference the other way round"),
    pytest.param("y*sign(1 - x)", "y*sign(1 - x)", id="sign of a difference the other way round"),
    pytest.param("abs(m*x^2 - m*y*x)", "m*abs(x^2 - y*x)", id="size of a sum"),
    pytest.param("(x^2 - y^2)*sign(x - y)", "(y + x)*abs(x - y)", id="a sum that holds its sign's"),
    pytest.param("x/(x^2 + x*y)", "1/(y + x)", id="a fraction that cancels"),
    pytest.param("x^2/(x + y) - y^2/(x + y)", "x - y", id="fractions that cancel together"),
    pytest.param("x/sqrt(x + y) + y/sqrt(x + y)", "sqrt(y + x)", id="fractions that cancel to a root"),
    pytest.param("(x + y)^2/(x + y)", "y + x", id="a power that cancels"),
    pytest.param("1/(m*x + m*y)", "1/(m*(y + x))", id="factor below the line"),
    pytest.param("1/(x/2 + y/3)", "6/(2*y + 3*x)", id="whole numbers below the line"),
    pytest.param("sqrt(4*m*x^2 + 4*m*y^2)", "2*sqrt(m)*sqrt(y^2 + x^2)", id="squares leave a root"),
    pytest.param("sqrt(8*x^2 + 8)", "sqrt(8*x^2 + 8)", id="what is no square stays under the root"),
    pytest.param("sqrt(x^3 + x^2*y)", "sqrt(y*x^2 + x^3)", id="what may be negative stays under the root"),
    pytest.param("sqrt(m*x + m*y)*sqrt(x + y) - sqrt(m)*x", "sqrt(m)*y", id="roots whose product is multiplied out"),
    pytest.param("sqrt(m*x + m*y)*sqrt(x + y) + sqrt(x + y)", "sqrt(y + x) + sqrt(m)*(y + x)",
                 id="roots whose product stands beside one of them"),
    pytest.param("sqrt(x^2 + y^2)^3", "(y^2 + x^2)^(3/2)", id="a power of a root"),
    pytest.param("sqrt(4*x^2 + 4*y^2)^3", "8*(y^2 + x^2)^(3/2)", id="a square leaves a power of a root"),
    pytest.param("1/sqrt(9*x^2 + 9*y^2)", "1/(3*sqrt(y^2 + x^2))", id="a square leaves a root below the line"),
    pytest.param("1/sqrt(m*x^2/4 + m*y^2/4)", "2/(sqrt(m)*sqrt(y^2 + x^2))", id="a quarter under a root"),
    pytest.param("sqrt(12)*m + sqrt(3)*m", "3*sqrt(3)*m", id="roots of numbers"),
    pytest.param("(8*m)^(1/3)", "2*m^(1/3)", id="cube root of a product"),
    pytest.param("tan(phi)*sin(phi)", "sin(phi)*tan(phi)", id="a tangent that does not cancel"),
    pytest.param("sin(phi)*cos(x) + cos(phi)*sin(x)", "sin(phi + x)", id="sum of two angles"),
    pytest.param("sin(phi)^2 - sin(phi)^4", "sin(2*phi)^2/4", id="product of squares"),
    pytest.param("cos(phi)^2 - sin(phi)^2", "cos(2*phi)", id="double angle"),
    pytest.param("sin(phi/2)*cos(phi/2)", "sin(phi)/2", id="half angle"),
    pytest.param("cos(phi)^3", "cos(phi)^3", id="a cube stays a cube"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), ROWS)
def test_shown_as(text: str, shown: str) -> None:
    assert plain(display(read(text), SYMBOLS), Order(NAMES)) == shown


@pytest.mark.parametrize("text", [row.values[0] for row in ROWS], ids=[row.id for row in ROWS])
def test_what_is_shown_is_shown_as_it_is(text: str) -> None:
    shown = display(read(text), SYMBOLS)
    assert display(shown, SYMBOLS) == shown


DOUBLE_ROWS = [
    pytest.param(
        DOUBLE_KINETIC_ENERGY,
        "(m1 + m2)*l1^2*dot(phi1)^2/2 + m2*l1*l2*cos(phi1 - phi2)*dot(phi1)*dot(phi2) + m2*l2^2*dot(phi2)^2/2",
        id="kinetic energy",
    ),
    pytest.param(
        f"diff({DOUBLE_KINETIC_ENERGY}, dot(phi1))",
        "(m1 + m2)*l1^2*dot(phi1) + m2*l1*l2*cos(phi1 - phi2)*dot(phi2)",
        id="momentum",
    ),
    pytest.param(
        f"d/dt (diff({DOUBLE_KINETIC_ENERGY}, dot(phi1))) - diff({DOUBLE_KINETIC_ENERGY}, phi1)"
        " + (m1 + m2)*g*l1*sin(phi1)",
        "(m1 + m2)*l1^2*ddot(phi1) + m2*l1*l2*cos(phi1 - phi2)*ddot(phi2)"
        " + m2*l1*l2*sin(phi1 - phi2)*dot(phi2)^2 + (m1 + m2)*g*l1*sin(phi1)",
        id="first equation",
    ),
]


@pytest.mark.parametrize(("text", "shown"), DOUBLE_ROWS)
def test_double_pendulum(text: str, shown: str) -> None:
    assert plain(display(read(text, names=DOUBLE), Symbols(DOUBLE)), Order(DOUBLE)) == shown


def test_entries_and_sides_are_shown_each() -> None:
    column = display(read("[sin(phi)^2 + cos(phi)^2, x]"), SYMBOLS)
    assert column == sympy.ImmutableMatrix([1, SYMBOLS.name("x")])
    equation = display(read("sin(phi)^2 + cos(phi)^2 = x + x - x"), SYMBOLS)
    assert equation == sympy.Eq(sympy.Integer(1), SYMBOLS.name("x"), evaluate=False)
    assert display(read("sin(phi)^2 + cos(phi)^2 = x; y = 0"), SYMBOLS).args[0] == equation


# A formula, the sums as the author wrote them, and how it is shown.
GIVEN = [
    ("k*(x - y)", ["x - y"], "k*(x - y)"),
    ("k*(x - y)", ["y - x"], "-k*(y - x)"),
    ("-k*(x - y)", ["x - y"], "-k*(x - y)"),
    ("-k*(x - y)", ["y - x"], "k*(y - x)"),
    ("-k*(x - y)", [], "k*(y - x)"),
    ("k*(x - y)^2", ["y - x"], "k*(y - x)^2"),
    ("k*(x - y)^3", ["y - x"], "-k*(y - x)^3"),
    ("-k*(x + y)", ["-x - y"], "-k*(y + x)"),
    ("-k*(m - l)*(x - y)", [], "(m - l)*k*(y - x)"),
]


@pytest.mark.parametrize(("text", "given", "shown"), GIVEN)
def test_a_difference_stands_the_way_round_that_it_was_given(text: str, given: list[str], shown: str) -> None:
    found = display(sympy.expand(read(text)), SYMBOLS, frozenset(map(read, given)))
    assert plain(found, Order(NAMES)) == shown


@pytest.mark.parametrize(
    ("text", "parts"), [("x", 1), ("2", 1), ("x + y", 3), ("-x", 3), ("m*x^2", 5), ("sin(x)", 2), ("x/y", 5)]
)
def test_how_many_parts_there_are_to_write(text: str, parts: int) -> None:
    assert size(read(text)) == parts


def test_display_keeps_the_value_of_what_it_cannot_expand() -> None:
    expr = read("sqrt(sin(phi)^2 + cos(phi)^2 + x^2)*log(x^2 + 1) + abs(x)*atan2(y, x)")
    assert is_zero(display(expr, SYMBOLS) - expr, SYMBOLS) is True


@pytest.mark.parametrize("power", [pytest.param(6, id="not shortened"), pytest.param(7, id="left as it is")])
def test_what_nobody_reads_is_not_worked_on(power: int) -> None:
    expr = read("x + y + m + l + g + k") ** power
    assert len(sympy.Add.make_args(sympy.expand(expr))) > 400
    assert display(expr, SYMBOLS) == expr


def test_without_names_latin_coordinates_come_before_greek_ones() -> None:
    assert plain(read("delta(phi) + delta(y)")) == "delta(y) + delta(phi)"
    assert plain(read("delta(phi) + delta(y)"), Order(Names())) == "delta(y) + delta(phi)"


def test_a_sum_in_a_sum_has_brackets() -> None:
    x, m, k = (SYMBOLS.name(name) for name in ("x", "m", "k"))
    assert plain(sympy.Add(x, sympy.Add(m, k, evaluate=False), evaluate=False), Order(NAMES)) == "x + (m + k)"
