"""The reader: readings that compete, chains and definitions, and bounds that hold for whatever is typed."""

from __future__ import annotations

import random
import sys
import time

import pytest
from tests.hostile import MARKUP
from tests.language.hostile import BOMBS, CODE, LARGE, LATEX

from deltaq.errors import ExpressionError
from deltaq.homework.checking import check
from deltaq.homework.reading import candidates
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import workbook_of
from deltaq.language.parser import Syntax
from deltaq.narration.catalog import message

from .habits import Habit, adversarial, habits

MOST_TRIED = 24
SLOW = 2.0  # seconds of this process
BOTH: tuple[Syntax, ...] = ("plain", "latex")


def verdict(scene: str, task: str, answer: str, syntax: Syntax = "plain", *, comma: bool = False) -> Verdict:
    workbook = workbook_of({"scene": scene})
    return check(workbook, workbook.task(task), answer, syntax, decimal_comma=comma)


# --- readings --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("scene", "task", "answer", "taken", "others"),
    [
        ("pendulum", "kinetic-energy", "1/2 m l^2 phi'^2", "m*l^2*dot(phi)^2/2", []),
        ("pendulum", "kinetic-energy", "1/2ml^2phi'^2", "m*l^2*dot(phi)^2/2", []),
        ("physical-pendulum", "equation:phi", "phi'' + 3g/2l sin(phi) = 0", "ddot(phi) + 3*g*sin(phi)/(2*l) = 0", []),
        ("pendulum", "potential-energy", "2mgl sin^2 phi/2", "2*m*g*l*sin(phi/2)^2", ["m*g*l*sin(phi)^2"]),
        ("pendulum", "potential-energy", "mgl sin phi/2", "m*g*l*sin(phi)/2", ["m*g*l*sin(phi/2)"]),
    ],
)
def test_the_reading_taken_and_the_others(scene: str, task: str, answer: str, taken: str, others: list[str]) -> None:
    found = verdict(scene, task, answer)
    workbook = workbook_of({"scene": scene})
    one = [c.reading.shown for c in candidates(workbook.task(task), workbook.solution, answer, "plain")]
    assert [reading.plain for reading in found.readings if not reading.taken] == others
    if others:
        assert [reading.plain for reading in found.readings if reading.taken] == [taken]
    else:
        assert len(one) == 1
        again = verdict(scene, task, taken)
        assert (again.outcome, again.understood_as) == (found.outcome, found.understood_as)


@pytest.mark.parametrize(
    ("task", "answer"),
    [
        ("potential-energy", "2mgl sin^2 phi/2"),
        ("potential-energy", "-mgl + mgl sin phi/2 + 2mgl sin^2 phi/2"),
        ("eigenfrequencies", "omega = sqrt(g/l) sin phi/2"),
        ("conserved:1", "1/2m l phi'^2"),
    ],
)
def test_each_reading_written_out_is_read_in_no_other_way(task: str, answer: str) -> None:
    readings = verdict("pendulum", task, answer).readings
    assert len(readings) >= 2
    for reading in readings:
        for syntax, text in zip(BOTH, (reading.plain, reading.latex), strict=True):
            again = verdict("pendulum", task, text, syntax)
            assert again.outcome != "invalid", text
            assert again.readings == ()


@pytest.mark.parametrize("comma", [False, True])
def test_a_comma_between_digits_is_told_by_the_task_and_the_language(*, comma: bool) -> None:
    assert verdict("pendulum", "kinetic-energy", "0,5*m*l^2*phi'^2", comma=comma).outcome == "correct"
    assert (
        verdict("pendulum", "kinetic-energy", r"0{,}5m\ell^2\dot\varphi^2", "latex", comma=comma).outcome == "correct"
    )
    assert verdict("cart-pendulum", "virtual-displacement:cart", "[1,0] delta(x)", comma=comma).outcome == "correct"
    parts = verdict("two-mass-oscillator", "eigenfrequencies", "3,13", comma=comma).parts
    assert len(parts) == (0 if comma else 2)


def test_a_chain_tells_the_member_that_does_not_hold() -> None:
    found = verdict("pendulum", "kinetic-energy", "T = m l^2 phi'^2 = 1/2 m l^2 phi'^2")
    assert (found.outcome, found.remark) == ("wrong", "chain")
    assert found.parameters["member"] == r"m \ell^{2} \dot{\varphi}^{2}"


NUMBERED = [
    row
    for row in habits()
    if row.right and not row.held_out and row.answer[:1] in "TVLpφx\\" and "\n" not in row.answer
]


