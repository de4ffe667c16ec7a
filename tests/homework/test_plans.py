"""A table as the plan by which it is marked, row by row; one row judged; and what is told of the whole."""

from __future__ import annotations

from typing import Any

import pytest

from deltaq.contract.base import SceneWithChanges
from deltaq.homework import grading
from deltaq.homework.assignment import read_assignment
from deltaq.homework.gradebook import Plan, Row, Shares, Target, earned_share
from deltaq.homework.grading import Sheet, grade, plan_of, read_answers, row_verdict
from deltaq.homework.results import Graded, summary, totals
from deltaq.homework.table import Style

KINETIC, EQUATION = "kinetic-energy", "equation:phi"
ASSIGNMENT = {
    "format": 1,
    "follow_through": 0.25,
    "individual": True,
    "tasks": [
        {"scene": "pendulum", "task": KINETIC, "points": 5},
        {"scene": "pendulum", "task": KINETIC, "points": 2},
        {"scene": "elastic-pendulum", "task": KINETIC},
        {"scene": "pendulum", "task": EQUATION},
    ],
}
ENERGY, MOTION = "Kinetic energy", r"Equation of motion of $\varphi$"


def target(scene: str, *rest: Any) -> Target:
    return Target(SceneWithChanges(scene=scene), scene, *rest)


TARGETS = (
    target("pendulum", KINETIC, ENERGY, 5.0),
    target("pendulum", KINETIC, ENERGY, 2.0),
    target("elastic-pendulum", KINETIC, ENERGY, 2.0),
    target("pendulum", EQUATION, MOTION, 3.0),
)
NO_SUCH = f"There is no task “{{}}” in this scene. There are: {KINETIC}, {KINETIC}, {KINETIC}, {EQUATION}.".format
SEVERAL = (
    f"Several tasks of the assignment are called “{KINETIC}”: 1 (pendulum), 2 (pendulum), 3 (elastic-pendulum). "
    "Write the number of the one that is meant, or its scene into the column scene."
)
NO_NUMBER = (
    "“first” in the column line is no number. The number says where in the working the answer stands; leave the cell "
    "empty if it stands alone."
)
TOO_MANY = (
    "This row has more cells than the header: “more  cells” belongs to no column. An answer that contains a separator "
    "must stand in quotes."
)
HEADER = "student,scene,task,answer,syntax,seed,line"


def plan(table: str, assignment: object = None, scene: object = "", language: str = "en") -> Plan:
    sheet = Sheet(None if assignment is None else read_assignment(assignment), scene)
    return plan_of(read_answers(table.encode()), sheet, language)


def ada(task: str, scene: str = "", **more: Any) -> Row:
    first = int("target" in more and "refused" not in more)  # what answers no task is no attempt at one
    return Row(2, "ada", scene, task, "a", **({"person": "ada", "seed": "ada", "attempt": first} | more))


def refused(task: str, told: str, scene: str = "") -> Row:
    return ada(task, scene, refused=told, column="task", seed=None)


