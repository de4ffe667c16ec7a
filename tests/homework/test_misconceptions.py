"""Every misconception can be made somewhere, is found again from the answer it leads to, and is told in words."""

from __future__ import annotations

import pytest

from deltaq.homework.checking import check
from deltaq.homework.diagnosis import MOST_NAMED
from deltaq.homework.faulty_solution import misconceptions
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.language.plain_printer import plain
from deltaq.narration.catalog import catalog

SCENES = [
    "pendulum",
    "elastic-pendulum",
    "guided-pendulum",
    "cart-pendulum",
    "spring-pendulum",
    "damped-pendulum",
    "physical-pendulum",
    "two-mass-oscillator",
    "atwood",
    "double-pendulum",
]
EVERY = 4  # of all candidates one in so many: they are very alike


def typed(parts: tuple, form: str) -> str:
    texts = [plain(part.expand()) for part in parts]
    return f"[{', '.join(texts)}]" if form == "vector" else "; ".join(texts)


def found_again(workbook: Workbook) -> tuple[int, list[str]]:
    """How many wrong answers there are, and which are not explained: by the mistake they came from, or, where that
    left no more than any slip leaves, by the terms that are wrong.
    """
    missed, count = [], 0
    for number, task in enumerate(workbook.tasks):
        for candidate in workbook.candidates(task)[number % EVERY :: EVERY]:
            text = typed(candidate.parts, task.quantity.form)
            if len(text) > 1000:
                continue
            count += 1
            verdict = check(workbook, task, text, "plain")
            assert verdict.outcome == "wrong", (task.id, text)
            crowded = len(verdict.misconceptions) == MOST_NAMED
            told = candidate.solution.id in verdict.misconceptions or bool(verdict.slips)
            if not told and not crowded and verdict.remark != "degenerate":
                missed.append(f"{task.id}: {candidate.solution.id} ({candidate.solution.about})")
    return count, missed


@pytest.mark.parametrize("scene", SCENES)
def test_wrong_answers_are_wrong_and_their_mistakes_found(scene: str) -> None:
    count, missed = found_again(workbook_of({"scene": scene}))
    assert count > 20 / EVERY
    assert len(missed) <= 0.03 * count, missed


def test_every_misconception_occurs() -> None:
    seen = {
        candidate.solution.id
        for scene in [*SCENES, "rolling-disc", "coupled-pendulums"]
        for workbook in [workbook_of({"scene": scene})]
        for task in workbook.tasks
        for candidate in workbook.candidates(task)
    }
    assert {kind.id for kind in misconceptions()} - seen == set()


@pytest.mark.parametrize("scene", SCENES)
def test_a_hint_names_only_what_the_mistake_is_about(scene: str) -> None:
    """A text with a placeholder that nothing fills would have a hole."""
    workbook = workbook_of({"scene": scene})
    nameless = {c.solution.id for task in workbook.tasks for c in workbook.candidates(task) if not c.solution.about}
    for language in ("de", "en"):
        told: dict = catalog(language)["homework"]["misconceptions"]  # type: ignore[index, assignment]
        assert {kind for kind in nameless if "{about}" in "".join(told[kind].values())} == set()


def test_misconceptions_are_told_and_explained() -> None:
    kinds = misconceptions()
    assert len(kinds) >= 30
    for language in ("de", "en"):
        told = catalog(language)["homework"]["misconceptions"]  # type: ignore[index]
        assert set(told) == {kind.id for kind in kinds} | {"wrong-dimension", "other-unit"}
    assert all(kind.__doc__ and not kind.__doc__.startswith(kind.__name__) for kind in kinds)
