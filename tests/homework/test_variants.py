"""Each student's own task: the same system told otherwise, with another right answer, and words that say how."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from itertools import combinations

import pytest
import sympy as sp

from deltaq.contract.assignment import Aspect
from deltaq.contract.base import SceneWithChanges
from deltaq.homework.checking import check, compare
from deltaq.homework.service import assignment_request, check_request, tasks_request
from deltaq.homework.solution import Solution
from deltaq.homework.statement import model_answer
from deltaq.homework.variants import Variant, drawn, varied
from deltaq.homework.workbook import Workbook, workbook_asked_about
from deltaq.language.rewriting import written
from deltaq.mechanics.document import examine
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene

ALL: tuple[Aspect, ...] = ("values", "axes", "coordinates", "factors")
TOLD: tuple[Aspect, ...] = ("axes", "coordinates", "factors")
SCENES = ["pendulum", "cart-pendulum", "elastic-pendulum", "rolling-disc", "two-mass-oscillator"]
NEVER = {"0", "stable", "unstable"}  # what no telling of it changes


def book(scene: str, seed: str | None, vary: tuple[Aspect, ...] = ALL) -> Workbook:
    return workbook_asked_about(SceneWithChanges(scene=scene), seed, vary)


def typed(workbook: Workbook, task: str) -> str:
    asked = workbook.task(task)
    parts = model_answer(asked, workbook)["plain"]
    return f"[{', '.join(parts)}]" if asked.quantity.form == "vector" else "; ".join(parts)


# --- the same system -------------------------------------------------------------------------------------------------


def numbers(expression: sp.Expr, values: Mapping[sp.Symbol, float]) -> float:
    return float(sp.N(expression.subs(values)))


def both(scene: Scene, variant: Variant, source: random.Random) -> tuple[dict[str, float], dict[str, float]]:
    """One state as the scene tells it, and as the variant does: q = s q' + c, p = k p'."""
    told = {p.name: p.value for p in scene.parameters}
    other = {name: value / float(dict(variant.factors).get(name, 1)) for name, value in told.items()}
    for coordinate in scene.free:
        shift = variant.shift_of.get(coordinate.name)
        new = source.uniform(0.2, 0.9)
        other[coordinate.name] = new
        if shift is None:
            told[coordinate.name] = new
            continue
        length = float(sp.sympify(written(shift.length), told))
        told[coordinate.name] = shift.sign * new + shift.quarters * math.pi / 2 + length
    return told, other


@pytest.mark.one_in(8)
@pytest.mark.parametrize("identifier", [one for one in scene_ids() if one not in ("triple-pendulum", "chain-pendulum")])
def test_a_variant_is_the_same_system(identifier: str) -> None:
    """Kinetic energy, and the positions up to the direction of the axes, are those of the scene in the same state."""
    scene, source = load_scene(identifier), random.Random(identifier)
    for seed in ("a", "b", "c"):
        variant = drawn(scene, seed, TOLD)
        other = varied(scene, variant)
        assert not examine(write_scene(other))[1]
        one, two = Solution(scene), Solution(other)
        told, new = both(scene, variant, source)
        speeds = {q: source.uniform(-1, 1) for q in one.free}
        signs = {q: variant.shift_of[q].sign if q in variant.shift_of else 1 for q in one.free}
        state = {one.q(n): v for n, v in told.items()} | {one.rate(q): signs[q] * v for q, v in speeds.items()}
        there = {two.q(n): v for n, v in new.items()} | {two.rate(q): v for q, v in speeds.items()}
        state |= {one.t: 0.3}
        there |= {two.t: 0.3}
        if not any(name in guide.value.names for guide in scene.guides for name, _ in variant.factors):
            assert numbers(two.kinetic_energy, there) == pytest.approx(numbers(one.kinetic_energy, state))
        for body in scene.bodies:
            if not body.material:
                turned = [-1 if variant.mirrored else 1, -1 if variant.upside else 1, 1]
                for sign, x, y in zip(turned, one.position(body.name), two.position(body.name), strict=False):
                    assert numbers(y, there) == pytest.approx(sign * numbers(x, state)), variant


# --- other answers ---------------------------------------------------------------------------------------------------


def test_a_right_answer_is_right_for_its_own_student_alone() -> None:
    refused = [one for scene in SCENES for one in _refused(scene)]
    assert len(refused) > 200
    assert sum(refused) >= 0.9 * len(refused)


def _refused(scene: str) -> list[bool]:
    """For every pair of three students and every task, whether the one's right answer is wrong for the other."""
    books = [book(scene, f"student {n}") for n in range(3)]
    tasks = [task.id for task in book(scene, None).tasks]
    for one in books:
        assert [task.id for task in one.tasks] == tasks
        for task in tasks:
            assert check(one, one.task(task), typed(one, task), "plain").outcome == "correct", (scene, task)
    asked = [(a, b, task) for a, b in combinations(books, 2) for task in tasks if typed(a, task) not in NEVER]
    return [compare(b, b.task(task), a.right(a.task(task))).equal is False for a, b, task in asked]


