"""What simpler scenes are made of: texts of expressions, eliminated coordinates, centres of mass, operations."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
import symengine as se

from deltaq.errors import ExpressionError
from deltaq.language.floats import evaluate
from deltaq.language.parser import parse
from deltaq.mechanics.bodies.continuum import Continuum
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.model.cyclic import cyclic_coordinates
from deltaq.model.dependence import dependencies, solved
from deltaq.model.elimination import eliminated
from deltaq.model.mass_centre import mass_centre
from deltaq.model.operations import operations
from deltaq.model.symbols import Symbols
from deltaq.model.symengine_algebra import to_symengine
from deltaq.model.writing import Writer
from deltaq.simulation.service import problem_of


def scene(*, parameters: tuple[str, ...] = (), loads: tuple[Mapping[str, object], ...] = (), **more: object) -> Scene:
    return read_scene(
        {
            "coordinates": [{"name": "x", "value": 0.4}, {"name": "y", "value": 0.3}],
            "parameters": [{"name": name, "value": 2.0 + k} for k, name in enumerate(("m", *parameters))],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "loads": list(loads),
            **more,
        }
    )


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("m*x^2/2", id="powers"),
        pytest.param("E*exp(1) + exp(x)", id="a parameter called E beside the constant e"),
        pytest.param("dot(x)^2 - dot(y)*E", id="rates"),
        pytest.param("sqrt(x^2 + y^2)^3/(m + E)", id="roots"),
        pytest.param("atan2(y, x) + asinh(x) - pi*t", id="functions, π and time"),
        pytest.param("I*sin(x)", id="a parameter called I"),
        pytest.param("0.1*x + 9.81*y", id="decimals"),
    ],
)
def test_what_is_written_means_the_same(text: str) -> None:
    found = scene(parameters=("E", "I"))
    symbols = Symbols.of(found)
    before = parse(text, found.names)
    after = Writer(symbols, found.names).expression(to_symengine(before.tree, symbols))
    values = {"x": 0.4, "y": 0.3, "m": 2.0, "E": 3.0, "I": 4.0, "t": 0.7, "dot(x)": 1.1, "dot(y)": 0.2}
    assert evaluate(after.tree, values) == pytest.approx(evaluate(before.tree, values), rel=1e-14)


def test_what_the_language_has_no_words_for_is_not_written() -> None:
    found = scene()
    with pytest.raises(ExpressionError):
        Writer(Symbols.of(found), found.names).expression(se.Function("erf")(se.Symbol("q0")))


def test_an_eliminated_coordinate_leaves_the_motion_of_the_constrained_one() -> None:
    """x = y²: E = ½ m (1 + 4 y²) ẏ², also in forces that depend on ẋ."""
    loads = ({"kind": "force", "name": "f", "at": "bob", "force": ["-m*dot(x)", "0"]},)
    full = scene(loads=loads)
    found = eliminated(full, "x", parse("y^2", full.names))
    problem = problem_of(found, 1.0)
    y, rate = 0.3, 0.7
    mass, forcing = problem.model.motion.table(problem.inputs(np.zeros(1), np.array([[y, rate]])))[0, :2]
    assert [each.name for each in found.coordinates] == ["y"]
    assert mass == pytest.approx(2.0 * (1 + 4 * y**2))
    assert forcing == pytest.approx(-8.0 * y * rate**2 - 2.0 * (2 * y * rate) * 2 * y)


@pytest.mark.parametrize(
    ("density", "mass", "place"),
    [
        pytest.param("m/l", 2.0, 1.5, id="uniform"),
        pytest.param("2*m*s/l^2", 2.0, 2.0, id="heavier towards the end"),
        pytest.param("3*m*s^2/l^3", 2.0, 2.25, id="parabolic"),
    ],
)
def test_centre_of_mass(density: str, mass: float, place: float) -> None:
    rod = {
        "name": "rod",
        "kind": "continuum",
        "material": [{"name": "s", "from": "0", "to": "l"}],
        "density": density,
        "position": ["s*sin(x)", "s*cos(x) + y"],
    }
    found = scene(parameters=("l",), bodies=[rod])
    body = found.bodies[0]
    assert isinstance(body, Continuum)
    whole, position = mass_centre(body, found)
    values = {"m": 2.0, "l": 3.0, "x": 0.4, "y": 0.3}
    assert evaluate(whole.tree, values) == pytest.approx(mass)
    expected = [place * np.sin(0.4), place * np.cos(0.4) + 0.3]
    assert [evaluate(part.tree, values) for part in position] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("m*x", {"x"}, id="one"),
        pytest.param("x*sin(y) - x*sin(y) + t", {"t"}, id="what cancels does not count"),
        pytest.param("y*(sin(x)^2 + cos(x)^2)", {"y"}, id="nor does a hidden one"),
        pytest.param("m", set(), id="none"),
    ],
)
def test_dependencies(text: str, expected: set[str]) -> None:
    found = scene()
    assert dependencies(found, parse(text, found.names).tree) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("y - x", 0.3 - 2.0, id="linear"),
        pytest.param("m*x + sin(y)", (2.0 - np.sin(0.3)) / 2.0, id="with a factor"),
        pytest.param("x^2 + y", None, id="quadratic"),
        pytest.param("x*y", None, id="the factor moves"),
        pytest.param("y", None, id="not in it"),
    ],
)
def test_solved(text: str, expected: float | None) -> None:
    """For x, set equal to m = 2 at y = 0.3."""
    found = scene()
    value = solved(found, parse(text, found.names).tree, "x", "m")
    assert (None if value is None else evaluate(value.tree, {"m": 2.0, "y": 0.3})) == (
        expected and pytest.approx(expected)
    )


@pytest.mark.parametrize(
    ("identifier", "expected"),
    [
        pytest.param("spherical-pendulum", ("psi",), id="azimuth"),
        pytest.param("heavy-top", ("psi", "phi"), id="two angles"),
        pytest.param("cart-pendulum", ("x",), id="displacement"),
        pytest.param("atwood", (), id="a potential depends on it"),
        pytest.param("pendulum", (), id="none"),
    ],
)
def test_cyclic_coordinates(identifier: str, expected: tuple[str, ...]) -> None:
    assert cyclic_coordinates(load_scene(identifier)) == expected


def test_a_force_or_a_drag_on_a_coordinate_makes_it_not_cyclic() -> None:
    push = {"kind": "force", "name": "push", "at": "bob", "force": ["m", "0"]}
    drag = {"kind": "dissipation", "name": "drag", "function": "m*(dot(x) - dot(y))^2/2"}
    assert cyclic_coordinates(scene()) == ("x", "y")
    assert cyclic_coordinates(scene(loads=(push,))) == ("y",)
    assert cyclic_coordinates(scene(loads=(drag,))) == ()


def test_operations_are_counted_once_for_each_common_part() -> None:
    """M = m, m and f = −m sin(x) y, −m cos(x)·…: two functions, shared products counted once, and Cholesky for two."""
    well = {"kind": "potential", "name": "well", "energy": "-m*cos(x)*y"}
    found = operations(scene(loads=(well,)))
    assert (found.additions, found.functions, found.solving) == (0, 2, 11)
    assert found.multiplications == 4
    assert found.total == 17
