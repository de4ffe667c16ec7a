"""The model chapter as a whole: every step verified, wrong ones caught, and the answer of the API."""

from __future__ import annotations

import math

import pytest
import sympy as sp
from scipy.optimize import brentq
from tests.derivation.model_scenes import heavy_top, model_steps, particle, rotating_hoop, spherical_pendulum
from tests.derivation.scenes import chain, spring_in_space

from deltaq.derivation import linearization as small_motions
from deltaq.derivation.formula import Named, Rounded
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.narration.derive import derive_request

SCENES = [
    pytest.param(rotating_hoop(5.0), id="hoop"),
    pytest.param(spherical_pendulum(), id="spherical pendulum"),
    pytest.param(heavy_top(), id="heavy top"),
    pytest.param(chain(3), id="triple pendulum"),
    pytest.param(spring_in_space(), id="spring in space"),
    pytest.param(particle(["x"], {}, ["x", "0"]), id="free particle"),
]


@pytest.mark.parametrize("scene", SCENES)
def test_every_step_is_verified(scene: Scene) -> None:
    assert [name for name, step in model_steps(scene).items() if not step.verified] == []


@pytest.mark.parametrize(
    ("wrong", "step"),
    [
        pytest.param("damping_at_rest", "linearization:1", id="damping"),
        pytest.param("stiffness_at_rest", "linearization:1", id="stiffness"),
    ],
)
def test_a_wrong_matrix_is_caught(wrong: str, step: str, monkeypatch: pytest.MonkeyPatch) -> None:
    right = getattr(small_motions, wrong)
    spoilt = lambda system: (right(system) + sp.eye(len(system.free)) / 10**9).as_immutable()
    monkeypatch.setattr(small_motions, wrong, spoilt)
    steps = model_steps(load_scene("base-pendulum"))
    assert not steps[step].verified
    assert steps["matrix-form"].verified


@pytest.mark.parametrize(
    ("energy", "outcome", "count", "shown"),
    [
        pytest.param("cosh(x-50)", "none-in-range", 0, 0, id="beyond the range"),
        pytest.param("cosh(x)", "in-range", 1, 1, id="one"),
        pytest.param("sin(x)*x", "in-range", 7, 4, id="tan x = −x has seven roots within ±10"),
        pytest.param("(x^2-1)^2+(y^2-1)^2", "everywhere", 9, 4, id="polynomial"),
        pytest.param("cosh(x)+sin(20*x)", "many-in-range", 47, 4, id="more than are looked at"),
        pytest.param("exp(x)*y+sin(x*y)+x", "budget", 9, 4, id="cut"),
    ],
)
def test_what_the_search_for_equilibria_says_of_itself(energy: str, outcome: str, count: int, shown: int) -> None:
    names = ["x", "y"] if "y" in energy else ["x"]
    load = {"kind": "potential", "energy": f"c*({energy})"}
    steps = model_steps(particle(names, {"c": 1.0}, [*names, "0"][:2], load))
    about = steps["equilibrium-search"].about
    assert (about["outcome"], int(about["shown"])) == (outcome, shown)
    assert int(about["count"]) == count or outcome == "budget"


@pytest.mark.parametrize(
    ("energy", "condition", "equilibria"),
    [
        pytest.param("c*x", "none", [], id="a constant force"),
        pytest.param("c*(x^3/3+x)", "none", [], id="x² + 1 has no root, and that is known"),
        pytest.param("c*cosh(x-50)", "not-found", [], id="beyond the range"),
        pytest.param("c*x^2", "text", ["stable"], id="a minimum"),
        pytest.param("c*(x^3/3-x)", "text", ["stable", "unstable"], id="a minimum and a maximum"),
        pytest.param("c*x^4", "text", ["stable-by-derivative"], id="a flat minimum"),
        pytest.param("c*y^2", "free", ["stable-in-the-others"], id="x is free"),
        pytest.param("-c*y^2", "free", ["unstable"], id="unstable beside x"),
    ],
)
def test_what_is_said_of_equilibria(energy: str, condition: str, equilibria: list[str]) -> None:
    names = ["x", "y"] if "y" in energy else ["x"]
    steps = model_steps(particle(names, {"c": 1.0}, [*names, "0"][:2], {"kind": "potential", "energy": energy}))
    assert steps["equilibrium-condition"].about["outcome"] == condition
    assert sorted(step.about["outcome"] for step in steps.values() if step.rule == "equilibrium") == equilibria


