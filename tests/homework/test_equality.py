"""What counts as the same answer, kind by kind: what the equations cannot tell is right, what loses a motion is not."""

from __future__ import annotations

import functools

import pytest

from deltaq.homework.checking import check
from deltaq.homework.reading import read
from deltaq.homework.workbook import Workbook, workbook_of

PENDULUM = "(l*ddot(phi) + g*sin(phi))"
CART = "(M + m)*ddot(x) + m*l*cos(phi)*ddot(phi) - m*l*sin(phi)*dot(phi)^2"
BOB = "l*ddot(phi) + cos(phi)*ddot(x) + g*sin(phi)"
V = "-m*g*l*cos(phi)"
L = "m*l^2*dot(phi)^2/2 + m*g*l*cos(phi)"
E = "(m*l^2*dot(phi)^2/2 - m*g*l*cos(phi))"
# By M⁻¹ of the two equations (Goldstein, Classical Mechanics, ch. 1, problem of the movable support).
SOLVED = "ddot(x) = (m*l*sin(phi)*dot(phi)^2 {} m*g*sin(phi)*cos(phi))/(M + m*sin(phi)^2)"
FIRST, SECOND = "sqrt(k/m)", "sqrt((k + 2*kappa)/m)"  # two equal masses, k to each wall, κ between them: textbook