@pytest.mark.parametrize(
    ("cells", "row"),
    [
        pytest.param("ada,,1,a,,,", ada("1", target=0), id="the first by its number"),
        pytest.param("ada,,4,a,,,", ada("4", target=3), id="the last by its number"),
        pytest.param("ada,,0004,a,,,", ada("0004", target=3), id="a number with zeros"),
        pytest.param("ada,,00004,a,,,", refused("00004", NO_SUCH("00004")), id="a number with too many"),
        pytest.param("ada,,0,a,,,", refused("0", NO_SUCH("0")), id="before the first"),
        pytest.param("ada,,5,a,,,", refused("5", NO_SUCH("5")), id="after the last"),
        pytest.param(f"ada,,{'x' * 70},a,,,", refused("x" * 70, NO_SUCH("x" * 64)), id="an endless name"),
        pytest.param(f"ada,,{EQUATION},a,,,", ada(EQUATION, target=3), id="the only one of this name"),
        pytest.param(f"ada,,{KINETIC},a,,,", refused(KINETIC, SEVERAL), id="several of this name"),
        pytest.param(
            f"ada,pendulum,{KINETIC},a,,,", ada(KINETIC, "pendulum", target=0), id="the first of those in the scene"
        ),
        pytest.param(
            f"ada,elastic-pendulum ,{KINETIC} ,a,,,",
            ada(f"{KINETIC} ", "elastic-pendulum ", target=2),
            id="the one in the other scene",
        ),
        pytest.param(f"ada,swing,{EQUATION},a,,,", ada(EQUATION, "swing", target=3), id="the only one, another scene"),
        pytest.param(f"ada,swing,{KINETIC},a,,,", refused(KINETIC, SEVERAL, "swing"), id="several, another scene"),
        pytest.param("ada,,4,a, LaTeX ,,", ada("4", target=3, syntax="latex"), id="the syntax"),
        pytest.param("ada,,4,a,Plain,,", ada("4", target=3), id="the usual syntax by its name"),
        pytest.param("ada,,4,a,, s9 ,", ada("4", target=3, seed="s9"), id="the values of another"),
        pytest.param("ada,,4,a,,,-2", ada("4", target=3, line=-2.0), id="a line"),
        pytest.param('ada,,4,a,,,"1,25"', ada("4", target=3, line=1.25), id="a line between others, in German"),
        pytest.param("ada,,4,a,,, 1.5 ", ada("4", target=3, line=1.5), id="a line between others"),
        pytest.param(
            " Zoe\u0308 ,,4,a,,,",
            Row(2, " Zoe\u0308 ", "", "4", "a", person="Zo\u00eb", target=3, seed="Zoe\u0308", attempt=1),
            id="a name with an accent",
        ),
        pytest.param(",,4,a,,,", Row(2, "", "", "4", "a", target=3), id="nobody"),
        pytest.param(
            "ada,,4,a,word,,1",
            ada("4", target=3, refused="There is no syntax “word”; there are plain and latex.", column="syntax"),
            id="no such syntax",
        ),
        pytest.param("ada,,4,a,,,first", ada("4", target=3, refused=NO_NUMBER, column="line"), id="no such line"),
        pytest.param(
            f"ada,,4,a,,,1,{'z' * 60}",
            ada("4", target=3, refused=TOO_MANY.replace("more  cells", "z" * 40), column="answer"),
            id="an endless cell too many",
        ),
        pytest.param(
            "ada,,4,a,,,1,more, cells", ada("4", target=3, refused=TOO_MANY, column="answer"), id="cells too many"
        ),
    ],
)
def test_a_row_of_an_assignment(cells: str, row: Row) -> None:
    found = plan(f"{HEADER}\n{cells}\n", ASSIGNMENT)
    assert found.rows == (row,)
    assert found.targets == TARGETS


def test_an_assignment_says_what_its_tasks_count() -> None:
    """The energy stands on it twice and is earned once: 5 + 2 + 3."""
    found = plan("task,answer\n1,a\n", ASSIGNMENT)
    assert (found.share, found.of, found.style) == (0.25, 10.0, Style())


def test_rows_without_an_assignment_name_their_scenes() -> None:
    table = (
        f"task;scene;answer\n{KINETIC}; pendulum ;a\n{KINETIC};swing;b\n{KINETIC};;c\nnone;pendulum;d\n"
        f"{KINETIC};swing;e\n{KINETIC};pendulum;f\nnone;pendulum;g\n"
    )
    found = plan(table, scene="cart-pendulum", language="de")
    assert found.targets == (
        target("pendulum", KINETIC, "Kinetische Energie", 2.0),
        target("cart-pendulum", KINETIC, "Kinetische Energie", 2.0),
    )
    assert [(row.number, row.answer, row.target, row.column) for row in found.rows] == [
        (2, "a", 0, ""),
        (3, "b", None, "scene"),
        (4, "c", 1, ""),
        (5, "d", None, "task"),
        (6, "e", None, "scene"),
        (7, "f", 0, ""),
        (8, "g", None, "task"),
    ]
    assert found.rows[1].refused.startswith("Es gibt keine Szene „swing“. Es gibt: atwood, ")
    assert found.rows[3].refused.startswith("Die Aufgabe „none“ gibt es in dieser Szene nicht. Es gibt: position:bob, ")
    assert (found.share, found.of, found.style) == (0.5, None, Style(";"))


