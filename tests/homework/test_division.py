"""What may be divided out of an equation though it can be zero, and what may not.

The mass on a spring in polar coordinates without a range: r² θ̈ + 2 r ṙ θ̇ + g r sin θ = 0 says nothing where r = 0.
"""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.homework.checking import check
from deltaq.homework.equality.division import _solved_left
from deltaq.homework.service import check_request
from deltaq.homework.workbook import workbook_of

TURN = "(r*theta'' + 2*r'*theta' + g*sin(theta))"
ALONG = "(m*r'' - m*r*theta'^2 + k*r - m*g*cos(theta))"
SCENE = {
    "format": 1,
    "id": "polar",
    "title": {"en": "Mass on a spring"},
    "dimension": 2,
    "coordinates": [{"name": "r", "unit": "m", "value": 1.0}, {"name": "theta", "unit": "rad", "value": 0.3}],
    "parameters": [
        {"name": "m", "unit": "kg", "value": 1.0},
        {"name": "k", "unit": "N/m", "value": 3.0},
        {"name": "g", "unit": "m/s^2", "value": 9.81},
    ],
    "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["r*sin(theta)", "r*cos(theta)"]}],
    "loads": [
        {"name": "spring", "kind": "potential", "energy": "k*r^2/2"},
        {"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]},
    ],
}


@pytest.mark.parametrize(
    ("task", "answer", "outcome", "remark"),
    [
        ("equation:theta", f"m*r*{TURN} = 0", "correct", ""),
        ("equation:theta", f"{TURN} = 0", "correct", "divided"),
        ("equation:theta", f"-3*m*{TURN} = 0", "correct", "divided"),
        ("equation:theta", "theta'' = -2*r'*theta'/r - g*sin(theta)/r", "correct", "divided"),
        ("equation:theta", f"theta*{TURN} = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"r'*{TURN} = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"r^2*{TURN} = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"(r - 3/10)*{TURN} = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"(r - 3/10)*{TURN}/r = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"{TURN}/sin(theta) = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"{TURN}/(1 - cos(theta)) = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"{TURN}/theta^2 = 0", "wrong", "factor-vanishes"),
        ("equation:r", f"{ALONG} = 0", "correct", ""),
        ("equation:r", f"{ALONG}/r = 0", "wrong", "factor-vanishes"),
        ("equations", f"{ALONG} = 0; {TURN} = 0", "correct", "divided"),
        ("equations", f"{ALONG} = 0; {TURN}/r = 0", "correct", "divided"),
        ("equations", f"{ALONG} + m*{TURN} = 0; {TURN} = 0", "correct", "divided"),
        ("equations", f"theta*{ALONG} = 0; {TURN} = 0", "wrong", "factor-vanishes"),
        ("equations", f"r*{ALONG} = 0; {TURN} = 0", "wrong", "factor-vanishes"),
        ("equations", f"{ALONG}/r = 0; {TURN} = 0", "wrong", "factor-vanishes"),
    ],
)
def test_only_what_the_right_equation_has_in_all_terms_is_divided_out(
    task: str, answer: str, outcome: str, remark: str
) -> None:
    workbook = workbook_of({"scene": SCENE})
    verdict = check(workbook, workbook.task(task), answer, "plain")
    assert (verdict.outcome, verdict.remark) == (outcome, remark)


NUMBERS = {
    **SCENE,
    "id": "of-numbers",
    "parameters": [{"name": "g", "unit": "m/s^2", "value": 9.81}],
    "bodies": [{"name": "bob", "kind": "particle", "mass": "2", "position": ["r*sin(theta)", "r*cos(theta)"]}],
    "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}],
}


@pytest.mark.parametrize(
    ("task", "answer", "outcome", "remark"),
    [
        ("equation:theta", f"2*r*{TURN} = 0", "correct", ""),
        ("equation:theta", f"{TURN} = 0", "correct", "divided"),
        ("equation:theta", f"{TURN}/r^2 = 0", "correct", "divided"),
        ("equation:theta", f"r*{TURN}/sin(theta) = 0", "wrong", "factor-vanishes"),
        ("equation:theta", f"r^2*{TURN} = 0", "wrong", "factor-vanishes"),
        ("equation:r", "r'' = r*theta'^2 + g*cos(theta)", "correct", ""),
        ("equation:r", "r*(r'' - r*theta'^2 - g*cos(theta)) = 0", "wrong", "factor-vanishes"),
    ],
)
def test_a_coordinate_is_divided_out_where_no_parameter_stands_before_it(
    task: str, answer: str, outcome: str, remark: str
) -> None:
    """The mass is a number: the matrix of the equations holds nothing but r."""
    workbook = workbook_of({"scene": NUMBERS})
    verdict = check(workbook, workbook.task(task), answer, "plain")
    assert (verdict.outcome, verdict.remark) == (outcome, remark)


SWING = "(sin(theta)*psi'' + 2*cos(theta)*theta'*psi')"
SPHERE = {
    "format": 1,
    "id": "sphere",
    "title": {"en": "On a sphere"},
    "dimension": 3,
    "coordinates": [{"name": "theta", "unit": "rad", "value": 0.5}, {"name": "psi", "unit": "rad", "value": 0.2}],
    "parameters": [{"name": "m", "unit": "kg", "value": 1.0}, {"name": "R", "unit": "m", "value": 1.0}],
    "bodies": [
        {
            "name": "bob",
            "kind": "particle",
            "mass": "m",
            "position": ["R*sin(theta)*cos(psi)", "R*sin(theta)*sin(psi)", "R*cos(theta)"],
        }
    ],
}


@pytest.mark.parametrize(
    ("answer", "outcome", "remark"),
    [
        (f"m*R^2*sin(theta)*{SWING} = 0", "correct", ""),
        (f"{SWING} = 0", "correct", "divided"),
        (f"{SWING}/sin(theta) = 0", "correct", "divided"),
        (f"cos(theta)*{SWING} = 0", "wrong", "factor-vanishes"),
        (f"{SWING}/cos(theta) = 0", "wrong", "factor-vanishes"),
        (f"theta*{SWING} = 0", "wrong", "factor-vanishes"),
    ],
)
def test_a_sine_may_be_divided_out_where_it_stands_in_all_terms(answer: str, outcome: str, remark: str) -> None:
    """R² sin²θ ψ̈ + 2 R² sin θ cos θ θ̇ ψ̇ = 0 says nothing at both poles of the sphere."""
    workbook = workbook_of({"scene": SPHERE})
    verdict = check(workbook, workbook.task("equation:psi"), answer, "plain")
    assert (verdict.outcome, verdict.remark) == (outcome, remark)


def test_the_condition_is_told() -> None:
    asked = {"scene": SCENE, "task": "equation:theta", "answer": {"value": f"{TURN} = 0"}, "lang": "en"}
    assert r"$r \neq 0$" in check_request(asked)["feedback"]


def test_a_mistake_in_a_divided_equation_is_named_all_the_same() -> None:
    workbook = workbook_of({"scene": SCENE})
    halved = check(workbook, workbook.task("equation:theta"), "r*theta'' + r'*theta' + g*sin(theta) = 0", "plain")
    assert halved.misconceptions == ("total-derivative-halved",)
    assert [(slip.kind, slip.place.offset) for slip in halved.slips if slip.place] == [("half", 12)]


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_a_row_is_solved_for_from_the_left(size: int) -> None:
    """x A = b, by NumPy as well; rows and columns may stand in any order, also with zeros on the diagonal."""
    draw = np.random.default_rng(size)
    for _ in range(20):
        matrix, row = draw.uniform(-2.0, 2.0, (size, size)), draw.uniform(-2.0, 2.0, size)
        matrix[draw.integers(size), draw.integers(size)] = 0.0 if size > 1 else 1.0
        np.testing.assert_allclose(_solved_left(matrix.tolist(), row.tolist()) @ matrix, row, rtol=1e-9, atol=1e-9)
    swapped = np.eye(size)[::-1]
    assert _solved_left(swapped.tolist(), row.tolist()) == row[::-1].tolist()
    assert np.isnan(_solved_left(np.zeros((size, size)).tolist(), row.tolist())).all()
