"""What is told of one wrong term is true: the change makes it right, and what is marked is the student's own."""

from __future__ import annotations

from typing import Any

import pytest

from deltaq.homework.checking import check
from deltaq.homework.service import check_request, lines_request
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import workbook_of
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.tree import Span
from deltaq.language.typography import Typography
from deltaq.language.written_latex import written_latex


def verdict_on(scene: str, task: str, answer: str) -> Verdict:
    workbook = workbook_of({"scene": scene})
    return check(workbook, workbook.task(task), answer, "plain")


@pytest.mark.parametrize(
    ("scene", "task", "answer", "wrong"),
    [
        ("cart-pendulum", "kinetic-energy", "(M + m)*x'^2/2 + m*l*x'*phi'*sin(phi) + m*l^2*phi'^2/2", ["sin(phi)"]),
        ("pendulum", "equation:phi", "phi'' = g/l*sin(phi)", ["g/l*sin(phi)"]),
        ("double-pendulum", "generalized-force:phi1", "-m1*g*l1*sin(phi1)", ["m1"]),
        (
            "cart-pendulum",
            "equations",
            "(M + m)*x'' + m*l*phi''*cos(phi) + m*l*phi'^2*sin(phi) = 0; l*phi'' + x''*cos(phi) + g*cos(phi) = 0",
            ["m*l*phi'^2*sin(phi)", "cos(phi)"],
        ),
        ("pendulum", "position:bob", "l*[sin(phi), -cos(phi)]", ["-cos(phi)"]),
    ],
)
def test_the_term_is_found_in_the_students_text(scene: str, task: str, answer: str, wrong: list[str]) -> None:
    places = [slip.place for slip in verdict_on(scene, task, answer).slips]
    assert [answer[place.offset : place.offset + place.length] for place in places if place] == wrong


@pytest.mark.parametrize(
    ("scene", "task", "answer"),
    [
        # -m l² φ̈ was never written: the sine is wrong, and nothing else.
        ("pendulum", "equation:phi", "phi'' + g/l*cos(phi) = 0"),
        ("spring-pendulum", "equation:phi", "r*phi'' - 2*r'*phi' + g*sin(phi) = 0"),
        ("spherical-pendulum", "equation:psi", "sin(theta)*psi'' - 2*cos(theta)*theta'*psi' = 0"),
        ("two-mass-oscillator", "equation:x1", "m*x1'' + k*x1 + kappa/2*(x1 - x2) = 0"),
        ("pendulum", "equation:phi", "m*l^2*phi'' + 2*m*g*l*sin(phi) = 0"),
    ],
)
def test_nobody_is_accused_of_what_they_did_not_write(scene: str, task: str, answer: str) -> None:
    found = verdict_on(scene, task, answer)
    assert found.misconceptions == ()
    (slip,) = found.slips
    assert slip.place
    assert "''" not in answer[slip.place.offset : slip.place.offset + slip.place.length]


def test_half_an_angle_is_no_hindrance() -> None:
    """A wrong factor sin(theta/2) is looked at in its shortest form."""
    answer = "theta'' - sin(theta)*cos(theta)*psi'^2 + g/l*sin(theta/2) = 0"
    assert [slip.kind for slip in verdict_on("spherical-pendulum", "equation:theta", answer).slips] == ["argument"]
    assert verdict_on("spherical-pendulum", "equation:theta", f"sin(theta/2)*({answer[:-4]}) = g").outcome == "wrong"


def test_a_change_that_cancels_another_term_explains_nothing() -> None:
    assert verdict_on("pendulum", "equation:phi", "l*ddot(phi) + g*sin(phi) = m - g").slips == ()


