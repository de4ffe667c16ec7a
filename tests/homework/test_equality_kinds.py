"""Each kind of equality by itself: what its numbers tell, and what its exact test decides without them.

An answer is checked twice, by numbers and exactly, so that a fault in one of the two shows here alone.
"""

from __future__ import annotations

import functools
import math
import tomllib
from importlib.resources import files

import pytest

from deltaq.homework.checking import compare
from deltaq.homework.equality import Match, Parts, equation, expression, weakest
from deltaq.homework.equality.frequencies import number_of
from deltaq.homework.reading import read
from deltaq.homework.sampling import CLOSE, close
from deltaq.homework.task import Task
from deltaq.homework.workbook import Workbook, workbook_of

YES, NO, UNDECIDED = Match(equal=True), Match(equal=False), Match(equal=None)
CONSTANT, OF_TIME, DERIVATIVE, MULTIPLE, ROUNDED, SOLVED = (
    Match(equal=True, remark=remark)
    for remark in ("constant", "function-of-time", "total-derivative", "multiple", "rounded", "solved")
)
VANISHES = Match(equal=False, remark="factor-vanishes")

PENDULUM = "(l*ddot(phi) + g*sin(phi))"
CART = "((M + m)*ddot(x) + m*l*cos(phi)*ddot(phi) - m*l*sin(phi)*dot(phi)^2)"
BOB = "(l*ddot(phi) + cos(phi)*ddot(x) + g*sin(phi))"
L = "m*l^2*dot(phi)^2/2 + m*g*l*cos(phi)"
E = "(m*l^2*dot(phi)^2/2 - m*g*l*cos(phi))"
V = "-m*g*l*cos(phi)"
T = "m*l^2*dot(phi)^2/2"
R = "(m*ddot(r) - m*r*dot(phi)^2 + k*(r - r0) - m*g*cos(phi))"  # spring pendulum, 0.5 ≤ r ≤ 1.8, |φ| ≤ 3.1
NOWHERE = "log(cos(phi) - 2)"  # real at no angle: undecided
FIRST, SECOND = "sqrt(k/m)", "sqrt((k + 2*kappa)/m)"  # √30 and √42 at the scene's values