@pytest.mark.parametrize("row", NUMBERED[::8], ids=lambda row: row.answer)
def test_numbering_changes_nothing(row: Habit) -> None:
    space = r"\;" if row.syntax == "latex" else " "
    numbered = [f"({n}){space}{row.answer}" for n in ("1", "3a", "IV", "*")] + [f"{row.answer}{space}(7)"]
    assert {verdict(row.scene, row.task, text, row.syntax).outcome for text in numbered} == {"correct"}


@pytest.mark.parametrize(
    ("answer", "code"),
    [
        ("m*L^2", "unknown-name"),
        ("L = T - V", "answer-implicit"),
        ("L = T - V, T = m, T = l, V = 0", "answer-defined-twice"),
        ("L = a, a = b, b = a", "answer-circular"),
        ("L^2 = m", "answer-left-side"),
        ("L = m; L = m", "answer-several"),
        ("L = " + " = ".join(["m"] * 14), "answer-statements"),
    ],
)
def test_what_cannot_be_read_is_told(answer: str, code: str) -> None:
    found = verdict("pendulum", "lagrangian", answer)
    assert [problem.code for problem in found.problems] == [code]
    for language in ("de", "en"):
        assert "{" not in message(language, found.problems[0])


# --- bounds ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("syntax", BOTH)
@pytest.mark.parametrize(("scene", "task"), [("pendulum", "position:bob"), ("cart-pendulum", "equations")])
def test_hostile_texts_are_refused_soon(scene: str, task: str, syntax: Syntax) -> None:
    for text in (*CODE, *BOMBS, *LARGE, *LATEX, *MARKUP):
        seconds = []
        while not seconds or (seconds[-1] >= SLOW and len(seconds) < 2):  # once, garbage of other tests is collected
            started = time.process_time()
            found = verdict(scene, task, text, syntax)
            seconds.append(time.process_time() - started)
        assert min(seconds) < SLOW, text[:80]
        assert found.outcome in ("invalid", "wrong"), text[:80]


@pytest.mark.parametrize("syntax", BOTH)
@pytest.mark.parametrize("unit", ["1/2m ", "x = ", "a = b, ", "((", "\\frac{", "=> ", "(1) ", "sin phi/2 + "])
def test_a_megabyte_is_refused_at_once(unit: str, syntax: Syntax) -> None:
    started = time.process_time()
    found = verdict("pendulum", "lagrangian", unit * (1_000_000 // len(unit)), syntax)
    assert [problem.code for problem in found.problems] == ["too-long"]
    assert time.process_time() - started < 0.1


@pytest.mark.parametrize("places", [3, 5, 40, 100])
def test_the_number_of_readings_tried_is_bounded(places: int, monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[object] = []
    module = sys.modules["deltaq.homework.reading.candidates"]
    read_once = module.read_once

    def counted(*given: object) -> object:
        tried.append(given)
        return read_once(*given)

    monkeypatch.setattr(module, "read_once", counted)
    started = time.process_time()
    answer = " + ".join(["m g l sin phi/2"] * places)
    found = verdict("pendulum", "potential-energy", answer)
    assert found.outcome in ("wrong", "invalid")
    assert 4 <= len(tried) <= 2 * MOST_TRIED
    assert len(found.readings) <= 4
    assert time.process_time() - started < 2 * SLOW


def test_definitions_do_not_grow_without_bound() -> None:
    chain = ", ".join(f"a{n} = a{n + 1} + a{n + 1} + a{n + 1} + a{n + 1}" for n in range(1, 10))
    found = verdict("pendulum", "lagrangian", f"L = a1, {chain}, a10 = m")
    assert [problem.code for problem in found.problems] == ["too-many-nodes"]


def test_whatever_is_typed_is_read_or_refused_at_its_place() -> None:
    """Mutations of answers with a fixed seed: no other error than one of the text, at a place within it."""
    draw = random.Random(2204)
    rows = [*habits(), *adversarial()]
    signs = [
        *"=,;()[]{}+-*/^'_\\& .:\"0129xyzTVLpq",
        "=>",
        "\\\\",
        "\\quad",
        " mit ",
        "e_x",
        "δ",
        "∂",
        "\n",
        "\\text{ und }",
    ]
    for _ in range(400):
        row = draw.choice(rows)
        text = row.answer
        for _ in range(draw.randint(1, 4)):
            at = draw.randrange(len(text) + 1)
            text = text[:at] + draw.choice(signs) + text[at + draw.randint(0, 2) :]
        workbook = workbook_of({"scene": row.scene})
        try:
            found = candidates(workbook.task(row.task), workbook.solution, text, draw.choice(BOTH))
        except ExpressionError as error:
            for problem in error.problems:
                assert problem.offset is None or 0 <= problem.offset <= len(text), (text, problem)
                assert "{" not in message("en", problem) or "{" in text, (text, problem)
        else:
            assert found
