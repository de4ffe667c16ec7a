"""Classes drawn by a seed: both ways of marking them give the same file, and the rules hold whatever is handed in."""

from __future__ import annotations

import json
import random
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import pytest
from tests.homework.both_graders import by_page, by_shell
from tests.homework.classes import class_archive, class_table

from deltaq.homework.assignment import read_assignment
from deltaq.homework.gradebook import Gradebook, Plan, refusal
from deltaq.homework.grading import Sheet, plan_of, read_answers
from deltaq.homework.results import OUTCOMES, Graded

SAME = range(5)
SEEDS = range(40, 80)
READABLE = ("correct", "wrong", "follow_through")


def test_the_shell_and_the_page_give_the_same_file(
    root: Path, tmp_path: Path, server: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """200 of them, of four students each, are marked by `python -m tests.benchmarks.bench_grader`."""
    tables = [*(class_table(seed, students=2) for seed in SAME), *(class_archive(seed) for seed in SAME)]
    pages = list(by_page(tables, server, root))
    for table, page in zip(tables, pages, strict=True):
        assert page == by_shell(table, tmp_path), table.seed


def plan_by_seed(seed: int) -> Plan:
    table = class_table(seed, students=6)
    assignment = read_assignment(table.assignment) if table.assignment else None
    return plan_of(read_answers(table.data), Sheet(assignment, table.scene), "en")


def marked(plan: Plan, outcomes: dict[int, str]) -> dict[int, Graded]:
    """The rows by number, when the judge says this of each: how points are given does not depend on who judges."""
    book, found = Gradebook(plan), {}
    for index in plan.order:
        row = plan.rows[index]
        outcome = "invalid" if book.question(row) is None else outcomes[row.number]
        found[row.number] = book.enter(row, refusal("", outcome))
    return found


def drawn_outcomes(seed: int, plan: Plan) -> dict[int, str]:
    source = random.Random(seed)
    return {row.number: source.choice(OUTCOMES) for row in plan.rows}


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", SEEDS)
def test_nobody_earns_more_than_a_task_counts_nor_less_than_their_best_answer(seed: int) -> None:
    plan = plan_by_seed(seed)
    outcomes = drawn_outcomes(seed, plan)
    sums, of, best = defaultdict(float), {}, defaultdict(set)
    for each in marked(plan, outcomes).values():
        if each.person and each.target is not None:
            key = each.person, plan.targets[each.target].working, each.task
            sums[key] += each.points
            of[key] = each.of
            best[key].add(each.outcome)
    assert all(0.0 <= sums[key] <= of[key] for key in sums)
    assert all(sums[key] == of[key] for key in sums if "correct" in best[key])
    assert all(sums[key] == 0.0 for key in sums if not best[key] & {"correct", "follow_through"})


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_others_hand_in_changes_nothing(seed: int) -> None:
    """A person's rows earn the same without the rest of the class, wherever these rows stand in between."""
    plan = plan_by_seed(seed)
    outcomes = drawn_outcomes(seed, plan)
    together = marked(plan, outcomes)
    for person in {row.person for row in plan.rows if row.person is not None}:
        own = replace(plan, rows=tuple(row for row in plan.rows if row.person == person))
        for number, each in marked(own, outcomes).items():
            assert together[number] == each


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", SEEDS)
def test_whoever_hands_in_everything_twice_earns_no_more(seed: int) -> None:
    plan = plan_by_seed(seed)
    outcomes = drawn_outcomes(seed, plan)
    named = replace(plan, rows=tuple(row for row in plan.rows if row.person is not None))
    twice = replace(named, rows=(*named.rows, *(replace(row, number=-row.number) for row in named.rows)))
    doubled = marked(twice, outcomes | {-number: outcome for number, outcome in outcomes.items()})
    once = marked(named, outcomes)
    assert sum(each.points for each in doubled.values()) == pytest.approx(sum(each.points for each in once.values()))


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_line_is_asked_about_with_the_last_wrong_answers_before_it_alone(seed: int) -> None:
    plan = plan_by_seed(seed)
    outcomes = drawn_outcomes(seed, plan)
    book = Gradebook(plan)
    before: dict[object, list[tuple[str, str, str]]] = defaultdict(list)  # by working: task, outcome, answer
    for index in plan.order:
        row = plan.rows[index]
        question = book.question(row)
        if question is None:
            book.refuse(row)
            continue
        working = plan.working_of(row)
        lines = before[working] if working else []
        for task in {task for task, _, _ in lines}:
            said = [(outcome, answer) for one, outcome, answer in lines if one == task and outcome in READABLE]
            standing = [one.answer.value for one in question.standing if one.task == task]
            assert standing == [answer for outcome, answer in said[-1:] if outcome != "correct"]
        assert len(question.standing) <= len({task for task, _, _ in lines})
        lines.append((question.task, outcomes[row.number], row.answer))
        book.enter(row, refusal("", outcomes[row.number]))


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_plan_crosses_a_border_as_it_is(seed: int) -> None:
    plan = plan_by_seed(seed)
    assert Plan.read(json.loads(json.dumps(plan.document))) == plan
