"""Random equivalent rewrites of right answers, and random mutations that make them wrong.

By hand: `python -m tests.homework.rewriting [number]` prints false accepts, false rejects and verdict times.
"""

from __future__ import annotations

import random
import statistics
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import sympy as sp

from deltaq.homework.checking import check
from deltaq.homework.task import Task
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.language.latex_printer import Typography, latex
from deltaq.language.plain_printer import plain

SCENES = (
    *("pendulum", "elastic-pendulum", "base-pendulum", "guided-pendulum", "cart-pendulum", "spring-pendulum"),
    *("damped-pendulum", "pendulum-with-moment", "physical-pendulum", "two-mass-oscillator", "atwood"),
    *("bead-on-rotating-hoop", "spherical-pendulum", "double-pendulum", "horizontally-guided-pendulum"),
    *("coupled-pendulums", "rolling-disc"),
)
Parts = tuple[sp.Expr, ...]
LONGEST = 1500


@dataclass(frozen=True)
class Sample:
    """An answer that must be right, or must be wrong, and how it was made."""

    scene: str
    task: str
    syntax: str
    text: str
    right: bool
    how: str


def samples(count: int, seed: int = 1) -> Iterator[Sample]:
    """Half rewrites, half mutations, over all scenes and tasks in turn."""
    source = random.Random(seed)
    books = {scene: workbook_of({"scene": scene}) for scene in SCENES}
    formulas = ((scene, task) for scene in SCENES for task in books[scene].tasks)
    pairs = [(scene, task) for scene, task in formulas if task.quantity.judge is None]
    made = 0
    while made < count:
        scene, task = source.choice(pairs)
        sample = _sample(scene, books[scene], task, source, right=made % 2 == 0)
        if sample is not None:
            made += 1
            yield sample


def _sample(scene: str, book: Workbook, task: Task, source: random.Random, *, right: bool) -> Sample | None:
    found = changed(book, task, source, right=right)
    if found is None:
        return None
    parts, how = found
    syntax = source.choice(("plain", "latex"))
    text = _typed(parts, task, syntax, book, source)
    return Sample(scene, task.id, syntax, text, right, how) if len(text) <= LONGEST else None


def changed(book: Workbook, task: Task, source: random.Random, *, right: bool) -> tuple[Parts, str] | None:
    """The parts of a right answer in another form, or of a wrong one, and how they were made; None where none are."""
    parts, names = book.shown(task), []
    for _ in range(source.randint(1, 3)):
        name, rewrite = source.choice(REWRITES)
        parts = tuple(rewrite(part, source, book) for part in parts)
        names.append(name)
    if task.quantity.form in ("equation", "equations"):
        name, recombine = source.choice(COMBINATIONS)
        parts, names = recombine(parts, source, book), [*names, name]
    if not right:
        mutated = _mutated(parts, task, source, book)
        if mutated is None:
            return None
        parts, names = mutated[0], [*names, mutated[1]]
    return parts, " + ".join(names)


def _typed(parts: Parts, task: Task, syntax: str, book: Workbook, source: random.Random) -> str:
    typography = Typography(book.scene.names)
    write = plain if syntax == "plain" else lambda part: latex(part, typography)
    if task.quantity.form in ("equation", "equations"):
        return "; ".join(_equation(part, write, source) for part in parts)
    texts = [write(part) for part in parts]
    if task.quantity.form != "vector":
        return "; ".join(texts)
    return f"[{', '.join(texts)}]" if syntax == "plain" else r"\begin{bmatrix}" + r"\\".join(texts) + r"\end{bmatrix}"


def _equation(part: sp.Expr, write: Callable[[sp.Expr], str], source: random.Random) -> str:
    """Some terms on the left, the others on the right."""
    terms = sp.Add.make_args(part)
    left = [term for term in terms if source.random() < 0.6]
    right = sp.Add(*(-term for term in terms if term not in left))
    return f"{write(sp.Add(*left))} = {write(right)}"


def _expanded(part: sp.Expr, _source: random.Random, _book: Workbook) -> sp.Expr:
    return sp.expand(part)