def test_the_answer_of_another_student_is_wrong_through_the_api() -> None:
    sheet = {
        "format": 1,
        "individual": True,
        "vary": ["axes", "coordinates", "factors"],
        "tasks": [{"scene": "pendulum", "task": "equation:phi"}, {"scene": "pendulum", "task": "kinetic-energy"}],
    }
    statements = {
        seed: [one["task"]["statement"] for one in assignment_request({"assignment": sheet, "seed": seed})["tasks"]]
        for seed in ("Ada", "Emmy")
    }
    assert statements["Ada"][0] != statements["Emmy"][0]
    for task in ("equation:phi", "kinetic-energy"):
        answer = {"value": typed(book("pendulum", "Ada", TOLD), task)}
        asked = {"scene": "pendulum", "vary": sheet["vary"], "task": task, "answer": answer}
        assert check_request(asked | {"seed": "Ada"})["outcome"] == "correct"
        assert check_request(asked | {"seed": "Emmy"})["outcome"] == "wrong"


def test_without_vary_a_seed_draws_values_alone() -> None:
    told = tasks_request({"scene": "cart-pendulum", "seed": "Ada"})["scene"]
    common = tasks_request({"scene": "cart-pendulum"})["scene"]
    assert isinstance(told, dict)
    assert isinstance(common, dict)
    assert told["bodies"] == common["bodies"]
    assert [p["value"] for p in told["parameters"]] != [p["value"] for p in common["parameters"]]


def test_everybody_can_be_asked_the_same_things() -> None:
    """A fast hoop has another rest than a slow one: what is asked of the class can be asked of everyone."""
    common = [task.id for task in book("bead-on-rotating-hoop", None).tasks]
    for seed in ("student 1", "student 2", "student 3"):
        assert [task.id for task in book("bead-on-rotating-hoop", seed).tasks] == common


# --- words -----------------------------------------------------------------------------------------------------------

DIRECTIONS = {
    (0, 1): "from the vertical downwards",
    (0, -1): "from the vertical upwards",
    (1, 0): "from the horizontal to the right",
    (-1, 0): "from the horizontal to the left",
}


@pytest.mark.one_in(6)
@pytest.mark.parametrize("seed", range(24))
def test_the_statement_says_from_where_an_angle_counts(seed: int) -> None:
    """The bob is where the words say at φ = 0, and goes round as they say when φ grows; so does the drawing."""
    own = book("pendulum", str(seed), TOLD)
    solution, element = own.solution, next(one for one in own.scene.drawing.elements if one.kind == "angle")
    down = 1 if own.scene.drawing.vertical == "down" else -1

    def on_screen(phi: float) -> tuple[float, float]:
        x, y = (part.subs({solution.q("phi"): phi, solution.q("l"): 1}) for part in solution.position("bob"))
        length = math.hypot(x, y)
        return float(x) / length, down * float(y) / length

    (x, y), (ahead_x, ahead_y) = on_screen(0.0), on_screen(0.1)
    statement = tasks_request({"scene": "pendulum", "seed": str(seed), "vary": TOLD, "lang": "en"})["tasks"][0]
    assert DIRECTIONS[round(x), round(y)] in statement["statement"]
    turns_left = x * ahead_y - y * ahead_x < 0  # the second axis of the screen points down
    assert (", counterclockwise." if turns_left else ", clockwise.") in statement["statement"]
    options = dict(element.options)
    zero, sense = float(options.get("offset", 0.0)), -1 if options.get("direction") == "clockwise" else 1
    assert (math.sin(zero), math.cos(zero)) == pytest.approx((x, y), abs=1e-9)
    assert (math.sin(zero + sense * 0.1), math.cos(zero + sense * 0.1)) == pytest.approx((ahead_x, ahead_y))


@pytest.mark.parametrize("scene", ["cart-pendulum", "rolling-disc", "base-pendulum"])
def test_a_dimension_begins_where_its_coordinate_is_zero(scene: str) -> None:
    own = book(scene, "Ada", TOLD)
    dimensions = [one for one in own.scene.drawing.elements if one.kind == "dimension"]
    for places, name in ((dict(one.places), dict(one.options)["coordinate"]) for one in dimensions):
        start, end = (own.solution.position(places[key]) for key in ("from", "to"))
        assert sp.simplify(end.subs(own.solution.q(str(name)), 0) - start) == sp.zeros(*start.shape)
