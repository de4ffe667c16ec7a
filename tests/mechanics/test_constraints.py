"""Constraints of scene documents: what is read, and what is refused at its field."""

from __future__ import annotations

import json
import pickle
from typing import Any

import pytest

from deltaq.errors import InputError, Problem
from deltaq.language.floats import evaluate
from deltaq.mechanics.changes import change
from deltaq.mechanics.document import examine, read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene

Table = dict[str, object]
UNITS = {"m": "kg", "l": "m", "c": "m", "omega": "1/s"}


def document(*constraints: Table, **changes: object) -> Table:
    """Two particles in the plane, the second on a horizontal line, with constraints."""
    base: Table = {
        "coordinates": [{"name": name, "unit": "m", "value": 1.0} for name in ("x", "y", "z")],
        "parameters": [{"name": name, "unit": unit} for name, unit in UNITS.items()],
        "points": [{"name": "pivot", "position": ["0", "c"]}],
        "bodies": [
            {"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]},
            {"name": "slider", "kind": "particle", "mass": "m", "position": ["z", "0*l"]},
        ],
        "constraints": list(constraints),
    }
    return base | changes


def equation(text: str, **more: str) -> Table:
    return {"kind": "equation", "name": "track", "equation": text, **more}


def rod(start: str = "pivot", end: str = "bob", length: str = "l") -> Table:
    return {"kind": "distance", "name": "rod", "from": start, "to": end, "length": length}


def at_equation(code: str, offset: int, length: int, **parameters: str) -> tuple[Problem, ...]:
    return (Problem(code, "/constraints/0/equation", offset, length, parameters),)


def tied(code: str, *equations: str) -> Any:
    """Equations of which the last is tied to all others."""
    names = [f"law{index}" for index in range(len(equations))]
    parameters = {"name": names[-1], "names": ", ".join(names)}
    told = (Problem(code, f"/constraints/{len(equations) - 1}", parameters=parameters),)
    laws = [{**equation(text), "name": name} for text, name in zip(equations, names, strict=True)]
    return pytest.param(laws, told, id=f"{code}: {'; '.join(equations)}")


FOLLOWS, CONTRADICTS, DEMANDS = "dependent-constraints", "contradictory-constraints", "constraints-on-coordinates"
TIED = [
    tied(FOLLOWS, "x = l", "y = l", "x + y = 2*l"),
    tied(CONTRADICTS, "x = l", "y = l", "x + y = 3*l"),
    tied(FOLLOWS, "x^2 + y^2 = l^2", "(x^2 + y^2)^2 = l^4"),
    tied(CONTRADICTS, "x^2 + y^2 = l^2", "(x^2 + y^2)^2 = 2*l^4"),
    tied(CONTRADICTS, "x^64 = l^64", "x^64 + 10^22*l^64 = l^64"),  # here and there the second has no row
    tied(FOLLOWS, "dot(x) = l*omega", "dot(y) = l*omega", "dot(x) + dot(y) = 2*l*omega"),
    tied(CONTRADICTS, "dot(x) = l*omega", "dot(y) = l*omega", "dot(x) + dot(y) = 3*l*omega"),
    tied(CONTRADICTS, "x = l*omega*t", "x = 2*l*omega*t"),
    tied(FOLLOWS, "x = l*omega*t", "dot(x) = l*omega"),
    tied(CONTRADICTS, "x = l*omega*t", "dot(x) = 2*l*omega"),
    tied(DEMANDS, "dot(x) = omega*y", "dot(x) = 2*omega*y"),
    tied(DEMANDS, "x = l + l*omega*t", "dot(x) = omega*y"),
    tied(DEMANDS, "x*dot(x) + y*dot(y) = l*l*omega", "x*dot(x) + y*dot(y) = l*omega*(x - y)"),
]
WRONG = [
    pytest.param([equation("x^2 = l")], at_equation("inconsistent-units", 6, 1, term="l", found="m", expected="m²")),
    pytest.param([equation("x + dot(x)^2*l = 0")], at_equation("constraint-not-linear", 4, 8, term="dot(x)^2")),
    pytest.param([equation("dot(y)/dot(x) = 1")], at_equation("constraint-not-linear", 0, 13, term="dot(y)/dot(x)")),
    pytest.param([equation("l + sin(dot(x)) = 0")], at_equation("constraint-not-linear", 4, 11, term="sin(dot(x))")),
    pytest.param([equation("y = l*ddot(x)/c")], at_equation("constraint-with-acceleration", 6, 7, coordinate="x")),
    pytest.param([equation("y = abs(x)")], at_equation("constraint-not-smooth", 4, 6, function="abs")),
    pytest.param([equation("x^2 + y^2 <= l^2")], at_equation("inequality-in-scene", 10, 1, character="<")),
    pytest.param([equation("x ≥ l")], at_equation("inequality-in-scene", 2, 1, character="≥")),
    pytest.param([equation("\\dot{x} = l")], at_equation("latex-in-scene", 0, 1)),
    pytest.param([equation("x = \\ell")], at_equation("latex-in-scene", 4, 1)),
    pytest.param([equation("y = x +")], at_equation("unexpected-end", 7, 0)),
    pytest.param([equation("y = x; x = 1")], (Problem("not-scalar", "/constraints/0/equation"),)),
    pytest.param([equation("l = c")], (Problem("constraint-without-coordinates", "/constraints/0"),)),
    pytest.param([equation("x - x = 0")], (Problem("constraint-without-coordinates", "/constraints/0"),)),
    pytest.param(
        [{**equation(f"{name} = l"), "name": name} for name in "xyz"],
        (Problem("too-many-constraints", "/constraints/2", parameters={"count": 3, "free": 3}),),
    ),
    pytest.param(
        [equation("x - y = l"), {**equation("2*y = 2*x - 2*l"), "name": "again"}],
        (Problem("dependent-constraints", "/constraints/1", parameters={"name": "again", "names": "track, again"}),),
    ),
    pytest.param(
        [rod(), {**equation("x^2 + (y - c)^2 = l^2"), "name": "again"}],
        (Problem("dependent-constraints", "/constraints/1", parameters={"name": "again", "names": "rod, again"}),),
    ),
    pytest.param(
        [equation("x + y = l"), {**equation("dot(x) + dot(y) = 0"), "name": "again"}],
        (Problem("dependent-constraints", "/constraints/1", parameters={"name": "again", "names": "track, again"}),),
    ),
    pytest.param(
        [equation("x - y = l"), {**equation("3*x - 3*y = l"), "name": "other"}],
        (
            Problem(
                "contradictory-constraints", "/constraints/1", parameters={"name": "other", "names": "track, other"}
            ),
        ),
    ),
    *TIED,
    pytest.param(
        [rod(end="bobb")],
        (Problem("unknown-place", "/constraints/0/to", parameters={"name": "bobb", "suggestion": "bob"}),),
    ),
    pytest.param(
        [rod(end="pivot")], (Problem("distance-of-itself", "/constraints/0/to", parameters={"name": "pivot"}),)
    ),
    pytest.param(
        [rod(length="l - l")], (Problem("length-not-positive", "/constraints/0/length", parameters={"value": 0.0}),)
    ),
    pytest.param(
        [rod(length="l + dot(x)*l/c")],
        (Problem("length-with-rate", "/constraints/0/length", parameters={"coordinate": "x"}),),
    ),
    pytest.param(
        [equation("y = l", multiplier="m")],
        (Problem("duplicate-name", "/constraints/0/multiplier", parameters={"name": "m"}),),
    ),
    pytest.param(
        [equation("y = l", multiplier="sin")],
        (Problem("reserved-name", "/constraints/0/multiplier", parameters={"name": "sin"}),),
    ),
    pytest.param(
        [equation("y = l", latex="\\input{x}")],
        (Problem("invalid-latex", "/constraints/0/latex", parameters={"latex": "\\input{x}"}),),
    ),
    pytest.param(
        [equation("y = l"), equation("x = l")],
        (Problem("duplicate-name", "/constraints/1/name", parameters={"name": "track"}),),
    ),
    pytest.param(
        [{"kind": "rod", "name": "rod"}],
        (Problem("unknown-kind", "/constraints/0/kind", parameters={"kind": "rod", "known": "distance, equation"}),),
    ),
]


@pytest.mark.parametrize(("constraints", "problems"), WRONG)
def test_what_is_no_constraint_is_refused_at_its_field(constraints: list[Table], problems: tuple[Problem, ...]) -> None:
    _, found = examine(document(*constraints))
    assert tuple(problem for problem in found if problem.severity == "error") == problems


@pytest.mark.parametrize(
    ("multiplier", "word"),
    [("", "lambda"), ("", "λ"), ("", "lambda_1"), ("N", "N"), ("F_N", "F_N"), ("lambda_N", "λ_N")],
)
def test_forces_and_events_by_a_multiplier_are_told_what_it_is(multiplier: str, word: str) -> None:
    """It looks like a function, a unit or a misspelt name, and is what a lecturer writes for μ N or for lifting off."""
    named = {"multiplier": multiplier} if multiplier else {}
    load = {"kind": "force", "name": "drag", "at": "slider", "force": [f"c*{word}", "0"]}
    _, found = examine(
        document(equation("y = l", **named), loads=[load], events=[{"name": "off", "value": f"0.5*{word}"}])
    )
    told = [(p.code, p.pointer, p.offset) for p in found if p.severity == "error"]
    assert told == [("multiplier-in-scene", "/loads/0/force/0", 2), ("multiplier-in-scene", "/events/0/value", 4)]


def test_a_name_that_no_constraint_declares_is_no_multiplier() -> None:
    load = {"kind": "force", "name": "drag", "at": "slider", "force": ["c*F_N", "0"]}
    _, found = examine(document(equation("y = l"), loads=[load]))
    assert [problem.code for problem in found if problem.severity == "error"] == ["unknown-name"]


def test_a_link_without_mass_is_told_what_takes_its_place() -> None:
    """Its angle moves nothing but what constraints move: M has no inverse, though the motion is determined."""
    link = [{"name": "psi", "unit": "rad", "value": 0.3}]
    base = document()
    bodies = {"coordinates": [*base["coordinates"], *link]}  # type: ignore[misc]
    along, across = equation("x + l*cos(psi) = z"), {**equation("y + l*sin(psi) = c"), "name": "across"}
    _, found = examine(document(along, across, **bodies))
    told = [(problem.code, problem.pointer) for problem in found if problem.severity == "error"]
    assert told == [("held-coordinate-without-inertia", "/coordinates/3")]
    _, found = examine(document(equation("x = z"), **bodies))
    assert [problem.code for problem in found if problem.severity == "error"] == ["coordinate-without-inertia"]


def test_a_constraint_of_what_is_guided_holds_nothing() -> None:
    guides = [{"coordinate": "x", "value": "l*c/l"}]
    _, found = examine(document(equation("x = l"), guides=guides))
    assert tuple(problem for problem in found if problem.severity == "error") == (
        Problem("constraint-of-guided", "/constraints/0", parameters={"names": "x"}),
    )


RIGHT = [
    pytest.param([equation("x^2 + y^2 = l^2")], [True], 2, ["lambda"], id="holonomic"),
    pytest.param([equation("y - l*sin(omega*t) = 0")], [True], 2, ["lambda"], id="of the time"),
    pytest.param([equation("dot(y)*x - y*dot(x)")], [False], 2, ["lambda"], id="of rates, to be zero"),
    pytest.param([equation("(x*dot(y) - dot(x)*y)/l = 0")], [False], 2, ["lambda"], id="of rates, with a quotient"),
    pytest.param([rod(), equation("x = z")], [True, True], 1, ["lambda_1", "lambda_2"], id="two"),
    pytest.param([rod(), equation("x = z", multiplier="N")], [True, True], 1, ["lambda", "N"], id="one named"),
]


@pytest.mark.parametrize(("constraints", "holonomic", "freedom", "multipliers"), RIGHT)
def test_scenes_keep_their_constraints(
    constraints: list[Table], holonomic: list[bool], freedom: int, multipliers: list[str]
) -> None:
    scene = scene_of(*constraints)
    assert [condition.is_holonomic for condition in scene.conditions] == holonomic
    assert (scene.degrees_of_freedom, [symbol.name for symbol in scene.multipliers]) == (freedom, multipliers)
    assert read_scene(json.loads(json.dumps(write_scene(scene)))) == scene == pickle.loads(pickle.dumps(scene))


def scene_of(*constraints: Table, **changes: object) -> Scene:
    scene, problems = examine(document(*constraints, **changes))
    assert scene is not None
    assert [problem for problem in problems if problem.severity == "error"] == []
    return scene


def test_names_of_multipliers_avoid_those_of_the_scene() -> None:
    taken = [{"name": "x", "unit": "m"}, {"name": "y", "unit": "m"}, {"name": "lambda", "unit": "m"}]
    bodies = [
        {"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y + 0*l"]},
        {"name": "slider", "kind": "particle", "mass": "m", "position": ["lambda", "0*c"]},
    ]
    scene = scene_of(equation("x = y + l"), coordinates=taken, bodies=bodies)
    assert [symbol.name for symbol in scene.multipliers] == ["lambda_1"]


def test_the_condition_of_a_rod_is_what_its_length_lacks() -> None:
    """With g = s − |r₂ − r₁| the multiplier is positive in tension: the reaction λ ∂g/∂q pulls the ends together."""
    (condition,) = scene_of(rod()).conditions
    values = {"x": 3.0, "y": 5.0, "c": 1.0, "l": 6.0}
    assert evaluate(condition.value, values) == pytest.approx(6.0 - 5.0)


def test_freezing_leaves_a_motion_or_is_refused() -> None:
    scene = scene_of(rod(), equation("x = z"))
    with pytest.raises(InputError) as caught:
        change(scene, freeze=["x"])
    told = {"count": 2, "free": 2}
    assert caught.value.problems == (Problem("too-many-constraints", "/freeze/0", parameters=told),)
    held = scene_of(equation("x = l"))
    with pytest.raises(InputError) as caught:
        change(held, freeze=["x"])
    assert caught.value.problems == (Problem("constraint-of-guided", "/freeze/0", parameters={"names": "x"}),)
