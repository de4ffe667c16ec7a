"""Complex modes of damped and follower-loaded systems, against the quadratic eigenvalue problem solved by SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb
from scipy.linalg import eig
from tests.derivation.model_scenes import model_steps, particle

from deltaq.derivation import spectrum
from deltaq.derivation.linearization import Linearization, linearizations
from deltaq.derivation.spectrum import ComplexMode
from deltaq.derivation.system import System
from deltaq.mechanics.scene import Scene

PARAMETERS = {"k": 10.0, "c": 0.4, "F": 3.0}


def pushed(*force: str) -> Scene:
    load = {"kind": "force", "name": "push", "at": "bob", "force": list(force)}
    return particle(["x", "y"], PARAMETERS, ["x", "y"], load)


SCENES = [
    pytest.param(pushed("-2*k*x + k*y - c*dot(x)", "k*x - k*y"), id="one damper"),
    pytest.param(pushed("-k*x - 9*c*k*dot(x)", "-k*y - c*dot(y)"), id="overdamped beside underdamped"),
    pytest.param(pushed("-k*x + c*dot(y)", "-2*k*y - c*dot(x)"), id="gyroscopic"),
    pytest.param(pushed("-k*x + F*y", "-k*y - F*x"), id="circulatory"),
    pytest.param(pushed("-c*dot(x)", "-k*y"), id="free to drift"),
]


def matrices(linear: Linearization, scene: Scene) -> tuple[np.ndarray, ...]:
    values = System(scene).parameter_values
    parts = (linear.mass, linear.damping, linear.stiffness)
    return tuple(np.array(part.xreplace(dict(values)).tolist(), dtype=float) for part in parts)


def shape(mode: ComplexMode) -> np.ndarray:
    return np.array([complex(float(u), float(w)) for u, w in zip(mode.real, mode.imaginary, strict=True)])


def root(mode: ComplexMode) -> complex:
    return complex(float(mode.eigenvalue.real), float(mode.eigenvalue.imaginary))


def by_parts(value: complex) -> tuple[float, float]:
    return round(abs(value.imag), 6), value.real


@pytest.mark.parametrize("scene", SCENES)
def test_modes_of_the_quadratic_eigenvalue_problem(scene: Scene) -> None:
    linear = linearizations(System(scene))[0]
    assert linear.spectrum is not None
    M, D, K = matrices(linear, scene)
    zero, one = np.zeros_like(M), np.eye(len(M))
    expected = eig(np.block([[zero, one], [-K, -D]]), np.block([[one, zero], [zero, M]]), right=False)
    found = [root(mode) for mode in linear.spectrum.complex_modes]
    upper = [value for value in expected if value.imag > -1e-9]
    np.testing.assert_allclose(sorted(found, key=by_parts), sorted(upper, key=by_parts), atol=1e-9)
    for mode in linear.spectrum.complex_modes:
        law = root(mode) ** 2 * M + root(mode) * D + K
        assert np.abs(law @ shape(mode)).max() < 1e-12
        assert np.abs(shape(mode)).max() == pytest.approx(1.0)


@pytest.mark.parametrize("scene", SCENES)
def test_every_step_is_verified(scene: Scene) -> None:
    steps = model_steps(scene)
    assert steps["complex-mode-shapes:1"].verified
    assert [name for name, step in steps.items() if not step.verified] == []


def test_a_wrong_shape_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    right = spectrum.kernel
    monkeypatch.setattr(spectrum, "kernel", lambda *law: [[x[0] * (1 + arb(2) ** -60), *x[1:]] for x in right(*law)])
    steps = model_steps(pushed("-2*k*x + k*y - c*dot(x)", "k*x - k*y"))
    assert not steps["complex-mode-shapes:1"].verified
    assert steps["linearization:1"].verified


def test_a_double_root_keeps_its_one_shape() -> None:
    """Critical damping: x and y apart, the root of x is double and has one shape only."""
    scene = pushed("-4*x - 4*dot(x)", "-k*y - c*dot(y)")
    (linear,) = linearizations(System(scene))
    assert linear.spectrum is not None
    real = [mode for mode in linear.spectrum.complex_modes if mode.eigenvalue.imaginary == 0]
    assert [float(mode.eigenvalue.real) for mode in real] == pytest.approx([-2.0])
    np.testing.assert_allclose(shape(real[0]), [1, 0], atol=1e-30)
