"""Wrong answers with the mistakes they came from, in the scenes whose misconceptions are tested."""

from __future__ import annotations

from deltaq.homework.checking import check
from deltaq.homework.diagnosis import MOST_NAMED
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.language.plain_printer import plain
from deltaq.narration.catalog import catalog

SHORT = [
    "pendulum",
    "elastic-pendulum",
    "guided-pendulum",
    "cart-pendulum",
    "damped-pendulum",
    "physical-pendulum",
    "two-mass-oscillator",
    "atwood",
]
EVERY = 4  # of all candidates one in so many: they are very alike
LONG = ["spring-pendulum", "double-pendulum"]  # their equations fill a line: half of all the time


def typed(parts: tuple, form: str) -> str:
    texts = [plain(part.expand()) for part in parts]
    return f"[{', '.join(texts)}]" if form == "vector" else "; ".join(texts)


def found_again(workbook: Workbook, part: int, parts: int) -> tuple[int, list[str]]:
    """How many wrong answers there are, and which are not explained: by the mistake they came from, or, where that
    left no more than any slip leaves, by the terms that are wrong.
    """
    missed, count, every = [], 0, EVERY * parts
    for number, task in enumerate(workbook.tasks):
        for candidate in workbook.candidates(task)[(number + EVERY * part) % every :: every]:
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


def assert_mistakes_are_found(scene: str, part: int = 0, parts: int = 1) -> None:
    """Every wrong answer of one part of so many is wrong, and nearly each names the mistake it came from."""
    count, missed = found_again(workbook_of({"scene": scene}), part, parts)
    assert count > 20 / (EVERY * parts)
    assert len(missed) <= 0.03 * count, missed


def assert_hints_are_whole(scene: str) -> None:
    """A text with a placeholder that nothing fills would have a hole."""
    workbook = workbook_of({"scene": scene})
    nameless = {c.solution.id for task in workbook.tasks for c in workbook.candidates(task) if not c.solution.about}
    for language in ("de", "en"):
        told: dict = catalog(language)["homework"]["misconceptions"]  # type: ignore[index, assignment]
        assert {kind for kind in nameless if "{about}" in "".join(told[kind].values())} == set()
