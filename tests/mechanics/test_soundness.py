"""Scenes that read well and still are wrong: units, inertia, idle parameters."""

from __future__ import annotations

import copy

import pytest

from deltaq.errors import Problem
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.mechanics.document import examine
from deltaq.mechanics.homogeneity import dimension_problems
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.units import Dimension, dimension_of


def document(**changes: object) -> dict[str, object]:
    """A bob that may move in the plane, with changes."""
    base: dict[str, object] = {
        "coordinates": [{"name": "x", "unit": "m"}, {"name": "phi", "unit": "rad"}],
        "parameters": [{"name": "m", "unit": "kg"}, {"name": "l", "unit": "m"}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x + l*sin(phi)", "l*cos(phi)"]}],
    }
    return copy.deepcopy(base | changes)


def bob(*position: str, mass: str = "m") -> list[dict[str, object]]:
    return [{"name": "bob", "kind": "particle", "mass": mass, "position": list(position)}]


def rigid(inertia: str, angle: str = "phi") -> list[dict[str, object]]:
    body = {"name": "bob", "kind": "rigid", "mass": "m", "position": ["x", "0"], "inertia": inertia, "angle": angle}
    return [body]


def rod(density: str, lower: str = "0", upper: str = "l") -> list[dict[str, object]]:
    material = [{"name": "s", "from": lower, "to": upper}]
    position = ["x + s*sin(phi)", "s*cos(phi)"]
    return [{"name": "rod", "kind": "continuum", "material": material, "density": density, "position": position}]


def units(term: str, found: str, expected: str) -> dict[str, str]:
    return {"term": term, "found": found, "expected": expected}


def potential(energy: str) -> list[dict[str, object]]:
    return [{"name": "field", "kind": "potential", "energy": energy}]


LIGHT = [{"name": "m"}, {"name": "l"}]
WITHOUT_UNITS = [{"name": "x"}, {"name": "phi"}]
CASES = [
    pytest.param({}, (), id="nothing wrong"),
    pytest.param(
        {"parameters": [{"name": "m", "unit": "kg"}, {"name": "l", "unit": "m"}, {"name": "k"}]},
        (Problem("unused-parameter", "/parameters/2", parameters={"name": "k"}, severity="warning"),),
        id="unused parameter",
    ),
    pytest.param(
        {
            "parameters": [{"name": "m", "unit": "kg"}, {"name": "l", "unit": "m"}, {"name": "k"}],
            "drawing": {"elements": [{"kind": "bob", "at": "bob", "radius": "k"}]},
        },
        (),
        id="a parameter of the drawing alone",
    ),
    pytest.param(
        {"coordinates": [{"name": "x", "unit": "furlong"}, {"name": "phi"}]},
        (Problem("unknown-unit", "/coordinates/0/unit", parameters={"unit": "furlong"}, severity="warning"),),
        id="unknown unit",
    ),
    pytest.param(
        {"bodies": bob("x + sin(phi)", "l*cos(phi)")},
        (Problem("inconsistent-units", "/bodies/0/position/0", 4, 8, units("sin(phi)", "1", "m")),),
        id="length plus a bare sine",
    ),
    pytest.param(
        {"bodies": bob("x + l*sin(phi)", "l*cos(x)")},
        (Problem("inconsistent-units", "/bodies/0/position/1", 6, 1, units("x", "m", "1")),),
        id="cosine of a length",
    ),
    pytest.param(
        {"bodies": bob("x + l*sin(phi)", "m*cos(phi)")},
        (Problem("inconsistent-units", "/bodies/0/position/1", 0, 10, units("m*cos(phi)", "kg", "m")),),
        id="position in kilograms",
    ),
    pytest.param(
        {"coordinates": WITHOUT_UNITS, "loads": potential("cosh(x) + x^4 - 2*exp(-x)*sin(phi)")},
        (),
        id="functions of what has no unit take the dimension of their surroundings",
    ),
    pytest.param(
        {"coordinates": WITHOUT_UNITS, "loads": potential("m*cosh(x)")},
        (Problem("inconsistent-units", "/loads/0/energy", 0, 9, units("m*cosh(x)", "kg", "kg m² s⁻²")),),
        id="a mass times a function of what has no unit",
    ),
    pytest.param(
        {"loads": potential("cosh(x)")},
        (
            Problem("inconsistent-units", "/loads/0/energy", 5, 1, units("x", "m", "1")),
            Problem("inconsistent-units", "/loads/0/energy", 0, 7, units("cosh(x)", "1", "kg m² s⁻²")),
        ),
        id="cosh of a length as energy",
    ),
    pytest.param(
        {"coordinates": [{"name": "x", "unit": "cm"}, {"name": "phi", "unit": "rad"}]},
        (Problem("inconsistent-units", "/bodies/0/position/0", 0, 1, units("x", "0.01 m", "m")),),
        id="centimetres plus metres",
    ),
    pytest.param(
        {"bodies": bob("x + l*sin(phi + t)", "l*cos(phi)")},
        (Problem("inconsistent-units", "/bodies/0/position/0", 16, 1, units("t", "s", "1")),),
        id="sine of a time",
    ),
    pytest.param(
        {
            "parameters": [{"name": "m"}, {"name": "l", "unit": "m"}],
            "bodies": bob("x + l*sin(phi + t)", "l*cos(phi)"),
        },
        (),
        id="sine of a time where not all units are given",
    ),
    pytest.param(
        {"bodies": bob("l*sin(phi)", "l*cos(phi)")},
        (Problem("coordinate-without-inertia", "/coordinates/0", parameters={"name": "x", "names": "x"}),),
        id="coordinate that moves nothing",
    ),
    pytest.param(
        {"bodies": bob("x + l*phi", "0")},
        (Problem("dependent-coordinates", "/coordinates/1", parameters={"name": "phi", "names": "x, phi"}),),
        id="coordinates that move together",
    ),
    pytest.param(
        {"bodies": bob("x + l*sin(phi)", "l*cos(phi)", mass="m*(1 + sin(phi))")},
        (Problem("mass-varies", "/bodies/0/mass", parameters={"name": "bob"}),),
        id="mass that varies",
    ),
    pytest.param(
        {"bodies": bob("x + l*sin(phi)", "l*cos(phi)", mass="m - 2*m")},
        (Problem("mass-not-positive", "/bodies/0/mass", parameters={"name": "bob", "value": -1.0}),),
        id="negative mass",
    ),
    pytest.param(
        {"bodies": rigid("-m*l^2")},
        (Problem("inertia-not-positive", "/bodies/0/inertia", parameters={"name": "bob", "value": -1.0}),),
        id="negative inertia",
    ),
    *(
        pytest.param(
            change, (Problem("position-with-rate", pointer, parameters={"coordinate": "phi"}),), id=f"rate in {pointer}"
        )
        for change, pointer in (
            ({"bodies": rigid("m*l^2", "t*dot(phi)")}, "/bodies/0/angle"),
            ({"loads": [{"kind": "moment", "angle": "t*dot(phi)", "moment": "m*l^2"}]}, "/loads/0/angle"),
        )
    ),
    pytest.param(
        {"bodies": rod("m/l*(1 - 2*s/l)")},
        (Problem("density-not-positive", "/bodies/0/density", parameters={"name": "rod", "value": -0.774597}),),
        id="density that becomes negative",
    ),
    pytest.param(
        {"bodies": rod("m/s")},
        (Problem("divergent-integral", "/bodies/0/density", parameters={"name": "s"}),),
        id="rod of infinite mass",
    ),
    pytest.param(
        {
            "loads": [
                {
                    "kind": "distributed",
                    "material": [{"name": "s", "from": "0", "to": "l"}],
                    "position": ["x + s", "0"],
                    "density": ["m/(s - l/3)^2", "0"],
                }
            ]
        },
        (Problem("divergent-integral", "/loads/0/density", parameters={"name": "s"}),),
        id="load with a pole",
    ),
    *(
        pytest.param(
            {"loads": [load]},
            (Problem("acceleration-in-scene", f"/loads/0/{field}", parameters={"coordinate": "phi"}),),
            id=f"acceleration in the {field} of a {load['kind']}",
        )
        for load, field in (
            ({"kind": "force", "at": "bob", "force": ["m*l*ddot(phi)", "0"]}, "force/0"),
            ({"kind": "force", "at": "bob", "force": ["m*l*dddot(phi)*t", "0"]}, "force/0"),
            ({"kind": "moment", "angle": "phi", "moment": "m*l^2*ddot(phi)"}, "moment"),
            ({"kind": "dissipation", "function": "m*l^2*ddot(phi)*dot(phi)"}, "function"),
            (
                {
                    "kind": "distributed",
                    "material": [{"name": "s", "from": "0", "to": "l"}],
                    "position": ["x + s", "0"],
                    "density": ["0", "m*ddot(phi)"],
                },
                "density/1",
            ),
        )
    ),
    pytest.param(
        {"bodies": rod("m/l", "l", "0")},
        (Problem("empty-material", "/bodies/0/material/0/to", parameters={"name": "s", "min": 1.0, "max": 0.0}),),
        id="material bounds the wrong way round",
    ),
    pytest.param(
        {"bodies": rod("m/l", "0", "l*cos(phi)^2")},
        (Problem("mass-varies", "/bodies/0/material/0/to", parameters={"name": "rod"}),),
        id="rod whose length varies",
    ),
    pytest.param(
        {"bodies": bob("x + l*sqrt(-1 - sin(phi)^2)", "l*cos(phi)")},
        (
            Problem(
                "never-defined",
                "/bodies/0/position/0",
                parameters={"expression": "x + l*sqrt(-1 - sin(phi)^2)"},
            ),
        ),
        id="root of what is always negative",
    ),
    pytest.param(
        {"loads": [{"kind": "potential", "energy": "m*x^2/t^2/(phi - phi)"}]},
        (Problem("never-defined", "/loads/0/energy", parameters={"expression": "m*x^2/t^2/(phi - phi)"}),),
        id="potential divided by zero",
    ),
    *(
        pytest.param({"coordinates": WITHOUT_UNITS, "parameters": LIGHT, "loads": potential(energy)}, (), id=energy)
        for energy in ("m*l/cosh(2000*(x - 9))^2", "m*l/(1 + exp(2000*(9 - x)))", "m*l*tanh(2000*(x - 9))")
    ),
]


@pytest.mark.parametrize(("changes", "problems"), CASES)
def test_problems(changes: dict, problems: tuple[Problem, ...]) -> None:
    _, found = examine(document(**changes))
    assert found == problems


@pytest.mark.parametrize("x", [0.0, 0.3])
def test_a_rope_that_runs_out_moves_while_it_lasts(x: float) -> None:
    """0.5 m of rope run up to x, where its end is caught: behind 0.5 m nothing moves along."""
    caught = {
        "format": 1,
        "id": "rope",
        "title": {"en": "Rope"},
        "coordinates": [{"name": "x", "value": x}, {"name": "y"}],
        "parameters": [{"name": "rho", "value": 2.0}],
        "bodies": [
            {
                "name": "rope",
                "kind": "continuum",
                "material": [{"name": "s", "from": "0", "to": "0.5"}],
                "density": "rho",
                "position": ["min(x, s)", "y"],
            }
        ],
    }
    _, problems = examine(caught)
    assert [problem.code for problem in problems if problem.severity == "error"] == []


@pytest.mark.parametrize("identifier", scene_ids())
def test_library_scenes_have_no_problem(identifier: str) -> None:
    from deltaq.mechanics.writing import write_scene

    assert examine(write_scene(load_scene(identifier)))[1] == ()


UNITS = [
    ("kg", "kg"),
    ("m/s^2", "m s⁻²"),
    ("m/s²", "m s⁻²"),
    ("m s⁻²", "m s⁻²"),
    ("N/m", "kg s⁻²"),
    ("N m", "kg m² s⁻²"),
    ("N·m·s/rad", "kg m² s⁻¹"),
    ("1/s", "s⁻¹"),
    ("cm", "0.01 m"),
    ("km/h", "0.277778 m s⁻¹"),
    ("rad", "1"),
]


@pytest.mark.parametrize(("unit", "dimension"), UNITS)
def test_units(unit: str, dimension: str) -> None:
    assert str(dimension_of(unit)) == dimension


@pytest.mark.parametrize("unit", ["", "furlong", "m/", "m^x", "m^99", "//"])
def test_unknown_units(unit: str) -> None:
    assert dimension_of(unit) is None


NAMES = Names((Symbol("x", "coordinate"), Symbol("l", "parameter"), Symbol("k", "parameter"), Symbol("a", "parameter")))
KNOWN: dict[str, Dimension | None] = {
    "x": dimension_of("m"),
    "l": dimension_of("m"),
    "k": dimension_of("N/m"),
    "a": None,
    "t": dimension_of("s"),
}
DIMENSIONS = [
    pytest.param("k*x^2/2", "J", (), id="energy"),
    pytest.param("sqrt(x^2 + l^2)", "m", (), id="root of squares"),
    pytest.param("dot(x)*t + 2*l", "m", (), id="rate times time"),
    pytest.param("a*x + 3", "N", (), id="what is not known fits"),
    pytest.param("x^(1/2)*l^(1/2)", "m", (), id="fractional powers"),
    pytest.param("atan2(x, l)", "rad", (), id="angle of two lengths"),
    pytest.param("k*x", "J", ("k*x",), id="force for energy"),
    pytest.param("x + l^2 + k", "m", ("l^2", "k"), id="two wrong terms"),
    pytest.param("exp(-x)", "1", ("-x",), id="exponential of a length"),
    pytest.param("ddot(x) + dot(x)", "m/s^2", ("dot(x)",), id="acceleration plus rate"),
]


@pytest.mark.parametrize(("text", "unit", "terms"), DIMENSIONS)
def test_dimensions(text: str, unit: str, terms: tuple[str, ...]) -> None:
    problems = dimension_problems(parse(text, NAMES), dimension_of(unit), KNOWN)
    assert tuple(problem.parameters["term"] for problem in problems) == terms


@pytest.mark.parametrize(
    ("gap", "part"),
    [
        ("x^3", "x^3"),
        ("x^2", "x^2"),
        ("2*x^3", "x^3"),
        ("-(x - l)^3/l", "(x - l)^3"),
        ("x^(3/2)", "x^(3/2)"),
        ("x^(1/3)", "x^(1/3)"),
        ("sqrt(x)", "sqrt(x)"),
        ("l*sqrt(x + l)", "sqrt(x + l)"),
        ("x", None),
        ("x*l^2", None),
        ("l^3/l^2 - x", None),
        ("x/sqrt(l)", None),
        ("l - sqrt(x^2 + l^2)/2", None),
        ("x^1", None),
        ("x*exp(x/l)", None),
    ],
)
def test_gaps_without_a_gradient_where_they_close_are_refused(gap: str, part: str | None) -> None:
    event = {"name": "wall", "value": gap, "then": "bounce", "restitution": "1/2"}
    places = [{"name": "x", "unit": "m", "value": 1.0}, {"name": "phi", "unit": "rad"}]
    _, problems = examine(document(coordinates=places, events=[event]))
    found = [each for each in problems if each.severity == "error"]
    assert [each.code for each in found] == ([] if part is None else ["bounce-without-gradient"])
    for each in found:
        assert (each.pointer, each.parameters["part"]) == ("/events/0/value", part)
        assert gap[each.offset : each.offset + each.length] == part
