"""What a way to write a formula costs: its operations, and what speaks against it by habit."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
import sympy
from tests.language.test_textbook import NAMES, ORDER, SYMBOLS

from deltaq.language.kernel_reader import KernelReader
from deltaq.language.parser import parse
from deltaq.language.plan import Plan, Powers, Prices, Product, Sum, expanded, in_whole_numbers
from deltaq.language.planner import Planner, split_off
from deltaq.language.polynomial import Alphabet, Poly
from deltaq.language.sympy_algebra import to_sympy
from deltaq.language.textbook import Textbook
from deltaq.language.trigonometry import written


class Page:
    """One alphabet for several texts, each of them a monomial."""

    def __init__(self, *texts: str) -> None:
        self.reader = KernelReader()
        self.forms = {
            text: written(self.reader.read(to_sympy(parse(text, NAMES).tree, SYMBOLS)), self.reader) for text in texts
        }
        book = Textbook(self.reader, ORDER, frozenset())
        self.alphabet = Alphabet(self.reader, ORDER, self.forms.values(), book._kernel)
        self.prices = Prices(self.alphabet.shape)

    def poly(self, text: str) -> tuple[Poly, int]:
        return self.alphabet.polynomial(self.forms[text])

    def term(self, text: str) -> Product:
        poly, denominator = self.poly(text)
        ((exponents, number),) = poly.items()
        return self.prices.monomial(exponents, Fraction(number, denominator))

    def sum(self, *texts: str) -> Sum:
        return self.prices.sum(self.term(text) for text in texts)

    def powers(self, text: str) -> Powers:
        return self.term(text).powers


def price_of_habit(outside: str, inside: tuple[str, ...], *, power: int = 1, free: bool = False) -> float:
    """What a product with a bracket costs besides its operations."""
    page = Page(outside, *inside)
    bracket = page.sum(*inside)
    whole = page.prices.product(Fraction(1), page.powers(outside), ((bracket, power),), free=free)
    return whole.price - bracket.price - page.term(outside).price - 1 - (power != 1)


@pytest.mark.parametrize(
    ("text", "operations"),
    [
        ("x", 0),
        ("-x", 0),
        ("2*x", 1),
        ("x/2", 1),
        ("m*x", 1),
        ("-m*x", 1),
        ("m*x^2", 2),
        ("m*x^2/2", 3),
        ("3*m*x^2/2", 3),
        ("1/x", 1),
        ("-1/x", 1),
        ("2/x", 1),
        ("1/(2*x)", 2),
        ("1/x^2", 2),
        ("m/x", 1),
        ("1/(m*x)", 2),
        ("k*m/x^3", 3),
        ("sqrt(x)", 1),
        ("x^(3/2)", 1),
        ("1/sqrt(x)", 2),
        ("sin(phi)", 1),
        ("sin(phi)^2", 2),
        ("m*sin(phi)*dot(x)", 3),
        ("cos(phi - psi)", 2),
        ("sqrt(x^2 + y^2)", 4),
        ("1/sqrt(x^2 + y^2)", 5),
    ],
)
def test_a_product_costs_its_operations(text: str, operations: int) -> None:
    assert Page(text).term(text).price == operations


def test_a_bracket_costs_its_operations() -> None:
    """2 (m + x): a sum and a product; (m + x)²: a sum and a power; 3 (m + x)² y: a sum, a power, two products."""
    page = Page("m", "x", "y")
    inner = page.sum("m", "x")
    made = [
        page.prices.product(Fraction(2), (), ((inner, 1),), free=True),
        page.prices.product(Fraction(1), (), ((inner, 2),), free=True),
        page.prices.product(Fraction(3), page.powers("y"), ((inner, 2),), free=True),
        page.prices.product(Fraction(-1), (), ((inner, 1), (page.sum("x", "y"), 1)), free=True),
    ]
    assert [one.price for one in made] == [2, 2, 4, 3]


@pytest.mark.parametrize(
    ("outside", "inside", "price"),
    [
        ("x", ("m1", "m2"), 0.25),
        ("dot(x)^2", ("m1", "m2"), 0.25),
        ("x", ("k", "l"), 0.25),
        ("k", ("x", "y"), 0.75),
        ("k", ("sin(phi)", "cos(phi)"), 0.75),
        ("k", ("x", "l"), 0.75),
        ("k", ("dot(x)", "dot(y)"), 0.75),
        ("k", ("ddot(x)", "ddot(y)"), 0.75),
        ("k", ("dot(x)^2", "dot(x)*dot(y)"), 0.75),
        ("k", ("dot(x)", "y"), 0.75 + 0.5),  # unequal degrees in the rates
        ("k", ("dot(x)^2", "dot(y)"), 0.75 + 0.5),
        ("k", ("m1*dot(x)", "m2*dot(y)"), 0.75 + 2.0),  # masses with rates
        ("k", ("m1*ddot(x)", "m2*ddot(y)"), 0.75 + 2.0),
        ("dot(x)", ("m1*dot(x)", "m2*dot(y)"), 0.75 + 2.0 + 2.0),  # ẋ (m₁ ẋ + m₂ ẏ)
        ("k", ("m1*x", "m2*y"), 0.75 + 1.5),  # masses with places
        ("k", ("m1*sin(phi)", "l"), 0.75 + 1.5),
        ("dot(y)", ("m1*x", "m2*y"), 0.75),  # which are what a rate is multiplied by
        ("k*delta(y)", ("m1*x", "m2*y"), 0.75),
        ("x", ("k*x", "l*y"), 0.75 + 2.0),  # x (k x + l y)
        ("x", ("k*y", "l*x"), 0.75 + 2.0),
        ("k*x", ("y", "phi"), 0.75),
        ("k", ("k*x", "l*y"), 0.75),
        ("sin(phi)", ("sin(phi)", "cos(phi)"), 0.75),
    ],
)
def test_what_speaks_against_a_bracket(outside: str, inside: tuple[str, ...], price: float) -> None:
    assert price_of_habit(outside, inside) == price
    assert price_of_habit(outside, inside, power=2) == price
    assert price_of_habit(outside, inside, free=True) == 0


def test_a_bracket_in_a_bracket_costs_more() -> None:
    page = Page("m1", "m2", "x", "y", "k", "l", "m1*dot(x)", "dot(x)")
    inner = page.sum("m1", "m2")
    term = page.prices.product(Fraction(1), page.powers("x"), ((inner, 1),))
    outer = page.prices.sum((term, page.term("y")))
    plain = page.prices.product(Fraction(1), page.powers("k"), ((outer, 1),), free=True).price
    assert page.prices.product(Fraction(1), page.powers("k"), ((outer, 1),)).price == plain + 0.75 + 1.0 + 1.5
    deep = page.prices.product(Fraction(1), page.powers("l"), ((page.sum("m1*dot(x)", "dot(x)"), 1),), free=True)
    whole = page.prices.sum((deep, page.term("dot(x)")))
    plain = page.prices.product(Fraction(1), page.powers("k"), ((whole, 1),), free=True).price
    # one degree in the rates, as the bracket is not looked into: masses with rates, a bracket in it, unequal degrees
    assert page.prices.product(Fraction(1), page.powers("k"), ((whole, 1),)).price == plain + 0.75 + 1.0 + 2.0 + 0.5


@pytest.mark.parametrize(
    ("terms", "price"),
    [
        (("m*x", "k*x"), 0.0),
        (("m*dot(x)", "k*dot(y)"), 0.0),
        (("m*dot(x)", "k*dot(x)"), 2.0),
        (("m*dot(x)", "k*dot(x)", "l*dot(x)"), 4.0),
        (("m*dot(x)^2", "k*dot(x)"), 0.0),
        (("m*dot(x)*dot(y)", "k*dot(x)*dot(y)", "l*dot(x)", "c*dot(x)"), 4.0),
        (("m*ddot(x)", "k*ddot(x)"), 3.5),
        (("m*ddot(x)", "k*ddot(x)", "l*ddot(x)"), 7.0),
        (("m*delta(x)", "k*delta(y)"), 0.0),
        (("m*ddot(x)*dot(y)", "k*ddot(x)*dot(y)"), 5.5),
    ],
)
def test_the_same_rates_in_several_terms_of_a_sum_speak_against_it(terms: tuple[str, ...], price: float) -> None:
    page = Page(*terms)
    operations = sum(page.term(text).price for text in terms) + len(terms) - 1
    assert page.sum(*terms).price == operations + price


@pytest.mark.parametrize(
    ("outside", "power", "inside", "price"),
    [
        ("k", 1, ("dot(x)", "y"), 2.0),  # k (ẋ + y) + m ẋ has ẋ twice when it is multiplied out
        ("k", 1, ("dot(y)", "y"), 0.0),
        ("k", 2, ("dot(x)", "y"), 0.0),  # (ẋ + y)² has other products
        ("dot(y)", 1, ("dot(x)", "y"), 0.0),  # so has ẏ (ẋ + y)
    ],
)
def test_the_same_rates_are_found_in_a_bracket(outside: str, power: int, inside: tuple[str, ...], price: float) -> None:
    page = Page(outside, *inside, "m*dot(x)")
    bracketed = page.prices.product(Fraction(1), page.powers(outside), ((page.sum(*inside), power),))
    other = page.term("m*dot(x)")
    assert page.prices.sum((bracketed, other)).price == bracketed.price + other.price + 1 + price


def test_further_factors_join_the_powers_that_are_there() -> None:
    page = Page("m*x", "x^2", "m*x^3", "y", "m", "x")
    times = page.prices.times
    assert times(page.term("m*x"), Fraction(1), page.powers("x^2")) == page.term("m*x^3")
    assert times(page.term("m*x"), Fraction(1), page.powers("x^2")).price == page.term("m*x^3").price
    assert times(page.term("y"), Fraction(3), ()).number == 3
    assert times(times(page.term("y"), Fraction(3), ()), Fraction(1, 2), ()).number == Fraction(3, 2)
    assert times(page.term("y"), Fraction(1), ()) is not None
    bracket = page.prices.product(Fraction(2), (), ((page.sum("m", "y"), 1),), free=True)
    assert times(bracket, Fraction(1), page.powers("x"), free=True).price == 3
    assert times(bracket, Fraction(1), page.powers("x")).price == 3 + 0.75 + 1.5
    assert times(bracket, Fraction(1), page.powers("x")).brackets == bracket.brackets


def multiplied_out(page: Page, plan: Plan) -> dict[str, Fraction]:
    names = {page.alphabet.exponents(mono): text for text, form in page.forms.items() for mono, _, _ in form}
    return {names[key]: number for key, number in expanded(plan, page.alphabet.shape).items()}


def test_a_plan_is_multiplied_out() -> None:
    """3 x (x − y)² (x + y)/2 = 3/2 (x⁴ − x³ y − x² y² + x y³)."""
    page = Page("x", "y", "x^2", "x*y", "y^2", "x^4", "x^3*y", "x^2*y^2", "x*y^3")
    minus = page.prices.sum((page.term("x"), page.prices.times(page.term("y"), Fraction(-1), ())))
    plan = page.prices.product(Fraction(3, 2), page.powers("x"), ((minus, 2), (page.sum("x", "y"), 1)))
    half = Fraction(3, 2)
    assert multiplied_out(page, plan) == {"x^4": half, "x^3*y": -half, "x^2*y^2": -half, "x*y^3": half}
    assert multiplied_out(page, page.prices.product(Fraction(1), (), ((minus, 1), (page.sum("x", "y"), 1)))) == {
        "x^2": 1, "y^2": -1,
    }  # fmt: skip
    gone = page.prices.sum((page.term("x"), page.prices.times(page.term("x"), Fraction(-1), ()), page.term("y")))
    assert multiplied_out(page, gone) == {"y": 1}
    assert in_whole_numbers({(1, 0): 3, (0, 1): -2}, 4) == {(1, 0): Fraction(3, 4), (0, 1): Fraction(-1, 2)}


@pytest.mark.parametrize(
    ("poly", "number", "common", "rest"),
    [
        ({(2, 1): 4, (1, 3): -6}, 2, (1, 1), {(1, 0): 2, (0, 2): -3}),
        ({(2, 1): -4, (1, 3): 6}, -2, (1, 1), {(1, 0): 2, (0, 2): -3}),  # as many minus as plus: the first is positive
        ({(2, 0): 1, (1, 0): -1, (0, 0): -1}, -1, (0, 0), {(2, 0): -1, (1, 0): 1, (0, 0): 1}),
        ({(2, 0): -1, (1, 0): 1, (0, 0): 1}, 1, (0, 0), {(2, 0): -1, (1, 0): 1, (0, 0): 1}),
        ({(2, 0): -3, (2, 2): -3}, -3, (2, 0), {(0, 0): 1, (0, 2): 1}),
        ({(3, 1): 5}, 5, (3, 1), {(0, 0): 1}),
    ],
)
def test_what_terms_share_is_split_off(poly: Poly, number: int, common: tuple[int, ...], rest: Poly) -> None:
    assert split_off(poly) == (number, common, rest)


def test_kinds_of_generators_and_their_order() -> None:
    """What moves fastest first, then functions, coordinates, parameters, masses; in each the order of writing."""
    page = Page("m*k*x*sin(phi)*dot(x)*ddot(x)*delta(x)*d(x)*omega*t*sqrt(x^2 + l^2)*sqrt(k^2 + l^2)*sin(a)*dddot(x)*M")
    assert [(str(g.value), g.kind.name, g.moves) for g in page.alphabet.generators] == [
        ("ddot(x)", "OUTER", True),
        ("dddot(x)", "OUTER", True),
        ("d(x)", "OUTER", True),
        ("delta(x)", "OUTER", True),
        ("dot(x)", "RATE", True),
        ("l**2 + x**2", "KERNEL", True),
        ("sin(phi)", "WAVE", True),
        ("x", "COORDINATE", True),
        ("t", "COORDINATE", True),
        ("k", "PARAMETER", False),
        ("k**2 + l**2", "PARAMETER", False),
        ("omega", "PARAMETER", False),
        ("sin(a)", "PARAMETER", False),
        ("M", "MASS", False),
        ("m", "MASS", False),
    ]


def test_a_plan_that_may_not_be_sought_is_the_plain_sum() -> None:
    page = Page("m1*x + m2*x")
    poly, denominator = page.poly("m1*x + m2*x")
    assert len(Planner(page.alphabet.shape).terms(poly, denominator)) == 1
    assert isinstance(Planner(page.alphabet.shape, budget=0).plan({(1, 0, 1): 1, (0, 1, 0): 1}), Sum)
    squares = {(2, 0, 0): 1, (1, 1, 0): 2, (0, 2, 0): 1}
    assert isinstance(Planner(page.alphabet.shape, budget=1).plan(squares), Product)
    assert isinstance(Planner(page.alphabet.shape, budget=0).plan(squares), Sum)


def written_by_hand(generator: random.Random) -> sympy.Expr:
    """Two or three products, most with a bracket or two and one perhaps squared, as somebody would write a formula."""
    symbols = [SYMBOLS.name(name) for name in ("x", "y", "phi", "l", "k", "a", "c", "m")]
    symbols += [SYMBOLS.rate("x"), SYMBOLS.rate("y"), SYMBOLS.rate("x", 2)]

    def bracket() -> sympy.Expr:
        size = generator.choice((2, 2, 3))
        return sympy.Add(*(generator.choice((1, 1, -1, 2)) * one for one in generator.sample(symbols, size)))

    def product() -> sympy.Expr:
        outside = generator.sample(symbols, generator.choice((1, 1, 2)))
        brackets = [bracket() ** generator.choice((1, 1, 2)) for _ in range(generator.choice((0, 1, 1, 2)))]
        return sympy.Mul(generator.choice((1, -1, 3)), *outside, *brackets, evaluate=False)

    return sympy.Add(*(product() for _ in range(generator.choice((2, 3)))), evaluate=False)


def test_what_thirty_formulas_cost_together() -> None:
    """What was looked for is found: a total that grows is a loss, one that shrinks is to be written down here."""
    generator = random.Random(19)
    total = 0.0
    for _ in range(30):
        reader = KernelReader()
        form = reader.read(sympy.expand(written_by_hand(generator)))
        if form:
            alphabet = Alphabet(reader, ORDER, [form], reader.meaning.__getitem__)
            poly, denominator = alphabet.polynomial(form)
            plan = Planner(alphabet.shape).plan(poly, denominator)
            assert expanded(plan, alphabet.shape) == in_whole_numbers(poly, denominator)
            total += plan.price
    assert total == 699.75
