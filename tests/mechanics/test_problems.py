"""Eighty standard problems of courses on analytical mechanics: which can be described, and what is known of them."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import mpmath
import pytest
import sympy as sp
from tests.mechanics.published import DIGITS, Published, State, rank, read

from deltaq.derivation.engine import derive
from deltaq.mechanics.document import examine
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.narration.derive import derive_request

PROBLEMS = tomllib.loads(Path(__file__).with_name("problems.toml").read_text(encoding="utf-8"))["problem"]
DESCRIBED = [pytest.param(row, id=row["topic"]) for row in PROBLEMS if "coordinates" in row and "missing" not in row]
BY_TOPIC = {row["topic"]: row for row in PROBLEMS if "missing" not in row}
KNOWN = [pytest.param(topic, id=topic) for topic in BY_TOPIC]
POINTS = 20
CLOSE = mpmath.mpf(10) ** -30


def having(part: str) -> list[Any]:
    return [pytest.param(topic, id=topic) for topic, row in BY_TOPIC.items() if part in row]


def document(row: Mapping[str, Any]) -> dict[str, object]:
    """The scene document of a row."""
    start, values = row.get("start", {}), row.get("values", {})
    bodies = [
        {"name": name, "kind": "particle", "mass": mass, "position": position}
        for name, (mass, *position) in row.get("particles", {}).items()
    ]
    bodies += [
        {"name": name, "kind": "rigid", "mass": mass, "inertia": inertia, "angle": angle, "position": position}
        for name, (mass, inertia, angle, *position) in row.get("rigids", {}).items()
    ]
    bodies += [
        {
            "name": name,
            "kind": "rigid",
            "mass": mass,
            "inertia": rest[:3],
            "angular_velocity": rest[3:6],
            "position": rest[6:] or ["0", "0", "0"],
        }
        for name, (mass, *rest) in row.get("space", {}).items()
    ]
    loads = [{"kind": "gravity", "acceleration": row["gravity"]}] if "gravity" in row else []
    constraints = [{"kind": "equation", "equation": equation} for equation in row.get("constraints", [])]
    constraints += [{"kind": "distance", "from": a, "to": b, "length": s} for a, b, s in row.get("distances", [])]
    return {
        "dimension": row.get("dimension", 2),
        "coordinates": [{"name": name, "value": start.get(name, 0.7)} for name in row["coordinates"].split()],
        "parameters": [{"name": name, "value": values.get(name, 1.0)} for name in row["parameters"].split()],
        "points": row.get("points", []),
        "bodies": [*bodies, *row.get("bodies", [])],
        "loads": [*loads, *row.get("loads", [])],
        "constraints": constraints,
        "events": row.get("events", []),
    }


def test_nine_of_ten_can_be_described() -> None:
    missing = [row["topic"] for row in PROBLEMS if "missing" in row]
    assert len(PROBLEMS) == len({row["topic"] for row in PROBLEMS}) == 80
    assert missing == [
        "Rocket, whose mass decreases",
        "Vibrating string as a field",
        "Relativistic particle",
        "Chain folded and let go at one end",
        "Rod that leans on a wall and is held by a string: statics (Landau, Lifshitz, §38, problem 2)",
    ]
    assert {row["scene"] for row in PROBLEMS if "scene" in row} <= set(scene_ids())
    assert all(load_scene(row["scene"]) for row in PROBLEMS if "scene" in row)


@pytest.mark.parametrize("row", DESCRIBED)
def test_a_problem_is_described(row: dict[str, Any]) -> None:
    """Without a warning, too."""
    scene, problems = examine(document(row))
    assert scene is not None
    assert [problem.code for problem in problems if problem.code != "unused-parameter"] == []


@pytest.mark.parametrize("row", [pytest.param(row, id=row["topic"]) for row in PROBLEMS if "refusal" in row])
def test_what_cannot_be_described_is_refused_at_its_place(row: dict[str, Any]) -> None:
    _, problems = examine(document(row))
    assert [[p.code, p.pointer] for p in problems if p.severity == "error"] == [row["refusal"]]


@pytest.mark.one_in(9)
@pytest.mark.parametrize("row", DESCRIBED)
def test_a_problem_is_derived(row: dict[str, Any]) -> None:
    scene, _ = examine(document(row))
    assert scene is not None
    _, derivation = derive(scene)
    assert [step.id for step in derivation.steps() if not step.verified] == []


def scene_of(row: Mapping[str, Any]) -> Scene:
    if "scene" in row:
        return load_scene(row["scene"])
    scene, _ = examine(document(row))
    assert scene is not None
    return scene


@cache
def published(topic: str) -> Published:
    """A row beside what the service answers to it."""
    row = BY_TOPIC[topic]
    asked = {"scene": row.get("scene") or document(row), "release": list(row.get("released", {})), "lang": "en"}
    constants = frozenset(parameter.name for parameter in scene_of(row).parameters)
    return Published(row, dict(derive_request(asked)["result"]), constants)  # type: ignore[call-overload]


@pytest.fixture(autouse=True)
def _many_digits() -> Iterator[None]:
    with mpmath.workdps(DIGITS):
        yield


def states(problem: Published) -> Iterator[State]:
    """Random ones; that they keep the constraints is the service's word against the row's `on`."""
    for seed in range(POINTS):
        state = problem.state(seed)
        assert all(abs(state(kept)) < CLOSE for kept in problem.kept)
        yield state


def wrong(problem: Published) -> list[str]:
    """The published laws that the derived motion breaks."""
    found = [str(law) for state in states(problem) for law in problem.laws if abs(state(law)) > CLOSE]
    return sorted(set(found))


def test_every_problem_names_where_its_answer_is_from() -> None:
    assert [t for t, row in BY_TOPIC.items() if "source" not in row and "§" not in t] == []
    assert [t for t, row in BY_TOPIC.items() if not row.keys() & {"laws", "lagrangian"}] == []


@pytest.mark.parametrize("topic", KNOWN)
def test_the_published_laws_hold_where_the_system_moves(topic: str) -> None:
    assert wrong(published(topic)) == []


@pytest.mark.parametrize("topic", KNOWN)
def test_the_published_laws_leave_nothing_open(topic: str) -> None:
    """With the constraints they give every acceleration and every multiplier."""
    problem = published(topic)
    laws = [*map(problem.resolved, problem.laws), *problem.kept_accelerations]
    state = problem.state(0)
    assert rank([[state(law.diff(unknown)) for unknown in problem.unknowns] for law in laws]) == len(problem.unknowns)


@pytest.mark.parametrize("topic", having("laws"))
def test_a_wrong_law_is_noticed(topic: str) -> None:
    """Each law whose right side is made a hundredth larger, so that none holds for whatever moves."""
    problem = published(topic)
    state = problem.state(0)
    for law in problem.row["laws"]:
        left, right = law.split(" = ")
        assert right == "0" or abs(state(read(f"{left} = 101/100*({right})"))) > CLOSE, law


@pytest.mark.parametrize("topic", KNOWN)
def test_multipliers_in_closed_form_are_those_of_the_equations(topic: str) -> None:
    problem = published(topic)
    closed = [c for c in problem.result["constraints"] if c["reaction"]]
    for state in states(problem) if closed else ():
        for constraint in closed:
            found = state(read(constraint["reaction"]["plain"]))
            assert abs(found - state(read(constraint["multiplier"]["plain"]))) < CLOSE


@pytest.mark.parametrize("topic", having("released"))
def test_what_holds_a_length_is_the_published_force(topic: str) -> None:
    problem = published(topic)
    reactions = {each["name"]: read(each["reaction"]["plain"]) for each in problem.result["reactions"]}
    assert reactions.keys() == problem.row["released"].keys()
    for state in states(problem):
        for name, text in problem.row["released"].items():
            assert abs(state(reactions[name]) - state(read(text))) < CLOSE


@pytest.mark.parametrize("topic", having("conserved"))
def test_published_integrals_are_conserved_and_found(topic: str) -> None:
    """They are functions of those that the service lists, unless it says that it did not look for them."""
    problem = published(topic)
    integrals, listed = problem.integrals(), [read(c["plain"]) for c in problem.result["conserved"]]
    for state in states(problem):
        assert [c for c in integrals if abs(state(problem.time_derivative(c))) > CLOSE] == []
        if not problem.kept:
            both = [[state(problem.resolved(c).diff(x)) for x in problem.states()] for c in [*listed, *integrals]]
            assert rank(both) == rank(both[: len(listed)])


def number(topic: str, text: str, initial: Mapping[str, float] | None = None) -> float:
    """A published value for the parameters of the scene."""
    values = {p.name: p.value for p in scene_of(BY_TOPIC[topic]).parameters} | dict(initial or {})
    return float(read(text).subs({sp.Symbol(name): value for name, value in values.items()}))


@pytest.mark.parametrize("topic", having("rests"))
def test_published_positions_of_rest_have_the_published_frequencies(topic: str) -> None:
    for rest in BY_TOPIC[topic]["rests"]:
        at = {name: number(topic, text) for name, text in rest["at"].items()}
        (found,) = [
            each
            for each in published(topic).result["equilibria"]
            if all(each["values"][q]["number"] == pytest.approx(value, abs=1e-10) for q, value in at.items())
        ]
        squares = sorted(number(topic, text) for text in rest["squares"])
        assert [omega**2 for omega in found["eigenfrequencies"]] == pytest.approx(squares, rel=1e-10)


@pytest.mark.parametrize("topic", having("steady"))
def test_published_steady_motions_are_found(topic: str) -> None:
    for steady in BY_TOPIC[topic]["steady"]:
        (found,) = [m for m in published(topic).result["relative_equilibria"] if m["turning"] == steady["turning"]]
        initial = {name: start["value"] for name, start in found["initial"].items()}
        assert found["rate"]["number"] == pytest.approx(number(topic, steady["rate"], initial), rel=1e-10)
        assert found["eigenfrequency"] ** 2 == pytest.approx(number(topic, steady["square"], initial), rel=1e-10)


@pytest.mark.parametrize("topic", having("impact"))
def test_an_impact_changes_rates_as_published(topic: str) -> None:
    problem = published(topic)
    (contact,) = problem.result["contacts"]
    jumps = {jump["coordinate"]: read(jump["plain"]) for jump in contact["impact"]["rate_jumps"]}
    for state in states(problem):
        for q, text in problem.row["impact"].items():
            assert abs(state(jumps[q]) - state(read(text))) < CLOSE
