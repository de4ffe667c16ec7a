"""Answers graded by the exported questions in Maxima and by δq's own check, side by side.

By hand: `python -m tests.homework.stack_against_checks [scene …]` prints what differs, of all scenes if none is named.
"""

from __future__ import annotations

import random
import re
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from xml.etree import ElementTree as ET

import sympy as sp
from tests.homework.maxima_runner import Graded, run
from tests.homework.rewriting import changed

import deltaq
from deltaq.homework.service import check_request
from deltaq.homework.stack.answer_tests import value
from deltaq.homework.stack.maxima import RENAMED, maxima
from deltaq.homework.stack.question import Asked, left_out, quiz
from deltaq.homework.task import Task
from deltaq.homework.workbook import Workbook, workbook_of

RIGHT, WRONG, LONGEST = 10, 5, 1500
Parts = tuple[sp.Expr, ...]


@dataclass(frozen=True)
class Form:
    """An answer as a student of STACK types it (with decimal points), as δq reads it, and how it was made."""

    stack: str
    own: str
    how: str


@dataclass(frozen=True)
class Compared:
    """One answer and both of its grades: the outcome with the share that δq gives, and the score that STACK gives."""

    scene: str
    task: str
    form: Form
    outcome: str
    share: float
    stack: Graded

    @property
    def alike(self) -> bool:
        """Whether both give the same part of the points."""
        return abs(self.share - self.stack.score) < 2e-3


def scenes() -> list[str]:
    """The built-in scenes."""
    return sorted(path.stem for path in (Path(deltaq.__file__).parent / "scenes").glob("*.toml"))


# --- forms ------------------------------------------------------------------------------------------------------------


