"""Formulas of mechanics are shown as textbooks print them, however they were made, and nothing of them is lost."""

from __future__ import annotations

import random

import pytest
import sympy

from deltaq.language.canonical import display, is_zero
from deltaq.language.fourier import Monomial
from deltaq.language.kernel_reader import KernelReader
from deltaq.language.names import Names, Symbol
from deltaq.language.operations import operations
from deltaq.language.order import Order
from deltaq.language.parser import parse
from deltaq.language.plain_printer import plain
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.language.textbook import Textbook

COORDINATES = ("x", "y", "z", "r", "theta", "phi", "psi")
PARAMETERS = (
    *("m", "M", "m1", "m2", "J", "J1", "J3", "k", "k1", "k2", "c", "g", "R"),
    *("l", "l0", "h", "a", "b", "Omega", "omega", "e", "A", "G"),
)
NAMES = Names(
    tuple(Symbol(name, "coordinate") for name in COORDINATES)
    + tuple(Symbol(name, "parameter", positive=True) for name in PARAMETERS)
)
SYMBOLS, ORDER = Symbols(NAMES), Order(NAMES)

BOB = "m*((dot(x) + l*cos(phi)*dot(phi))^2 + (l*sin(phi)*dot(phi))^2)/2"
SPIN = "J3*(dot(psi) + cos(theta)*dot(phi))^2/2"

