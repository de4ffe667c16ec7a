"""Equilibria and small motions with constraints: against coordinates without them, textbooks, and SciPy's minima."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy import linalg, optimize
from tests.derivation.model_scenes import model_steps

from deltaq.derivation import tangent
from deltaq.derivation.bound_equilibria import searched
from deltaq.derivation.equilibria import Search
from deltaq.derivation.linearization import Linearization, linearizations
from deltaq.derivation.matrix_form import forces_at_rest
from deltaq.derivation.system import System
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request


def with_values(name: str, **values: float) -> Scene:
    """A built-in scene with other parameters."""
    document: dict[str, Any] = write_scene(load_scene(name))
    for parameter in document["parameters"]:
        parameter["value"] = values.get(parameter["name"], parameter["value"])
    return read_scene(document)


def particle(constraints: list[dict[str, str]], *loads: Mapping[str, object]) -> Scene:
    """A weight in the plane, y downwards, that keeps constraints."""
    weight = {"kind": "gravity", "acceleration": ["0", "g"]}
    return read_scene(
        {
            "id": "particle",
            "coordinates": [{"name": "x", "value": 0.6}, {"name": "y", "value": 0.8}],
            "parameters": [{"name": name, "value": v} for name, v in (("m", 2.0), ("l", 1.0), ("g", 9.81), ("c", 0.5))],
            "points": [{"name": "pivot", "position": ["0", "0"]}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "loads": [weight, *loads],
            "constraints": constraints,
        }
    )


CIRCLE = {"kind": "equation", "name": "circle", "equation": "x^2 + y^2 = l^2"}


def numbers(system: System, linear: Linearization) -> dict[str, float]:
    """Coordinates and multipliers of an equilibrium at the scene's values."""
    known = {**linear.equilibrium.values, **linear.equilibrium.reactions}
    return {q.name: float(value.xreplace(dict(system.parameter_values))) for q, value in known.items()}


def found(system: System) -> Search:
    known = searched(system)
    assert known is not None
    return known


def squares(linear: Linearization) -> list[float]:
    assert linear.spectrum is not None
    return sorted(float(mode.square) for mode in linear.spectrum.modes)


@pytest.mark.parametrize("lengths", [(1.0, 1.0), (0.7, 1.3)])
def test_two_rods_are_the_double_pendulum_in_angles(lengths: tuple[float, float]) -> None:
    """M φ̈ + K φ = 0 with M = (m₁+m₂)l₁², m₂l₁l₂, m₂l₂² and K = (m₁+m₂)g l₁, m₂g l₂, turned where a rod stands up."""
    (l1, l2), (m1, m2, g) = lengths, (1.5, 0.8, 9.81)
    system = System(with_values("double-pendulum-by-rods", m1=m1, m2=m2, l1=l1, l2=l2))
    assert (found(system).count, found(system).complete) == (4, True)
    for linear in linearizations(system):
        at = numbers(system, linear)
        up = [math.copysign(1.0, at["y1"]), math.copysign(1.0, at["y2"] - at["y1"])]
        assert [at["y1"], at["y2"] - at["y1"]] == pytest.approx([up[0] * l1, up[1] * l2])
        assert [at["S1"], at["S2"]] == pytest.approx([up[0] * (m1 + m2) * g, up[1] * m2 * g])
        coupling = up[0] * up[1] * m2 * l1 * l2
        mass = np.array([[(m1 + m2) * l1**2, coupling], [coupling, m2 * l2**2]])
        stiffness = np.diag([up[0] * (m1 + m2) * g * l1, up[1] * m2 * g * l2])
        assert squares(linear) == pytest.approx(list(linalg.eigh(stiffness, mass, eigvals_only=True)), rel=1e-10)
        assert linear.stability == ("stable" if up == [1.0, 1.0] else "unstable")
        assert linear.equilibrium.exact  # also where y₂ = l₁ − l₂ is zero by chance


def test_one_rod_in_closed_form() -> None:
    system = System(load_scene("cartesian-pendulum"))
    m, length, g, S = (system.q(name) for name in ("m", "l", "g", "S"))
    below, above = linearizations(system)
    for linear, sign in ((below, 1), (above, -1)):
        assert linear.equilibrium.values == {system.q("x"): 0, system.q("y"): sign * length}
        assert linear.equilibrium.reactions == {S: sign * m * g}
        assert sp.simplify(linear.stiffness[0, 0] / linear.mass[0, 0] - sign * g / length) == 0
    assert (below.stability, above.stability) == ("stable", "unstable")