RUB = {"kind": "friction", "name": "rubbing", "coordinate": "x", "force": "c"}
MINIMA = [
    pytest.param("x y", "c*(x^2 + y^2)", [], id="quadratic"),
    pytest.param("x y", "c*x^2", [], id="of x alone"),
    pytest.param("x y", "c*x^4", [], id="flat, of x alone"),
    pytest.param("x y", "c*(x^4 + y^4)", [], id="flat"),
    pytest.param("x y z", "c*(x^4 + x^2*y^2 + y^4)", [], id="a form of x and y"),
    pytest.param("x y z", "c*(x^4 + x^2*y^2 + y^4 + z^4)", [], id="a form of all"),
    pytest.param("x y z", "c*((x - y)^4 + (x + y)^2)", [], id="along a kernel, but of z"),
    pytest.param("x y", "c*abs(x)", [], id="a kink of x alone"),
    pytest.param("x y", "c*abs(x) + c*abs(y)", [], id="kinks of both"),
    pytest.param("x y z", "c*abs(x) + c*y^2", [], id="a kink, but of z"),
    pytest.param("x y", "c*x^2", [RUB], id="of x alone, with friction"),
    pytest.param("x y", "c*(x^2 + y^2)", [RUB], id="of both, with friction"),
    pytest.param("x y", "0*x", [RUB], id="no potential"),
]


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize(("names", "energy", "more"), MINIMA)
def test_a_minimum_is_strict_in_all_coordinates_or_the_others_are_named(
    names: str, energy: str, more: list[dict[str, str]], lang: str
) -> None:
    """A potential that does not depend on a coordinate has no strict minimum, only one in all else."""
    moving = names.split()
    loads = [{"kind": "potential", "energy": energy}, *more]
    position = moving if len(moving) > 2 else [*moving, "0"][:2]
    document: dict[str, object] = {
        "dimension": len(position),
        "coordinates": [{"name": name} for name in moving],
        "parameters": [{"name": "m"}, {"name": "c"}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": position}],
        "loads": loads,
    }
    steps = (step for c in derive_request({"scene": document, "lang": lang})["chapters"] for step in c["steps"])
    free = [name for name in moving if name not in energy]
    words = {"en": "strict minimum", "de": "strenges Minimum"}[lang]
    for step in steps:
        if words in step["text"] and step["rule"] in ("equilibrium", "kink-equilibrium"):
            told = {"en": "in all else", "de": "allem anderen"}[lang] in step["text"].lower()
            assert told == bool(free), step["text"]
            assert all(f"${name}$" in step["text"] for name in free)


@pytest.mark.parametrize(("power", "degree"), [(2, None), (4, "4"), (6, "6")])
def test_a_degree_is_told_where_the_second_derivatives_do_not_decide(power: int, degree: str | None) -> None:
    steps = model_steps(particle(["x"], {"c": 1.0}, ["x", "0"], {"kind": "potential", "energy": f"c*x^{power}"}))
    assert steps["equilibrium:1"].about.get("degree") == degree


def test_where_no_force_acts_rest_is_everywhere() -> None:
    assert model_steps(particle(["x"], {}, ["x", "0"]))["equilibrium-condition"].about["outcome"] == "everywhere"


def test_a_wrong_jacobi_energy_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    right = System.momentum
    monkeypatch.setattr(System, "momentum", lambda self, q: right(self, q) / 2)
    assert not model_steps(load_scene("pendulum"))["jacobi-energy"].verified


def test_the_answer() -> None:
    result = derive_request({"scene": "base-pendulum"})["result"]
    hanging, standing = result["equilibria"]
    assert hanging["values"]["y"] == {
        "plain": "m*g/k",
        "latex": r"\frac{m g}{k}",
        "spoken": "the fraction m g over k, end of fraction",
        "number": 0.1635,
    }
    assert (hanging["exact"], hanging["stability"], standing["stability"]) == (True, "stable", "unstable")
    assert hanging["eigenfrequencies"] == pytest.approx([math.sqrt(9.81), math.sqrt(60)])
    assert hanging["modes"][0]["shape"] == {"y": 0.0, "phi": 1.0}
    assert result["jacobi_energy"]["equals_energy"] is True
    assert result["routh"] is None


@pytest.mark.parametrize("order", [("x", "phi"), ("phi", "x")])
def test_positions_that_are_numbers_have_the_units_of_their_coordinates(order: tuple[str, str]) -> None:
    """x = l, and φ = sin(1 − φ), which no formula solves (SciPy: Brent's method)."""
    coordinates = {"x": {"name": "x", "unit": "m", "value": 0.5}, "phi": {"name": "phi", "unit": "rad", "value": 0.2}}
    parameters = {"m": ("kg", 1.0), "k": ("N/m", 2.0), "l": ("m", 1.5), "c": ("J", 3.0)}
    steps = model_steps(
        read_scene(
            {
                "id": "units",
                "dimension": 2,
                "coordinates": [coordinates[name] for name in order],
                "parameters": [{"name": n, "unit": unit, "value": value} for n, (unit, value) in parameters.items()],
                "bodies": [
                    {"name": "bob", "kind": "particle", "mass": "m", "position": ["x + l*cos(phi)", "l*sin(phi)"]}
                ],
                "loads": [{"kind": "potential", "energy": "k*(x - l)^2/2 + c*(phi^2/2 - cos(phi - 1))"}],
            }
        )
    )
    angle = brentq(lambda phi: phi - math.sin(1.0 - phi), 0.0, 1.0, xtol=1e-15)
    told = {}
    for relation in steps["equilibrium:1"].relations[:2]:
        name, value = relation.members
        assert isinstance(name, Named)
        assert isinstance(value, Rounded)
        told[name.quantity.of] = (float(value.value), value.unit)
    assert told == {"x": (pytest.approx(1.5), "m"), "phi": (pytest.approx(angle, rel=1e-12), "rad")}
    assert steps["equilibrium:1"].verified
