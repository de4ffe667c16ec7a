"""Checking a step by a route that its rule did not take.

A rule differentiates with SymPy. Here no formula is differentiated symbolically: each is evaluated in ball arithmetic
(Arb, 512 bits) at random points, derivatives as central differences with the step 2⁻¹²⁸, the first variation by its
definition. Two formulas of a relation agree if their difference is below 2⁻⁸⁰ of their size at two points.

A central difference has the relative error f‴h²/6f′ ≈ 2⁻²⁵⁶, and loses 128 of 512 bits to cancellation; a second one
around it is still good to 2⁻¹²⁸ (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.14 for the
balance of the two errors).
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice, pairwise

from flint import arb, ctx

from .evaluation import evaluate
from .formula import Formula
from .points import Place, Point
from .step import Chapter, Derivation, Evidence, Relation, Step
from .system import System

BITS = 512
TOLERANCE = arb(2) ** -80
POINTS = 2
SAMPLED = Evidence("sampled", POINTS, 24)  # 2⁻⁸⁰ ≈ 10⁻²⁴
ATTEMPTS = 8
RISING = ("<", "≤")  # signs between numbers, of the scene's own values
HALF = arb(2) ** -20  # of the interval of an action: so short that few nodes integrate over it


def verified(derivation: Derivation, system: System) -> Derivation:
    """The derivation with every step checked and marked."""
    points = tuple(random_points(system))
    chapters = tuple(
        Chapter(chapter.id, tuple(verified_step(step, points) for step in chapter.steps))
        for chapter in derivation.chapters
    )
    return replace(derivation, chapters=chapters)


def verified_step(step: Step, points: tuple[Point, ...]) -> Step:
    """The step, `verified` if all its relations hold and all its substeps are verified."""
    substeps = tuple(verified_step(substep, points) for substep in step.substeps)
    sound = all(holds(relation, points) for relation in step.relations)
    return replace(step, substeps=substeps, verified=sound and all(substep.verified for substep in substeps))


def holds(relation: Relation, points: tuple[Point, ...]) -> bool:
    """Whether the members agree at enough points where all are defined (or, for the sign ≠, differ at one)."""
    with ctx.workprec(BITS):
        if relation.sign in RISING:
            return _rise(relation, points)
        gaps = tuple(islice(filter(arb.is_finite, (_gap(relation.members, point) for point in points)), POINTS))
    if relation.sign == "≠":
        return any(gap > TOLERANCE for gap in gaps)
    return len(gaps) == POINTS and all(gap < TOLERANCE for gap in gaps)


def _rise(relation: Relation, points: tuple[Point, ...]) -> bool:
    """Whether each member is above the one before it, or as large where that is allowed."""
    for one, other in pairwise(relation.members):
        steps = (evaluate(other, point)[0] - evaluate(one, point)[0] for point in points)
        finite = tuple(islice(filter(arb.is_finite, steps), POINTS))
        least = -TOLERANCE if relation.sign == "≤" else TOLERANCE
        if len(finite) < POINTS or not all(step > least for step in finite):
            return False
    return True


def _gap(members: tuple[Formula, ...], point: Point) -> arb:
    """The largest distance of a member from the first, relative to the size of the first where that is above 1."""
    first, *others = (evaluate(member, point) for member in members)
    size = sum(map(abs, first), arb(1))
    gaps = (sum((abs(a - b) for a, b in zip(first, other, strict=True)), arb(0)) / size for other in others)
    return sum(gaps, arb(0))


def random_points(system: System, seed: int = 1) -> Iterator[Point]:
    """Points with exact dyadic values between 1/4 and 7/4 for every symbol, the same for every call.

    The last have the scene's own parameter values: some formulas are defined only for some (an angle as arcsine).
    """
    source = random.Random(seed)
    forms = ("{}", "dot({})", "ddot({})", "delta({})", "d({})")
    moving = [form.format(name) for name in system.coordinates for form in forms]
    symbols = dict.fromkeys([*moving, *(symbol.name for symbol in system.scene.names.symbols), "d(t)"])
    symbols |= dict.fromkeys([system.omega.name, system.exponent.name])
    for _ in range(ATTEMPTS):
        point = {name: arb(source.randint(2**20, 7 * 2**20)) / 2**22 for name in symbols}
        yield with_fixed_ends(system, point)
    own = {parameter.name: arb(parameter.value) for parameter in system.scene.parameters}
    for _ in range(POINTS):
        point = {name: own.get(name, arb(source.randint(2**20, 7 * 2**20)) / 2**22) for name in symbols}
        yield with_fixed_ends(system, point)


def with_fixed_ends(system: System, point: Point) -> Place:
    """The point with a short interval around its time, and each δq a parabola that vanishes at both ends."""
    start, end = system.ends
    before, after = HALF, 2 * HALF
    times = {start.name: point["t"] - before, end.name: point["t"] + after}
    jets: dict[str, arb] = {}
    for name in system.coordinates:
        height = point[f"delta({name})"] / (before * after)
        jets |= {f"dot(delta({name}))": height * (after - before), f"ddot(delta({name}))": -2 * height}
    return Place({**point, **times, **jets})