def test_damping_is_projected_as_well() -> None:
    """λ² + (c/m) λ + g/l = 0 of a bob dragged by c v, whichever way the circle is stated."""
    drag = {"kind": "force", "at": "bob", "force": ["-c*dot(x)", "-c*dot(y)"]}
    rod = {"kind": "distance", "name": "rod", "from": "pivot", "to": "bob", "length": "l"}
    expected = sorted(np.roots([1.0, 0.5 / 2.0, 9.81]), key=lambda root: root.imag)
    for constraint in (CIRCLE, rod):
        below = linearizations(System(particle([constraint], drag)))[0]
        assert below.spectrum is not None
        ours = [complex(float(v.real), float(v.imaginary)) for v in below.spectrum.eigenvalues]
        assert sorted(ours, key=lambda root: root.imag) == pytest.approx(expected, rel=1e-12)
        assert below.stability == "stable"


@cache
def four_bar() -> tuple[System, dict[str, float]]:
    system = System(load_scene("four-bar"))
    return system, {symbol.name: float(value) for symbol, value in system.parameter_values.items()}


def height(angles: Any) -> float:
    """V/(μ g) of the links, each with its centre in its middle."""
    _, p = four_bar()
    one, two, three = np.sin(angles)
    middle = p["a"] ** 2 * one / 2 + p["b"] * (p["a"] * one + p["b"] * two / 2)
    return float(middle + p["c"] ** 2 * three / 2)


def loop(angles: Any) -> list[float]:
    _, p = four_bar()
    lengths = [p["a"], p["b"], -p["c"]]
    return [float(np.dot(lengths, np.cos(angles)) - p["s"]), float(np.dot(lengths, np.sin(angles)))]


def test_a_four_bar_rests_where_scipy_finds_minima_of_its_height() -> None:
    system, _ = four_bar()
    ours = [numbers(system, each) for each in linearizations(system) if each.stability == "stable"]
    minima = []
    for start in ([-1.5, -0.3, -1.6], [-1.9, 0.9, 2.4]):
        result = optimize.minimize(
            height, start, method="SLSQP", constraints={"type": "eq", "fun": loop}, options={"ftol": 1e-15}
        )
        assert result.success
        minima.append(result.x)
    for own, theirs in zip(sorted(ours, key=lambda each: -each["phi1"]), minima, strict=True):
        assert [own["phi1"], own["phi2"], own["phi3"]] == pytest.approx(list(theirs), abs=1e-6)


def test_a_four_bar_swings_as_its_height_over_the_crank_says() -> None:
    """ω² = V″(φ₁)/m(φ₁) along the closed loop, by differences; and no other equilibria on either way to close it."""
    system, p = four_bar()
    assert (found(system).count, found(system).complete) == (4, True)
    for linear in linearizations(system):
        at = numbers(system, linear)
        start = [at["phi2"], at["phi3"]]
        path = {k: closed(at["phi1"] + k * 1e-3, start) for k in (-1, 0, 1)}
        curvature = p["mu"] * p["g"] * (height(path[1]) - 2 * height(path[0]) + height(path[-1])) / 1e-6
        slopes = (path[1] - path[-1]) / 2e-3
        assert squares(linear)[0] == pytest.approx(curvature / inertia(path[0], slopes), rel=1e-4)


def closed(crank: float, near: list[float]) -> Any:
    found, *_ = optimize.fsolve(lambda rest: loop([crank, *rest]), near, full_output=True, xtol=1e-14)
    return np.array([crank, *found])


def inertia(angles: Any, slopes: Any) -> float:
    """Σ m v² + J ω² for φ̇₁ = 1, each link a uniform rod."""
    _, p = four_bar()
    a, b, c, mu = (p[name] for name in ("a", "b", "c", "mu"))

    def along(angle: float, rate: float) -> Any:
        return rate * np.array([-math.sin(angle), math.cos(angle)])

    pin = a * along(angles[0], slopes[0])
    centre = pin + b / 2 * along(angles[1], slopes[1])
    turning = mu * (b**3 / 12 * slopes[1] ** 2 + a**3 / 3 * slopes[0] ** 2 + c**3 / 3 * slopes[2] ** 2)
    return float(mu * b * (centre @ centre) + turning)


