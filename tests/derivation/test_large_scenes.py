"""Large scenes: what the time is not enough for is left out and named, and never takes the equations along."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import count
from typing import Any

import pytest
from tests.derivation.large_scenes import KINDS, large_scene

from deltaq.derivation.effort import UNBOUNDED, Allowance
from deltaq.derivation.newton import DENSE, solved, step_of
from deltaq.derivation.result import equations_of
from deltaq.derivation.system import System
from deltaq.language.planner import planned, planned_terms
from deltaq.mechanics.document import read_scene
from deltaq.narration import derive
from deltaq.narration.catalog import LANGUAGES, text
from deltaq.narration.derive import TimeIsUp, derive_parts

Document = dict[str, Any]
SIZES = {"rods": 4, "springs": 5, "hinges": 2, "links": 3}
BUDGETS = (0, 25)  # looks at the clock, each of which is a second


@pytest.fixture(autouse=True)
def _results_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scenes of a few bodies count as large: what is told of large ones takes as long as they are large."""
    monkeypatch.setattr(derive, "LARGE", 8)


def told(scene: Document, allowance: Allowance, **asked: Any) -> tuple[list[Document], bool]:
    """All documents that a derivation tells, the last one behind the others; whether that one is all there is."""
    documents: list[Document] = []
    parts = derive_parts({"scene": scene, "lang": "en", **asked}, allowance)
    while True:
        try:
            documents.append(next(parts))
        except StopIteration as end:
            return [*documents, end.value], True
        except TimeIsUp:
            return documents, False


def left_out(document: Document) -> dict[str, str]:
    return {each["part"]: each["reason"] for each in document["left_out"]}


def steps(document: Document) -> Iterator[Document]:
    below = [step for chapter in document["chapters"] for step in chapter["steps"]]
    while below:
        step = below.pop()
        below += step["substeps"]
        yield step


def untold(document: Document) -> list[str]:
    """The chapters whose steps are missing; each of them says so and nothing else."""
    found = [chapter for chapter in document["chapters"] if chapter["steps"][0]["rule"] == "left-out"]
    found = [chapter for chapter in found if chapter["id"] != "model"]
    assert all([step["id"] for step in chapter["steps"]] == [f"left-out:steps:{chapter['id']}"] for chapter in found)
    return [chapter["id"] for chapter in found]


@pytest.mark.parametrize(
    ("kind", "formulation"), [*((kind, "dalembert-lagrange") for kind in KINDS), ("links", "hamilton")]
)
def test_a_time_that_ends_takes_no_equation_along(kind: str, formulation: str) -> None:
    scene = large_scene(kind, SIZES[kind], 1)
    names = [each["name"] for each in scene["coordinates"]]
    expected: list[Document] | None = None
    for seconds in BUDGETS:
        documents, whole = told(scene, Allowance(seconds, count().__next__), formulation=formulation)
        for document in documents:
            expected = expected or document["result"]["equations"]
            assert [each["coordinate"] for each in document["result"]["equations"]] == names
            same = zip(document["result"]["equations"], expected, strict=True)
            assert all(one["plain"] == other["plain"] for one, other in same)
            assert len(document["result"]["constraints"]) == len(scene.get("constraints", ()))
            assert bool(untold(document)) == ("steps" in left_out(document))
        assert whole == ("time" not in left_out(documents[-1]).values())
        assert "equation:" + names[-1] in {step["id"] for step in steps(documents[-1])} or formulation == "hamilton"
    assert "time" in left_out(told(scene, Allowance(0, count().__next__))[0][-1]).values()


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_left_out_is_named_and_nothing_rests_on_it(kind: str) -> None:
    documents, _ = told(large_scene(kind, SIZES[kind], 2), Allowance(0, count().__next__))
    for document in documents:
        present = {step["id"] for step in steps(document)}
        assert all(set(step["premises"]) <= present for step in steps(document))
        assert untold(document)
        missing = {each["part"]: each["text"] for each in document["left_out"]}
        assert missing["steps"] == text("en", "rules.steps.left-out.steps-time")
        for step in steps(document):
            if step["rule"] == "left-out":
                assert (step["latex"], step["terms"], step["evidence"]["kind"]) == ("", [], "stated")
    assert not any(chapter["id"] == "model" for chapter in documents[-1]["chapters"])
    assert left_out(documents[-1])["model"] == "time"
    assert not documents[-1]["result"]["equilibria"]


def test_with_time_enough_nothing_is_left_out_for_time() -> None:
    for kind in ("springs", "links"):
        scene = large_scene(kind, 2, 3)
        documents, whole = told(scene, Allowance(10**9, count().__next__))
        assert whole
        assert documents[-1] == told(scene, UNBOUNDED)[0][-1]


@pytest.mark.parametrize("part", ["equilibria", "integrals", "relative-equilibria"])
def test_a_part_that_begins_when_the_time_has_passed_says_so(part: str) -> None:
    system = System(read_scene(large_scene("links", 2, 4)))
    now = [0.0]
    system.effort.allowance = Allowance(1.0, lambda: now[0])
    assert system.effort.afford("integrals", lambda: system.effort.spend(1) or "found", "nothing") == "found"
    now[0] = 2.0
    assert system.effort.afford("canonical", lambda: "known", "nothing") == "known"
    assert system.effort.afford(part, lambda: system.effort.spend(1) or "found", "nothing") == "nothing"  # type: ignore[arg-type]
    assert system.effort.left_out == {part: "time"}
    assert all(text(language, f"rules.steps.left-out.{part}-time") for language in LANGUAGES)


def test_sums_that_differ_in_their_symbols_alone_are_planned_once() -> None:
    misses = []
    for size in (5, 7):
        planned.cache_clear()
        planned_terms.cache_clear()
        ring = large_scene("rods", size, 6)
        equations_of(System(read_scene(ring)))
        misses.append(planned.cache_info().misses + planned_terms.cache_info().misses)
    assert misses[1] <= misses[0] + 4  # the sums over all bodies are longer, and some have other neighbours


@pytest.mark.parametrize("size", [DENSE, DENSE + 1, 3 * DENSE])
def test_steps_of_sparse_systems_are_those_of_exact_numbers(size: int) -> None:
    rows = [{i: 2.0 + i % 3, (i + 1) % size: -1.0, (5 * i + 2) % size: 0.5} for i in range(size)]
    value = [float((7 * i) % 11 - 5) for i in range(size)]
    found = step_of(rows, value, 0.25, size)
    exact = [[Fraction(0)] * size for _ in range(size)]
    right = [Fraction(0)] * size
    for row, force in zip(rows, value, strict=True):
        for i, a in row.items():
            right[i] -= Fraction(a) * Fraction(force)
            for j, b in row.items():
                exact[i][j] += Fraction(a) * Fraction(b)
    largest = max(exact[i][i] for i in range(size))
    for i in range(size):
        exact[i][i] += Fraction(0.25) * largest
    expected = solved(exact, right)
    assert found is not None
    assert expected is not None
    assert found == pytest.approx([float(each) for each in expected], rel=1e-11, abs=1e-13)
