"""Small motions: frequencies, shapes and damping, against what textbooks state."""

from __future__ import annotations

import math

import pytest
import sympy as sp
from tests.derivation.model_scenes import model_steps, particle, spherical_pendulum
from tests.derivation.scenes import chain

from deltaq.derivation.linearization import linearizations
from deltaq.derivation.modes import symbolic_modes
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene
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
    assert steps["equilibrium:1"].about["outcome"] == "singular"
    assert "linearization:1" not in steps


def test_a_chain_of_twelve_has_its_lowest_frequency() -> None:
    lowest = linearizations(System(chain(12)))[0]
    assert lowest.spectrum is not None
    assert lowest.stability == "stable"
    # The hanging rope of length n l: ω₁ ≈ 1.2024 √(g/(n l)), with the first zero of J₀ halved.
    assert float(lowest.spectrum.frequencies[0]) == pytest.approx(1.2024 / math.sqrt(12), rel=0.03)
