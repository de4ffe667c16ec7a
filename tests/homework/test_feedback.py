"""What is said of wrong answers: terms by name, states in the symbols of the scene and the language's numbers."""

from __future__ import annotations

from math import cos, exp, sin
from typing import Any

import pytest

from deltaq.homework.service import check_request


def verdict(scene: str, task: str, answer: str, language: str = "en") -> dict[str, Any]:
    return check_request({"scene": scene, "task": task, "answer": {"value": answer}, "lang": language})


@pytest.mark.parametrize(
    ("answer", "term"),
    [
        pytest.param("ddot(phi) = phi", r"\varphi", id="the right side"),
        pytest.param("ddot(phi) + g*phi = 1", r"g \varphi", id="a term of the left side"),
        pytest.param("l*ddot(phi) + g*sin(phi) = m - g", "m", id="a term of the right side"),
    ],
)
def test_the_term_of_another_unit_is_named(answer: str, term: str) -> None:
    assert f"The term ${term}$ has" in verdict("pendulum", "equation:phi", answer)["feedback"]


@pytest.mark.parametrize(
    ("task", "answer", "unknown"),
    [
        pytest.param("equation:x", "(M + m)*ddot(x) = 0", {"ddot(x)"}, id="one equation"),
        pytest.param("equations", "ddot(x) = 0; ddot(phi) = phi", {"ddot(x)", "ddot(phi)"}, id="a set"),
    ],
)
def test_what_is_solved_for_is_not_given(task: str, answer: str, unknown: set[str]) -> None:
    example = verdict("cart-pendulum", task, answer)["counterexample"]
    assert example["of"] == "ddot(x)"
    assert not unknown & set(example["values"])
    assert example["latex"]["ddot(x)"] == r"\ddot{x}"


@pytest.mark.parametrize(
    ("language", "told"),
    [
        pytest.param("de", r"$q_2 = 0{,}9$ ergibt Ihre Antwort $1$, richtig wäre $0{,}7833$.", id="de"),
        pytest.param("en", r"$q_2 = 0.9$", id="en"),
    ],
)
def test_states_are_told_in_symbols_and_the_languages_numbers(language: str, told: str) -> None:
    assert told in verdict("elastic-pendulum", "position:bob", "[1, 2]", language)["feedback"]


def test_the_acceleration_that_differs_is_named() -> None:
    answer = "(M + m)*ddot(x) + m*l*cos(phi)*ddot(phi) - m*l*sin(phi)*dot(phi)^2 = 0; l*ddot(phi) + g*exp(phi) = 0"
    told = verdict("cart-pendulum", "equations", answer)
    at = told["counterexample"]["values"]
    turning = -at["g"] * exp(at["phi"]) / at["l"]  # ddot(phi) of the second equation
    pull = sin(at["phi"]) * at["dot(phi)"] ** 2 - cos(at["phi"]) * turning
    assert told["counterexample"]["yours"] == pytest.approx(at["m"] * at["l"] * pull / (at["M"] + at["m"]), rel=1e-5)
    assert r"your answer gives $\ddot{x} = " in told["feedback"]


@pytest.mark.parametrize(
    ("language", "told"),
    [
        pytest.param("de", "Komponente $y$: Bei ", id="de"),
        pytest.param("en", "Component $y$: at ", id="en"),
    ],
)
def test_the_component_that_differs_is_named(language: str, told: str) -> None:
    assert told in verdict("pendulum", "position:bob", "[l*sin(phi), l*exp(phi)]", language)["feedback"]


def test_units_are_told_with_raised_exponents() -> None:
    told = verdict("elastic-pendulum", "generalized-force:phi", "m*g*sin(phi)")["feedback"]
    assert "has the unit kg m s⁻²; what is asked for has kg m² s⁻²." in told


@pytest.mark.parametrize(
    ("task", "answer"), [("potential-energy", "m*g*l*sin(phi/2)^2"), ("lagrangian", "-m*l*g*phi^2")]
)
def test_what_is_known_up_to_a_constant_differs_whatever_the_constant(task: str, answer: str) -> None:
    """Both agree at the reference, so that no constant makes them agree at the state as well."""
    shifted = [verdict("pendulum", task, f"{answer} + {constant}")["counterexample"] for constant in ("0", "7*m*g*l")]
    assert [one["reference"]["phi"] for one in shifted] == [0.0, 0.0]
    gaps = [one["yours"] - one["right"] for one in shifted]
    assert gaps[0] == pytest.approx(gaps[1], rel=1e-4)
    assert abs(gaps[0]) > 1e-3


@pytest.mark.parametrize(
    ("task", "answer", "language", "told"),
    [
        pytest.param("momentum:y", "10^-9*m*dot(y)", "en", r"$6 \cdot 10^{-10}$", id="a power of ten, no letter e"),
        pytest.param("momentum:y", "12345678*m*dot(y)", "de", r"$7{,}407 \cdot 10^{6}$", id="with a decimal comma"),
        pytest.param("equation:phi", "m*l*ddot(phi) = 0", "en", r"\ddot{q}_1 = 0$", id="nothing, without a sign"),
    ],
)
def test_numbers_are_written_as_formulas_have_them(task: str, answer: str, language: str, told: str) -> None:
    """6e-10 in a formula would be 6 e − 10."""
    assert told in verdict("elastic-pendulum", task, answer, language)["feedback"]
