"""Several lines: the first mistake, right consequences of it, and points that cannot be had for nothing."""

from __future__ import annotations

import pytest

from deltaq.homework.workbook import workbook_of
from deltaq.homework.working import Line, Scheme, mark

E_RIGHT = ("kinetic-energy", "m*l^2*phi'^2/2")
E_DOUBLE = ("kinetic-energy", "m*l^2*phi'^2")
V_RIGHT = ("potential-energy", "-m*g*l*cos(phi)")
V_SIGN = ("potential-energy", "m*g*l*cos(phi)")
V_NOTHING = ("potential-energy", "0")
EQUATION = ("equation:phi", "phi'' + g/l*sin(phi) = 0")


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
    scheme = Scheme({"equation:phi": 10.0}, follow_through=1.0)
    lines = [E_DOUBLE, ("equation:phi", "2*m*l^2*phi'' + m*g*l*sin(phi) = 0")]
    assert outcomes("pendulum", *lines, scheme=scheme) == [("wrong", 0), ("follow_through", 10)]