# scene, task, answer, what the numbers tell, what the exact test decides
ROWS = [
    ("pendulum", "kinetic-energy", T, "alike", YES),
    ("pendulum", "kinetic-energy", f"{T}*(sin(phi)^2 + cos(phi)^2)", "alike", YES),
    ("pendulum", "kinetic-energy", f"{T} + m", "other", NO),
    ("pendulum", "kinetic-energy", f"{T} + {NOWHERE}", "untold", UNDECIDED),
    ("pendulum", "kinetic-energy", "exp(exp(exp(7 + phi)))", "untold", NO),
    ("pendulum", "position:bob", "[l*sin(phi), l*cos(phi)]", "alike", YES),
    ("pendulum", "position:bob", "[l*cos(phi), l*cos(phi)]", "other", NO),
    ("pendulum", "position:bob", "[l*sin(phi), l*sin(phi)]", "other", NO),
    ("pendulum", "position:bob", f"[l*sin(phi), {NOWHERE}]", "untold", UNDECIDED),
    ("pendulum", "position:bob", f"[l, {NOWHERE}]", "untold", NO),
    ("pendulum", "potential-energy", V, "alike", YES),
    ("pendulum", "potential-energy", f"{V}*(sin(phi)^2 + cos(phi)^2)", "alike", YES),
    ("pendulum", "potential-energy", f"{V} + 2*m*g*l", "alike", CONSTANT),
    ("pendulum", "potential-energy", f"{V} + t^2", "alike", OF_TIME),
    ("pendulum", "potential-energy", f"{V} + m*g*l*(sin(phi)^2 + cos(phi)^2)", "alike", CONSTANT),
    ("pendulum", "potential-energy", f"{V} + m*g*l*phi", "other", NO),
    ("pendulum", "potential-energy", f"{V} + m*dot(phi)^2", "other", NO),
    ("pendulum", "potential-energy", f"2*({V})", "other", NO),
    ("pendulum", "potential-energy", "m", "other", NO),
    ("pendulum", "potential-energy", f"{V} + {NOWHERE}", "untold", NO),
    ("pendulum", "lagrangian", L, "alike", YES),
    ("pendulum", "lagrangian", f"{L} - 3*m", "alike", CONSTANT),
    ("pendulum", "lagrangian", f"{L} + t", "alike", OF_TIME),
    ("pendulum", "lagrangian", f"{L} + m*l^2*(2*t*phi*dot(phi) + phi^2)", "alike", DERIVATIVE),
    ("pendulum", "lagrangian", f"{L} + dot(phi)*cos(phi)", "alike", DERIVATIVE),
    ("pendulum", "lagrangian", f"{L} + t*dot(phi)", "other", NO),
    ("pendulum", "lagrangian", f"{L} + m*g*phi", "other", NO),
    ("pendulum", "lagrangian", f"{L} + dot(phi)^2", "other", NO),
    ("pendulum", "lagrangian", f"{L} + {NOWHERE}", "other", NO),
    ("pendulum", "conserved:1", E, "alike", YES),
    ("pendulum", "conserved:1", f"{E}*(sin(phi)^2 + cos(phi)^2)", "alike", YES),
    ("pendulum", "conserved:1", f"-2*{E}/(m*l) + g", "alike", MULTIPLE),
    ("pendulum", "conserved:1", f"{E} + m*g*l", "alike", MULTIPLE),
    ("pendulum", "conserved:1", "dot(phi)^2/2 - g/l*cos(phi)", "alike", MULTIPLE),
    ("pendulum", "conserved:1", f"{E} + m*g*l*cos(phi)/2", "other", NO),
    ("pendulum", "conserved:1", f"t*{E}", "alike", NO),  # the time is the same at all points
    ("pendulum", "conserved:1", f"{E} + m*l^2*ddot(phi)*dot(phi)", "other", NO),
    ("pendulum", "conserved:1", f"{E}/10^15", "alike", MULTIPLE),
    ("pendulum", "conserved:1", "m*g*l", "nothing", NO),
    ("pendulum", "conserved:1", "10^12*m*(sin(phi)^2 + cos(phi)^2)", "nothing", NO),
    ("spherical-pendulum", "conserved:1", "sin(theta)^2*dot(psi)", "alike", MULTIPLE),
    ("spherical-pendulum", "conserved:1", "dot(psi)", "other", NO),
    ("spherical-pendulum", "conserved:1", "theta*dot(psi)", "other", NO),
    ("pendulum", "conserved:1", f"{E} + {NOWHERE}", "untold", NO),
    ("pendulum", "equation:phi", f"-3*{PENDULUM} = 0", "alike", YES),
    ("pendulum", "equation:phi", "ddot(phi) = -g/l*sin(phi)", "alike", YES),
    ("pendulum", "equation:phi", "ddot(phi) = g/l*sin(phi)", "other", NO),
    ("pendulum", "equation:phi", "ddot(phi) = 0", "other", NO),
    ("pendulum", "equation:phi", "ddot(phi)^2 = 0", "untold", NO),
    ("pendulum", "equation:phi", f"ddot(phi)*{PENDULUM} = 0", "untold", NO),
    ("pendulum", "equation:phi", "g*sin(phi) = 0", "nothing", NO),
    ("pendulum", "equation:phi", "0 = 0", "nothing", NO),
    ("pendulum", "equation:phi", f"(abs(phi - 1) + phi - 1)*{PENDULUM} = 0", "nothing", VANISHES),  # for φ < 1
    ("pendulum", "equation:phi", f"{PENDULUM} + {NOWHERE} = 0", "untold", UNDECIDED),
    ("pendulum", "equation:phi", f"{NOWHERE}*{PENDULUM} = 0", "untold", UNDECIDED),
    ("cart-pendulum", "equation:x", f"{CART} = 0", "alike", YES),
    ("cart-pendulum", "equation:x", f"{BOB} = 0", "other", NO),
    ("cart-pendulum", "equation:phi", f"{BOB} = 0", "alike", YES),
    ("cart-pendulum", "equation:phi", f"{CART} = 0", "other", NO),
    ("cart-pendulum", "equations", f"{BOB} = 0; 2*{CART} - {BOB}*m = 0", "alike", YES),
    ("cart-pendulum", "equations", f"{BOB} = 0; {CART} = m", "other", NO),
    ("cart-pendulum", "equations", f"{BOB} = g; {CART} = 0", "other", NO),
    ("cart-pendulum", "equations", f"{BOB} = 0; 2*{BOB} = 0", "nothing", NO),
    ("cart-pendulum", "equations", f"{BOB} = 0; x = 0", "nothing", NO),
    ("cart-pendulum", "equations", f"{BOB} = 0", "other", NO),
    ("cart-pendulum", "equations", f"{BOB} = 0; {CART} + ddot(x)^2 = 0", "untold", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"{SECOND}; {FIRST}", "alike", YES),
    ("two-mass-oscillator", "eigenfrequencies", f"{SECOND}*(sin(x1)^2 + cos(x1)^2); {FIRST}", "alike", YES),
    ("two-mass-oscillator", "eigenfrequencies", f"{FIRST}; {FIRST}", "other", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"{FIRST}; {SECOND}; {SECOND}", "other", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"{FIRST}; sqrt((k + 12)/m)", "other", NO),
    ("two-mass-oscillator", "eigenfrequencies", "5.4772256; 6.4807407", "other", ROUNDED),
    ("two-mass-oscillator", "eigenfrequencies", "5.502; 6.51", "other", ROUNDED),  # 4.5 ‰ too much
    ("two-mass-oscillator", "eigenfrequencies", "5.453; 6.451", "other", ROUNDED),
    ("two-mass-oscillator", "eigenfrequencies", "5.510; 6.48", "other", NO),  # 6 ‰ too much
    ("two-mass-oscillator", "eigenfrequencies", "5.444; 6.48", "other", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"-{FIRST}; {SECOND}", "untold", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"0*k; {SECOND}", "untold", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"sqrt(k/m - 100); {SECOND}", "untold", NO),
    ("two-mass-oscillator", "eigenfrequencies", f"{FIRST}; sqrt(k - 100)", "untold", NO),
]
# A factor that vanishes somewhere where the scene can be loses motions; one that vanishes elsewhere does not.
FACTORS = [
    ("spring-pendulum", f"r*{R}", True),
    ("spring-pendulum", f"(r + 1)*{R}", True),
    ("spring-pendulum", f"(2 + cos(phi + r))*{R}", True),
    ("spring-pendulum", f"exp(-r^2 - dot(r)^2 - dot(phi)^2 - phi^2)*{R}", True),
    ("spring-pendulum", f"{R}/(r + r0)^2", True),
    ("spring-pendulum", f"{R}/r", True),
    ("spring-pendulum", f"(r - 1)*{R}", False),
    ("spring-pendulum", f"(r - 9/10)^2*{R}", False),
    ("spring-pendulum", f"(phi^2 + (dot(r) - 9/10)^2)*{R}", False),
    ("spring-pendulum", f"cos(phi)*(2 + sin(r) + sin(dot(r)) + sin(dot(phi)))*{R}", False),
    ("spring-pendulum", f"(2 + sin(r + dot(r) + dot(phi)))*dot(r)*cos(phi)*{R}", False),
    ("spring-pendulum", f"(1 + phi*dot(r))*(2 + sin(r + dot(phi)))*{R}", False),
    ("spring-pendulum", f"(phi + 7/10)^2*{R}", False),
    ("spring-pendulum", f"{R}/cos(phi)", False),
    ("spring-pendulum", f"{R}/sin(phi)", False),
    ("spring-pendulum", f"{R}/(1 - cos(phi))", False),
    ("spring-pendulum", f"{R}/phi^2", False),
    ("spring-pendulum", f"sqrt(phi)*{R}", False),
    ("spring-pendulum", f"(1 + cos(phi))*{R}", False),  # the slider ends short of π, the motion does not
    ("spring-pendulum", f"(1 - cos(phi))*{R}", False),
    ("spring-pendulum", f"k*m/(m + k)*{R}", True),
]
# A mass on a spring that can be between two ends only.
BETWEEN = [
    (0.1, 0.6, "q", True),
    (0.1, 0.6, "(q - 7/10)", True),
    (0.1, 0.6, "(q - 35/100)", False),
    (0.1, 0.6, "sqrt(q - 3/10)", False),
    (0.1, 0.6, "sqrt(4/10 - q)", False),
    (0.1, 0.6, "q*(7/10 - q)", True),
    (0.0, 0.9, "q", False),  # the ends belong to it
    (0.0, 0.9, "(q - 9/10)", False),
    (0.01, 0.89, "q*(q - 9/10)", True),
    (None, 0.9, "(q - 2)", False),  # one end is none
    (0.1, None, "(q + 2/10)", False),
    (None, None, "(q^2 + q + 1)", True),
]
# Once around, nearly so, and half a turn, as a polar angle between its poles has it.
AROUND = [(-3.1, 3.1, False), (-math.pi, math.pi, False), (0.0, 6.2, False), (0.1, 3.0, True), (-1.5, 1.5, True)]
MOMENT = "(m*l^2*ddot(phi) + m*g*l*sin(phi) - M)"  # a moment may have either sign