# As a derivation comes by it, and as books have it.
ROWS = [
    pytest.param(
        f"M*dot(x)^2/2 + {BOB}",
        "(M + m)*dot(x)^2/2 + m*l*cos(phi)*dot(x)*dot(phi) + m*l^2*dot(phi)^2/2",
        id="pendulum on a cart: kinetic energy",
    ),
    pytest.param(
        f"diff(M*dot(x)^2/2 + {BOB}, dot(x))",
        "(M + m)*dot(x) + m*l*cos(phi)*dot(phi)",
        id="its momentum",
    ),
    pytest.param(
        f"d/dt (diff(M*dot(x)^2/2 + {BOB}, dot(x)))",
        "(M + m)*ddot(x) + m*l*cos(phi)*ddot(phi) - m*l*sin(phi)*dot(phi)^2",
        id="the cart's equation",
    ),
    pytest.param(
        f"d/dt (diff({BOB}, dot(phi))) - diff({BOB}, phi) + m*g*l*sin(phi)",
        "m*l^2*ddot(phi) + m*l*cos(phi)*ddot(x) + m*g*l*sin(phi)",
        id="the pendulum's equation",
    ),
    pytest.param(
        "m*((dot(r)*cos(phi)-r*sin(phi)*dot(phi))^2+(dot(r)*sin(phi)+r*cos(phi)*dot(phi))^2)/2",
        "m*(dot(r)^2 + r^2*dot(phi)^2)/2",
        id="polar coordinates",
    ),
    pytest.param(
        "d/dt(m*dot(r)) - diff(m*(dot(r)^2+r^2*dot(phi)^2)/2 + k/r, r)",
        "m*ddot(r) - m*r*dot(phi)^2 + k/r^2",
        id="central force: radial equation",
    ),
    pytest.param(
        "d/dt(diff(m*(dot(r)^2+r^2*dot(phi)^2)/2, dot(phi)))",
        "m*r^2*ddot(phi) + 2*m*r*dot(r)*dot(phi)",
        id="central force: angular equation",
    ),
    pytest.param(
        "m*l^2*((cos(theta)*dot(theta)*cos(phi) - sin(theta)*sin(phi)*dot(phi))^2"
        " + (cos(theta)*dot(theta)*sin(phi) + sin(theta)*cos(phi)*dot(phi))^2 + sin(theta)^2*dot(theta)^2)/2",
        "m*l^2*(dot(theta)^2 + sin(theta)^2*dot(phi)^2)/2",
        id="spherical pendulum: kinetic energy",
    ),
    pytest.param(
        "d/dt(m*l^2*sin(theta)^2*dot(phi))",
        "m*l^2*sin(theta)^2*ddot(phi) + m*l^2*sin(2*theta)*dot(theta)*dot(phi)",
        id="spherical pendulum: rate of its momentum",
    ),
    pytest.param(
        "m1*dot(x)^2/2+m2*dot(x)^2/2+J*(dot(x)/R)^2/2",
        "(J/R^2 + m1 + m2)*dot(x)^2/2",
        id="Atwood's machine: kinetic energy",
    ),
    pytest.param(
        "(m1+m2)*ddot(x)+J*ddot(x)/R^2-m1*g+m2*g",
        "(J/R^2 + m1 + m2)*ddot(x) + (m2 - m1)*g",
        id="Atwood's machine: equation",
    ),
    pytest.param("k1*x^2/2+k2*(y-x)^2/2", "k1*x^2/2 + k2*(y - x)^2/2", id="two springs: potential"),
    pytest.param("-diff(k1*x^2/2+k2*(y-x)^2/2,x)", "k2*y - (k1 + k2)*x", id="force of both springs"),
    pytest.param("-diff(k1*x^2/2+k2*(y-x)^2/2,y)", "k2*(x - y)", id="force of one spring"),
    pytest.param("diff(k*x^2/2+k*(y-x)^2/2+k*y^2/2,x)", "k*(2*x - y)", id="three springs"),
    pytest.param(
        "m*g*l*(1-cos(phi))+k*(a*sin(phi))^2/2",
        "m*g*l*(1 - cos(phi)) + k*a^2*sin(phi)^2/2",
        id="pendulum with a spring",
    ),
    pytest.param(
        "-diff(k*(a*sin(phi)-a*sin(psi))^2/2, phi)",
        "k*a^2*(sin(psi) - sin(phi))*cos(phi)",
        id="coupled pendulums",
    ),
    pytest.param("k*(r-l0)^2/2-m*g*r*cos(phi)", "k*(r - l0)^2/2 - m*g*r*cos(phi)", id="elastic pendulum: potential"),
    pytest.param(
        "diff(k*(r-l0)^2/2-m*g*r*cos(phi) - m*r^2*dot(phi)^2/2, r) + m*ddot(r)",
        "m*ddot(r) - m*r*dot(phi)^2 + k*(r - l0) - m*g*cos(phi)",
        id="elastic pendulum: equation",
    ),
    pytest.param("m*dot(x)^2/2+m*R^2*(dot(x)/R)^2/4", "3*m*dot(x)^2/4", id="rolling disc"),
    pytest.param(
        "J1*((sin(theta)*sin(psi)*dot(phi) + cos(psi)*dot(theta))^2"
        f" + (sin(theta)*cos(psi)*dot(phi) - sin(psi)*dot(theta))^2)/2 + {SPIN}",
        "J1*(dot(theta)^2 + sin(theta)^2*dot(phi)^2)/2 + J3*(cos(theta)*dot(phi) + dot(psi))^2/2",
        id="symmetric top: kinetic energy",
    ),
    pytest.param(
        "diff(J3*(dot(psi)+cos(theta)*dot(phi))^2/2,dot(psi))",
        "J3*(cos(theta)*dot(phi) + dot(psi))",
        id="symmetric top: spin",
    ),
    pytest.param(
        "diff(J1*sin(theta)^2*dot(phi)^2/2+J3*(dot(psi)+cos(theta)*dot(phi))^2/2,dot(phi))",
        "J1*sin(theta)^2*dot(phi) + J3*cos(theta)*(cos(theta)*dot(phi) + dot(psi))",
        id="symmetric top: momentum of precession",
    ),
    pytest.param(
        f"J1*ddot(theta) - diff(J1*sin(theta)^2*dot(phi)^2/2 + {SPIN} - m*g*l*cos(theta), theta)",
        "J1*ddot(theta) + (J3 - J1)*sin(theta)*cos(theta)*dot(phi)^2"
        " + J3*sin(theta)*dot(phi)*dot(psi) - m*g*l*sin(theta)",
        id="symmetric top: nutation",
    ),
    pytest.param(
        "m*((dot(x)-Omega*y)^2+(dot(y)+Omega*x)^2)/2",
        "m*((dot(x) - Omega*y)^2 + (dot(y) + Omega*x)^2)/2",
        id="turning frame",
    ),
    pytest.param(
        "m*((l*cos(phi)*dot(phi)+A*omega*cos(omega*t))^2+(l*sin(phi)*dot(phi))^2)/2",
        "m*(l^2*dot(phi)^2 + 2*A*l*omega*cos(phi)*cos(omega*t)*dot(phi) + A^2*omega^2*cos(omega*t)^2)/2",
        id="driven pivot: kinetic energy",
    ),
    pytest.param(
        "m*l^2*ddot(phi)+m*l*(g-A*omega^2*cos(omega*t))*sin(phi)",
        "m*l^2*ddot(phi) + m*l*(g - A*omega^2*cos(omega*t))*sin(phi)",
        id="driven pivot: equation",
    ),
    pytest.param(
        "m*(dot(x)^2+(2*a*x*dot(x))^2)/2",
        "m*(4*a^2*x^2 + 1)*dot(x)^2/2",
        id="bead on a parabola: kinetic energy",
    ),
    pytest.param(
        "d/dt(m*(1+4*a^2*x^2)*dot(x))-diff(m*(1+4*a^2*x^2)*dot(x)^2/2,x)+2*m*g*a*x",
        "m*(4*a^2*x^2 + 1)*ddot(x) + 2*m*a*x*(2*a*dot(x)^2 + g)",
        id="bead on a parabola: equation",
    ),
    pytest.param(
        "m*((R*(1-cos(phi))*dot(phi))^2+(R*sin(phi)*dot(phi))^2)/2",
        "m*R^2*(1 - cos(phi))*dot(phi)^2",
        id="cycloid",
    ),
    pytest.param("diff(-G*M*m/sqrt(x^2+y^2+z^2),x)", "M*m*G*x/(x^2 + y^2 + z^2)^(3/2)", id="gravitation"),
    pytest.param("diff(k*(sqrt(x^2+h^2)-l0)^2/2,x)", "k*x*(1 - l0/sqrt(x^2 + h^2))", id="slanted spring"),
    pytest.param(
        "diff(k*(sqrt((x-a)^2+h^2)-l0)^2/2,x)",
        "k*(x - a)*(1 - l0/sqrt(x^2 - 2*a*x + a^2 + h^2))",
        id="slanted spring with an offset",
    ),
    pytest.param("m*(l/2)^2*dot(phi)^2/2+m*l^2*dot(phi)^2/24", "m*l^2*dot(phi)^2/6", id="rod about its end"),
    pytest.param(
        "m*l^2*(dot(phi)^2*4/3+dot(psi)^2/3+dot(phi)*dot(psi)*cos(phi-psi))/2",
        "m*l^2*(4*dot(phi)^2 + 3*cos(phi - psi)*dot(phi)*dot(psi) + dot(psi)^2)/6",
        id="two rods",
    ),
    pytest.param("-diff(c*(dot(x)-dot(y))^2/2,dot(x))", "c*(dot(y) - dot(x))", id="damper"),
    pytest.param(
        "(-k*x - c*dot(x) + A*cos(omega*t))*delta(x)",
        "(A*cos(omega*t) - c*dot(x) - k*x)*delta(x)",
        id="virtual work of one coordinate",
    ),
    pytest.param(
        "-k*(x-y)*delta(x)+k*(x-y)*delta(y)",
        "-k*(x - y)*delta(x) + k*(x - y)*delta(y)",
        id="virtual work of a spring between two",
    ),
    pytest.param(
        "delta(m*g*r*(1-cos(phi)))",
        "m*g*(1 - cos(phi))*delta(r) + m*g*r*sin(phi)*delta(phi)",
        id="variation of a potential",
    ),
    pytest.param("d(r*cos(phi))", "cos(phi)*d(r) - r*sin(phi)*d(phi)", id="differential of a position"),
    pytest.param(
        "m*((dot(x)-e*Omega*sin(Omega*t))^2+(e*Omega*cos(Omega*t))^2)/2",
        "m*(dot(x)^2 - 2*e*Omega*sin(Omega*t)*dot(x) + e^2*Omega^2)/2",
        id="rotating unbalance",
    ),
    pytest.param(
        "m*((1+cot(a)^2)*dot(r)^2+r^2*dot(phi)^2)/2",
        "m*((1 + cot(a)^2)*dot(r)^2 + r^2*dot(phi)^2)/2",
        id="cone",
    ),
    pytest.param("diff(sqrt(1+dot(y)^2),dot(y))", "dot(y)/sqrt(dot(y)^2 + 1)", id="slope of an arc length"),
    pytest.param(
        "sqrt(dot(theta)^2+sin(theta)^2*dot(phi)^2)",
        "sqrt(dot(theta)^2 + sin(theta)^2*dot(phi)^2)",
        id="length on a sphere",
    ),
    pytest.param(
        "m*dot(r)^2/2 + l^2/(2*m*r^2) - G*m*M/r",
        "m*dot(r)^2/2 - M*m*G/r + l^2/(2*m*r^2)",
        id="effective potential",
    ),
    pytest.param("diff(l^2/(2*m*r^2) - k/r, r)", "k/r^2 - l^2/(m*r^3)", id="slope of the effective potential"),
    pytest.param("A*cos(omega*t)*cos(phi)-A*sin(omega*t)*sin(phi)", "A*cos(phi + omega*t)", id="two waves"),
    pytest.param(
        "m*((dot(phi)*b*sin(phi))^2+(b*cos(phi)*dot(phi))^2+((a+b*cos(phi))*dot(theta))^2)/2",
        "m*((a + b*cos(phi))^2*dot(theta)^2 + b^2*dot(phi)^2)/2",
        id="torus",
    ),
    pytest.param(
        "sqrt((l*sin(phi)-l*sin(psi))^2+(l*cos(phi)-l*cos(psi))^2)",
        "l*sqrt(2 - 2*cos(phi - psi))",
        id="distance of two points on a circle",
    ),
    pytest.param(
        "(dot(x) + (1/sin(a) - 1)*y*sin(a))^2",
        "(dot(x) + y - y*sin(a))^2",
        id="powers of a reciprocal that cancel one after the other",
    ),
]