def _factored(part: sp.Expr, _source: random.Random, _book: Workbook) -> sp.Expr:
    return sp.factor_terms(part)


def _pythagoras(part: sp.Expr, source: random.Random, book: Workbook) -> sp.Expr:
    """One term times sin² + cos² of a coordinate."""
    q = book.solution.q(source.choice(book.solution.free))
    terms = list(sp.Add.make_args(part))
    index = source.randrange(len(terms))
    one = sp.sin(q, evaluate=False) ** 2 + sp.cos(q, evaluate=False) ** 2
    terms[index] = sp.expand(terms[index] * one)
    return sp.Add(*terms)


def _double_angle(part: sp.Expr, _source: random.Random, _book: Workbook) -> sp.Expr:
    """sin x = 2 sin(x/2) cos(x/2)"""
    waves = {f: 2 * sp.sin(f.args[0] / 2) * sp.cos(f.args[0] / 2) for f in part.atoms(sp.sin)}
    return part.xreplace(waves)


def _cosine_by_half(part: sp.Expr, _source: random.Random, _book: Workbook) -> sp.Expr:
    """cos x = 1 − 2 sin²(x/2)"""
    return part.xreplace({f: 1 - 2 * sp.sin(f.args[0] / 2) ** 2 for f in part.atoms(sp.cos)})


def _nothing_added(part: sp.Expr, source: random.Random, book: Workbook) -> sp.Expr:
    """The first term split into a third and two thirds."""
    first, *rest = sp.Add.make_args(part)
    return sp.Add(sp.Mul(sp.Rational(1, 3), first), sp.Mul(sp.Rational(2, 3), first, evaluate=False), *rest)


REWRITES: tuple[tuple[str, Callable[[sp.Expr, random.Random, Workbook], sp.Expr]], ...] = (
    ("expanded", _expanded),
    ("factored", _factored),
    ("sin² + cos²", _pythagoras),
    ("double angle", _double_angle),
    ("half angle", _cosine_by_half),
    ("term split", _nothing_added),
)


def _factor(source: random.Random, book: Workbook) -> sp.Expr:
    """A factor that cannot vanish: a number and powers of positive parameters."""
    positive = [book.solution.q(p.name) for p in book.scene.parameters if p.positive]
    number = source.choice((1, -1, 2, sp.Rational(1, 2), sp.Rational(-3, 2)))
    return number * sp.Mul(*(p ** source.choice((-2, -1, 0, 0, 1)) for p in positive))


def _scaled(parts: Parts, source: random.Random, book: Workbook) -> Parts:
    return tuple(sp.expand(part * _factor(source, book)) for part in parts)


def _mixed(parts: Parts, source: random.Random, book: Workbook) -> Parts:
    """Each equation plus a multiple of the next, in another order."""
    if len(parts) < 2:
        return _scaled(parts, source, book)
    sums = [part + 2 * parts[n + 1] if n + 1 < len(parts) else part for n, part in enumerate(parts)]
    source.shuffle(sums)
    return tuple(sp.expand(part) for part in sums)


COMBINATIONS: tuple[tuple[str, Callable[[Parts, random.Random, Workbook], Parts]], ...] = (
    ("as it is", lambda parts, _source, _book: parts),
    ("factor", _scaled),
    ("combined", _mixed),
)


def _mutated(parts: Parts, task: Task, source: random.Random, book: Workbook) -> tuple[Parts, str] | None:
    """One term changed so that the answer is wrong in every allowed sense; None where no change makes it so."""
    index = source.randrange(len(parts))
    terms = list(sp.Add.make_args(sp.expand(parts[index])))
    at = source.randrange(len(terms))
    moving = {book.solution.q(p.name) for p in book.scene.parameters} | {book.solution.t}
    if terms[at] == 0 or (
        task.quantity.form != "set" and not terms[at].free_symbols - moving and _up_to_constant(task)
    ):
        return None
    if task.quantity.kind == "lagrangian" and _is_gauge(terms[at], book):
        return None
    if (len(terms) == 1 and task.quantity.form in ("equation", "equations")) or _scales(task, terms):
        return None
    name, change = source.choice(MUTATIONS)
    terms[at] = change(terms[at], source, book)
    changed = (*parts[:index], sp.Add(*terms), *parts[index + 1 :])
    return None if _unchanged(parts, changed, source, book) else (changed, name)