@functools.cache
def asked(scene: str, task: str) -> tuple[Workbook, Task]:
    book = workbook_of({"scene": scene})
    return book, book.task(task)


def parts_of(scene: str, task: str, answer: str) -> Parts:
    book, one = asked(scene, task)
    return read(one, book.solution, answer, "plain").parts


def numbers_tell(scene: str, task: str, answer: str) -> str:
    """What is known from numbers alone, as `checking.compare` reads them."""
    book, one = asked(scene, task)
    own, right = one.quantity.equality.fingerprint(parts_of(scene, task, answer), book.sampler), book.fingerprint(one)
    assert right
    if not own:
        return "untold" if own is None else "nothing"
    return "alike" if len(own) == len(right) and close(own, right, CLOSE) else "other"


@pytest.mark.parametrize(("scene", "task", "answer", "numbers", "exact"), ROWS, ids=lambda value: str(value)[:60])
def test_numbers_and_the_exact_test_each_for_itself(
    scene: str, task: str, answer: str, numbers: str, exact: Match
) -> None:
    book, one = asked(scene, task)
    decided = one.quantity.equality.same(parts_of(scene, task, answer), book.right(one), book.solution)
    assert (numbers_tell(scene, task, answer), decided) == (numbers, exact)


@pytest.mark.parametrize(("scene", "answer", "harmless"), FACTORS, ids=lambda value: str(value)[:60])
def test_a_factor_is_harmless_where_it_vanishes_nowhere_in_the_range(scene: str, answer: str, harmless: bool) -> None:
    book, one = asked(scene, "equation:r")
    decided = one.quantity.equality.same(parts_of(scene, "equation:r", answer), book.right(one), book.solution)
    assert decided == (YES if harmless else VANISHES)


