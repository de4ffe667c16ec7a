"""Small motions: frequencies, shapes and damping, against what textbooks state."""

from __future__ import annotations

import math
import random

import pytest
import sympy as sp
from tests.derivation.model_scenes import model_steps, particle, spherical_pendulum
from tests.derivation.scenes import chain

from deltaq.derivation.linearization import linearizations
from deltaq.derivation.modes import symbolic_modes
from deltaq.derivation.system import System
from deltaq.mechanics.changes import change
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene


def frequencies(scene: Scene) -> list[list[str]]:
    """ω² of each mode about every equilibrium, as text."""
    system = System(scene)
    modes = [symbolic_modes(system, each) for each in linearizations(system)]
    return [[str(sp.expand(square)) for square in each.squares] for each in modes if each]


def test_frequencies_in_the_parameters() -> None:
    assert frequencies(load_scene("pendulum")) == [["g/l"], ["-g/l"]]
    assert frequencies(chain(2))[0] == ["-sqrt(2)*g/l + 2*g/l", "sqrt(2)*g/l + 2*g/l"]
    assert frequencies(load_scene("base-pendulum"))[0] == ["g/l", "k/m"]


def test_mode_shapes_of_the_double_pendulum() -> None:
    system = System(chain(2))
    modes = symbolic_modes(system, linearizations(system)[0])
    assert modes is not None
    assert [list(shape) for shape in modes.shapes] == [[1, sp.sqrt(2)], [1, -sp.sqrt(2)]]


@pytest.mark.parametrize("n", [2, 3, 5])
def test_numbers_agree_with_the_characteristic_polynomial(n: int) -> None:
    """The eigenvalues against the zeros of det(K − ω²M), which SymPy finds."""
    system = System(chain(n))
    lowest = linearizations(system)[0]
    assert lowest.spectrum is not None
    omega = sp.Symbol("x")
    numbers = dict(system.parameter_values)
    matrix = sp.Matrix((lowest.stiffness - omega * lowest.mass).xreplace(numbers))
    zeros = sorted(float(z) for z in sp.Poly(matrix.det(method="berkowitz"), omega).nroots(n=20))
    assert [float(mode.square) for mode in lowest.spectrum.modes] == pytest.approx(zeros, rel=1e-12)
    assert [float(f) for f in lowest.spectrum.frequencies] == pytest.approx([math.sqrt(z) for z in zeros], rel=1e-12)


def test_damped_frequency() -> None:
    force = {"kind": "force", "at": "bob", "force": ["-c*dot(x)-k*x", "0"]}
    (each,) = linearizations(System(particle(["x"], {"k": 2.0, "c": 0.2}, ["x", "0"], force)))
    assert each.spectrum is not None
    (frequency,) = each.spectrum.frequencies
    assert float(frequency) == pytest.approx(math.sqrt(2 - 0.01), rel=1e-14)
    assert [float(value.real) for value in each.spectrum.eigenvalues] == pytest.approx([-0.1, -0.1])


@pytest.mark.parametrize("damping", [1.0, 2.0, 3.0], ids=["under", "critical", "over"])
def test_every_damping_is_verified(damping: float) -> None:
    force = {"kind": "force", "at": "bob", "force": ["-c*dot(x)-k*x", "0"]}
    steps = model_steps(particle(["x"], {"k": 1.0, "c": damping}, ["x", "0"], force))
    assert [name for name, step in steps.items() if not step.verified] == []


def test_equal_frequencies_have_as_many_shapes() -> None:
    spring = {"kind": "potential", "energy": "k*(x^2 + y^2)/2"}
    (each,) = linearizations(System(particle(["x", "y"], {"k": 4.0}, ["x", "y"], spring)))
    assert each.spectrum is not None
    assert [tuple(map(float, mode.shape)) for mode in each.spectrum.modes] == [(1.0, 0.0), (0.0, 1.0)]
    assert [float(frequency) for frequency in each.spectrum.frequencies] == [2.0, 2.0]


def test_singular_coordinates_are_not_linearized() -> None:
    steps = model_steps(spherical_pendulum())
    assert steps["equilibrium:1"].about["outcome"] == "singular-stable"  # where it hangs, the azimuth is none
    assert "linearization:1" not in steps


def test_a_top_that_hangs_may_stand_at_any_angle_about_its_axis() -> None:
    about = model_steps(load_scene("heavy-top"))["equilibrium:1"].about
    assert (about["outcome"], about["coordinate"]) == ("singular-stable-in-the-others", "psi, phi")


@pytest.mark.parametrize(
    ("energy", "stability", "is_linearized"),
    [
        pytest.param("k*max(x, 0)^2", "undecided", False, id="flat on one side"),
        pytest.param("k*x^2*step(x)", "undecided", False, id="flat on one side, by a step"),
        pytest.param("k*x^2*(1 + step(x))", "stable", False, id="stiffer on one side"),
        pytest.param("k*x^2*sign(x)", "undecided", False, id="falling on one side"),
        pytest.param("k*x^2*(1 + abs(x))", "stable", True, id="a bend of the slope alone"),
        pytest.param("k*x^2 + k*max(x - 1, 0)^2", "stable", True, id="a bend elsewhere"),
    ],
)
def test_a_force_that_bends_has_no_stiffness_there(energy: str, stability: str, is_linearized: bool) -> None:
    """K would be 2 k on one side and another on the other; a mean of them is none."""
    found = linearizations(System(particle(["x"], {"k": 1.0}, ["x", "0"], {"kind": "potential", "energy": energy})))
    (there,) = [each for each in found if all(abs(float(value)) < 1e-9 for value in each.equilibrium.values.values())]
    assert (there.stability, there.spectrum is not None) == (stability, is_linearized)


