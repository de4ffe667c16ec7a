"""Ordering tasks: every order that the derivation's own premises allow is right, every other one is wrong and told why.

The premises are read from the answer to `POST /derivations`, and all that follows from them is worked out here.
"""

from __future__ import annotations

import random
import re
import time
from collections.abc import Iterator, Mapping, MutableSequence, Sequence
from functools import cache
from itertools import combinations
from typing import Any, cast

import pytest
from tests.derivation.random_scenes import random_scene

from deltaq.derivation.step import Step
from deltaq.errors import RequestError
from deltaq.homework.checking import check, compare
from deltaq.homework.feedback import verdict_document
from deltaq.homework.grading import Sheet, grade, plan_of, read_answers
from deltaq.homework.ordering.blocks import Blocks, OrderedSteps, blocks_of, shuffled
from deltaq.homework.ordering.judge import Ordering
from deltaq.homework.quantities import quantity_of
from deltaq.homework.service import check_request, lines_request, reading_request, solution_request, tasks_request
from deltaq.homework.stack.question import Asked, left_out
from deltaq.homework.statement import task_document
from deltaq.homework.task import Task
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.homework.working import Line, parts_of
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.narration.derive import derive_parts

TOO_LONG = {"magnetic-pendulum"}  # nobody reads the forces of three magnets as blocks
# Of scenes with constraints the steps that lead to an equation are not put in order.
SCENES = [name for name in scene_ids() if not load_scene(name).constraints and name not in TOO_LONG]
ORDERS = 200  # of each scene
Needs = Mapping[str, frozenset[str]]


@cache
def book(scene: str, seed: str | None = None) -> Workbook:
    return workbook_of({"scene": scene} | ({"seed": seed} if seed else {}))


def order_tasks(scene: str) -> list[Task]:
    workbook = book(scene)
    return [workbook.task("order-lagrangian"), workbook.task(f"order-equation:{workbook.solution.free[0]}")]


def blocks(workbook: Workbook, task: Task) -> Blocks:
    assert isinstance(task.quantity.judge, Ordering)
    return blocks_of(workbook.solution, task.quantity.judge.goal, task.subject)


def judged(workbook: Workbook, task: Task, order: Sequence[str]) -> Verdict:
    return check(workbook, task, "; ".join(order), "plain")


def model_order(scene: str, seed: str | None = None) -> tuple[str, ...]:
    answer = solution_request({"scene": scene, "task": "order-lagrangian"} | ({"seed": seed} if seed else {}))
    return tuple(cast("list[str]", answer["plain"]))


MODEL = model_order("pendulum")


@cache
def premises(scene: str) -> Mapping[str, tuple[str, ...]]:
    """What each step and substep rests on, as the answer of the API says."""
    answer: Any = next(derive_parts({"scene": scene}))
    left = [step for chapter in answer["chapters"] for step in chapter["steps"]]
    found = {}
    while left:
        step = left.pop()
        found[step["id"]] = tuple(step["premises"])
        left += step["substeps"]
    return found


def below(scene: str, step: str) -> set[str]:
    """All that a step rests on, by way of others too."""
    seen: set[str] = set()
    left = [step]
    while left:
        new = {*premises(scene)[left.pop()]} - seen
        seen |= new
        left += new
    return seen


def block_documents(scene: str, task: Task, language: str) -> list[dict[str, str]]:
    found = task_document(task, book(scene), language)["blocks"]
    return cast("list[dict[str, str]]", found)


def needs(scene: str, known: Blocks) -> Needs:
    """For each letter of a block that belongs those of the blocks that it rests on."""
    letters = {block.step.id: block.id for block in known.shown if block.mistake is None}
    return {
        letter: frozenset(letters[one] for one in below(scene, step) & letters.keys())
        for step, letter in letters.items()
    }


def topological(needed: Needs, source: random.Random) -> list[str]:
    """One of the orders in which everything stands after what it needs, block by block at random."""
    order: list[str] = []
    while len(order) < len(needed):
        ready = [letter for letter in needed if letter not in order and needed[letter] <= {*order}]
        order.append(source.choice(ready))
    return order


def broken(order: Sequence[str], needed: Needs) -> Iterator[list[str]]:
    """The order with one block moved before one that it needs, or that one moved behind it: all ways there are."""
    for later in order:
        for earlier in needed[later]:
            rest = [letter for letter in order if letter != later]
            yield [*rest[: rest.index(earlier)], later, *rest[rest.index(earlier) :]]
            rest = [letter for letter in order if letter != earlier]
            yield [*rest[: rest.index(later) + 1], earlier, *rest[rest.index(later) + 1 :]]


