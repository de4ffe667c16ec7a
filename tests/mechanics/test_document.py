"""Scene documents: what is read, and every problem at its place."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Callable

import pytest

from deltaq.errors import Problem, SceneError
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.writing import write_scene
from deltaq.packages import classes_of

PENDULUM: dict[str, object] = {
    "format": 1,
    "id": "mine",
    "title": {"de": "Meins", "en": "Mine"},
    "dimension": 2,
    "coordinates": [{"name": "phi"}],
    "parameters": [{"name": "m"}, {"name": "l"}, {"name": "g"}],
    "points": [{"name": "pivot", "position": ["0", "0"]}],
    "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["l*sin(phi)", "l*cos(phi)"]}],
    "loads": [{"kind": "gravity", "acceleration": ["0", "g"]}],
    "drawing": {"vertical": "down", "elements": [{"kind": "rod", "from": "pivot", "to": "bob"}]},
}


def test_reads_what_it_writes() -> None:
    scene = read_scene(PENDULUM)
    assert read_scene(json.loads(json.dumps(write_scene(scene)))) == scene


def test_an_impact_needs_its_coefficient() -> None:
    event = {"name": "hit", "value": "1 - phi", "then": "bounce"}
    with pytest.raises(SceneError) as caught:
        read_scene({**PENDULUM, "events": [event]})
    assert [p.pointer for p in caught.value.problems] == ["/events/0/restitution"]
    whole = {**event, "restitution": "1/2", "title": {"en": "hit"}}
    assert write_scene(read_scene({**PENDULUM, "events": [whole]}))["events"] == [whole]


def test_events_are_written_where_there_are_any() -> None:
    event = {"name": "slack", "value": "m*(g*cos(phi) + l*dot(phi)^2)", "title": {"en": "slack"}, "at": "bob"}
    scene = read_scene({**PENDULUM, "events": [event]})
    assert write_scene(scene)["events"] == [event]
    assert read_scene(write_scene(scene)) == scene
    assert scene.events[0].called("en").plain == "slack"
    assert scene.events[0].called("de").plain == "slack"
    assert "events" not in write_scene(read_scene(PENDULUM))


def test_a_mistake_in_an_event_is_told_at_its_place() -> None:
    with pytest.raises(SceneError) as caught:
        read_scene({**PENDULUM, "events": [{"name": "slack", "value": "m*g*cos(phj)"}]})
    (problem,) = caught.value.problems
    assert (problem.pointer, problem.offset, problem.length) == ("/events/0/value", 8, 3)


def test_defaults() -> None:
    scene = read_scene(PENDULUM)
    assert [load.name for load in scene.loads] == ["gravity"]
    assert (scene.coordinates[0].value, scene.parameters[0].value, scene.parameters[0].positive) == (0.0, 1.0, True)
    assert [coordinate.name for coordinate in scene.free] == ["phi"]


@pytest.mark.parametrize(
    ("loads", "drawing", "vertical"),
    [
        pytest.param([{"kind": "gravity", "acceleration": ["0", "-g"]}], {}, "up", id="weight downwards"),
        pytest.param([{"kind": "gravity", "acceleration": ["0", "g"]}], {}, "down", id="as in the lecture"),
        pytest.param([{"kind": "gravity", "acceleration": ["g", "0"]}], None, "up", id="weight sideways"),
        pytest.param([], {}, "up", id="no weight"),
        pytest.param([{"kind": "gravity", "acceleration": ["0", "-g"]}], {"vertical": "down"}, "down", id="said"),
    ],
)
def test_a_drawing_that_does_not_say_it_shows_weights_pointing_down(
    loads: list[object], drawing: object, vertical: str
) -> None:
    assert read_scene({**PENDULUM, "loads": loads, "drawing": drawing}).drawing.vertical == vertical


def test_loads_of_one_kind_are_numbered() -> None:
    document = copy.deepcopy(PENDULUM)
    put("/loads/1", copy.deepcopy(document["loads"][0]))(document)  # type: ignore[index]
    assert [load.name for load in read_scene(document).loads] == ["gravity-1", "gravity-2"]


def test_bodies_of_one_kind_are_numbered() -> None:
    document = copy.deepcopy(PENDULUM)
    del document["bodies"][0]["name"], document["drawing"]  # type: ignore[attr-defined]
    put("/bodies/1", copy.deepcopy(document["bodies"][0]))(document)  # type: ignore[index]
    assert [body.name for body in read_scene(document).bodies] == ["particle1", "particle2"]


@pytest.mark.parametrize("section", ["points", "parameters", "coordinates"])
def test_what_is_of_no_kind_needs_a_name_of_its_own(section: str) -> None:
    nameless: dict[str, object] = {"position": ["0", "0"]} if section == "points" else {}
    document = {**copy.deepcopy(PENDULUM), section: [*PENDULUM.get(section, []), nameless, nameless]}  # type: ignore[misc]
    with pytest.raises(SceneError) as caught:
        read_scene(document)
    problems = [problem for problem in caught.value.problems if problem.pointer.endswith("/name")]
    assert [problem.code for problem in problems].count("missing-field") == 2
    assert {problem.parameters["name"] for problem in problems if "name" in problem.parameters} <= {""}


def put(path: str, value: object) -> Callable[[dict], None]:
    """A change of the document at a JSON pointer."""
    *parents, last = path.strip("/").split("/")

    def change(document: dict) -> None:
        place: object = document
        for key in parents:
            place = place[int(key) if isinstance(place, list) else key]  # type: ignore[index]
        if isinstance(place, list):
            place[int(last) : int(last) + 1] = [value]
        else:
            place[last] = value  # type: ignore[index]

    return change


def never_defined(pointer: str, expression: str) -> Problem:
    return Problem("never-defined", pointer, parameters={"expression": expression})


WRONG = [
    pytest.param(put("/title", {"en": 3, "de": "Drei"}), Problem("not-text", "/title/en"), id="number for a title"),
    pytest.param(put("/summary", {"de": None}), Problem("not-text", "/summary/de"), id="null for a summary"),
    pytest.param(put("/labels", {"bob": {"x/y": {}}}), Problem("not-text", "/labels/bob/x~1y"), id="table for a label"),
    pytest.param(put("/bodies/0/mass", 3), Problem("not-text", "/bodies/0/mass"), id="number for an expression"),
    pytest.param(
        put("/bodies/0/mass", ""),
        Problem("empty-expression", "/bodies/0/mass", parameters={"field": "mass"}),
        id="empty expression",
    ),
    pytest.param(
        put("/bodies/0/mass", None),
        Problem("missing-field", "/bodies/0/mass", parameters={"field": "mass"}),
        id="no mass",
    ),
    pytest.param(
        put("/bodies/0/position", ["l"]),
        Problem("wrong-dimension", "/bodies/0/position", parameters={"expected": 2, "found": 1}),
        id="vector too short",
    ),
    pytest.param(
        put("/bodies/0/position/1", "dot(phi)"),
        Problem("position-with-rate", "/bodies/0/position/1", parameters={"coordinate": "phi"}),
        id="position with a rate",
    ),
    pytest.param(
        put("/bodies/0/position/0", "delta(phi)"), Problem("not-scalar", "/bodies/0/position/0"), id="a variation"
    ),
    pytest.param(put("/loads", 7), Problem("not-a-list", "/loads"), id="loads not a list"),
    pytest.param(put("/loads/0", 7), Problem("not-a-table", "/loads/0"), id="load not a table"),
    pytest.param(
        put("/loads/0", {"kind": "gravty"}),
        Problem(
            "unknown-kind",
            "/loads/0/kind",
            parameters={"kind": "gravty", "known": ", ".join(classes_of("deltaq.mechanics.loads", "kind"))},
        ),
        id="unknown kind of load",
    ),
    *(
        pytest.param(
            put("/loads/0/name", name),
            Problem("invalid-name", "/loads/0/name", parameters={"name": name}),
            id=f"load called {name}",
        )
        for name in (
            "a b",
            "<b>",
            r"\binom{x}{y}",
            r"x}\href{javascript:alert(1)}{y",
            "gravity-",
            "-1",
            "gravity-x",
            "a-1-2",
        )
    ),
    pytest.param(
        put("/loads/0", {"kind": "potential", "energy": "dot(phi)"}),
        Problem("potential-with-rate", "/loads/0/energy", parameters={"coordinate": "phi"}),
        id="potential with a rate",
    ),
    *(
        pytest.param(
            put("/loads/0", {"kind": "friction", "coordinate": "phi", "force": "m*g", **wrong}),
            Problem(code, f"/loads/0/{key}", parameters=parameters),
            id=f"friction: {code}",
        )
        for wrong, code, key, parameters in (
            ({"coordinate": "psi"}, "unknown-coordinate", "coordinate", {"name": "psi", "known": "phi"}),
            ({"coordinate": "l"}, "unknown-coordinate", "coordinate", {"name": "l", "known": "phi"}),
            ({"coordinate": "2*l - g"}, "unknown-coordinate", "coordinate", {"name": "2*l - g", "known": "phi"}),
            ({"coordinate": "l + 2*phi - phi - phi"}, "friction-without-coordinates", "coordinate", {}),
            ({"coordinate": ""}, "empty-expression", "coordinate", {"field": "coordinate"}),
            ({"coordinate": 5}, "not-text", "coordinate", {}),
            ({"coordinate": "l*phi + dot(phi)"}, "friction-with-rate", "coordinate", {"coordinate": "phi"}),
            ({"force": "m*ddot(phi)"}, "friction-with-acceleration", "force", {"coordinate": "phi"}),
            ({"surface_rate": "g*phi"}, "surface-rate-by-coordinate", "surface_rate", {"name": "phi"}),
        )
    ),
    pytest.param(
        put("/loads/0", {"kind": "friction", "coordinate": "l + abs(phi)", "force": "m*g"}),
        Problem("friction-not-smooth", "/loads/0/coordinate", 4, 8, {"function": "abs"}),
        id="friction: friction-not-smooth",
    ),
    *(
        pytest.param(
            put("/events", [{"name": "hit", "value": "1 - phi", "then": "bounce", "restitution": "1/2", **wrong}]),
            problem,
            id=f"impact: {problem.code}",
        )
        for wrong, problem in (
            ({"then": "explode"}, Problem("unknown-ending", "/events/0/then", parameters={"name": "explode"})),
            ({"then": "end"}, Problem("restitution-without-bounce", "/events/0/restitution")),
            (
                {"restitution": "3/2"},
                Problem("restitution-outside", "/events/0/restitution", parameters={"value": 1.5}),
            ),
            (
                {"restitution": "-m"},
                Problem("restitution-outside", "/events/0/restitution", parameters={"value": -1.0}),
            ),
            (
                {"restitution": "phi"},
                Problem("restitution-varies", "/events/0/restitution", parameters={"name": "phi"}),
            ),
            (
                {"value": "1 - dot(phi)"},
                Problem("bounce-with-rate", "/events/0/value", parameters={"coordinate": "phi"}),
            ),
            ({"value": "1 - abs(phi)"}, Problem("bounce-not-smooth", "/events/0/value", 4, 8, {"function": "abs"})),
            ({"value": "1 + 0*phi"}, Problem("bounce-without-coordinates", "/events/0/value")),
            ({"value": "l - l"}, Problem("bounce-without-coordinates", "/events/0/value")),
        )
    ),
    *(
        pytest.param(
            put("/loads/0", {"kind": "generalized-potential", "energy": energy}),
            Problem(f"generalized-potential-{code}", "/loads/0/energy", parameters=parameters),
            id=f"generalized potential {code}",
        )
        for energy, code, parameters in (
            ("m*g*phi", "without-rate", {}),
            ("phi*ddot(phi)", "with-acceleration", {"coordinate": "phi"}),
            ("m*dot(phi)^2/2", "not-linear", {"coordinate": "phi"}),
            ("abs(dot(phi))*l", "not-linear", {"coordinate": "phi"}),
        )
    ),
    pytest.param(
        put("/loads/0", {"kind": "force", "at": "bop", "force": ["0", "0"]}),
        Problem("unknown-place", "/loads/0/at", parameters={"name": "bop", "suggestion": "bob"}),
        id="unknown place",
    ),
    pytest.param(
        put("/coordinates/0/value", math.nan), Problem("not-finite", "/coordinates/0/value"), id="initial value NaN"
    ),
    pytest.param(
        put("/coordinates/0/rate", math.inf), Problem("not-finite", "/coordinates/0/rate"), id="initial rate infinite"
    ),
    *(
        pytest.param(
            put(f"/coordinates/0/{key}", number),
            Problem("initial-too-large", f"/coordinates/0/{key}", parameters={"value": number, "most": 1e15}),
            id=f"initial {key} {number}",
        )
        for key, number in (("value", 1e17), ("value", -1.1e15), ("rate", 1e16), ("rate", -1e300))
    ),
    pytest.param(
        put("/parameters/0/value", 10**400), Problem("not-finite", "/parameters/0/value"), id="whole number too large"
    ),
    pytest.param(
        put("/parameters/0/value", True), Problem("not-a-number", "/parameters/0/value"), id="flag for a number"
    ),
    pytest.param(
        put("/parameters/0/value", -1.0),
        Problem("not-positive", "/parameters/0/value", parameters={"name": "m", "value": -1.0}),
        id="negative mass",
    ),
    pytest.param(
        put("/parameters/0/min", 2.0),
        Problem("outside-range", "/parameters/0/value", parameters={"value": 1.0, "min": "2.0", "max": "None"}),
        id="value below its range",
    ),
    pytest.param(
        put("/parameters/3", {"name": "m"}),
        Problem("duplicate-name", "/parameters/3/name", parameters={"name": "m"}),
        id="the same name twice",
    ),
    pytest.param(
        put("/parameters/3", {"name": "sin"}),
        Problem("reserved-name", "/parameters/3/name", parameters={"name": "sin"}),
        id="a function's name",
    ),
    pytest.param(
        put("/guides", [{"coordinate": "phi", "value": "sin(t)"}]),
        Problem("no-free-coordinate", "/guides"),
        id="nothing left to move",
    ),
    *(
        pytest.param(
            put("/coordinates/0/latex", latex),
            Problem("invalid-latex", "/coordinates/0/latex", parameters={"latex": latex}),
            id=f"latex {latex}",
        )
        for latex in (r"\href{x}{y}", r"\htmlClass{a}{b}", "}{", "{", "a$b", "x\\", "%", "\\\\")
    ),
    pytest.param(
        put("/labels", {"bop": {"en": "bob"}}),
        Problem("label-of-nothing", "/labels/bop", parameters={"name": "bop"}),
        id="label of nothing",
    ),
    *(
        pytest.param(put("/events", [{"name": "slack", **event}]), problem, id=f"event: {problem.code}")
        for event, problem in (
            ({"value": ""}, Problem("empty-expression", "/events/0/value", parameters={"field": "value"})),
            ({}, Problem("missing-field", "/events/0/value", parameters={"field": "value"})),
            (
                {"value": "g - ddot(phi)"},
                Problem("event-with-acceleration", "/events/0/value", parameters={"coordinate": "phi"}),
            ),
            ({"value": "sqrt(-1 - phi^2)"}, never_defined("/events/0/value", "sqrt(-1 - phi^2)")),
            ({"name": "a b", "value": "g"}, Problem("invalid-name", "/events/0/name", parameters={"name": "a b"})),
            (
                {"value": "g", "at": "bop"},
                Problem("unknown-place", "/events/0/at", parameters={"name": "bop", "suggestion": "bob"}),
            ),
            (
                {"value": "g", "when": "0"},
                Problem("unknown-field", "/events/0/when", parameters={"field": "when", "suggestion": "then"}),
            ),
        )
    ),
    pytest.param(
        put("/events", [{"name": "slack", "value": "g"}] * 3),
        Problem("duplicate-name", "/events/1/name", parameters={"name": "slack"}),
        id="three events of one name",
    ),
    pytest.param(
        put("/points/1", {"name": "bob", "position": ["0", "0"]}),
        Problem("duplicate-name", "/bodies/0/name", parameters={"name": "bob"}),
        id="a point and a body of one name",
    ),
    pytest.param(
        put("/loads", [{"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}] * 2),
        Problem("duplicate-name", "/loads/1/name", parameters={"name": "weight"}),
        id="two loads of one name",
    ),
    pytest.param(put("/dimension", 4), Problem("wrong-space", "/dimension"), id="four dimensions"),
    pytest.param(put("/dimension", True), Problem("not-an-integer", "/dimension"), id="dimension a flag"),
    pytest.param(put("/id", "../x"), Problem("invalid-id", "/id", parameters={"name": "../x"}), id="id with a path"),
    pytest.param(put("/format", 2), Problem("unknown-format", "/format", parameters={"expected": 1}), id="format 2"),
    pytest.param(
        put("/bodys", []),
        Problem("unknown-field", "/bodys", parameters={"field": "bodys", "suggestion": "bodies"}),
        id="misspelt field",
    ),
    *(
        pytest.param(change, Problem(code, pointer, parameters=parameters), id=f"pointer is escaped: {pointer}")
        for change, code, pointer, parameters in (
            (
                lambda d: d["bodies"][0].update({"a/b~c": 1}),
                "unknown-field",
                "/bodies/0/a~1b~0c",
                {"field": "a/b~c", "suggestion": ""},
            ),
            (put("/labels", {"a/b": {"en": "bob"}}), "label-of-nothing", "/labels/a~1b", {"name": "a/b"}),
            (put("/labels", {"a/b": 7}), "not-a-table", "/labels/a~1b", {}),
        )
    ),
    pytest.param(
        put("/drawing/elements/0/to", "bop"),
        Problem("unknown-place", "/drawing/elements/0/to", parameters={"name": "bop", "suggestion": "bob"}),
        id="drawing hangs on nothing",
    ),
    pytest.param(
        put("/drawing/elements/0", {"kind": "unicorn"}),
        Problem("unknown-kind", "/drawing/elements/0/kind", parameters={"kind": "unicorn"}),
        id="unknown element",
    ),
    *(
        pytest.param(put("/drawing/view", view), Problem("invalid-view", "/drawing/view"), id=f"view {name}")
        for name, view in (
            ("inside out", [1, 0, 0, 1]),
            ("of three numbers", [0, 1, 0]),
            ("with a word", [0, 1, 0, "b"]),
            ("with a flag", [0, True, 0, 1]),
            ("beyond all numbers", [0, 10**400, 0, 1]),
            ("infinite", [0, math.inf, 0, 1]),
        )
    ),
    *(
        pytest.param(
            put("/drawing/elements/0", {"kind": "rod", "from": "pivot", "to": "bob", "width": width}),
            Problem("not-finite", "/drawing/elements/0/width"),
            id=f"width {name}",
        )
        for name, width in (("infinite", math.inf), ("beyond all numbers", 10**400))
    ),
]


@pytest.mark.parametrize(("change", "problem"), WRONG)
def test_wrong_documents(change: Callable[[dict], None], problem: Problem) -> None:
    document = copy.deepcopy(PENDULUM)
    change(document)
    with pytest.raises(SceneError) as caught:
        read_scene(document)
    assert caught.value.problems.count(problem) == 1, caught.value.problems
    # Nothing else is complained about, unless an element of the wrong kind leaves its own fields unread.
    others = [other for other in caught.value.problems if other != problem]
    assert [other for other in others if other.code != "unknown-field" or other.pointer == problem.pointer] == []


def test_what_is_no_table_keeps_its_place_in_the_list() -> None:
    document = copy.deepcopy(PENDULUM)
    document["parameters"] = [{"name": "m"}, 7, {"name": "l"}, {"name": "g"}, {"name": "m"}]
    with pytest.raises(SceneError) as caught:
        read_scene(document)
    assert caught.value.problems == (
        Problem("duplicate-name", "/parameters/4/name", parameters={"name": "m"}),
        Problem("not-a-table", "/parameters/1"),
    )


def test_a_scene_needs_a_body() -> None:
    with pytest.raises(SceneError) as caught:
        read_scene({"coordinates": [{"name": "x"}]})
    assert caught.value.problems == (Problem("no-body", "/bodies"),)


def test_all_problems_are_found_at_once() -> None:
    document = copy.deepcopy(PENDULUM)
    put("/bodies/0/mass", "m*")(document)
    put("/bodies/0/position/0", "l*sin(phj)")(document)
    put("/coordinates/0/value", "zero")(document)
    with pytest.raises(SceneError) as caught:
        read_scene(document)
    assert {problem.pointer for problem in caught.value.problems} == {
        "/bodies/0/mass",
        "/bodies/0/position/0",
        "/coordinates/0/value",
    }
    misspelt = next(p for p in caught.value.problems if p.pointer == "/bodies/0/position/0")
    assert (misspelt.offset, misspelt.length) == (6, 3)