def test_a_chain_of_twelve_has_its_lowest_frequency() -> None:
    lowest = linearizations(System(chain(12)))[0]
    assert lowest.spectrum is not None
    assert lowest.stability == "stable"
    # The hanging rope of length n l: ω₁ ≈ 1.2024 √(g/(n l)), with the first zero of J₀ halved.
    assert float(lowest.spectrum.frequencies[0]) == pytest.approx(1.2024 / math.sqrt(12), rel=0.03)


def potential(energy: str) -> dict[str, str]:
    return {"kind": "potential", "energy": energy}


def force(*components: str) -> dict[str, object]:
    return {"kind": "force", "at": "bob", "force": list(components)}


@pytest.mark.parametrize(
    ("loads", "outcome"),
    [
        pytest.param([potential("x^4")], "stable-by-derivative", id="quartic well"),
        pytest.param([potential("x^6")], "stable-by-derivative", id="well of sixth order"),
        pytest.param(
            [potential("cosh(x*c*2)*m - m*x^2/2")],
            "stable-by-derivative",
            id="well that is quartic but does not look it",
        ),
        pytest.param([potential("-x^4")], "unstable-by-derivative", id="quartic hill"),
        pytest.param([potential("x^3")], "unstable-by-derivative", id="saddle of a cubic"),
        pytest.param([potential("x^4"), force("-c*dot(x)", "0")], "stable-by-derivative", id="quartic well, damped"),
        pytest.param([potential("x^3"), force("-c*dot(x)", "0")], "unstable-by-derivative", id="cubic, damped"),
        pytest.param([potential("x^4"), force("c*dot(x)", "0")], "unstable", id="quartic well, fed"),
        pytest.param([potential("x^2"), force("-c*sign(dot(x))", "0")], "band-stable", id="dry friction"),
        pytest.param([potential("x^2"), force("-c*abs(dot(x))*dot(x)", "0")], "stable", id="drag of the square"),
    ],
)
def test_verdicts_in_one_coordinate(loads: list[dict[str, object]], outcome: str) -> None:
    """By Lagrange, Dirichlet and Chetaev; what falls outside of them stays open, and for the reason that is given."""
    steps = model_steps(particle(["x"], {"c": 0.5}, ["x", "0"], *loads))
    assert steps["equilibrium:1"].about["outcome"] == outcome
    assert [name for name, step in steps.items() if not step.verified] == []


def test_a_pendulum_in_space_falls_from_its_highest_point() -> None:
    verdicts = {str(each.equilibrium.values): each.stability for each in linearizations(System(spherical_pendulum()))}
    assert verdicts == {"{theta: 0}": "stable", "{theta: pi}": "unstable"}


def test_drag_in_the_plane_is_nothing_to_first_order() -> None:
    """|v| v has the slope 0 at rest, though its derivative there reads 0/0."""
    speed = "sqrt(dot(x)^2 + dot(y)^2)"
    drag = force(f"-c*{speed}*dot(x) - b*dot(x)", f"-c*{speed}*dot(y)")
    scene = particle(["x", "y"], {"c": 0.5, "b": 0.25}, ["x", "y"], potential("2*(x^2 + y^2)"), drag)
    (each,) = linearizations(System(scene))
    assert each.is_smooth
    damping = each.damping.xreplace(dict(System(scene).parameter_values))
    assert [[float(entry) for entry in row] for row in damping.tolist()] == [[0.25, 0.0], [0.0, 0.0]]


def restitutions(scene: Scene) -> set[str]:
    """Parameters that are coefficients of restitution, and 1 at most."""
    return {name for event in scene.events if event.restitution for name in event.restitution.names}


@pytest.mark.one_in(3)
@pytest.mark.parametrize("identifier", scene_ids())
def test_as_many_modes_as_coordinates_at_any_value(identifier: str) -> None:
    """Wherever M, K are symmetric, M is regular and no rate enters: K − ω²M is small there by rounding alone."""
    scene, draw = load_scene(identifier), random.Random(identifier)
    counts = []
    for _ in range(3):
        drawn = {p.name: p.value * draw.uniform(0.2, 3.0) for p in scene.parameters}
        drawn |= {name: min(drawn[name], 1.0) for name in restitutions(scene) & drawn.keys()}
        changed = change(scene, parameters=drawn)
        for each in linearizations(System(changed)):
            symmetric = (each.stiffness - each.stiffness.T).is_zero_matrix
            if each.spectrum is not None and not each.is_damped and symmetric:
                counts.append(len(each.spectrum.modes) - changed.degrees_of_freedom)
    assert set(counts) <= {0}