@pytest.mark.parametrize(
    ("header", "person"),
    [
        pytest.param("task,answer,student", "ada", id="a name"),
        pytest.param("task,answer,line", "", id="lines alone are the working of one person"),
        pytest.param("task,answer,scene", None, id="neither"),
    ],
)
def test_whose_row_it_is(header: str, person: str | None) -> None:
    cell = {"student": "ada", "line": "1", "scene": ""}[header.rpartition(",")[2]]
    (row,) = plan(f"{header}\n{KINETIC},a,{cell}\n", scene="pendulum").rows
    assert row.person == person


@pytest.mark.parametrize("individual", [False, True])
def test_values_belong_to_a_name_only_where_everybody_has_their_own(individual: bool) -> None:
    (row,) = plan("task,answer,student\n1,a,ada\n", {**ASSIGNMENT, "individual": individual}).rows
    assert row.seed == ("ada" if individual else None)


def test_what_many_wrote_is_judged_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def judged(question: dict[str, Any]) -> dict[str, Any]:
        asked.append(question["answer"]["value"])
        return row_verdict(question)

    monkeypatch.setattr(grading, "row_verdict", judged)
    table = f"scene,task,answer\npendulum,{KINETIC},m\npendulum,{KINETIC},l\npendulum,{KINETIC},m\n"
    found = [each.outcome for _, each in grade(plan(table), "en")]
    assert (found, asked) == (["wrong"] * 3, ["m", "l"])


T, DOUBLE_T = "m*l^2*dot(phi)^2/2", "m*l^2*dot(phi)^2"
FACTOR = (
    "Not right yet. Which factor stands before $m v^2$? Check it with a body that moves in a straight line."
    r" It is about this term: $m \ell^{2} \dot{\varphi}^{2}$."
)


def told(outcome: str, understood: str, feedback: str, mistake: str = "", title: str = "", remark: str = "") -> object:
    return {
        "outcome": outcome,
        "remark": remark,
        "misconception": mistake,
        "mistake": title,
        "understood_as": understood,
        "feedback": feedback,
    }


@pytest.mark.parametrize(
    ("task", "answer", "standing", "entry"),
    [
        pytest.param(
            KINETIC, T, "", told("correct", r"\frac{1}{2} m \ell^{2} \dot{\varphi}^{2}", "Correct."), id="right"
        ),
        pytest.param(
            "potential-energy",
            "m*g*l*(1 - cos(phi))",
            "",
            told(
                "correct",
                r"m g \ell (1 - \cos\varphi)",
                "Correct. Your answer differs by a constant only, which changes no force.",
                remark="constant",
            ),
            id="right in a sense",
        ),
        pytest.param(
            KINETIC,
            DOUBLE_T,
            "",
            told(
                "wrong",
                r"m \ell^{2} \dot{\varphi}^{2}",
                FACTOR,
                "half-in-kinetic-energy",
                "Factor of the kinetic energy",
            ),
            id="a misconception",
        ),
        pytest.param(
            "potential-energy",
            "-2*m*g*l*cos(phi)",
            "",
            told(
                "wrong",
                r"-2 m g \ell \cos\varphi",
                r"Not right yet. One term is too large by a factor of 2: $-2 m g \ell \cos\varphi$.",
                "slip:double",
                "a term twice as large",
            ),
            id="a slip",
        ),
        pytest.param(
            EQUATION,
            "0 = 0",
            "",
            told(
                "wrong",
                "0 = 0",
                "Not right yet. This always holds, or determines no acceleration; it says nothing about the motion.",
                "degenerate",
                "says nothing about the motion",
                "degenerate",
            ),
            id="a remark",
        ),
        pytest.param(
            KINETIC,
            "log(cos(phi) - 2)",
            "",
            told(
                "undecided",
                r"\ln(\cos\varphi - 2)",
                "It could not be decided whether this is equivalent. Write it more simply, or ask; it does not count "
                "as wrong.",
            ),
            id="undecided",
        ),
        pytest.param(
            KINETIC,
            "m*(",
            "",
            told("invalid", "", "This could not be read. The expression ends too early: something is missing here."),
            id="unreadable",
        ),
        pytest.param(
            EQUATION,
            "2*l*ddot(phi) + g*sin(phi) = 0",
            DOUBLE_T,
            told(
                "follow_through",
                r"2 \ell \ddot{\varphi} + g \sin\varphi = 0",
                "Follows correctly from your earlier lines.",
            ),
            id="what follows from a wrong line",
        ),
    ],
)
def test_a_row_is_judged(task: str, answer: str, standing: str, entry: dict) -> None:
    earlier = [{"task": KINETIC, "answer": {"syntax": "plain", "value": standing}}] if standing else []
    question = {"scene": "pendulum", "task": task, "answer": {"value": answer}, "standing": earlier, "lang": "en"}
    assert row_verdict(question) == {**entry, "share": 0.0}  # an answer of one part