def test_a_parallelogram_has_places_without_unique_multipliers() -> None:
    """Flat, its loops depend on one another: that is said. Hanging, ω² = g (a + b)/(⅔ a² + a b) by the one angle."""
    system = System(with_values("four-bar", a=0.5, b=0.9, c=0.5, s=0.9))
    assert (found(system).complete, found(system).left_out) == (False, "singular")
    hanging = [each for each in linearizations(system) if abs(numbers(system, each)["phi1"] + math.pi / 2) < 1e-9]
    (below,) = hanging
    assert squares(below)[0] == pytest.approx(9.81 * (0.5 + 0.9) / (2 / 3 * 0.5**2 + 0.5 * 0.9), rel=1e-12)


def test_a_level_line_is_a_family_of_equilibria() -> None:
    line = {"kind": "equation", "name": "line", "equation": "y = l"}
    (each,) = linearizations(System(particle([line])))
    assert each.equilibrium.free == ("x",)
    assert (each.stability, each.verdict.kind) == ("stable", "family")


@pytest.mark.parametrize("lengths", [(1.0, 1.0, 1.0, 1.0), (0.5, 0.9, 0.5, 0.9), (0.3, 0.9, 0.6, 1.0)])
def test_bars_without_weight_rest_anywhere(lengths: tuple[float, ...]) -> None:
    """Where a parallelogram is flat its branches cross: that is one of its positions, no isolated one."""
    document: dict[str, Any] = write_scene(load_scene("four-bar"))
    values = dict(zip("abcs", lengths, strict=True))
    wide = [{**p, "min": 0.01, "max": 5.0, "value": values.get(p["name"], 1.0)} for p in document["parameters"]]
    labels = {name: label for name, label in document["labels"].items() if name != "weight"}
    starts = [{**c, "min": -4.0, "max": 4.0, "value": 0.7} for c in document["coordinates"]]
    bars = read_scene({**document, "coordinates": starts, "parameters": wide, "loads": [], "labels": labels})
    rests = linearizations(System(bars))
    assert [(each.stability, each.verdict.kind, len(each.equilibrium.free)) for each in rests] == [
        ("stable", "family", 1)
    ]


def test_a_slope_has_no_rest() -> None:
    line = {"kind": "equation", "name": "line", "equation": "y = x"}
    steps = model_steps(particle([line]))
    assert steps["equilibrium-condition"].about["outcome"] == "constrained-none"
    assert "equilibrium:1" not in steps


def test_answers_have_multipliers_and_shapes_in_all_coordinates() -> None:
    answer = derive_request({"scene": "slider-crank", "lang": "en"})["result"]
    stable = answer["equilibria"][0]  # type: ignore[index]
    assert {name: each["plain"] for name, each in stable["multipliers"].items()} == {"N": "0", "H": "-r*k"}
    (mode,) = stable["modes"]
    assert set(mode["shape"]) == {"phi", "psi", "x"}
    assert max(map(abs, mode["shape"].values())) == 1.0


def test_a_stiffness_without_the_reactions_is_not_verified(monkeypatch: pytest.MonkeyPatch) -> None:
    """The classic mistake: K₀ = −∂f/∂q, as if reactions did not turn with the constraint."""
    monkeypatch.setattr(tangent, "balance", forces_at_rest)
    steps = model_steps(load_scene("cartesian-pendulum"))
    assert not steps["linearization:1"].verified
    monkeypatch.undo()
    assert model_steps(load_scene("cartesian-pendulum"))["linearization:1"].verified


def test_a_kink_on_a_circle_may_be_at_rest_as_well() -> None:
    """V = −m g y + 2 m g |x − l/2|: at x = l/2 the force jumps over balance, which the search says it leaves out."""
    kink = {"kind": "potential", "energy": "2*m*g*abs(x - l/2)"}
    system = System(particle([CIRCLE], kink))
    assert (found(system).complete, found(system).left_out) == (False, "kinks")
    assert model_steps(particle([CIRCLE], kink))["equilibrium-search"].about["outcome"] == "kinks"