EQUATION = [
    # without an acceleration nothing moves: the state is said, not how it goes on
    ("phi = 0", "wrong", "degenerate"),
    ("dot(phi) = 0", "wrong", "degenerate"),
    ("g*sin(phi) = 0", "wrong", "degenerate"),
    ("g = 0", "wrong", "degenerate"),
    ("0 = 0", "wrong", "degenerate"),
    ("0*ddot(phi) + g*sin(phi) = 0", "wrong", "degenerate"),
    ("sqrt(-1 - phi^2) = 0", "wrong", ""),
    # a factor may be anything that vanishes nowhere
    (f"-3*{PENDULUM} = 0", "correct", ""),
    (f"exp(phi)*{PENDULUM} = 0", "correct", ""),
    (f"(2 + cos(phi))*{PENDULUM} = 0", "correct", ""),
    (f"cos(phi)*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"phi*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"dot(phi)*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"t*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"(phi - pi/2)*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"(phi + 7/10)*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"(phi - 9/10)^2*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"(1 + sin(phi))*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"(1 - sin(phi))*{PENDULUM} = 0", "wrong", "factor-vanishes"),
    (f"ddot(phi)*{PENDULUM} = 0", "wrong", ""),
    (f"{PENDULUM}/cos(phi) = 0", "wrong", "factor-vanishes"),
    (f"{PENDULUM}^2 = 0", "wrong", ""),
    ("l*ddot(phi) - g*sin(phi) = 0", "wrong", ""),
]
EQUATIONS = [
    (f"{CART} = 0; {BOB} = 0", "correct", ""),
    (f"{BOB} = 0; {CART} = 0", "correct", ""),
    (f"{CART} + m*({BOB}) = 0; -2*({BOB}) = 0", "correct", ""),
    (f"{CART} = 0", "wrong", ""),
    (f"{CART} = 0; 2*({CART}) = 0", "wrong", "degenerate"),
    (f"{CART} = 0; {BOB} = 0; {CART} = 0", "wrong", "degenerate"),
    (f"x = 0; {BOB} = 0", "wrong", "degenerate"),
    (f"cos(phi)*({CART}) = 0; {BOB} = 0", "wrong", "factor-vanishes"),
    (f"{CART} = 0; {BOB} = 1", "wrong", ""),
]
ONE_OF_TWO = [
    (f"{CART} = 0", "correct", ""),
    (f"{BOB} = 0", "wrong", ""),
    (f"{CART} + m*({BOB}) = 0", "wrong", ""),
    (SOLVED.format("+"), "correct", "solved"),
    (SOLVED.format("-"), "wrong", ""),
    ("dot(x) = 0", "wrong", "degenerate"),
    ("0*ddot(x) = 0", "wrong", "degenerate"),
]
POTENTIAL = [
    (V, "correct", ""),
    (f"{V} + m*g*l", "correct", "constant"),
    (f"{V} + t", "correct", "function-of-time"),
    (f"{V} + phi", "wrong", ""),
    (f"{V} + dot(phi)", "wrong", ""),
    (f"-({V})", "wrong", ""),
]
LAGRANGIAN = [
    (L, "correct", ""),
    (f"{L} + m*l", "correct", "constant"),
    (f"{L} + dot(phi)*sin(phi)", "correct", "total-derivative"),
    (f"{L} + m*l^2*phi*dot(phi)", "correct", "total-derivative"),
    (f"{L} + m*l^2*(t*dot(phi) + phi)", "correct", "total-derivative"),
    (f"{L} + m*l^2*t*dot(phi)", "wrong", ""),
    (f"{L} + m*l^2*ddot(phi)", "wrong", ""),
    (f"2*({L})", "wrong", ""),
]
CONSERVED = [
    (E, "correct", ""),
    (f"3*{E}", "correct", "multiple"),
    (f"-{E}/m", "correct", "multiple"),
    (f"{E} + m*g*l", "correct", "multiple"),
    ("m", "wrong", "degenerate"),
    (f"0*{E}", "wrong", "degenerate"),
    (f"{E}^2", "wrong", ""),
    (f"phi*{E}", "wrong", ""),
    (f"{E} + m*g*l*phi", "wrong", ""),
    ("dot(phi)", "wrong", ""),
]
FREQUENCIES = [  # m = 1 kg, k = 30 N/m, κ = 6 N/m: √30 and √42
    (f"{FIRST}; {SECOND}", "correct", ""),
    (f"{SECOND}; {FIRST}", "correct", ""),
    ("5.48; 6.48", "correct", "rounded"),
    ("6.48; 5.48", "correct", "rounded"),
    ("5.48; 6.53", "wrong", ""),
    ("-5.48; 6.48", "wrong", ""),
    (f"{FIRST}; {FIRST}", "wrong", ""),
    (f"{FIRST}", "wrong", ""),
    (f"-{FIRST}; {SECOND}", "wrong", ""),
    (f"{FIRST}; sqrt((k + kappa)/m)", "wrong", ""),
    (f"{FIRST}; sqrt(42)", "wrong", ""),
]
CASES = [
    pytest.param(scene, task, *case, id=f"{task} {case[0]}")
    for scene, task, cases in (
        ("pendulum", "equation:phi", EQUATION),
        ("cart-pendulum", "equations", EQUATIONS),
        ("cart-pendulum", "equation:x", ONE_OF_TWO),
        ("pendulum", "potential-energy", POTENTIAL),
        ("pendulum", "lagrangian", LAGRANGIAN),
        ("pendulum", "conserved:1", CONSERVED),
        ("two-mass-oscillator", "eigenfrequencies", FREQUENCIES),
    )
    for case in cases
]


@functools.cache
def workbook(scene: str) -> Workbook:
    return workbook_of({"scene": scene})


@pytest.mark.parametrize(("scene", "task", "answer", "outcome", "remark"), CASES)
def test_answer(scene: str, task: str, answer: str, outcome: str, remark: str) -> None:
    verdict = check(workbook(scene), workbook(scene).task(task), answer, "plain")
    assert (verdict.outcome, verdict.remark) == (outcome, remark), verdict


@pytest.mark.parametrize("answer", ["phi = 0", "dot(phi)^2 = 1", "0 = 0", "g*sin(phi) = 0"])
def test_no_exact_test_takes_an_equation_without_accelerations_for_the_right_one(answer: str) -> None:
    """Nor where no numbers have told so beforehand."""
    book = workbook("pendulum")
    task = book.task("equation:phi")
    given = read(task, book.solution, answer, "plain").parts
    assert task.quantity.equality.same(given, book.right(task), book.solution).equal is False