def test_of_several_misconceptions_the_likeliest_is_named() -> None:
    answer = {"value": "m*g*l*cos(phi)"}
    found = row_verdict(
        {"scene": "pendulum", "task": "potential-energy", "answer": answer, "standing": [], "lang": "en"}
    )
    assert (found["misconception"], found["mistake"]) == ("gravity-sign", "Sign of the weight")


@pytest.mark.parametrize(
    ("task", "answer", "mistake"),
    [
        pytest.param(KINETIC, "M*x'^2 + {}/2", "Faktor der kinetischen Energie von Wagen", id="a body"),
        pytest.param(KINETIC, "M*x'^2/2 + {}", "Faktor der kinetischen Energie von Masse", id="another body"),
    ],
)
def test_a_mistake_in_one_body_names_it_in_the_row(task: str, answer: str, mistake: str) -> None:
    value = answer.format("m*(x'^2 + 2*l*x'*phi'*cos(phi) + l^2*phi'^2)")
    question = {"scene": "cart-pendulum", "task": task, "answer": {"value": value}, "standing": [], "lang": "de"}
    assert row_verdict(question)["mistake"] == mistake


def test_what_cannot_be_asked_of_the_scene_is_told_in_the_row() -> None:
    question = {"scene": "swing", "task": KINETIC, "answer": {"value": T}, "standing": [], "lang": "de"}
    found = row_verdict(question)
    assert (found["outcome"], found["feedback"][:29]) == ("invalid", "Es gibt keine Szene „swing“. ")


def row(student: str, outcome: str, points: float = 0.0, *, task: str = "t", **more: Any) -> Graded:
    found = {
        "scene": "s",
        "person": student or None,
        "misconception": "",
        "of": 4.0,
        "target": None,
        "row": 0,
        "attempt": 1,
        "late": False,
        "counts": 1.0,
        "worth": points,
        **dict.fromkeys(
            ("understood_as", "feedback", "answer", "title", "mistake", "column", "id", "time", "file"), ""
        ),
    }
    return Graded(student=student, outcome=outcome, points=points, task=task, **(found | more))


WRONG = {"mistake": "Sign", "misconception": "gravity-sign"}
CLASS = [
    row("ada", "correct", 4.0),
    row("bob", "wrong", **WRONG),
    row("bob", "wrong", **WRONG),
    row("eve", "wrong", **WRONG),
    row("", "wrong"),
    row("eve", "follow_through", 2.0),
    row("ada", "undecided", task="u", target=7, of=1.0),
    row("bob", "invalid", task="u", target=7, of=1.0),
    row("bob", "correct", 1.0, task="u", target=7, of=1.0),
]


def test_a_class_in_total() -> None:
    found = totals(CLASS, None, "en")
    best = [
        (
            one["student"],
            one["points"],
            one["of"],
            [each and (each["outcome"], each["points"]) for each in one["answers"]],
        )
        for one in found["students"]
    ]
    assert best == [
        ("ada", 4.0, 5.0, [("correct", 4.0), ("undecided", 0.0)]),
        ("bob", 1.0, 5.0, [("wrong", 0.0), ("correct", 1.0)]),
        ("eve", 2.0, 4.0, [("follow_through", 2.0), None]),
    ]
    assert (found["points"], found["of"]) == (7.0, 18.0)  # 5 + 5 + 4, and 4 of a row that is nobody's
    assert found["tasks"] == [
        {
            "scene": "s",
            "task": "t",
            "title": "",
            "of": 4.0,
            "count": 6,
            "outcomes": {"correct": 1, "wrong": 4, "follow_through": 1},
            "mistakes": [
                {"outcome": "wrong", "mistake": "Sign", "count": 3, "students": ["bob", "eve"]},
                {"outcome": "wrong", "mistake": "not diagnosed", "count": 1, "students": []},
            ],
        },
        {
            "scene": "s",
            "task": "u",
            "title": "",
            "of": 1.0,
            "count": 3,
            "outcomes": {"undecided": 1, "invalid": 1, "correct": 1},
            "mistakes": [
                {"outcome": "undecided", "mistake": "undecided", "count": 1, "students": ["ada"]},
                {"outcome": "invalid", "mistake": "not readable", "count": 1, "students": ["bob"]},
            ],
        },
    ]