def between(energy: str, position: str = "q", **ends: float) -> Workbook:
    """A mass on a straight line with a potential energy."""
    scene = {
        "format": 1,
        "id": "between",
        "title": {"en": "Between"},
        "dimension": 2,
        "coordinates": [{"name": "q", "value": 0.2, **ends}],
        "parameters": [{"name": "m", "value": 1.0}, {"name": "k", "value": 3.0}],
        "bodies": [{"name": "mass", "kind": "particle", "mass": "m", "position": [position, "0"]}],
        "loads": [{"name": "spring", "kind": "potential", "energy": energy}],
    }
    return workbook_of({"scene": scene})


@pytest.mark.parametrize(
    ("answer", "equal"),
    [
        pytest.param("k*sqrt(1 - 16*q^2)", True, id="the same"),
        pytest.param("k*sqrt((1 - 4*q)*(1 + 4*q)) + m", True, id="up to a constant"),
        pytest.param("k*q^2", None, id="another, which is not shown without numbers"),
    ],
)
def test_where_the_right_answer_has_no_numbers_the_exact_test_decides(answer: str, equal: bool | None) -> None:
    """It is real for small q alone, and the numbers are taken at larger ones."""
    book = between("k*sqrt(1 - 16*q^2)")
    task = book.task("potential-energy")
    assert book.fingerprint(task) is None
    assert compare(book, task, read(task, book.solution, answer, "plain").parts).equal is equal


@pytest.mark.parametrize(("least", "most", "harmless"), AROUND)
def test_an_angle_that_goes_around_passes_every_value(least: float, most: float, harmless: bool) -> None:
    document = tomllib.loads(files("deltaq.scenes").joinpath("pendulum.toml").read_text(encoding="utf-8"))
    document["coordinates"][0] |= {"min": least, "max": most}
    book = workbook_of({"scene": document})
    task = book.task("equation:phi")
    given = read(task, book.solution, f"(1 + cos(phi))*{PENDULUM} = 0", "plain").parts
    assert task.quantity.equality.same(given, book.right(task), book.solution) == (YES if harmless else VANISHES)