def forms(book: Workbook, task: Task, right_ones: int = RIGHT, wrong_ones: int = WRONG) -> Iterator[Form]:
    """Rewrites and mutations, the wrong answers of misconceptions, and what is peculiar to a form."""
    source = random.Random(f"{book.scene.id}/{task.id}")
    for right, count in ((True, right_ones), (False, wrong_ones)):
        yield from islice(_random_forms(book, task, source, right=right), count)
    if not any(book.shown(task)):
        yield from _beside_zero(book, task)
    for candidate in book.candidates(task)[:: max(1, len(book.candidates(task)) // 3)]:
        yield _form(task, book.short(candidate.parts), candidate.solution.id)
    yield from PECULIAR[task.quantity.form](book, task)


def _random_forms(book: Workbook, task: Task, source: random.Random, *, right: bool) -> Iterator[Form]:
    for _ in range(60):
        found = changed(book, task, source, right=right)
        form = found and _form(task, found[0], found[1], source)
        if form and len(form.stack) <= LONGEST:
            yield form


def _beside_zero(book: Workbook, task: Task) -> Iterator[Form]:
    """Wrong answers where nothing is right, and so no term of it can be changed."""
    parts, symbol = book.shown(task), book.solution.q(book.scene.parameters[0].name)
    for number in range(1, WRONG + 1):
        yield _form(task, (parts[0] + symbol**number, *parts[1:]), "not zero")


def _form(task: Task, parts: Parts, how: str, source: random.Random | None = None) -> Form:
    if task.quantity.form in ("equation", "equations"):
        texts = [_equation(part, source) for part in parts]
        stack = texts[0] if task.quantity.form == "equation" else f"[{', '.join(texts)}]"
        return Form(stack, _own("; ".join(texts)), how)
    stack = value(task, parts)
    separator = "; " if task.quantity.form == "set" else ", "
    return Form(stack, _own(stack.strip("{}").replace(",", separator)), how)


def _equation(part: sp.Expr, source: random.Random | None) -> str:
    terms = sp.Add.make_args(part)
    left = [term for term in terms if source is None or source.random() < 0.6]
    return f"{maxima(sp.Add(*left))} = {maxima(sp.Add(*(-term for term in terms if term not in left)))}"


def _own(text: str) -> str:
    """As δq reads it: letters by their own names."""
    for name, renamed in RENAMED.items():
        text = re.sub(rf"(?<![a-zA-Z0-9]){renamed}(?![a-zA-Z0-9])", name, text)
    return text.replace("%pi", "pi")


def _same(text: str, how: str) -> Form:
    return Form(text, _own(text), how)


def _expressions(book: Workbook, task: Task) -> Iterator[Form]:
    text = value(task, book.shown(task))
    if task.quantity.labels:
        yield _same(f"{task.quantity.labels[0]} = {text}", "label")
    q = maxima(book.solution.q(book.solution.free[0]))
    rate = maxima(book.solution.rate(book.solution.free[0]))
    m = maxima(book.solution.q(book.scene.parameters[0].name))
    yield _same(f"{text} + 3*{m}", "a constant added")
    yield _same(f"{text} + 3*{m}*sin({q})*{rate}", "a total derivative added")
    yield _same(f"-2*{m}*({text}) + 1", "a multiple and a constant")
    yield _same(f"({text})*{q}", "times a coordinate")
    yield _same("0", "zero")


def _vectors(book: Workbook, task: Task) -> Iterator[Form]:
    parts = book.shown(task)
    yield _form(task, parts[:-1], "a component missing")
    yield _form(task, (*parts, sp.Integer(0)), "a component too many")
    yield _form(
        task, (parts[0], *(part + book.solution.q(book.solution.free[0]) for part in parts[1:])), "partly right"
    )
    yield _form(task, tuple(reversed(parts)), "reversed")


def _equations_of_one(book: Workbook, task: Task) -> Iterator[Form]:
    (part,) = book.shown(task)
    q = book.solution.q(book.solution.free[0])
    yield _same(maxima(part), "no equals sign")
    acceleration = book.solution.acceleration(task.subject)
    leading = sp.expand(part).coeff(acceleration)
    solved = sp.expand(part).subs(acceleration, 0)
    yield _same(f"{maxima(acceleration)} = {maxima(-solved)}/({maxima(leading)})", "solved")
    for factor in (sp.sin(q), 2 + sp.cos(q), 1 + q**2, q, book.solution.rate(task.subject)):
        yield _same(f"({maxima(part)})*({maxima(factor)}) = 0", f"times {factor}")
        yield _same(f"({maxima(part)})/({maxima(factor)}) = 0", f"by {factor}")
    yield _same("0 = 0", "nothing")


def _systems(book: Workbook, task: Task) -> Iterator[Form]:
    parts = book.shown(task)
    yield _form(task, tuple(reversed(parts)), "reversed")
    yield _form(task, parts[:-1], "an equation missing")
    yield _form(task, (*parts, parts[0]), "an equation twice")
    yield _form(task, (parts[0],) * len(parts), "the same equation")
    yield _form(
        task, (parts[0], *(part + book.solution.q(book.solution.free[0]) for part in parts[1:])), "partly right"
    )
    yield _form(task, (parts[0] * sp.sin(book.solution.q(book.solution.free[0])), *parts[1:]), "times a sine")


def _sets(book: Workbook, task: Task) -> Iterator[Form]:
    parts, values = book.shown(task), dict(book.solution.parameter_values)
    numbers = [float(part.xreplace(values)) for part in parts]
    for factor, how in ((1.0, "numbers"), (1.002, "rounded"), (1.02, "numbers far off")):
        texts = [f"{number * factor:.5g}" for number in numbers]
        yield Form("{" + ", ".join(texts) + "}", "; ".join(texts), how)
    yield _form(task, parts[:1], "the first only")
    yield _form(task, tuple(part**2 for part in parts), "squared")
    yield _form(task, tuple(-part for part in parts), "negative")
    yield _form(task, (*parts, 2 * parts[0]), "one too many")
    rooted = ";".join(f"sqrt({maxima(part**2)})" for part in parts)
    yield Form("{" + rooted.replace(";", ",") + "}", _own(rooted), "root of the square")


PECULIAR = {
    "expression": _expressions,
    "vector": _vectors,
    "equation": _equations_of_one,
    "equations": _systems,
    "set": _sets,
}


# --- both grades ------------------------------------------------------------------------------------------------------


def compared(
    scene: str, tasks: Sequence[Task] = (), right_ones: int = RIGHT, wrong_ones: int = WRONG
) -> Iterator[Compared]:
    """Forms of the tasks of a scene (all if none is named), graded twice."""
    book = workbook_of({"scene": scene})
    unasked = left_out(Asked(book, task) for task in book.tasks)
    asked = [task for task in tasks or book.tasks if task.id not in unasked]
    found = [list(forms(book, task, right_ones, wrong_ones)) for task in asked]
    typed = [[form.stack for form in each] for each in found]
    graded = run(list(zip(ET.fromstring(quiz(book, asked, "en")), typed, strict=True)))
    for task, each, scores in zip(asked, found, graded, strict=True):
        for form, score in zip(each, scores, strict=True):
            yield _compared(scene, task, form, score)


def _compared(scene: str, task: Task, form: Form, score: Graded) -> Compared:
    verdict = check_request({"scene": scene, "task": task.id, "answer": {"value": form.own}})
    share = verdict.get("share")
    return Compared(scene, task.id, form, str(verdict["outcome"]), share if isinstance(share, float) else 0.0, score)


def main(names: Iterable[str]) -> None:
    """Print every difference, and how many there are."""
    whole: Counter[str] = Counter()
    for scene in names:
        started, found = time.perf_counter(), list(compared(scene))
        for each in found:
            if not each.alike:
                print(_difference(each), flush=True)
        seen = counted(found)
        whole += seen
        print(f"{scene}: {dict(seen)} in {time.perf_counter() - started:.0f} s", flush=True)
    print(f"all: {dict(whole)}")


def _difference(each: Compared) -> str:
    grade = f"{each.outcome} {each.share:.3f}, STACK {each.stack.score:.3f} {each.stack.note}"
    return f"{each.scene} {each.task} [{each.form.how}] {grade}: {each.form.stack[:200]}"


def counted(found: Sequence[Compared]) -> Counter[str]:
    """How many answers are alike and different, right and not; how many tasks, and how many have few of either."""
    right = Counter(each.task for each in found if each.outcome == "correct")
    every = Counter(each.task for each in found)
    few = sum(right[task] < RIGHT or every[task] - right[task] < WRONG for task in every)
    alike = sum(each.alike for each in found)
    right_ones = right.total()
    figures = {"alike": alike, "different": len(found) - alike, "right": right_ones, "other": len(found) - right_ones}
    return Counter({**figures, "tasks": len(every), "tasks of few": few})


if __name__ == "__main__":
    main(sys.argv[1:] or scenes())
