"""Scenes with constraints: every step holds, and the multipliers are what Newton's law says."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from tests.derivation.scenes import constrained

from deltaq.derivation.chapters import constraints
from deltaq.derivation.engine import derive
from deltaq.derivation.formula import Equation, Inserted, MatrixTimes
from deltaq.derivation.model_chapter import model
from deltaq.derivation.multipliers import multipliers
from deltaq.derivation.result import Result, result_of
from deltaq.derivation.step import Derivation, Relation, Step
from deltaq.derivation.system import System
from deltaq.derivation.verification import random_points, verified_step
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import narrated
from deltaq.narration.outcome import missing

SCENES = {scene.id: scene for scene in constrained()}


@cache
def derived(name: str, formulation: str = "dalembert-lagrange") -> tuple[System, Derivation]:
    return derive(SCENES[name], formulation, canonical=True)


@cache
def result(name: str) -> Result:
    return result_of(derived(name)[0])


@pytest.mark.one_in(2)
@pytest.mark.parametrize("formulation", ["dalembert-lagrange", "hamilton"])
@pytest.mark.parametrize("name", SCENES)
def test_every_step_holds_exactly(name: str, formulation: str) -> None:
    _, derivation = derived(name, formulation)
    assert [step.id for step in derivation.steps() if not step.verified] == []
    sampled = {step.rule for step in derivation.steps() if step.evidence.kind == "sampled"}
    assert sampled <= {"eigenfrequencies", "mode-shapes"}  # which end in numbers


@pytest.mark.parametrize("name", SCENES)
def test_both_formulations_lead_to_the_same_equations(name: str) -> None:
    ours, theirs = (result_of(derived(name, each)[0]).equations for each in ("dalembert-lagrange", "hamilton"))
    assert ours == theirs


# λ by Newton's law along the normal of the path, each at a state where the constraint holds.
REACTIONS = [
    # On the circle x² + y² = l², δW = λ (2x δx + 2y δy): λ 2l is the force outwards, −m (l φ̇² + g cos φ).
    pytest.param(
        "particle-on-a-circle", {"x": 0.6, "y": 0.8, "dot(x)": 1.6, "dot(y)": -1.2}, [-(4.0 + 9.81 * 0.8) / 2]
    ),
    # The rod pulls with S = m (l φ̇² + g cos φ): positive in tension, negative where it is pushed at the top.
    pytest.param("particle-on-a-rod", {"x": 0.6, "y": 0.8, "dot(x)": 1.6, "dot(y)": -1.2}, [4.0 + 9.81 * 0.8]),
    pytest.param("particle-on-a-rod", {"x": 0.0, "y": -1.0, "dot(x)": 1.0, "dot(y)": 0.0}, [1.0 - 9.81]),
    # On a line that turns with ω = 2, at t = 0 along x: the force across it is m (2 ω ṙ) less the weight m g along y.
    pytest.param("particle-on-a-turning-line", {"x": 3.0, "y": 0.0, "dot(x)": 0.5, "dot(y)": 6.0}, [2.0 - 9.81]),
    # ẋ = ω (l − y) is kept by λ = m ẍ = −m ω ẏ.
    pytest.param("particle-on-a-belt", {"x": 0.0, "y": 0.5, "dot(x)": 1.0, "dot(y)": 0.25}, [-0.5]),
    # Sleigh at φ = 0 with speed v and turning rate w: λ = m J/(J + m a²) v w, across the blade.
    pytest.param("sleigh", {"phi": 0.0, "dot(x)": 3.0, "dot(y)": 0.0, "dot(phi)": 2.0}, [0.5 * 6.0]),
    # At rest, hanging straight down: the upper rod holds both weights, the lower one the second.
    pytest.param("two-rods", {"x1": 0.0, "y1": 1.0, "x2": 0.0, "y2": 2.0}, [2 * 9.81, 9.81]),
]


@pytest.mark.parametrize(("name", "state", "expected"), REACTIONS)
def test_multipliers_are_the_forces_of_newtons_law(name: str, state: dict[str, float], expected: list[float]) -> None:
    values = {**OWN, **state}
    assert solved(name, values) == pytest.approx(expected, abs=1e-12)
    written_out = [each.reaction for each in result(name).constraints if each.reaction is not None]
    assert [_number(value, values) for value in written_out] in ([], pytest.approx(expected, abs=1e-12))
    assert (written_out == []) is (name == "two-rods")  # which are too long to be read


OWN = {"m": 1.0, "m1": 1.0, "m2": 1.0, "l": 1.0, "l1": 1.0, "l2": 1.0, "g": 9.81, "omega": 2.0, "J": 1.0, "a": 1.0}


def solved(name: str, values: dict[str, float]) -> list[float]:
    """λ from the augmented system of the derivation, in numbers."""
    system, derivation = derived(name)
    (step,) = (step for step in derivation.steps() if step.rule == "augmented-system")
    (product, right), unknowns = _sides(step), len(system.free)
    matrix = product.applyfunc(lambda entry: _number(entry, values))
    found = matrix.LUsolve(right.applyfunc(lambda entry: _number(entry, values)))
    return [-float(each) for each in found[unknowns:]]


def hung(count: int) -> Scene:
    """So many bobs on rods from one pivot."""
    numbers = range(1, count + 1)
    rods = [{"name": f"rod{k}", "kind": "distance", "from": "pivot", "to": f"bob{k}", "length": "l"} for k in numbers]
    bobs = [{"name": f"bob{k}", "kind": "particle", "mass": "m", "position": [f"x{k}", f"y{k}"]} for k in numbers]
    return read_scene(
        {
            "id": "hung",
            "coordinates": [{"name": f"{axis}{k}", "value": float(axis == "y")} for k in numbers for axis in "xy"],
            "parameters": [{"name": name, "value": 1.0} for name in ("m", "l", "g")],
            "points": [{"name": "pivot", "position": ["0", "0"]}],
            "bodies": bobs,
            "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}],
            "constraints": rods,
        }
    )


def test_multipliers_of_parts_that_do_not_touch_are_written_out() -> None:
    """Each rod pulls with m (v²/l + g cos φ), whatever the others do."""
    found = multipliers(System(hung(3)))
    assert found is not None
    state = {"m": 2.0, "l": 1.0, "g": 9.81, "x1": 0.6, "y1": 0.8, "x2": 0.0, "y2": 1.0, "x3": 1.0, "y3": 0.0}
    state |= {"dot(x1)": 1.6, "dot(y1)": -1.2, "dot(x2)": 3.0, "dot(y3)": 0.5}
    expected = [2.0 * (4.0 + 9.81 * 0.8), 2.0 * (9.0 + 9.81), 2.0 * 0.25]
    assert [_number(value, state) for value in found.values.values()] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("scene", "why"),
    [(SCENES["two-rods"], "long"), (hung(5), "many")],
    ids=["long", "many"],
)
def test_multipliers_that_are_not_written_out_have_a_reason(scene: Scene, why: str) -> None:
    system = System(scene)
    *_, last = constraints(system)
    assert (last.id, last.about) == ("left-out:multipliers", {"outcome": f"multipliers-{why}"})
    assert system.effort.left_out == {"multipliers": why}
    assert [step.id for step in model(system)].count("left-out:multipliers") == 0
    told = [missing("multipliers", why, language)["text"] for language in ("de", "en")]
    assert all("Multipli" in each or "multipli" in each for each in told)
    assert told[0] != told[1]


def _sides(step: Step) -> tuple[sp.Matrix, sp.Matrix]:
    written = step.relations[0].after
    assert isinstance(written, Equation)
    assert isinstance(written.left, MatrixTimes)
    return sp.Matrix(written.left.matrix.value), sp.Matrix(written.right.value)


def _number(value: sp.Expr, state: dict[str, float]) -> float:
    return float(value.xreplace({symbol: state.get(symbol.name, 0.0) for symbol in value.free_symbols}))


def test_energy_is_conserved_where_constraints_do_not_move() -> None:
    kinds = {name: [(each.kind, each.coordinate) for each in result(name).conserved] for name in SCENES}
    assert kinds == {
        "particle-on-a-circle": [("energy", "")],
        "particle-on-a-rod": [("energy", "")],
        "particle-on-a-turning-line": [],
        "particle-on-a-belt": [],
        "sleigh": [("energy", "")],
        "two-rods": [("energy", "")],
    }


def test_momenta_of_bound_coordinates_are_not_conserved() -> None:
    """L of the sleigh holds neither x nor y, but the blade acts on both."""
    assert [each.kind for each in result("sleigh").conserved] == ["energy"]


@pytest.mark.parametrize("language", ["de", "en"])
def test_what_is_not_sought_with_constraints_is_named(language: str) -> None:
    told = narrated(*derived("sleigh"), language)
    missing = {each["part"]: each["reason"] for each in told["left_out"]}
    others = dict.fromkeys(("integrals", "relative-equilibria", "canonical"), "constraints")
    assert missing == {"equilibria": "rates", **others}
    assert (told["result"]["equilibria"], told["result"]["equilibrium_search"]) == ([], None)
    (bound,) = told["result"]["constraints"]
    assert (bound["name"], bound["kind"], bound["holonomic"]) == ("blade", "equation", False)
    assert bound["multiplier"]["plain"] == "lambda"
    assert [force["plain"] for force in bound["forces"]] == ["-lambda*sin(phi)", "lambda*cos(phi)"]


def test_a_wrong_multiplier_is_not_verified() -> None:
    """The check does not take the rule's word: with twice the reaction the differentiated constraint fails."""
    system, derivation = derived("particle-on-a-rod")
    (step,) = (step for step in derivation.steps() if step.rule == "multiplier")
    vanishing, zero = step.relations[1].members
    assert isinstance(vanishing, Inserted)
    doubled = Inserted(vanishing.of, {symbol: 2 * value for symbol, value in vanishing.values.items()})
    points = tuple(random_points(system))
    assert verified_step(step, points).verified
    assert not verified_step(Step("multiplier", "rod", (Relation((doubled, zero)),)), points).verified


