"""What came out of a table of answers: as CSV, and which misconceptions come up how often in which task."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from ..narration.catalog import text
from .table import Style

RESULT = ("student", "scene", "task", "outcome", "misconception", "points", "of", "understood_as", "feedback", "answer")
BAR = 30
PLAIN = Style()


@dataclass(frozen=True)
class Graded:
    """One row of the results."""

    student: str
    scene: str
    task: str
    outcome: str
    misconception: str
    points: float
    of: float
    understood_as: str
    feedback: str
    answer: str

    def row(self) -> list[object]:
        return [getattr(self, name) for name in RESULT]


def results_csv(graded: Iterable[Graded], style: Style = PLAIN) -> bytes:
    """The results as a file of CSV."""
    return style.written(RESULT, (each.row() for each in graded))


def summary(graded: Iterable[Graded], language: str) -> str:
    """By task: how many answers were right, and a bar for every mistake."""
    rows = list(graded)
    lines: list[str] = []
    for scene, task in dict.fromkeys((each.scene, each.task) for each in rows):
        own = [each for each in rows if (each.scene, each.task) == (scene, task)]
        right = sum(each.outcome == "correct" for each in own)
        lines.append(f"{scene}  {task}: {right}/{len(own)} {text(language, 'homework.summary.correct')}")
        counts = Counter(_mistake(each, language) for each in own if _failed(each))
        widest = max((len(name) for name in counts), default=0)
        for name, count in counts.most_common():
            lines.append(f"  {name:<{widest}}  {'█' * max(1, round(BAR * count / len(own)))} {count}")
    return "\n".join(lines)


def _failed(each: Graded) -> bool:
    return each.outcome in ("wrong", "invalid", "undecided")


def _mistake(each: Graded, language: str) -> str:
    """The mistake in words; misconceptions have names, slips (`slip:sign`) have kinds."""
    if each.outcome == "invalid":
        return text(language, "homework.summary.invalid")
    if not each.misconception:
        return text(language, "homework.summary.other")
    _, is_slip, kind = each.misconception.partition("slip:")
    key = f"homework.summary.slips.{kind}" if is_slip else f"homework.misconceptions.{each.misconception}.title"
    return text(language, key)
