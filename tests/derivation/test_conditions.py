"""When equilibria exist and are stable, as inequalities; bands of friction; verdicts beyond the second derivatives."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import replace

import pytest
from flint import arb
from tests.derivation.model_scenes import model_steps, particle, rotating_hoop
from tests.derivation.textbook_systems import SYSTEMS
from tests.simulation.scenes import document

from deltaq.derivation.leading_form import leading_form, sign_of
from deltaq.derivation.linearization import linearizations
from deltaq.derivation.matrix_form import forces_at_rest
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.parameter import Parameter
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request

BOOKS = {each.name: each.scene for each in SYSTEMS}


ORIGIN = {name: arb(0) for name in "xyz"} | {"c": arb(1)}


def told(scene: Scene) -> list[tuple[str, list[str], list[str]]]:
    """Of each equilibrium: its verdict, when it exists, when that is so."""
    result = derive_request({"scene": write_scene(scene)})["result"]
    return [
        (
            each["stability"],
            [written(line) for line in each["conditions"]["existence"]],
            [written(line) for line in each["conditions"]["stability"]],
        )
        for each in result["equilibria"]
        if each["conditions"] is not None
    ]


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        pytest.param(
            rotating_hoop(5.0),
            [("stable", ["g < r*Omega^2"], ["g < r*Omega^2"])] * 2
            + [("unstable", [], ["g < r*Omega^2"]), ("unstable", [], [])],
            id="fast hoop",
        ),
        pytest.param(rotating_hoop(4.0), [("stable", [], ["r*Omega^2 < g"]), ("unstable", [], [])], id="slow hoop"),
        pytest.param(
            BOOKS["flat truss, pressed"],
            [("stable", ["a < l"], ["a < l"])] * 2 + [("unstable", [], ["a < l"])],
            id="truss",
        ),
        pytest.param(
            BOOKS["inverted pendulum, strong torsion spring"], [("stable", [], ["g*l*m < c"])], id="inverted pendulum"
        ),
        pytest.param(
            BOOKS["pendulum under a moment"],
            [("stable", ["M < g*l*m"], ["M < g*l*m"]), ("unstable", ["M < g*l*m"], ["M < g*l*m"])],
            id="moment",
        ),
        pytest.param(
            particle(
                ["x"], {"k": 3.0, "c": 1.0, "F": 2.0}, ["x", "0"], {"kind": "potential", "energy": "(k-c)*x^2/2-F*x"}
            ),
            [("stable", [], ["c < k"])],
            id="a quotient is there whatever its sign",
        ),
        pytest.param(
            particle(
                ["x", "y"],
                {"k": 3.0, "c": 1.0},
                ["x", "y"],
                {"kind": "potential", "energy": "(k-c)*(x^2+y^2)/2"},
                {"kind": "force", "at": "bob", "force": ["-c*y", "c*x"]},
            ),
            [],
            id="a force that turns with the motion has no potential",
        ),
        pytest.param(
            BOOKS["two wells (Duffing)"], [("stable", [], [])] * 2 + [("unstable", [], [])], id="for all parameters"
        ),
    ],
)  # fmt: skip
def test_conditions_in_the_parameters(scene: Scene, expected: list[tuple[str, list[str], list[str]]]) -> None:
    found = [(verdict, *[[ordered(line) for line in lines] for lines in two]) for verdict, *two in told(scene)]
    assert found == [(verdict, *[[ordered(line) for line in lines] for lines in two]) for verdict, *two in expected]


@pytest.mark.parametrize(
    ("coordinates", "energy", "expected"),
    [
        pytest.param("x y", "(c-k)*y^2", [("stable", [], ["k < c"])], id="x is free"),
        pytest.param("y x", "(c-k)*y^2", [("stable", [], ["k < c"])], id="x is free and last"),
        pytest.param("y x", "(k-c)*y^2", [("unstable", [], ["k < c"])], id="unstable"),
        pytest.param("y x", "(c-k)^2*y^2", [("stable", [], [])], id="a square has its sign by itself"),
        pytest.param("y x", "(c-k)^3*y^2", [("stable", [], ["k < c"])], id="a cube has not"),
        pytest.param("y x", "(c+k*x)*y^2", [], id="the stiffness is another one for each free x"),
        pytest.param("z y x", "c*z^2+(c+k*x)*y^2", [], id="stable for z only by itself"),
        pytest.param("z y x", "c*z^2-(c+k*x)*y^2", [], id="unstable for some free x"),
    ],
)
def test_conditions_beside_coordinates_that_are_free(
    coordinates: str, energy: str, expected: list[tuple[str, list[str], list[str]]]
) -> None:
    names = coordinates.split()
    scene = particle(names, {"c": 3.0, "k": 1.0}, names, {"kind": "potential", "energy": energy})
    assert told(scene) == expected


def wells(stiffness: str, names: list[str], parameters: dict[str, float]) -> Scene:
    """A particle for each coordinate, in wells of one stiffness."""
    coordinates, bodies = dict.fromkeys(names, (0.0, 0.0)), {f"of_{name}": ("m", [name, "0"]) for name in names}
    energy = " + ".join(f"({stiffness})*{name}^2" for name in names)
    load = {"kind": "potential", "energy": energy}
    return read_scene(document(coordinates, {"m": 1.0, **parameters}, bodies, [load]))


@pytest.mark.parametrize(("count", "known"), [(1, True), (6, True), (7, False)])
def test_conditions_are_told_of_six_minors_at_most(count: int, known: bool) -> None:
    scene = wells("c-k", [f"x{number}" for number in range(1, count + 1)], {"c": 3.0, "k": 1.0})
    assert [(verdict, lines[:1]) for verdict, _, lines in told(scene)] == ([("stable", ["k < c"])] if known else [])


@pytest.mark.parametrize(("powers", "known"), [(21, True), (40, False)])  # the first with 30 operations
@pytest.mark.parametrize("sign", [1, -1])
def test_conditions_that_nobody_reads_are_not_told(powers: int, known: bool, sign: int) -> None:
    """A stiffness that is a long sum, on either side of the inequality."""
    stiffness = f"{sign}*(c - k" + "".join(f" - k^{n}" for n in range(2, powers)) + ")"
    assert bool(told(wells(stiffness, ["x"], {"c": 300.0 if sign > 0 else 0.1, "k": 0.5}))) is known


def written(line: Mapping[str, Mapping[str, str]]) -> str:
    return f"{line['smaller']['plain']} < {line['larger']['plain']}"


def ordered(line: str) -> str:
    """An inequality between products, their factors in one order."""
    return " < ".join("*".join(sorted(side.split("*"))) for side in line.split(" < "))


@pytest.mark.parametrize("speed", [1.0, 3.0, 4.4, 4.6, 6.0, 9.0])
def test_conditions_change_with_the_verdict(speed: float) -> None:
    """√(g/r) = √20 ≈ 4.47: the sign that is printed is the one that holds, and the chapter verifies it."""
    steps = model_steps(rotating_hoop(speed))
    assert [name for name, step in steps.items() if not step.verified] == []
    assert ("existence-condition:1" in steps) == (speed**2 > 20)


def test_friction_holds_a_band() -> None:
    loads = [{"kind": "force", "at": "bob", "force": ["P-k*x-R*sign(dot(x))", "0"]}]
    scene = particle(["x"], {"k": 4.0, "R": 2.0, "P": 3.0}, ["x", "0"], *loads)
    (each,) = derive_request({"scene": write_scene(scene)})["result"]["equilibria"]
    assert (each["band"]["low"]["number"], each["band"]["high"]["number"]) == (0.25, 1.25)
    assert (each["stability"], each["kind"]) == ("stable", "band")
    steps = model_steps(scene)
    assert steps["friction-band:1"].verified


def test_friction_that_balances_a_constant_force_holds_everywhere() -> None:
    def outcome(push: float) -> str:
        load = {"kind": "force", "at": "bob", "force": ["P-R*sign(dot(x))", "0"]}
        steps = model_steps(particle(["x"], {"R": 2.0, "P": push}, ["x", "0"], load))
        return steps["equilibrium-condition"].about["outcome"]

    assert [outcome(push) for push in (1.5, 2.5)] == ["held", "none"]


@pytest.mark.parametrize(
    ("energy", "verdict", "order"),
    [
        pytest.param("(y-x^2/s)^2 + x^6/s^4", "stable", 5, id="bent valley that rises"),
        pytest.param("(y-x^2/s)^2 - x^6/s^4", "unstable", 5, id="bent valley that falls"),
        pytest.param("(y-x^2/s)^2 + x^3/s", "unstable", 2, id="cubic valley"),
        pytest.param("y^2 + 2*y*x^2/s + 2*x^4/s^2", "stable", 3, id="straight on is not least"),
        pytest.param("y^2 + 2*y*x^2/s + x^4/s^2/2", "unstable", 3, id="straight on rises, beside it falls"),
        pytest.param("x^4 + y^4", "stable", 3, id="apart"),
        pytest.param("x^3 - 3*x*y^2", "unstable", 2, id="monkey saddle"),
        pytest.param("x^4 - 6*x^2*y^2 + y^4", "unstable", 3, id="saddle with four valleys"),
        pytest.param("x^4 - x^2*y^2 + y^4", "stable", 3, id="quartic bowl that is no sum of powers"),
        pytest.param("x^4 - 2*x^2*y^2 + y^4 + x^6", "undecided", 0, id="flat along two lines: the next degree decides"),
        pytest.param("x^5 + x*y^4", "unstable", 4, id="odd"),
    ],
)
def test_minima_by_higher_derivatives(energy: str, verdict: str, order: int) -> None:
    scene = particle(["x", "y"], {"c": 1.0, "s": 1.0}, ["x", "y"], {"kind": "potential", "energy": f"c*({energy})"})
    origin = next(each for each in linearizations(System(scene)) if set(each.equilibrium.values.values()) == {0})
    assert (origin.stability, origin.verdict.derivative) == (verdict, order)


@pytest.mark.parametrize(
    ("energy", "verdict"),
    [
        pytest.param("x*y*z", "unstable", id="product"),
        pytest.param("x^4 + y^4 + z^4 - x^2*y^2 - y^2*z^2", "stable", id="bowl in space"),
        pytest.param("x^4 + y^4 + z^4 - 3*x^2*y*z", "unstable", id="falls along the diagonals only"),
    ],
)
def test_forms_in_space(energy: str, verdict: str) -> None:
    scene = particle(["x", "y", "z"], {"c": 1.0}, ["x", "y", "z"], {"kind": "potential", "energy": f"c*({energy})"})
    system = System(scene)
    form = leading_form(forces_at_rest(system), list(map(system.q, system.free)), ORIGIN)
    assert form is not None
    assert sign_of(form) == {"stable": 1, "unstable": -1}[verdict]


def test_a_degenerate_equilibrium_is_told_by_its_form() -> None:
    """Damping changes nothing of it; gyroscopic forces leave it open."""
    saddle = {"kind": "potential", "energy": "c*(x^3-3*x*y^2)"}
    drag = {"kind": "force", "at": "bob", "force": ["-c*dot(x)", "-c*dot(y)"]}
    turn = {"kind": "force", "at": "bob", "force": ["-c*dot(y)", "c*dot(x)"]}
    for loads, outcome in (((saddle,), "unstable-by-form"), ((saddle, drag), "unstable-by-form")):
        steps = model_steps(particle(["x", "y"], {"c": 1.0}, ["x", "y"], *loads))
        assert (steps["equilibrium:1"].about["outcome"], steps["equilibrium:1"].about["degree"]) == (outcome, "3")
    steps = model_steps(particle(["x", "y"], {"c": 1.0}, ["x", "y"], saddle, turn))
    assert steps["equilibrium:1"].about["outcome"] == "degenerate-undecided"


@pytest.mark.one_in(6)
@pytest.mark.parametrize("name", scene_ids())
def test_modes_are_found_all_over_the_sliders(name: str) -> None:
    """As many modes as degrees of freedom where nothing depends on rates: no rounding of a slider loses one."""
    scene, draw = load_scene(name), random.Random(name)
    for _ in range(2):
        moved = replace(scene, parameters=tuple(replace(p, value=drawn(p, draw)) for p in scene.parameters))
        for each in linearizations(System(moved)):
            symmetric = each.stiffness.is_symmetric()
            if each.spectrum is not None and not each.is_damped and symmetric:
                assert len(each.spectrum.modes) == moved.degrees_of_freedom, each.equilibrium.values


def drawn(parameter: Parameter, draw: random.Random) -> float:
    low = parameter.min or parameter.value / 2
    high = parameter.max or parameter.value * 2
    return round(draw.uniform(low, high), 1) or parameter.value