@pytest.mark.parametrize(
    ("outcomes", "best"),
    [
        pytest.param(["invalid", "wrong"], "wrong", id="wrong is better than unreadable"),
        pytest.param(["wrong", "undecided"], "undecided", id="undecided than wrong"),
        pytest.param(["undecided", "follow_through"], "follow_through", id="what follows than undecided"),
        pytest.param(["wrong", "correct", "follow_through"], "correct", id="right than all"),
    ],
)
def test_the_best_of_several_answers(outcomes: list[str], best: str) -> None:
    (student,) = totals([row("ada", outcome, 1.0) for outcome in outcomes], None, "en")["students"]
    (answer,) = student["answers"]
    assert (answer["outcome"], answer["points"], answer["last"]) == (best, float(len(outcomes)), outcomes[-1])


def test_what_an_assignment_counts_is_what_everybody_can_earn() -> None:
    found = totals(CLASS, 9.0, "en")
    assert [each["of"] for each in found["students"]] == [9.0, 9.0, 9.0]
    assert found["of"] == 31.0  # three times 9, and 4 of a row that is nobody's


def test_the_rows_of_a_working_without_a_name_count_and_are_no_student() -> None:
    found = totals([row("", "correct", 4.0, person="")], None, "en")
    assert (found["points"], found["of"], found["students"]) == (4.0, 4.0, [])


def test_a_summary_as_it_is_printed() -> None:
    """The most frequent mistake first; a bar of 30 is all answers of the task, and none is shorter than 1."""
    rare = [row("", "wrong", task="v", mistake="Rare"), row("", "wrong", task="w")]
    more = [row("", "correct", 4.0, task="v") for _ in range(99)]
    assert summary([*CLASS, *rare, *more], "en").splitlines() == [
        "s  t: 1/6 right",
        f"  Sign           {'█' * 15} 3",
        f"  not diagnosed  {'█' * 5} 1",
        "s  u: 1/3 right",
        f"  undecided     {'█' * 10} 1",
        f"  not readable  {'█' * 10} 1",
        "s  v: 99/100 right",
        "  Rare  █ 1",
        "s  w: 0/1 right",
        f"  not diagnosed  {'█' * 30} 1",
    ]


@pytest.mark.parametrize(
    ("misconception", "mistake"),
    [
        pytest.param("gravity-sign", "Sign of the weight", id="a misconception"),
        pytest.param("slip:missing", "a term is missing", id="a slip"),
        pytest.param("factor-vanishes", "a factor that can be zero", id="a remark"),
        pytest.param("", "not diagnosed", id="none"),
    ],
)
def test_a_mistake_without_words_is_named_by_its_id(misconception: str, mistake: str) -> None:
    (task,) = totals([row("ada", "wrong", misconception=misconception)], None, "en")["tasks"]
    assert [one["mistake"] for one in task["mistakes"]] == [mistake]


def test_the_right_parts_of_a_wrong_answer_are_told() -> None:
    right, wrong = "l*phi'' + x''*cos(phi) + g*sin(phi) = 0", "(M + m)*x'' + m*l*phi'' = 0"
    question = {"scene": "cart-pendulum", "task": "equations", "answer": {"value": f"{right}; {wrong}"}, "lang": "en"}
    assert row_verdict({**question, "standing": []})["share"] == 0.5


@pytest.mark.parametrize(
    ("outcome", "remark", "partial", "earned"),
    [
        ("correct", "", 0.0, 1.0),
        ("wrong", "", 0.5, 0.5),
        ("wrong", "", 0.0, 0.0),
        ("undecided", "", 0.5, 0.0),
        ("follow_through", "", 0.5, 0.4),
        ("follow_through", "simplified", 0.0, 0.1),
        ("follow_through", "repeated", 0.0, 0.0),
    ],
)
def test_what_an_answer_earns(outcome: str, remark: str, partial: float, earned: float) -> None:
    assert earned_share(outcome, remark, partial, Shares(0.4, 0.25)) == pytest.approx(earned)