def read(text: str) -> sympy.Expr:
    """The value of a text, its derivatives carried out."""
    return to_sympy(parse(text, NAMES).tree, SYMBOLS)


@pytest.mark.parametrize(("raw", "printed"), ROWS)
def test_printed_as_in_textbooks(raw: str, printed: str) -> None:
    assert plain(display(read(raw), SYMBOLS), ORDER) == printed
    assert is_zero(read(raw) - read(printed), SYMBOLS)


@pytest.mark.parametrize("apart", [True, False])
@pytest.mark.parametrize("raw", [row.values[0] for row in ROWS], ids=[row.id for row in ROWS])
def test_the_terms_of_a_formula_are_the_formula(raw: str, *, apart: bool) -> None:
    reader = KernelReader()
    form = reader.read(read(raw))
    book = Textbook(reader, ORDER, frozenset())
    terms = [(part.value, part.sign) for part in book.summands(form, apart=apart).terms]
    for signed in (terms, book.products(form)):
        assert all(sign in (1, -1) and value.as_coeff_Mul()[0] > 0 for value, sign in signed)
        assert is_zero(sympy.Add(*(sign * value for value, sign in signed)) - read(raw), SYMBOLS)


def brackets(generator: random.Random) -> sympy.Expr:
    """A product of a number, some symbols and two or three sums, the first perhaps squared; masses go other ways."""
    symbols = [SYMBOLS.name(name) for name in ("x", "y", "phi", "l", "k", "a", "c")]
    sums = [
        sympy.Add(*(generator.choice((1, -1, 2)) * symbol for symbol in generator.sample(symbols, terms)))
        for terms in generator.choice(((2, 2), (2, 3), (2, 2, 2)))
    ]
    number = sympy.Rational(generator.choice((1, -1, 2, -3)), generator.choice((1, 2)))
    power = generator.choice((1, 1, 2))
    outside = generator.sample(symbols, generator.choice((0, 1, 2)))
    return sympy.Mul(number, *outside, sums[0] ** power, *sums[1:], evaluate=False)