def test_the_multiplier_has_the_letter_that_the_scene_gives_it() -> None:
    """The action, whose letter is S as well, gives way."""
    told = narrated(*derived("particle-on-a-rod", "hamilton"), "en")
    assert told["result"]["constraints"][0]["multiplier"]["latex"] == "S"
    steps = {step["rule"]: step for chapter in told["chapters"] for step in chapter["steps"]}
    assert steps["action"]["latex"].startswith(r"\begin{aligned}\mathcal{S} &= ")


def on_a_line(left: list[str], right: list[str], start: tuple[float, float], **constraint: str) -> Scene:
    """Two masses that move along one line, x(0) and z(0) given, and what binds them."""
    bodies = (("a", "M", left), ("b", "m", right))
    return read_scene(
        {
            "dimension": len(left),
            "coordinates": [{"name": n, "value": v, "unit": "m"} for n, v in zip("xz", start, strict=True)],
            "parameters": [{"name": n, "value": 2.0} for n in ("m", "M", "F", "l", "c")],
            "bodies": [{"name": n, "kind": "particle", "mass": m, "position": r} for n, m, r in bodies],
            "constraints": [{"name": "rod", **constraint}] if constraint else [],
        }
    )


ROD = {"kind": "distance", "from": "a", "to": "b", "length": "l"}
ON_A_LINE = [
    pytest.param(on_a_line(["x", "0"], ["z", "0"], (0.0, 2.0), **ROD), -1, id="from left to right"),
    pytest.param(on_a_line(["x", "0"], ["z", "0"], (2.0, 0.0), **ROD), 1, id="from right to left"),
    pytest.param(on_a_line(["l", "x"], ["l", "z"], (0.0, 2.0), **ROD), -1, id="upright"),
    pytest.param(on_a_line(["0", "0", "x"], ["0", "0", "z"], (0.0, 2.0), **ROD), -1, id="in space"),
]


@pytest.mark.parametrize("formulation", ["dalembert-lagrange", "hamilton"])
@pytest.mark.parametrize(("scene", "sign"), ON_A_LINE)
def test_a_rod_along_a_line_pulls_its_ends_together(scene: Scene, sign: int, formulation: str) -> None:
    """M ẍ = S for the mass on the left: a distance |z − x| has no slope at zero, which the rod keeps it from."""
    system, derivation = derive(scene, formulation)
    assert [step.id for step in derivation.steps() if not step.verified] == []
    first, multiplier = result_of(system).equations["x"], system.multiplier(system.conditions[0])
    assert sp.expand(first).coeff(multiplier) == sign


def test_a_damper_along_a_line_has_no_signs() -> None:
    """R = c/2 ṡ² is the same whichever way the length is counted."""
    document = write_scene(on_a_line(["x", "0"], ["z", "0"], (0.0, 2.0)))
    document["loads"] = [{"kind": "damper", "name": "oil", "from": "a", "to": "b", "coefficient": "c"}]
    system, _ = derive(read_scene(document), "dalembert-lagrange")
    assert not any(each.has(sp.sign, sp.Abs) for each in result_of(system).equations.values())
