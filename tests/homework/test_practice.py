"""Systems drawn at random: sound, told in full, the same on every machine, and hard in the way that was asked for."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from typing import Any

import pytest

from deltaq.derivation.engine import derive
from deltaq.errors import UnknownNameError
from deltaq.homework.practice.draw import Draw
from deltaq.homework.practice.exercise import exercise_of, worthwhile
from deltaq.homework.practice.levels import LEVELS, Family, system_of
from deltaq.homework.practice.parts import document_of
from deltaq.homework.practice.symbols import shown
from deltaq.homework.service import check_request, practice_request, solution_request
from deltaq.homework.workbook import workbook_of
from deltaq.mechanics.document import examine
from deltaq.narration.catalog import LANGUAGES, keys

Document = dict[str, Any]
FAMILIES = tuple({family.__name__: family for level in LEVELS for family in level.families}.values())
SEEDS = range(10)
UNTOLD = ("g",)
MASSES = ("bob", "block", "cart", "disc", "guide")
ANSWERED = [(level.number, number) for level in LEVELS for number in (1, 2)]
RECALLED = [
    ("gravity-sign", "potential-energy", 1),
    ("half-in-kinetic-energy", "kinetic-energy", 3),
    ("force-components-swapped", "virtual-work", 1),
    ("energy-slope-dropped", "equation", 4),
    ("guide-velocity-missing", "kinetic-energy", 5),
    ("time-term-kept", "virtual-displacement", 5),
    ("mixed-term-missing", "kinetic-energy", 3),
    ("frequency-without-root", "eigenfrequencies", 6),
]


def drawn(family: Family, seed: int) -> Document:
    return document_of(family(Draw("test", seed)), Draw(seed), "practice")


@pytest.mark.one_in(5)
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_each_system_is_sound_and_its_derivation_verified(family: Family) -> None:
    for seed in SEEDS:
        scene, problems = examine(drawn(family, seed))
        assert problems == ()
    assert scene is not None
    _, derivation = derive(scene)
    assert [step.id for step in derivation.steps() if not step.verified] == []


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_problem_tells_of_every_symbol(family: Family, language: str) -> None:
    for seed in range(12):
        document = drawn(family, seed)
        text = document["summary"][language]
        symbols = [each["name"] for each in (*document["coordinates"], *document["parameters"])]
        missing = [name for name in symbols if not re.search(rf"(?<!\w){shown(name)}(?!\w)", text)]
        assert set(missing) <= set(UNTOLD), text
        assert not re.search(r"[{}*^]", text + document["title"][language])


def test_every_text_is_used() -> None:
    """Each title, sentence, addition and label of the catalog stands in some system."""
    found: dict[str, set[str]] = {"titles": set(), "told": set(), "adds": set(), "labels": set()}
    for part in (family(Draw("texts", seed)) for family in FAMILIES for seed in range(150)):
        found["titles"].add(part.title)
        found["told"] |= {key for key, _ in part.told}
        found["adds"] |= set(part.adds)
        names = {thing["name"] for thing in (*part.points, *part.bodies, *part.loads)}
        found["labels"] |= {part.called.get(name, name) for name in names}
    for section, used in found.items():
        assert set(keys("en", f"practice.{section}")) == used - {"origin"}, section


def test_every_particle_is_drawn_where_it_is() -> None:
    for document in [drawn(family, seed) for family in FAMILIES for seed in range(25)]:
        drawn_at = {each["at"] for each in document["drawing"]["elements"] if each["kind"] in MASSES}
        particles = {body["name"] for body in document["bodies"] if body["kind"] == "particle"}
        assert particles - {"wedge"} <= drawn_at, document["id"]


@pytest.mark.parametrize("kind", ["position", "virtual-displacement", "generalized-force"])
def test_nothing_is_asked_that_needs_no_working(kind: str) -> None:
    """The position of a cart is its coordinate, a force along a cyclic coordinate is zero: these are no exercises."""
    for family in FAMILIES:
        workbook = workbook_of({"scene": drawn(family, 1)})
        for task in worthwhile(workbook, kind):
            assert any(part.count_ops() for part in workbook.right(task)), (family.__name__, task.id)


PROGRAM = """
import json
from deltaq.homework.practice.levels import LEVELS, system_of
print(json.dumps([system_of(level, "ada", number) for level in LEVELS for number in range(1, 20)]))
"""


def test_the_same_seed_draws_the_same_systems_whatever_the_hashes() -> None:
    texts = []
    for hashes in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": hashes}
        texts.append(
            subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, check=True).stdout
        )
    here = [system_of(level, "ada", number) for level in LEVELS for number in range(1, 20)]
    assert texts[0] == texts[1]
    assert json.loads(texts[0]) == here


def test_another_seed_draws_others() -> None:
    rows = [[system_of(LEVELS[0], seed, number) for number in range(1, 9)] for seed in ("ada", "bob")]
    assert rows[0] != rows[1]


@pytest.mark.parametrize("level", LEVELS, ids=lambda level: str(level.number))
def test_no_family_comes_again_before_all_have_been(level: Any) -> None:
    count = len(level.families)
    for turn in range(3):
        numbers = range(turn * count + 1, (turn + 1) * count + 1)
        assert len({system_of(level, "ada", number)["id"] for number in numbers}) == count


def test_each_level_asks_for_what_it_says() -> None:
    for level in LEVELS:
        found = [exercise_of(level, "ada", number) for number in range(1, 6)]
        assert {each.task.quantity.kind for each in found} <= set(level.kinds)
        freedoms = {len(each.workbook.solution.free) for each in found}
        assert freedoms <= {1: {1}, 2: {1}, 3: {2}, 4: {2}}.get(level.number, {1, 2})


@pytest.mark.parametrize(("level", "number"), ANSWERED)
def test_the_right_answer_is_judged_right(level: int, number: int) -> None:
    asked = practice_request({"seed": "ada", "level": level, "number": number})
    found = check_request(right_answer(asked))
    assert found["outcome"] == "correct", found


def right_answer(asked: Mapping[str, Any]) -> Document:
    question = {"scene": asked["scene"], "task": asked["task"]["id"]}
    parts = solution_request(question)["plain"]
    value = f"[{', '.join(parts)}]" if asked["task"]["form"] == "vector" else "; ".join(parts)
    return question | {"answer": {"syntax": "plain", "value": value}}


@pytest.mark.parametrize(("misconception", "kind", "level"), RECALLED)
def test_a_misconception_comes_back_on_another_system(misconception: str, kind: str, level: int) -> None:
    exercise = exercise_of(LEVELS[level - 1], "ada", 1, misconception, kind)
    assert (exercise.recalled, exercise.task.quantity.kind) == (misconception, kind)
    assert misconception in {each.solution.id for each in exercise.workbook.candidates(exercise.task)}


def test_the_mistake_that_is_sought_is_named_when_it_is_made() -> None:
    exercise = exercise_of(LEVELS[0], "ada", 1, "gravity-sign", "potential-energy")
    wrong = next(c for c in exercise.workbook.candidates(exercise.task) if c.solution.id == "gravity-sign")
    answered = practice_request({"seed": "ada", "recall": "gravity-sign", "kind": "potential-energy"})
    given = {"syntax": "plain", "value": str(wrong.parts[0]).replace("**", "^")}
    found = check_request({"scene": answered["scene"], "task": answered["task"]["id"], "answer": given})
    assert "gravity-sign" in [each["id"] for each in found["misconceptions"]]


def test_what_no_system_has_is_answered_by_another_exercise() -> None:
    found = practice_request({"seed": "ada", "recall": "mass-at-the-end"})  # nothing drawn is a continuum
    assert found["recalled"] is None
    assert found["level"] == 1


def test_an_unknown_misconception_is_refused() -> None:
    with pytest.raises(UnknownNameError) as caught:
        practice_request({"seed": "ada", "recall": "gravity-sing"})
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer, problem.parameters["suggestion"]) == (
        "unknown-misconception",
        "/recall",
        "gravity-sign",
    )
