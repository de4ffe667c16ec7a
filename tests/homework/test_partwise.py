"""What is said of the parts of an answer."""

from __future__ import annotations

import pytest

from deltaq.homework.checking import check
from deltaq.homework.service import check_request
from deltaq.homework.workbook import workbook_of

CASES = [
    pytest.param("pendulum", "position:bob", "[l*sin(phi), l*sin(phi)]", ("correct", "wrong"), id="component"),
    pytest.param("pendulum", "position:bob", "[l*sin(phi), l*cos(phi)]", (), id="all right"),
    pytest.param(
        "pendulum", "position:bob", "[l*sin(phi), sqrt(sin(phi) - 2)]", ("correct", "undecided"), id="never real"
    ),
    pytest.param("pendulum", "kinetic-energy", "m*l^2", (), id="a single part"),
    pytest.param(
        "cart-pendulum",
        "equations",
        "(M + m)*ddot(x) + m*l*cos(phi)*ddot(phi) - m*l*sin(phi)*dot(phi)^2 = 0; ddot(phi) = 0",
        ("correct", "wrong"),
        id="equation of a set",
    ),
    pytest.param("cart-pendulum", "equations", "x = 0; ddot(x)^2 = 0", ("wrong", "wrong"), id="no accelerations"),
]


@pytest.mark.parametrize(("scene", "task", "answer", "expected"), CASES)
def test_parts(scene: str, task: str, answer: str, expected: tuple[str, ...]) -> None:
    workbook = workbook_of({"scene": scene})
    assert check(workbook, workbook.task(task), answer, "plain").parts == expected


def test_one_of_two_frequencies() -> None:
    workbook = workbook_of({"scene": "two-mass-oscillator"})
    task = workbook.task("eigenfrequencies")
    right = workbook.right(task)[0]
    assert check(workbook, task, f"{right}; 1".replace("**", "^"), "plain").parts == ("correct", "wrong")


@pytest.mark.parametrize(
    ("answer", "share"),
    [("sqrt(g)/l", 0.0), ("sqrt(l*g)", 0.0), ("g/l", 0.0), ("sqrt(g/l); 3.13", 0.5), ("3.13", 1.0), ("sqrt(g/l)", 1.0)],
)
def test_a_frequency_that_is_right_for_a_length_of_one_metre_only_earns_nothing(answer: str, share: float) -> None:
    """The pendulum of the library is 1 m long."""
    asked = {"scene": "pendulum", "task": "eigenfrequencies", "answer": {"value": answer}, "lang": "en"}
    assert check_request(asked)["share"] == share


@pytest.mark.parametrize(
    ("scene", "answer", "share"),
    [
        pytest.param(
            "pendulum-with-moment", "((m*g*l)^2 - M^2)^(1/4)/(l*sqrt(m)); 1", 0.5, id="not real where m g l < M"
        ),
        pytest.param("pendulum-with-moment", "2*((m*g*l)^2 - M^2)^(1/4)/(l*sqrt(m)); 1", 0.0, id="nor is its double"),
        pytest.param("two-mass-oscillator", "sqrt(k/m)*(sin(x1)^2 + cos(x1)^2); 1", 0.5, id="motion that cancels"),
        pytest.param("two-mass-oscillator", "sqrt(k/m)*sin(x1)^2; 1", 0.0, id="motion that stays"),
    ],
)
def test_a_frequency_is_right_in_any_form_that_the_whole_answer_may_have(scene: str, answer: str, share: float) -> None:
    asked = {"scene": scene, "task": "eigenfrequencies", "answer": {"value": answer}, "lang": "en"}
    assert check_request(asked)["share"] == share


@pytest.mark.parametrize(("answer", "share"), [("[x, 0]", 1.0), ("[x, 1]", 0.0), ("[2*x, 0]", 0.0)])
def test_a_component_that_should_be_zero_and_is_not_costs_what_another_earns(answer: str, share: float) -> None:
    asked = {"scene": "cart-pendulum", "task": "position:cart", "answer": {"value": answer}, "lang": "en"}
    assert check_request(asked)["share"] == share