def test_what_was_multiplied_out_is_found_again() -> None:
    generator = random.Random(11)
    products = [brackets(generator) for _ in range(60)]
    shown = [display(sympy.expand(product), SYMBOLS) for product in products]
    assert [one for one, product in zip(shown, products, strict=True) if sympy.expand(one - product) != 0] == []
    longer = [one for one, product in zip(shown, products, strict=True) if operations(one) > operations(product)]
    assert len(longer) <= 2  # a habit may outweigh an operation


def test_what_is_zero_only_where_it_is_multiplied_out_is_zero() -> None:
    hidden = read("l*cos(phi)*sin(psi) - l*sin(2*phi)*sin(psi)/(2*sin(phi))")
    assert hidden != 0
    assert display(hidden, SYMBOLS) == 0


ANGLES = ("phi", "theta", "acos(g/(R*Omega^2))", "asin(a/b)", "atan(a/b)", "Omega*t", "pi/3", "acos(a/b)/2")


def waves(generator: random.Random) -> str:
    """A sum of products of waves, some of angles whose cosine is known: cos(2 acos(a/b) + φ)."""
    kinds = ("sin", "cos")
    angles = [
        f"{generator.choice(kinds)}({generator.randint(1, 3)}*{generator.choice(ANGLES)}"
        f"{generator.choice(('', ' + phi', ' - ' + generator.choice(ANGLES)))})"
        for _ in range(4)
    ]
    first, second, *rest = (f"{wave}^{generator.randint(1, 2)}" for wave in angles)
    return f"m*a*{first}*{second} + m*b*{'*'.join(rest)} + m*a*sin(phi)^2"


