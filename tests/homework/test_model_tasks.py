"""Tasks on the last chapter: positions of rest, their stability, integrals of motion, steady motions.

What is right is what textbooks publish, written as students write it; what is wrong is wrong by the same books.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import cycle
from typing import Any

import pytest
from tests.derivation import textbook_integrals
from tests.derivation.textbook_systems import SYSTEMS, particle, potential, scene

from deltaq.homework.checking import check
from deltaq.homework.feedback import verdict_document
from deltaq.homework.quantities import QUANTITIES
from deltaq.homework.service import check_request, lines_request, reading_request, solution_request, tasks_request
from deltaq.homework.statement import model_answer
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.mechanics.library import scene_ids
from deltaq.mechanics.writing import write_scene
from deltaq.narration.catalog import keys

KINDS = ("equilibria", "stability", "symmetry", "steady-motion")
BOOKS = {each.name: each for each in SYSTEMS}
INTEGRALS = textbook_integrals.SYSTEMS
CONE, TOP = "conical-pendulum", "heavy-top"

# The double well of Arnold, Mathematical Methods of Classical Mechanics, §4: V = −a x²/2 + b x⁴/4.
WELL = scene(["x"], {"m": 1, "a": 2, "b": 3}, [particle("x", "0")], potential("-a*x^2/2 + b*x^4/4"))
# The inverted pendulum on a torsion spring: Gross, Hauger, Technische Mechanik 1, §8.5, with c = 20 > m g l.
SPRUNG = BOOKS["inverted pendulum, strong torsion spring"].scene
# The problem of Kepler in Cartesian coordinates: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §3.2.
KEPLER = scene(["x", "y"], {"m": 1.3, "k": 2}, [particle("x", "y")], potential("-k/sqrt(x^2 + y^2)"))
OWN = {"well": WELL, "sprung": SPRUNG, "kepler": KEPLER}


@cache
def book(name: str) -> Workbook:
    name = {"hoop": "bead-on-rotating-hoop", "two": "double-pendulum"}.get(name, name)
    return Workbook(OWN[name]) if name in OWN else workbook_of({"scene": name})


def verdict(name: str, task: str, answer: str, syntax: str = "plain", *, comma: bool = False) -> Verdict:
    workbook = book(name)
    return check(workbook, workbook.task(task), answer, syntax, decimal_comma=comma)  # type: ignore[arg-type]


def rows(text: str) -> list[tuple[str, str, str]]:
    """Lines `scene | task | answer`."""
    found = [line.split(" | ") for line in text.strip().splitlines() if line.strip()]
    return [(name.strip(), task.strip(), answer.strip()) for name, task, answer in found]


RIGHT = r"""
pendulum | equilibria | phi = 0; phi = pi
pendulum | equilibria | 0, pi
pendulum | equilibria | phi = 0 oder phi = 180°
pendulum | equilibria | phi = 0 or phi = -pi
pendulum | equilibria | φ_1 = 0, φ_2 = π
pendulum | equilibria | phi = n*pi, n ∈ Z
pendulum | equilibria | phi = k*pi mit k ∈ ℤ
pendulum | equilibria | sin(phi) = 0
pendulum | equilibria | phi = 2*pi; phi = 3*pi
pendulum | equilibria | phi = 0; phi = ±pi
pendulum | equilibria | phi = 0 und phi = 3.14
pendulum | equilibria | phi in {0, pi}
well | equilibria | x = 0; x = ±sqrt(a/b)
well | equilibria | x = 0, x = sqrt(a/b), x = -sqrt(a/b)
well | equilibria | 0; sqrt(2/3); -sqrt(2/3)
well | equilibria | x = 0 or x = 0.816 or x = -0.816
well | equilibria | x_1 = 0, x_{2,3} = ±sqrt(a/b)
hoop | equilibria | theta = 0; theta = pi; cos(theta) = g/(R*Omega^2)
hoop | equilibria | theta = 0, theta = pi, theta = ±acos(g/(R*Omega^2))
hoop | equilibria | sin(theta) = 0 or cos(theta) = g/(Omega^2*R)
double-pendulum | equilibria | [0, 0]; [0, pi]; [pi, 0]; [pi, pi]
double-pendulum | equilibria | (0, 0), (0, pi), (pi, 0), (pi, pi)
double-pendulum | equilibria | (phi1, phi2) = (0,0), (pi,0), (0,pi), (pi,pi)
double-pendulum | equilibria | (0|0), (pi|0), (0|pi), (pi|pi)
two | equilibria | phi1 = 0, phi2 = 0; phi1 = 0, phi2 = pi; phi1 = pi, phi2 = 0; phi1 = pi, phi2 = pi
double-pendulum | equilibria | phi1 = n*pi, phi2 = k*pi
spring-pendulum | equilibria | phi = 0, r = r0 + m*g/k; phi = pi, r = r0 - m*g/k
pendulum | stability:1 | stable
pendulum | stability:1 | stabil
pendulum | stability:1 | The equilibrium is stable.
pendulum | stability:2 | instabil
pendulum | stability:2 | nicht stabil
pendulum | stability:2 | labil
pendulum | stability:2 | always unstable
sprung | stability:1 | stable for m*g*l < c
sprung | stability:1 | stabil für c > m g l
sprung | stability:1 | stable if c/(m*g*l) > 1
sprung | stability:1 | stabil, falls l < c/(m*g), sonst instabil
sprung | stability:1 | instabil für c < m*g*l, stabil für c > m*g*l
sprung | stability:1 | for c >= m*g*l stable
hoop | stability:3 | unstable for g < R*Omega^2
hoop | stability:3 | stable for Omega < sqrt(g/R)
hoop | stability:3 | stabil für R*Omega^2/g < 1, instabil für R*Omega^2/g > 1
hoop | stability:1 | stable
hoop | stability:1 | stable for g < R*Omega^2
wilberforce | stability:1 | stabil für epsilon^2 < 4*k*kappa
wilberforce | stability:1 | stable if k > 0, kappa > epsilon^2/(4*k)
kepler | symmetry:1 | m*(x*dot(y) - y*dot(x))
kepler | symmetry:1 | L = m*(x*dot(y) - y*dot(x)) = const
kepler | symmetry:1 | y*dot(x) - x*dot(y)
kepler | symmetry:1 | I = x*dot(y) - y*dot(x) + 3
kepler | symmetry:1 | x*dot(y) - y*dot(x) + m*(dot(x)^2 + dot(y)^2)/2 - k/sqrt(x^2 + y^2)
foucault | symmetry:1 | x*dot(y) - y*dot(x) + Omega*sin(beta)*(x^2 + y^2)
atwood | symmetry:1 | dot(y) + (m2 - m1)*g*t/(J/R^2 + m1 + m2)
conical-pendulum | steady-motion:psi | dot(psi)^2 = g/(l*cos(theta))
conical-pendulum | steady-motion:psi | dot(psi) = sqrt(g/(l*cos(theta)))
conical-pendulum | steady-motion:psi | dot(psi) = ±sqrt(g/(l*cos(theta)))
conical-pendulum | steady-motion:psi | Omega^2 = g/(l*cos(theta))
conical-pendulum | steady-motion:psi | omega = sqrt(g/l/cos(theta))
conical-pendulum | steady-motion:psi | sqrt(g/(l*cos(theta)))
conical-pendulum | steady-motion:psi | l*dot(psi)^2*cos(theta) = g
conical-pendulum | steady-motion:psi | m*l^2*sin(theta)*cos(theta)*dot(psi)^2 - m*g*l*sin(theta) = 0
conical-pendulum | steady-motion:psi | dot(psi)^3*l*cos(theta) = g*dot(psi)
heavy-top | steady-motion:psi | (m*l^2 + A - C)*cos(theta)*dot(psi)^2 - C*dot(phi)*dot(psi) + m*g*l = 0
"""

RIGHT_IN_LATEX = r"""
pendulum | equilibria | \varphi = 0 \quad\text{oder}\quad \varphi = \pi
pendulum | equilibria | \varphi_1 = 0,\; \varphi_2 = 180^\circ
pendulum | equilibria | \varphi = n\pi,\ n \in \mathbb{Z}
pendulum | equilibria | \varphi \in \left\{0, \pi\right\}
pendulum | equilibria | \begin{aligned} \varphi &= 0 \\ \varphi &= \pi \end{aligned}
well | equilibria | x = 0 \lor x = \pm\sqrt{\frac{a}{b}}
hoop | equilibria | \vartheta = 0, \vartheta = \pi, \vartheta_{1,2} = \pm\arccos\left(\frac{g}{R\Omega^2}\right)
two | equilibria | \begin{pmatrix}0\\0\end{pmatrix}; \begin{pmatrix}0\\\pi\end{pmatrix}; [\pi,0]; (\pi,\pi)
pendulum | stability:1 | \text{stabil}
pendulum | stability:1 | stable
pendulum | stability:2 | \mathrm{instabil}
sprung | stability:1 | \text{stabil für } c > mgl
sprung | stability:1 | stabilf\"ur c > mgl
sprung | stability:1 | \operatorname{\mathrm{stabil}}\operatorname{\mathrm{für}}c>mgl
sprung | stability:1 | stableifc>mgl
sprung | stability:1 | stabilfürc>mgl
sprung | stability:1 | \text{stable} \quad \text{for} \quad c \geq m g l
hoop | stability:3 | \text{instabil für } \frac{R\Omega^2}{g} > 1
kepler | symmetry:1 | m\left(x\dot{y} - y\dot{x}\right) = \text{const.}
conical-pendulum | steady-motion:psi | \dot\psi^2 = \frac{g}{\ell\cos\vartheta}
conical-pendulum | steady-motion:psi | \Omega = \pm\sqrt{\frac{g}{\ell \cos\vartheta}}
"""

WRONG = r"""
pendulum | equilibria | phi = 0 | equilibrium-missing
pendulum | equilibria | phi = pi | equilibrium-missing
pendulum | equilibria | phi = 2*n*pi | equilibrium-missing
pendulum | equilibria | phi = 0; phi = pi; phi = pi/2 | no-equilibrium
pendulum | equilibria | phi = 0; phi = 90° | no-equilibrium
pendulum | equilibria | phi = 0; phi = 3.2 | no-equilibrium
pendulum | equilibria | cos(phi) = 0 | no-equilibrium
pendulum | equilibria | phi = 0; phi = 180 | no-equilibrium
well | equilibria | x = ±sqrt(a/b) | equilibrium-missing
well | equilibria | x = 0; x = sqrt(a/b) | equilibrium-missing
well | equilibria | x = 0; x = ±sqrt(b/a) | no-equilibrium
well | equilibria | x = 0; x = ±sqrt(2*a/b) | no-equilibrium
hoop | equilibria | theta = 0; theta = pi; theta = acos(g/(R*Omega^2)) | equilibrium-missing
hoop | equilibria | theta = 0; theta = pi; sin(theta) = g/(R*Omega^2) | no-equilibrium
double-pendulum | equilibria | [0, 0]; [pi, pi] | equilibrium-missing
conical-pendulum | equilibria | theta = 0, psi = 0; theta = pi, psi = 0 | one-of-family
pendulum | stability:1 | unstable | stability-exchanged
pendulum | stability:2 | stabil | stability-exchanged
pendulum | stability:1 | stable for g > l | condition-needless
sprung | stability:1 | stable | condition-missing
sprung | stability:1 | unstable | stability-exchanged
sprung | stability:1 | stable for c < m*g*l | condition-reversed
sprung | stability:1 | unstable for c > m*g*l | condition-reversed
sprung | stability:1 | stable for c > 2*m*g*l | condition-other
sprung | stability:1 | stable for c > 1.00001*m*g*l | condition-other
hoop | stability:3 | unstable for g*1.00001 < R*Omega^2 | condition-other
sprung | stability:1 | stable for c > m*g*l^2 | condition-other
sprung | stability:1 | stable for 0 < c | condition-other
sprung | stability:1 | stable for c < c | condition-other
pendulum | stability:2 | stable for 1 < 0 | condition-other
hoop | stability:3 | stable for R*Omega^2 > g | condition-reversed
hoop | stability:3 | stable for g < R*Omega | condition-other
kepler | symmetry:1 | x*dot(y) + y*dot(x) | not-conserved
kepler | symmetry:1 | m*dot(x) | not-conserved
kepler | symmetry:1 | x | not-conserved
kepler | symmetry:1 | m*(dot(x)^2 + dot(y)^2)/2 - k/sqrt(x^2 + y^2) | other-integral
kepler | symmetry:1 | (x*dot(y) - y*dot(x))^2 | other-integral
cart-pendulum | symmetry:1 | (M + m)*dot(x) + m*l*cos(phi)*dot(phi) | other-integral
conical-pendulum | steady-motion:psi | dot(psi)^2 = g*cos(theta)/l | steady-wrong
conical-pendulum | steady-motion:psi | dot(psi)^2 = g/(l*sin(theta)) | steady-wrong
conical-pendulum | steady-motion:psi | dot(psi) = g/(l*cos(theta)) | steady-wrong
conical-pendulum | steady-motion:psi | (dot(psi)^2 - g/(l*cos(theta)))*(dot(psi) - 3) = 0 | steady-more
conical-pendulum | steady-motion:psi | (dot(psi) + 1)^2 = dot(psi)^2 + 2*dot(psi) + 1 | steady-empty
"""


@pytest.mark.parametrize(("name", "task", "answer"), rows(RIGHT))
def test_right_answers(name: str, task: str, answer: str) -> None:
    found = verdict(name, task, answer)
    assert (found.outcome, found.problems) == ("correct", ())


@pytest.mark.parametrize(("name", "task", "answer"), rows(RIGHT_IN_LATEX))
def test_right_answers_in_latex(name: str, task: str, answer: str) -> None:
    found = verdict(name, task, answer, "latex")
    assert (found.outcome, found.problems) == ("correct", ())


def wrong_rows() -> list[list[str]]:
    return [[cell.strip() for cell in line.split(" | ")] for line in WRONG.strip().splitlines()]


@pytest.mark.parametrize(("name", "task", "answer", "remark"), wrong_rows())
def test_wrong_answers_are_wrong_for_what_is_wrong(name: str, task: str, answer: str, remark: str) -> None:
    found = verdict(name, task, answer)
    assert (found.outcome, found.remark, found.problems) == ("wrong", remark, ())
    assert 0 <= found.partial < 1
    for language in ("de", "en"):
        told = verdict_document(found, book(name).scene, language)
        assert str(told["feedback"]).endswith(".")


def test_one_of_two_rates_that_differ_by_more_than_their_sign_is_not_all() -> None:
    first, second = model_answer(book(TOP).task("steady-motion:psi"), book(TOP))["plain"]
    alone = verdict(TOP, "steady-motion:psi", first)
    assert (alone.outcome, alone.remark, alone.partial) == ("wrong", "steady-missing", 0.25)
    assert verdict(TOP, "steady-motion:psi", f"{second}; {first}").outcome == "correct"


def test_a_decimal_comma_is_read_as_the_language_writes_it_and_else_if_that_is_right() -> None:
    assert verdict("well", "equilibria", "x = 0; x = 0,816; x = -0,816", comma=True).outcome == "correct"
    assert verdict("well", "equilibria", "x = 0; x = 0,816; x = -0,816").outcome == "correct"
    assert verdict("well", "equilibria", r"x = 0; x = \pm 0{,}816", "latex", comma=True).outcome == "correct"
    assert verdict("double-pendulum", "equilibria", "[0,0]; [0,pi]; [pi,0]; [pi,pi]", comma=True).outcome == "correct"


@pytest.mark.one_in(4)
@pytest.mark.parametrize("name", [name for name, each in BOOKS.items() if each.whole][::2])
def test_published_positions_are_right_and_with_one_less_or_one_more_wrong(name: str) -> None:
    published, workbook = BOOKS[name], Workbook(BOOKS[name].scene)
    tasks = [task for task in workbook.tasks if task.quantity.kind == "equilibria"]
    if not tasks:  # a family, dry friction, or more than can be asked for
        assert any(rest.kind for rest in published.rests) or len(published.rests) in (0, 1, 16), name
        return
    written = [", ".join(f"{q} = {value:.6g}" for q, value in rest.at.items()) for rest in published.rests]
    assert check(workbook, tasks[0], "; ".join(written), "plain").outcome == "correct"
    if len(written) > 1:
        assert check(workbook, tasks[0], "; ".join(written[1:]), "plain").remark == "equilibrium-missing"
    beside = ", ".join(f"{q} = {value + 0.123:.6g}" for q, value in published.rests[0].at.items())
    more = check(workbook, tasks[0], "; ".join([*written, beside]), "plain")
    assert (more.outcome, more.remark) == ("wrong", "no-equilibrium")


@pytest.mark.one_in(4)
@pytest.mark.parametrize("name", list(INTEGRALS)[::3])
def test_published_integrals_are_right_and_turned_in_one_sign_not_conserved(name: str) -> None:
    published, workbook = INTEGRALS[name], Workbook(INTEGRALS[name].scene)
    tasks = [task for task in workbook.tasks if task.quantity.kind == "symmetry"]
    for integral in published.integrals if tasks else ():
        outcomes = {task.id: check(workbook, task, integral, "plain") for task in tasks}
        right = [task for task, found in outcomes.items() if found.outcome == "correct"]
        assert len(right) == 1 or len(tasks) == 6  # more than are asked for
        others = [found.remark for task, found in outcomes.items() if task not in right]
        assert set(others) <= {"other-integral"}
        scaled = [check(workbook, workbook.task(task), f"7 - 3*({integral})", "plain") for task in right]
        assert all((found.outcome, found.remark) == ("correct", "multiple") for found in scaled)


@pytest.mark.one_in(12)
@pytest.mark.parametrize(("name", "lang"), list(zip(scene_ids(), cycle(("de", "en")), strict=False)))
def test_the_right_answer_handed_back_is_right(name: str, lang: str) -> None:
    asked = {"scene": name, "lang": lang}
    for task in tasks_request(asked)["tasks"]:
        if task["kind"] in KINDS:
            assert back(asked | {"task": task["id"]}) == {"plain": "correct", "latex": "correct"}, task["id"]


def back(asked: Mapping[str, Any]) -> dict[str, str]:
    """The outcome of the answer that the service gives, and of what it understands by it."""
    outcomes = {}
    for syntax, parts in solution_request(asked).items():
        answer = {"syntax": syntax, "value": "; ".join(parts)}
        read = reading_request(asked | {"answer": answer})
        again = {"syntax": syntax, "value": read[syntax]}
        found = {check_request(asked | {"answer": one})["outcome"] for one in (answer, again)}
        outcomes[syntax] = "/".join(sorted(found))
    return outcomes


HOSTILE = (
    "",
    ";",
    "= 0",
    "phi",
    "phi = ",
    "phi = x",
    "phi = phi",
    "phi = dot(phi)",
    "phi = ]",
    "phi = [1, 2, 3]; [",
    "phi = t",
    "stable for",
    "stable for a <",
    "stable for < >",
    "stable stable unstable < 1",
    "stable unstable",
    "stable, unstable for g < l",
    "maybe",
    "phi = " + "(" * 900,
    "phi = " + "(" * 400 + "0" + ")" * 400,
    "phi = 1/0",
    "phi = n*m*pi",
    "phi = n*pi/1000000",
    "phi = pi^pi^pi^pi",
    "phi = " + "±" * 500 + "1",
    "; ".join(f"phi = {n}" for n in range(180)),
    ",".join("0" for _ in range(900)),
    "phi = 0\\\\" * 150,
    "9" * 1900,
    "x" * 1_000_000,
    "phi = 0; " * 200_000,
    "\\begin{pmatrix}" * 100,
    "\\frac{" * 300,
    "stable for " + "m < " * 400 + "m",
    "\x00\u202e\ud7ff",
)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("syntax", ["plain", "latex"])
def test_hostile_answers_are_refused_or_wrong_in_no_time(kind: str, syntax: str) -> None:
    name = {"symmetry": "cart-pendulum", "steady-motion": CONE}.get(kind, "pendulum")
    *_, task = (task for task in book(name).tasks if task.quantity.kind == kind)
    for answer in HOSTILE:
        start = time.perf_counter()
        found = verdict(name, task.id, answer, syntax)
        assert found.outcome in ("invalid", "wrong"), answer[:60]
        assert time.perf_counter() - start < 30, answer[:60]  # what is read as it should not be takes for ever
        for problem in found.problems:
            assert problem.offset is None or 0 <= problem.offset <= len(answer), (answer[:60], problem)
        verdict_document(found, book(name).scene, "de")


def spliced(count: int, seed: int) -> Iterator[tuple[str, str, str, str]]:
    """Right answers cut somewhere and joined with others of any kind."""
    source = random.Random(seed)
    told = [(*row, "plain") for row in rows(RIGHT)] + [(*row, "latex") for row in rows(RIGHT_IN_LATEX)]
    for _ in range(count):
        (name, task, one, syntax), (*_, other, _) = source.choice(told), source.choice(told)
        start, end = source.randrange(len(one) + 1), source.randrange(len(other) + 1)
        yield name, task, one[:start] + other[end:], syntax


def test_answers_cut_and_joined_at_random_get_a_verdict() -> None:
    for name, task, answer, syntax in spliced(400, 23):
        found = verdict(name, task, answer, syntax)
        assert found.outcome in ("correct", "wrong", "invalid", "undecided"), answer
        verdict_document(found, book(name).scene, "en")


def test_what_is_wrong_is_said_where_it_stands() -> None:
    (problem,) = verdict("pendulum", "equilibria", "phi = 0; phi = foo").problems
    assert (problem.code, problem.offset) == ("unknown-name", 15)
    (problem,) = verdict("double-pendulum", "equilibria", "phi1 = 0, phi2 = 0; phi1 = pi").problems
    assert (problem.code, problem.offset) == ("answer-position-incomplete", 20)
    (problem,) = verdict("sprung", "stability:1", "stable for c = m*g*l").problems
    assert (problem.code, problem.offset) == ("answer-comparison", 11)


def test_positions_share_their_points() -> None:
    shares = [verdict("well", "equilibria", text).partial for text in ("x = 0; x = sqrt(a/b)", "x = 0", "x = 5")]
    assert shares == pytest.approx([2 / 3, 1 / 3, 0])
    assert verdict("well", "equilibria", "x = 0; x = ±sqrt(a/b); x = 5").partial == pytest.approx(2 / 3)
    assert verdict("sprung", "stability:1", "stable").partial == 0.5


def test_lines_of_a_working_hold_such_answers_and_carry_nothing_wrong_on() -> None:
    lines = [
        {"task": "equilibria", "answer": {"value": "phi = 0"}},
        {"task": "equilibria", "answer": {"value": "phi = 0"}},
        {"task": "kinetic-energy", "answer": {"value": "m*l*dot(phi)^2/2"}},
        {"task": "equation:phi", "answer": {"value": "l*ddot(phi) + g*sin(phi) = 0"}},
        {"task": "stability:1", "answer": {"value": "unstable"}},
        {"task": "stability:2", "answer": {"value": "unstable"}},
    ]
    found = lines_request({"scene": "pendulum", "lines": lines})["lines"]
    assert [each["outcome"] for each in found] == [
        "wrong",
        "follow_through",
        "wrong",
        "correct",
        "wrong",
        "correct",
    ]
    assert found[0]["points"] == pytest.approx(1.0)  # half of two points


def test_every_remark_has_its_words_in_the_table() -> None:
    remarks = {line[3] for line in wrong_rows()}
    for language in ("de", "en"):
        assert remarks <= set(keys(language, "homework.summary.remarks"))
        assert remarks <= set(keys(language, "homework.remarks"))


def test_a_task_names_its_symmetry_and_a_length_that_would_be_negative_is_no_condition() -> None:
    (task,) = (task for task in tasks_request({"scene": "foucault"})["tasks"] if task["kind"] == "symmetry")
    assert r"x \to x - \varepsilon \, y" in task["statement"]
    assert model_answer(book("spring-pendulum").task("stability:2"), book("spring-pendulum"))["plain"] == ["unstable"]


def test_a_scene_of_ones_own_is_asked_about() -> None:
    document = {"scene": write_scene(KEPLER), "task": "symmetry:1"}
    assert back(document) == {"plain": "correct", "latex": "correct"}
    assert {each.kind for each in QUANTITIES if each.judge and each.chapter == "model"} == set(KINDS) - {"symmetry"}
