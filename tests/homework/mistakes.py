"""Reads the table of mistakes and counts how many are named, how many wrongly, and in how many the term is shown.

`python -m tests.homework.mistakes [tuning | held-out | all]` prints what fails and the figures.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from deltaq.homework.checking import check
from deltaq.homework.verdict import Verdict
from deltaq.homework.workbook import workbook_of
from deltaq.language.parser import Syntax

TABLE = Path(__file__).with_name("mistakes.txt")
WIDER = 2.5  # times the term that is wrong: what is marked besides would hide it


@dataclass(frozen=True)
class Mistake:
    """One answer of the table: what may be named, the mistake made first, and the term it is in."""

    scene: str
    task: str
    syntax: Syntax
    answer: str
    names: tuple[str, ...]
    term: str
    held_out: bool

    @property
    def right(self) -> bool:
        return self.names == ("right",)


def mistakes() -> Iterator[Mistake]:
    """The rows of the table; held out is what stands below `[scene held-out]`."""
    scene = ""
    held_out = False
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            scene, held_out = line.strip("[]").removesuffix(" held-out"), line.endswith(" held-out]")
        elif line and not line.startswith("#"):
            task, answer, names, term = line.split(" | ")
            syntax: Syntax = "latex" if answer.startswith("latex:") else "plain"
            named = tuple(name.strip() for name in names.split(","))
            yield Mistake(scene, task, syntax, answer.removeprefix("latex:"), named, term, held_out)


def verdict_on(row: Mistake) -> Verdict:
    workbook = workbook_of({"scene": row.scene})
    return check(workbook, workbook.task(row.task), row.answer, row.syntax)


def told(verdict: Verdict) -> str:
    """The one word by which a verdict names the mistake; empty if it names none."""
    if verdict.misconceptions:
        return verdict.misconceptions[0]
    return verdict.slip.kind if verdict.slip else verdict.remark


def marked(row: Mistake, verdict: Verdict) -> str:
    """What is marked in the answer: "" where nothing is, "other" where it is not the term that is wrong."""
    span = verdict.slip.place if verdict.slip else None
    if span is None:
        return ""
    if row.term == "~":
        return "there"
    at = row.answer.index(row.term)
    first, last = max(at, span.offset), min(at + len(row.term), span.offset + span.length)
    return "there" if first < last and span.length <= WIDER * len(row.term) + 2 else "other"


@dataclass(frozen=True)
class Judged:
    """A row with what was said of it, and in how much time."""

    row: Mistake
    verdict: Verdict
    seconds: float

    @property
    def kind(self) -> str:
        if self.row.right:
            return "accepted" if self.verdict.outcome == "correct" else "false reject"
        if self.verdict.outcome == "correct":
            return "false accept"
        if not told(self.verdict):
            return "not named"
        fits = told(self.verdict) in self.row.names and marked(self.row, self.verdict) != "other"
        return "named" if fits else "misleading"

    @property
    def shown(self) -> bool:
        return marked(self.row, self.verdict) == "there"


def judged(rows: list[Mistake]) -> Iterator[Judged]:
    for row in rows:
        workbook = workbook_of({"scene": row.scene})
        workbook.candidates(workbook.task(row.task))  # made once for a scene, not with every answer
        started = time.perf_counter()
        verdict = verdict_on(row)
        yield Judged(row, verdict, time.perf_counter() - started)


def main(which: str) -> None:
    """Print what fails, and the figures."""
    rows = [row for row in mistakes() if which == "all" or row.held_out is (which == "held-out")]
    seen = list(judged(rows))
    for each in seen:
        if each.kind not in ("accepted", "named") or not (each.shown or each.row.right or each.row.term == "~"):
            slip = each.verdict.slip
            print(f"{each.kind:12} {each.row.scene} {each.row.task} | {each.row.answer} | wanted {each.row.names}")
            there = marked(each.row, each.verdict)
            print(f"             said {told(each.verdict)!r}, marked {slip and slip.term!r} {there}")
    kinds = Counter(each.kind for each in seen)
    wrong = [each for each in seen if not each.row.right]
    times = sorted(each.seconds for each in seen)
    print(dict(kinds), f"of {len(wrong)} wrong: named {kinds['named'] / len(wrong):.1%},", end=" ")
    print(f"term shown {sum(each.shown for each in wrong) / len(wrong):.1%};", end=" ")
    print(f"p50 {1e3 * times[len(times) // 2]:.0f} ms, p95 {1e3 * times[int(0.95 * len(times))]:.0f} ms,", end=" ")
    print(f"max {1e3 * times[-1]:.0f} ms")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "tuning")