@pytest.mark.parametrize(("least", "most", "factor", "harmless"), BETWEEN)
def test_a_factor_may_vanish_where_the_coordinate_cannot_be(
    least: float | None, most: float | None, factor: str, harmless: bool
) -> None:
    ends = {name: value for name, value in (("min", least), ("max", most)) if value is not None}
    book = between("k*q^2/2", **ends)
    task = book.task("equation:q")
    given = read(task, book.solution, f"{factor}*(m*ddot(q) + k*q) = 0", "plain").parts
    assert task.quantity.equality.same(given, book.right(task), book.solution) == (YES if harmless else VANISHES)


def test_where_the_right_equation_is_undefined_no_factor_is_blamed() -> None:
    """The mass is at q + q√q, so that there is nothing left of q = 0, and no range says so."""
    book = between("k*q^2/2", "q + q*sqrt(q)")
    task = book.task("equation:q")
    equality, right = task.quantity.equality, book.right(task)
    q = book.solution.q("q")
    decided = [equality.same((factor * right[0],), right, book.solution) for factor in (2, 1 + q**2, q - 1)]
    assert decided == [YES, YES, VANISHES]


@pytest.mark.parametrize(
    ("factor", "decided"),
    [
        pytest.param("m", YES, id="a mass is positive"),
        pytest.param("(m + l)", YES, id="so is a sum of such"),
        pytest.param("M", VANISHES, id="a moment may be none"),
        pytest.param("(M - 9/10)", VANISHES, id="or of another size"),
    ],
)
def test_a_parameter_vanishes_only_if_it_is_not_said_to_be_positive(factor: str, decided: Match) -> None:
    book, one = asked("pendulum-with-moment", "equation:phi")
    given = parts_of("pendulum-with-moment", "equation:phi", f"{factor}*{MOMENT} = 0")
    assert one.quantity.equality.same(given, book.right(one), book.solution) == decided


# By M⁻¹ of the two equations (Goldstein, Classical Mechanics, ch. 1, problem of the movable support).
MOVED = "(m*l*sin(phi)*dot(phi)^2 + m*g*sin(phi)*cos(phi))/(M + m*sin(phi)^2)"


@pytest.mark.parametrize(
    ("answer", "decided"),
    [
        (f"ddot(x) = {MOVED}", SOLVED),
        (f"2*(M + m*sin(phi)^2)*(ddot(x) - {MOVED}) = 0", SOLVED),
        (f"{CART} = 0", SOLVED),
        (f"ddot(x) = 2*{MOVED}", NO),
        (f"ddot(x) = {MOVED} + g", NO),
        (f"ddot(x) = {MOVED} + {NOWHERE}", UNDECIDED),
    ],
)
def test_an_equation_solved_with_the_whole_set(answer: str, decided: Match) -> None:
    book, _ = asked("cart-pendulum", "equation:x")
    assert equation.same_solved(parts_of("cart-pendulum", "equation:x", answer), book.solution) == decided


def test_vectors_of_other_lengths_are_other_vectors() -> None:
    book, one = asked("pendulum", "position:bob")
    right = book.right(one)
    assert expression.same(right[:1], right, book.solution) == NO
    assert expression.same((*right, right[0]), right, book.solution) == NO


@pytest.mark.parametrize(
    ("outcomes", "whole"),
    [
        ([], True),
        ([True, True], True),
        ([True, None], None),
        ([None, False, True], False),
    ],
)
def test_the_weakest_decision_is_that_of_the_whole(outcomes: list[bool | None], whole: bool | None) -> None:
    assert weakest(outcomes) is whole


@pytest.mark.parametrize(
    ("answer", "value"), [("sqrt(k/m)", 5.477225575051661), ("4", 4.0), ("k/m/10", 3.0), ("sqrt(k - 100)", None)]
)
def test_a_frequency_has_its_value_in_the_scene(answer: str, value: float | None) -> None:
    book, _ = asked("two-mass-oscillator", "eigenfrequencies")
    (part,) = parts_of("two-mass-oscillator", "eigenfrequencies", answer)
    found = number_of(part, book.solution)
    assert found != found if value is None else found == pytest.approx(value, rel=1e-12)  # noqa: PLR0124