def first_too_early(order: Sequence[str], needed: Needs) -> tuple[str, frozenset[str]]:
    return next(
        (letter, needed[letter] - {*order[:place]})
        for place, letter in enumerate(order)
        if needed[letter] - {*order[:place]}
    )


@pytest.mark.one_in(8)
@pytest.mark.parametrize("scene", SCENES)
def test_every_order_is_right_that_the_premises_allow_and_no_other(scene: str) -> None:
    workbook, source = book(scene), random.Random(scene)
    for task in order_tasks(scene):
        known = blocks(workbook, task)
        needed = needs(scene, known)
        assert 5 <= len(needed) <= 9
        orders = [topological(needed, source) for _ in range(ORDERS // 2)]
        assert {judged(workbook, task, order).outcome for order in orders} == {"correct"}
        assert len(set(map(tuple, orders))) > 3  # there is a choice
        shown = [block.id for block in known.shown if block.id in needed]
        assert judged(workbook, task, shown).outcome == "wrong"  # and nothing is given away
        for order in broken(orders[0], needed):
            verdict = judged(workbook, task, order)
            assert verdict.outcome == "wrong", order
            early, lacking = first_too_early(order, needed)
            assert (verdict.remark, verdict.blocks[0].id) == ("order-needs", early)
            told = verdict.blocks[1].id
            assert told in lacking
            assert not any(told in needed[other] for other in lacking)  # the block uses it itself
            assert 0 <= verdict.partial < 1


def edits(order: Sequence[str], needed: Needs) -> int:
    """The fewest blocks taken out and put in, by trying all sets of blocks that stay."""
    belonging = [letter for letter in order if letter in needed]
    sizes = range(len(belonging), -1, -1)
    kept = next(
        size
        for size in sizes
        for some in combinations(belonging, size)
        if not any(b in needed[a] for a, b in combinations(some, 2))
    )
    return len(order) - kept + len(needed) - kept


@pytest.mark.parametrize("scene", ["pendulum", "elastic-pendulum", "chain-pendulum", "quarter-car"])
def test_the_share_is_what_the_fewest_edits_leave(scene: str) -> None:
    source = random.Random(scene)
    shares = set()
    for task in order_tasks(scene):
        known = blocks(book(scene), task)
        needed = needs(scene, known)
        letters = [block.id for block in known.shown]
        for number in range(60):
            order = (
                topological(needed, source) if number % 2 else source.sample(letters, source.randint(1, len(letters)))
            )
            at = source.randrange(len(order))
            order.insert(source.randrange(len(order)), order.pop(at))
            verdict = judged(book(scene), task, order)
            count = edits(order, needed)
            assert (verdict.outcome == "correct") == (count == 0)
            assert verdict.partial == pytest.approx(max(0, 1 - count / len(needed)) if count else 0)
            shares.add(round(verdict.partial, 3))
    assert len(shares) > 4


@pytest.mark.parametrize("seed", [4025, 4039])
def test_long_scenes_have_no_orders(seed: int) -> None:
    """Forces of 20,000 operations, and five coordinates: nobody reads such blocks, and nobody waits for them."""
    solution = Workbook(random_scene(seed)).solution
    begin = time.process_time()
    for kind in ("order-lagrangian", "order-equation"):
        quantity = quantity_of(kind)
        assert quantity
        assert not quantity.subjects(solution)
    assert time.process_time() - begin < 4


# --- blocks that do not belong ---------------------------------------------------------------------------------------

STATED = {"kinetic-energy": "kinetic-energy", "lagrangian": "lagrangian", "momentum": "momentum:{subject}"}


def rows(latex: str) -> list[str]:
    """What stands behind the sign in each row of a formula."""
    inside = latex.removeprefix(r"\begin{aligned}").removesuffix(r"\end{aligned}")
    return [row.rpartition("&")[2].removeprefix("=").strip() for row in re.split(r"\\\\\[0\.\d+em\]", inside)]


@pytest.mark.one_in(3)
@pytest.mark.parametrize("scene", [*SCENES[::5], "rolling-disc", "wind-on-rod"])
def test_the_wrong_block_is_wrong_and_its_twin_is_right(scene: str) -> None:
    """What they say is taken as the answer to the task that asks for just that."""
    for task in order_tasks(scene):
        known, shown = blocks(book(scene), task), block_documents(scene, task, "en")
        (wrong,) = (block for block in known.shown if block.mistake is not None)
        (twin,) = (block for block in known.shown if block.step.id == wrong.step.id and block is not wrong)
        formulas = {block["id"]: rows(block["latex"])[-1] for block in shown}
        assert formulas[wrong.id] != formulas[twin.id]
        kind = "kinetic-energy" if wrong.step.rule.startswith("kinetic-energy") else wrong.step.rule
        if kind in STATED:
            asked = book(scene).task(STATED[kind].format(subject=task.subject or book(scene).solution.free[0]))
            assert is_right(scene, asked, formulas[twin.id])
            assert is_right(scene, asked, formulas[wrong.id]) is False


def is_right(scene: str, task: Task, latex: str) -> bool | None:
    given = parts_of(book(scene), Line(task.id, latex, "latex"))
    return compare(book(scene), task, given).equal


@pytest.mark.parametrize("language", ["de", "en"])
def test_a_wrong_block_is_named_wherever_it_stands(language: str) -> None:
    workbook = book("elastic-pendulum")
    for task in order_tasks("elastic-pendulum"):
        known = blocks(workbook, task)
        (wrong,) = (block for block in known.shown if block.mistake is not None)
        assert wrong.mistake is not None
        for place in range(len(known.model) + 1):
            verdict = judged(workbook, task, [*known.model[:place], wrong.id, *known.model[place:]])
            assert (verdict.outcome, verdict.remark) == ("wrong", "order-wrong-block")
            assert verdict.misconceptions == (wrong.mistake.id,)
            assert verdict.partial == pytest.approx(1 - 1 / len(known.model))
            told = verdict_document(verdict, workbook.scene, language)
            assert told["blocks"] == [wrong.id]
            assert f"({wrong.id})" in told["feedback"]  # type: ignore[operator]


# --- the answer of the API -------------------------------------------------------------------------------------------


def test_the_first_mistake_is_told_in_words() -> None:
    answer: Any = tasks_request({"scene": "pendulum", "lang": "en"})
    (task,) = (one for one in answer["tasks"] if one["id"] == "order-lagrangian")
    letter = {block["title"]: block["id"] for block in task["blocks"]}
    velocity, energy = letter["Velocity: bob"], letter["Kinetic energy: bob"]
    rest = [one for one in MODEL if one not in (velocity, energy)]
    early = f"“Kinetic energy: bob” ({energy}) uses “Velocity: bob” ({velocity})"

    def said(order: Sequence[str]) -> tuple[object, object]:
        asked = {"scene": "pendulum", "task": "order-lagrangian", "answer": {"value": "; ".join(order)}}
        verdict = check_request(asked)
        return verdict["feedback"], verdict["blocks"]

    first = [rest[0], energy, velocity, *rest[1:]]
    assert said(first) == (f"Not right yet. {early} and must stand after it.", [energy, velocity])
    left = [rest[0], energy, *rest[1:]]
    assert said(left) == (f"Not right yet. {early}, which you have left out.", [energy, velocity])
    assert said(MODEL[:-1]) == (f"Not right yet. “Lagrange function” ({MODEL[-1]}) is missing.", [MODEL[-1]])


@pytest.mark.one_in(2)
@pytest.mark.parametrize("scene", ["pendulum", "double-pendulum", "guided-pendulum", "quarter-car", "heavy-top"])
def test_blocks_say_what_the_steps_of_the_derivation_say(scene: str) -> None:
    """Each row of a block is the end of a row of a step with the same title, whoever's; but for the wrong block."""
    answer: Any = next(derive_parts({"scene": scene, "lang": "de"}))
    steps = [step for chapter in answer["chapters"] for step in chapter["steps"]]
    steps += [substep for step in steps for substep in step["substeps"]]
    for task in order_tasks(scene):
        wrong = {block.id for block in blocks(book(scene), task).shown if block.mistake is not None}
        for block in block_documents(scene, task, "de"):
            own = re.compile(rf"{re.escape(block['title'])}( \([^()]+\))?")
            alike = [rows(step["latex"]) for step in steps if own.fullmatch(step["title"])]
            assert block["spoken"]
            if block["id"] not in wrong:
                assert any(set(rows(block["latex"])) <= {*said} for said in alike), block


def test_everybody_has_an_order_of_their_own() -> None:
    answers = [model_order("pendulum", seed) for seed in ("ada", "ada", "emmy", "sofja", "maria")]
    assert answers[0] == answers[1]
    assert len(set(answers)) == 4
    task = book("pendulum", "emmy").task("order-lagrangian")
    assert judged(book("pendulum", "emmy"), task, answers[2]).outcome == "correct"
    assert judged(book("pendulum", "emmy"), task, answers[0]).outcome == "wrong"


def test_what_stands_right_by_chance_is_shuffled_again() -> None:
    class Stacked(random.Random):
        """Leaves everything as it is twice."""

        left = 2

        def shuffle(self, x: MutableSequence[Any]) -> None:
            self.left -= 1
            if self.left < 0:
                super().shuffle(x)

    steps = tuple(Step(name, "", ()) for name in "rvE")
    ordered = OrderedSteps(steps, {"r": frozenset(), "v": frozenset("r"), "E": frozenset("rv")})
    source = Stacked(1)
    found = shuffled(ordered, None, source)
    assert source.left < 0
    assert [block.step.id for block in found.shown] != ["r", "v", "E"]
    assert [next(block.step.id for block in found.shown if block.id == letter) for letter in found.model] == [
        "r",
        "v",
        "E",
    ]


@pytest.mark.parametrize(
    ("syntax", "between"),
    [
        *(("plain", sign) for sign in (";", ", ", " ", "", "\n", " → ", " -> ", ") ")),
        *(("latex", sign) for sign in (r"\;", r" \to ", r",\, ", ";", r" \rightarrow ", r"} \text{")),
    ],
)
def test_letters_are_read_however_they_are_parted(syntax: str, between: str) -> None:
    for letters in (MODEL, tuple(map(str.upper, MODEL))):
        text = between.join(letters)
        asked = {"syntax": syntax, "value": rf"\text{{{text}}}" if between.startswith("}") else text}
        assert check_request({"scene": "pendulum", "task": "order-lagrangian", "answer": asked})["outcome"] == "correct"
        read = reading_request({"scene": "pendulum", "task": "order-lagrangian", "answer": asked})
        assert read["plain"] == "; ".join(MODEL)


@pytest.mark.parametrize(
    ("answer", "code", "offset"),
    [
        ("", "empty", None),
        (" ; ; ", "empty", None),
        ("a; b; x", "answer-block-unknown", 6),
        ("a; Velocity; b", "answer-block-unknown", 3),
        ("1; 2; 3", "answer-block-unknown", 0),
        ("a; ä", "answer-block-unknown", 3),
        ("a; b; c; b", "answer-block-twice", 9),
        ("abca", "answer-block-twice", 3),
        ("m*l^2*ddot(phi) = 0", "answer-block-unknown", 0),
        ("a; " * 600_000, "too-long", 2000),
    ],
)
def test_what_is_no_order_is_refused(answer: str, code: str, offset: int | None) -> None:
    verdict = check(book("pendulum"), book("pendulum").task("order-lagrangian"), answer, "plain")
    assert verdict.outcome == "invalid"
    (problem,) = verdict.problems
    assert (problem.code, problem.offset) == (code, offset)
    for language in ("de", "en"):
        assert verdict_document(verdict, book("pendulum").scene, language)["feedback"]


def test_a_megabyte_never_reaches_the_judge() -> None:
    asked = {"scene": "pendulum", "task": "order-lagrangian", "answer": {"value": "a; " * 400_000}}
    with pytest.raises(RequestError) as caught:
        check_request(asked)
    assert caught.value.problems[0].code == "request-text-too-long"


# --- where answers go ------------------------------------------------------------------------------------------------


def test_orders_are_marked_in_workings_and_tables() -> None:
    wrong = [MODEL[1], MODEL[0], *MODEL[2:]]
    right = "; ".join(MODEL)
    lines = [("order-lagrangian", "; ".join(wrong)), ("kinetic-energy", "m*l^2*dot(phi)^2")]
    lines += [("lagrangian", "m*l^2*dot(phi)^2 + m*g*l*cos(phi)"), ("order-lagrangian", right)]
    told: Any = lines_request({"scene": "pendulum", "lines": [{"task": t, "answer": {"value": v}} for t, v in lines]})
    assert [line["outcome"] for line in told["lines"]] == ["wrong", "wrong", "follow_through", "correct"]
    assert [line["points"] for line in told["lines"]][::3] == [1.5, 0.5]
    rows = [f'ada,pendulum,order-lagrangian,"{right}"', f"emmy,pendulum,order-lagrangian,{''.join(wrong)}"]
    table = "\n".join(["student,scene,task,answer", *rows])
    graded = [one for _, one in grade(plan_of(read_answers(table.encode()), Sheet(), "en"), "en")]
    assert [(one.outcome, one.points) for one in graded] == [("correct", 2.0), ("wrong", 1.5)]
    assert graded[1].mistake == "a step before another one that it uses"


def test_stack_leaves_orders_out_by_name() -> None:
    workbook = book("pendulum")
    told = left_out(Asked(workbook, task) for task in workbook.tasks)
    assert {"order-lagrangian", "order-equation:phi"} <= set(told)