@pytest.mark.parametrize("seed", range(60))
def test_waves_of_angles_with_a_known_cosine_are_shown_as_what_they_are(seed: int) -> None:
    generator = random.Random(seed)
    raw = read(waves(generator))
    shown = display(raw, SYMBOLS)
    point = {symbol: sympy.Float(generator.uniform(0.2, 0.9), 30) for symbol in raw.free_symbols | shown.free_symbols}
    point |= {symbol: 1 + value for symbol, value in point.items() if symbol.name in ("b", "R", "Omega")}
    assert abs(raw.subs(point).n(25) - shown.subs(point).n(25)) < sympy.Float("1e-20")


def test_inertia_is_written_apart() -> None:
    """One term for each acceleration and product of rates, though they share m l²."""
    reader = KernelReader()
    form = reader.read(read("m*l^2*ddot(phi) + m*l^2*ddot(psi) + k*dot(x) + k*dot(y) + m*g*l*sin(phi)"))
    book = Textbook(reader, ORDER, frozenset())
    apart = [plain(part.value, ORDER) for part in book.summands(form, apart=True).terms]
    assert sorted(apart) == ["k*dot(x)", "k*dot(y)", "m*g*l*sin(phi)", "m*l^2*ddot(phi)", "m*l^2*ddot(psi)"]
    assert len(book.summands(form, apart=False).terms) < len(apart)


def test_the_terms_of_a_bracket_know_their_products() -> None:
    reader = KernelReader()
    form = reader.read(read("(m1 + m2)*l^2*ddot(phi) + k*x"))
    book = Textbook(reader, ORDER, frozenset())
    summands = book.summands(form, apart=False)
    inside = [
        (plain(bracket, ORDER), plain(term, ORDER), keys == {summands.key(mono)})
        for part in summands.terms
        for bracket, term, keys in book.inside(part, summands.alphabet)
        for mono in (_times(reader, f"{plain(term, ORDER)}*l^2*ddot(phi)"),)
    ]
    assert sorted(inside) == [("m1 + m2", "m1", True), ("m1 + m2", "m2", True)]
    assert summands.key((("y", 1),)) is None


def _times(reader: KernelReader, text: str) -> Monomial:
    ((mono, _, _),) = reader.read(read(text))
    return mono
