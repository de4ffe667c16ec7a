"""Several lines: the first mistake, right consequences of it, and points that cannot be had for nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest

from deltaq.homework.checking import check
from deltaq.homework.gradebook import Shares
from deltaq.homework.service import check_request, lines_request
from deltaq.homework.workbook import workbook_of
from deltaq.homework.working import Line, Scheme, check_following, mark, wrong_among

E_RIGHT = ("kinetic-energy", "m*l^2*phi'^2/2")
E_DOUBLE = ("kinetic-energy", "m*l^2*phi'^2")
V_RIGHT = ("potential-energy", "-m*g*l*cos(phi)")
V_SIGN = ("potential-energy", "m*g*l*cos(phi)")
V_NOTHING = ("potential-energy", "0")
EQUATION = ("equation:phi", "phi'' + g/l*sin(phi) = 0")
FROM_DOUBLE = ("equation:phi", "2*m*l^2*phi'' + m*g*l*sin(phi) = 0")


def outcomes(scene: str, *lines: tuple[str, str], scheme: Scheme | None = None) -> list[tuple[str, float]]:
    marked = mark(workbook_of({"scene": scene}), [Line(*line) for line in lines], scheme or Scheme())
    return [(each.verdict.outcome, each.points) for each in marked]


CASES = [
    pytest.param([E_RIGHT, V_RIGHT, EQUATION], [("correct", 2), ("correct", 1), ("correct", 3)], id="all right"),
    pytest.param(
        [E_DOUBLE, V_RIGHT, ("equation:phi", "2*m*l^2*phi'' + m*g*l*sin(phi) = 0")],
        [("wrong", 0), ("correct", 1), ("follow_through", 1.5)],
        id="factor of the energy carried on",
    ),
    pytest.param(
        [E_RIGHT, V_SIGN, ("lagrangian", "m*l^2*phi'^2/2 - m*g*l*cos(phi)"), ("equation:phi", "phi'' = g/l*sin(phi)")],
        [("correct", 2), ("wrong", 0), ("follow_through", 0.5), ("follow_through", 1.5)],
        id="sign of the potential carried on twice",
    ),
    pytest.param(
        [
            ("position:bob", "[l*cos(phi), l*sin(phi)]"),
            ("virtual-displacement:bob", "[-l*sin(phi)*delta(phi), l*cos(phi)*delta(phi)]"),
        ],
        [("wrong", 0), ("follow_through", 0.5)],
        id="displacement of a wrong position",
    ),
    pytest.param(
        [E_DOUBLE, ("equation:phi", "phi'' + g/l*sin(phi) = 0")],
        [("wrong", 0), ("correct", 3)],
        id="right in spite of a wrong line",
    ),
    pytest.param(
        [E_DOUBLE, ("equation:phi", "2*m*l^2*phi'' - m*g*l*sin(phi) = 0")],
        [("wrong", 0), ("wrong", 0)],
        id="second mistake",
    ),
    pytest.param(
        [V_NOTHING, ("equation:phi", "m*l^2*phi'' = 0")],
        [("wrong", 0), ("wrong", 0)],
        id="no potential makes everything trivial",
    ),
    pytest.param(
        [("kinetic-energy", "0"), ("lagrangian", "m*g*l*cos(phi)"), ("equation:phi", "sin(phi) = 0")],
        [("wrong", 0), ("wrong", 0), ("wrong", 0)],
        id="no kinetic energy",
    ),
    pytest.param(
        [("lagrangian", "phi'"), ("momentum:phi", "1"), ("equation:phi", "0 = 0")],
        [("wrong", 0), ("wrong", 0), ("wrong", 0)],
        id="trivial Lagrange function",
    ),
    pytest.param([E_RIGHT, E_RIGHT, E_RIGHT], [("correct", 2), ("correct", 0), ("correct", 0)], id="paid once"),
    pytest.param([E_DOUBLE, E_DOUBLE], [("wrong", 0), ("follow_through", 0)], id="wrong line repeated"),
    pytest.param(
        [E_DOUBLE, E_RIGHT, ("equation:phi", "2*m*l^2*phi'' + m*g*l*sin(phi) = 0")],
        [("wrong", 0), ("correct", 2), ("wrong", 0)],
        id="a line that was mended carries nothing",
    ),
    pytest.param([("kinetic-energy", "m*("), EQUATION], [("invalid", 0), ("correct", 3)], id="unreadable line"),
    pytest.param(
        [("equation:phi", "phi'' - g/l*sin(phi) = 0"), ("linearized:phi", "phi'' - g/l*phi = 0")],
        [("wrong", 0), ("follow_through", 1)],
        id="linearized from a wrong equation",
    ),
    pytest.param(
        [E_DOUBLE, V_SIGN, FROM_DOUBLE],
        [("wrong", 0), ("wrong", 0), ("follow_through", 1.5)],
        id="from the first of two wrong lines",
    ),
    pytest.param(
        [V_SIGN, E_DOUBLE, FROM_DOUBLE],
        [("wrong", 0), ("wrong", 0), ("follow_through", 1.5)],
        id="from the last of two wrong lines",
    ),
    pytest.param(
        [E_DOUBLE, V_SIGN, ("equation:phi", "2*m*l^2*phi'' - m*g*l*sin(phi) = 0")],
        [("wrong", 0), ("wrong", 0), ("follow_through", 1.5)],
        id="from both wrong lines",
    ),
    pytest.param(
        [E_DOUBLE, FROM_DOUBLE, EQUATION],
        [("wrong", 0), ("follow_through", 1.5), ("correct", 1.5)],
        id="the right answer adds what is missing",
    ),
    pytest.param(
        [E_DOUBLE, EQUATION, FROM_DOUBLE],
        [("wrong", 0), ("correct", 3), ("follow_through", 0)],
        id="a worse answer takes nothing away",
    ),
    pytest.param(
        [E_DOUBLE, V_SIGN, ("equation:phi", "phi'' = 0"), ("equation:phi", "2*m*l^2*phi'' = m*g*l*sin(phi)")],
        [("wrong", 0), ("wrong", 0), ("wrong", 0), ("follow_through", 1.5)],
        id="from both, and not from an earlier answer to the same task",
    ),
    pytest.param([E_DOUBLE, ("equation:phi", "0 = 0")], [("wrong", 0), ("wrong", 0)], id="says nothing"),
    pytest.param(
        [("equation:phi", "phi'' = 0"), ("equation:phi", "2*phi'' = 0")],
        [("wrong", 0), ("follow_through", 0)],
        id="repeated in another form",
    ),
    pytest.param(
        [("equation:phi", "phi'' = 0"), ("equation:phi", "phi'' = phi")],
        [("wrong", 0), ("wrong", 0)],
        id="another wrong answer to the same task",
    ),
    pytest.param(
        [("kinetic-energy", "log(cos(phi) - 2)"), ("equation:phi", "phi'' = 0")],
        [("undecided", 0), ("wrong", 0)],
        id="from what is undecided nothing follows",
    ),
]


@pytest.mark.parametrize(("lines", "expected"), CASES)
def test_pendulum(lines: list[tuple[str, str]], expected: list[tuple[str, float]]) -> None:
    assert outcomes("pendulum", *lines) == expected


def test_work_and_forces_carry_on() -> None:
    lines = [
        ("virtual-displacement:bob", "[l*cos(phi)*delta(phi), delta(y) + l*sin(phi)*delta(phi)]"),
        ("virtual-work", "(m*g - k*y - F0*sin(phi))*delta(y) + (m*g*l*sin(phi) + F0*l*cos(2*phi))*delta(phi)"),
        ("generalized-force:phi", "m*g*l*sin(phi) + F0*l*cos(2*phi)"),
    ]
    assert [outcome for outcome, _ in outcomes("elastic-pendulum", *lines)] == [
        "wrong",
        "follow_through",
        "follow_through",
    ]


def test_set_of_equations_follows_from_a_wrong_lagrangian() -> None:
    lines = [
        ("lagrangian", "(M+m)*x'^2/2 + m*l*x'*phi'*cos(phi) + m*l^2*phi'^2/2 - m*g*l*cos(phi)"),
        ("equations", "(M+m)*x'' + m*l*phi''*cos(phi) - m*l*phi'^2*sin(phi) = 0; l*phi'' + x''*cos(phi) = g*sin(phi)"),
    ]
    assert outcomes("cart-pendulum", *lines) == [("wrong", 0), ("follow_through", 2)]


def test_teacher_sets_the_points() -> None:
    scheme = Scheme({"equation:phi": 10.0}, Shares(follow_through=1.0))
    lines = [E_DOUBLE, ("equation:phi", "2*m*l^2*phi'' + m*g*l*sin(phi) = 0")]
    assert outcomes("pendulum", *lines, scheme=scheme) == [("wrong", 0), ("follow_through", 10)]


@pytest.mark.parametrize(
    ("scene", "wrong", "line", "outcome"),
    [
        pytest.param(
            "spring-pendulum",
            ("potential-energy", "-m*g*r*cos(phi)"),
            ("equation:r", "m*r'' - m*r*phi'^2 - m*g*cos(phi) = 0"),
            "follow_through",
            id="three of five terms",
        ),
        pytest.param(
            "elastic-pendulum",
            ("virtual-work", "-F0*y*sin(phi)*delta(y) + F0*l*delta(phi)"),
            ("generalized-force:y", "-F0*y*sin(phi)"),
            "wrong",
            id="one of three terms",
        ),
        pytest.param(
            "elastic-pendulum",
            ("virtual-work", "(m*g - F0 + k*l)*delta(y) + F0*l*delta(phi)"),
            ("generalized-force:y", "m*g - F0 + k*l"),
            "wrong",
            id="as many terms without a coordinate",
        ),
        pytest.param(
            "pendulum",
            ("lagrangian", "phi'^2/2 + cos(phi)"),
            ("equation:phi", "phi'' + sin(phi) = 0"),
            "follow_through",
            id="without any parameter",
        ),
        pytest.param(
            "cart-pendulum",
            ("lagrangian", "x*phi"),
            ("equation:x", "ddot(x) = phi"),
            "wrong",
            id="without accelerations",
        ),
        pytest.param(
            "pendulum",
            ("position:bob", "[l*sin(phi), 0]"),
            ("virtual-displacement:bob", "[l*cos(phi)*delta(phi), 0]"),
            "wrong",
            id="one of two components",
        ),
        pytest.param(
            "elastic-pendulum",
            ("virtual-displacement:bob", "[l*cos(phi)*delta(phi), phi*delta(y)]"),
            ("potential-energy", "k*y^2"),
            "wrong",
            id="forces that have no potential",
        ),
        pytest.param(
            "elastic-pendulum",
            ("virtual-work", "(k*y - F0*sin(phi))*delta(y) + F0*l*delta(phi)"),
            ("generalized-force:y", "k*y - F0*sin(phi)"),
            "follow_through",
            id="without a parameter",
        ),
    ],
)
def test_what_follows_must_be_most_of_the_answer(
    scene: str, wrong: tuple[str, str], line: tuple[str, str], outcome: str
) -> None:
    assert [found for found, _ in outcomes(scene, wrong, line)] == ["wrong", outcome]


@pytest.mark.parametrize(
    ("wrong", "line"),
    [
        pytest.param(E_DOUBLE, FROM_DOUBLE, id="misconceptions"),
        pytest.param(
            ("potential-energy", "-2*m*g*l*cos(phi)"),
            ("equation:phi", "m*l^2*phi'' + 2*m*g*l*sin(phi) = 0"),
            id="slips",
        ),
    ],
)
def test_a_line_that_follows_is_told_nothing_of_mistakes(wrong: tuple[str, str], line: tuple[str, str]) -> None:
    """What it would be by itself is a mistake with a name, and a state where it differs."""
    book = workbook_of({"scene": "pendulum"})
    first, alone = (check(book, book.task(task), text, "plain") for task, text in (wrong, line))
    for verdict in (first, alone):
        assert verdict.outcome == "wrong"
        assert verdict.misconceptions or verdict.slip
        assert verdict.counterexample
    standing = wrong_among(book, [Line(*wrong)])
    follows, again = (check_following(book, book.task(one[0]), Line(*one), standing) for one in (line, wrong))
    nothing = {"outcome": "follow_through", "misconceptions": (), "slips": (), "marked": ""}
    assert follows == replace(alone, counterexample=None, **nothing)
    assert again == replace(first, remark="repeated", **nothing)


@pytest.mark.parametrize(
    ("previous", "outcome"),
    [
        pytest.param([], "wrong", id="nothing before"),
        pytest.param([E_DOUBLE], "follow_through", id="a wrong line"),
        pytest.param([E_DOUBLE, E_RIGHT], "wrong", id="a wrong line that was mended"),
        pytest.param([E_RIGHT, E_DOUBLE], "follow_through", id="a right line that was spoiled"),
        pytest.param([E_DOUBLE, ("kinetic-energy", "m*(")], "follow_through", id="an unreadable line besides"),
    ],
)
def test_an_answer_in_the_light_of_those_before_it(previous: list[tuple[str, str]], outcome: str) -> None:
    lines = [{"task": task, "answer": {"value": answer}} for task, answer in [*previous, FROM_DOUBLE]]
    assert check_request({"scene": "pendulum", "previous": lines[:-1], **lines[-1]})["outcome"] == outcome
    assert lines_request({"scene": "pendulum", "lines": lines})["lines"][-1]["outcome"] == outcome


FORGOTTEN = [
    ("position:bob", "[l, l]"),
    ("virtual-displacement:bob", "[l*delta(phi), l*delta(phi)]"),
    ("virtual-work", "m*g*l*delta(phi)"),
    ("generalized-force:phi", "m*g*l"),
    ("linearized:phi", "phi'' = 0"),
    ("eigenfrequencies", "1"),
]


@pytest.mark.parametrize(("between", "outcome"), [(5, "follow_through"), (6, "wrong")])
def test_a_line_follows_from_one_of_the_last_six_wrong_ones(between: int, outcome: str) -> None:
    found = outcomes("pendulum", E_DOUBLE, *FORGOTTEN[:between], FROM_DOUBLE)
    assert [each for each, _ in found] == ["wrong"] * (1 + between) + [outcome]