def _up_to_constant(task: Task) -> bool:
    return task.quantity.kind in ("potential-energy", "lagrangian", "conserved")


def _is_gauge(term: sp.Expr, book: Workbook) -> bool:
    """A constant times a rate is a total time derivative: changing it changes nothing."""
    used = term.free_symbols
    return (
        not used & {book.solution.q(q) for q in book.solution.free}
        and any(
            not term.coeff(book.solution.rate(q)).has(book.solution.rate(q)) and term.coeff(book.solution.rate(q)) != 0
            for q in book.solution.free
        )
        and not used & {book.solution.t}
    )


def _scales(task: Task, terms: list[sp.Expr]) -> bool:
    """A single term changed by a factor is still the same equation or conserved quantity; frequencies are one term."""
    return len(terms) == 1 and task.quantity.kind == "conserved"


def _unchanged(parts: Parts, changed: Parts, source: random.Random, book: Workbook) -> bool:
    """Whether the numbers are the same, by an evaluation of its own."""
    symbols = {s for part in (*parts, *changed) for s in part.free_symbols}
    point = {s: sp.Float(source.uniform(0.4, 1.3), 30) for s in symbols}
    return all(abs(sp.N((a - b).xreplace(point), 25)) < 1e-12 for a, b in zip(parts, changed, strict=True))


def _other_parameter(term: sp.Expr, source: random.Random, book: Workbook) -> sp.Expr:
    return term * book.solution.q(source.choice(book.scene.parameters).name)


def _swapped(term: sp.Expr, _source: random.Random, _book: Workbook) -> sp.Expr:
    waves = {f: (sp.cos if isinstance(f, sp.sin) else sp.sin)(f.args[0]) for f in term.atoms(sp.sin, sp.cos)}
    return term.xreplace(waves) if waves else -term


MUTATIONS: tuple[tuple[str, Callable[[sp.Expr, random.Random, Workbook], sp.Expr]], ...] = (
    ("sign", lambda term, _source, _book: -term),
    ("double", lambda term, _source, _book: 2 * term),
    ("half", lambda term, _source, _book: term / 2),
    ("one percent", lambda term, _source, _book: term * sp.Rational(101, 100)),
    ("parameter", _other_parameter),
    ("sine for cosine", _swapped),
)


def verdicts(count: int, seed: int = 1) -> Iterator[tuple[Sample, str, float]]:
    """Each sample with its outcome and the seconds it took."""
    for sample in samples(count, seed):
        book = workbook_of({"scene": sample.scene})
        task = book.task(sample.task)
        started = time.perf_counter()
        outcome = check(book, task, sample.text, sample.syntax).outcome
        yield sample, outcome, time.perf_counter() - started


def main(count: int) -> None:
    """Print what went wrong, and how long verdicts take."""
    seen: Counter[tuple[bool, str]] = Counter()
    times: list[float] = []
    for sample, outcome, seconds in verdicts(count):
        seen[sample.right, outcome] += 1
        times.append(seconds)
        if (outcome == "correct") is not sample.right:
            print("right but" if sample.right else "wrong but", outcome, sample)
    for (right, outcome), number in sorted(seen.items()):
        print(f"{'rewrites' if right else 'mutations'}: {outcome} {number}")
    times.sort()
    centiles = [times[int(share * (len(times) - 1))] * 1e3 for share in (0.5, 0.9, 0.99, 1.0)]
    print(f"verdict: p50 {centiles[0]:.1f}, p90 {centiles[1]:.1f}, p99 {centiles[2]:.1f}, max {centiles[3]:.0f} ms")
    print(f"mean {statistics.mean(times) * 1e3:.1f} ms over {len(times)}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5000)