def test_the_formula_is_shown_as_it_was_written() -> None:
    names = Names((Symbol("m", "parameter"), Symbol("l", "parameter"), Symbol("phi", "coordinate")))
    text = "-(l*m)^2/2 + sin(phi)^2*dot(phi) - 0.5*m"
    tree = parse(text, names, "plain").tree
    marked = written_latex(tree, Typography(names), [Span(text.index("0.5") - 2, 7)], "slip")
    assert marked == (r"\frac{-(l \, m)^{2}}{2} + \sin^{2}(\varphi) \, \dot{\varphi} \htmlClass{slip}{-0.5 \, m}")


def test_one_of_two_equations_earns_half() -> None:
    right, wrong = "l*phi'' + x''*cos(phi) + g*sin(phi) = 0", "(M + m)*x'' + m*l*phi'' = 0"
    answers = {f"{right}; {wrong}": 0.5, right: 0.5, f"{right}; 2*({right[:-4]}) = 0": 0.5, f"{wrong}; {wrong}": 0.0}
    found = {answer: verdict_on("cart-pendulum", "equations", answer).partial for answer in answers}
    assert found == answers


@pytest.mark.parametrize(
    ("task", "answer", "outcome"),
    [
        ("potential-energy", "-m*g*l*cos(phi) - M*phi", "correct"),
        ("potential-energy", "-m*g*l*cos(phi)", "correct"),
        ("potential-energy", "-M*phi", "wrong"),  # the weight belongs to V
        ("potential-energy", "-m*g*l*cos(phi) - M", "wrong"),  # M for M φ is no constant of one's own
        ("lagrangian", "m*l^2*phi'^2/2 + m*g*l*cos(phi)", "correct"),
        ("equation:phi", "m*l^2*phi'' + m*g*l*sin(phi) = 0", "wrong"),
        ("conserved:1", "m*l^2*phi'^2/2 - m*g*l*cos(phi)", "wrong"),
    ],
)
def test_a_constant_moment_may_stay_out_of_the_potential(task: str, answer: str, outcome: str) -> None:
    assert verdict_on("pendulum-with-moment", task, answer).outcome == outcome


def marks(scene: str, lines: list[tuple[str, str]], **scheme: float) -> list[tuple[str, str | None, float]]:
    asked: dict[str, Any] = {"scene": scene, "lang": "en", "scheme": scheme}
    asked["lines"] = [{"task": task, "answer": {"value": text}} for task, text in lines]
    answer: Any = lines_request(asked)
    return [(line["outcome"], line["remark"], line["points"]) for line in answer["lines"]]


LOST = [
    ("kinetic-energy", "m*l^2/2*(theta'^2 + psi'^2)"),  # sin² lost
    ("momentum:psi", "m*l^2*psi'"),
    ("equation:theta", "theta'' + g/l*sin(theta) = 0"),
]


def test_what_a_mistake_made_easier_follows_at_a_share_of_its_own() -> None:
    assert marks("spherical-pendulum", LOST)[1:] == [
        ("follow_through", "simplified", 0.25),
        ("follow_through", "simplified", 0.75),
    ]
    assert [points for *_, points in marks("spherical-pendulum", LOST, simplified=1.0)] == [0.0, 0.5, 1.5]
    assert [points for *_, points in marks("spherical-pendulum", LOST, simplified=0.0)] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    "lines",
    [
        [("kinetic-energy", "0"), ("momentum:psi", "0")],
        [("kinetic-energy", "m*l^2*theta'^2/7"), ("momentum:theta", "2*m*l^2*theta'/7"), ("equation:psi", "0 = 0")],
    ],
)
def test_from_nothing_follows_nothing(lines: list[tuple[str, str]]) -> None:
    assert marks("spherical-pendulum", lines)[-1][0] == "wrong"


def test_the_line_is_named_that_made_it_easier() -> None:
    previous = [{"task": task, "answer": {"value": text}} for task, text in LOST[:1]]
    asked = {"scene": "spherical-pendulum", "task": LOST[1][0], "answer": {"value": LOST[1][1]}, "lang": "en"}
    assert "easier (Kinetic energy)" in check_request({**asked, "previous": previous})["feedback"]
