"""Each method is what its file says: coefficients, order, stability."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import DOP853, RK23, RK45
from scipy.integrate._ivp import dop853_coefficients as published
from tests.simulation.references import simulated, trusted
from tests.simulation.scenes import get_scene, oscillator

from deltaq.errors import Problem, UnknownNameError
from deltaq.packages import modules_of
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.method import Method, Newmark, Partitioned, Tableau
from deltaq.simulation.stability import growth, real_stability
from deltaq.simulation.weights import explicit_weights

METHODS = [pytest.param(get_method(identifier), id=identifier) for identifier in method_ids()]
EXPLICIT = [case for case in METHODS if isinstance(case.values[0].scheme, Tableau)]
IMPLICIT = [case for case in METHODS if isinstance(case.values[0].scheme, Partitioned)]


# one tableau for everything
PLAIN = {case.values[0].id for case in EXPLICIT} | {"implicit-midpoint", "gauss-4", "gauss-6", "radau-5"}


def test_ids_by_rising_order() -> None:
    by_order = {
        1: ("explicit-euler", "symplectic-euler"),
        2: ("heun", "implicit-midpoint", "newmark", "stormer-verlet", "variational-midpoint"),
        3: ("bogacki-shampine-32",),
        4: ("gauss-4", "rk4"),
        5: ("dormand-prince-54", "radau-5"),
        6: ("gauss-6",),
        8: ("dop853", "taylor"),
    }
    expected = [identifier for ids in by_order.values() for identifier in ids]
    assert [identifier for identifier in method_ids() if identifier in expected] == expected
    orders = [get_method(identifier).order for identifier in method_ids()]
    assert orders == sorted(orders)


def test_unknown_method_names_the_nearest() -> None:
    with pytest.raises(UnknownNameError) as caught:
        get_method("dopri853")
    parameters = {"name": "dopri853", "suggestion": "dop853", "known": ", ".join(method_ids())}
    assert caught.value.problems == (Problem("unknown-method", "/method", parameters=parameters),)


@pytest.mark.parametrize("module", modules_of("deltaq.simulation.methods"), ids=lambda module: module.__name__)
def test_docstrings_say_what_is_known(module: object) -> None:
    text = module.__doc__ or ""
    assert all(word in text for word in ("rder", "stage", "tab", "symplectic", "Source:")), text


@pytest.mark.parametrize("method", EXPLICIT)
def test_each_stage_starts_where_its_weights_say(method: Method) -> None:
    t = method.scheme
    for row, c in zip((*t.a, *t.extra_a), (*t.c, *t.extra_c), strict=True):
        assert abs(sum(row) - c) < Fraction(1, 10**25)


def full(rows: tuple[tuple[Fraction, ...], ...], width: int) -> np.ndarray:
    matrix = np.full((len(rows), width), Fraction(0))
    for i, row in enumerate(rows):
        matrix[i, : len(row)] = row
    return matrix


@pytest.mark.parametrize("method", IMPLICIT)
def test_each_implicit_stage_lies_where_its_weights_say(method: Method) -> None:
    t = method.scheme
    assert all(abs(sum(row) - c) < Fraction(1, 10**25) for row, c in zip(t.a, t.c, strict=True))


@pytest.mark.parametrize("method", [case for case in METHODS if case.values[0].id in PLAIN])
def test_order_conditions(method: Method) -> None:
    """Of rooted trees up to order 5 (Butcher), and of quadrature up to the order stated, in exact arithmetic."""
    t = method.scheme
    a, b, c = full(t.a, t.stages), np.array(t.b), np.array(t.c)
    conditions = [(k, b @ c ** (k - 1), Fraction(1, k)) for k in range(1, method.order + 1)]
    conditions += [
        (3, b @ a @ c, Fraction(1, 6)),
        (4, (b * c) @ a @ c, Fraction(1, 8)),
        (4, b @ a @ c**2, Fraction(1, 12)),
        (4, b @ a @ a @ c, Fraction(1, 24)),
        (5, (b * c**2) @ a @ c, Fraction(1, 10)),
        (5, b @ (a @ c) ** 2, Fraction(1, 20)),
        (5, (b * c) @ a @ c**2, Fraction(1, 15)),
        (5, b @ a @ c**3, Fraction(1, 20)),
        (5, (b * c) @ a @ a @ c, Fraction(1, 30)),
        (5, b @ a @ (c * (a @ c)), Fraction(1, 40)),
        (5, b @ a @ a @ c**2, Fraction(1, 60)),
        (5, b @ a @ a @ a @ c, Fraction(1, 120)),
    ]
    for order, found, wanted in conditions:
        assert order > method.order or abs(found - wanted) < Fraction(1, 10**24), (order, float(found), wanted)


@pytest.mark.parametrize("method", EXPLICIT)
def test_error_weights_vanish_on_constants(method: Method) -> None:
    assert all(abs(sum(row)) < Fraction(1, 10**25) for row in method.scheme.error)


@pytest.mark.parametrize(
    ("identifier", "solver"), [("bogacki-shampine-32", RK23), ("dormand-prince-54", RK45), ("dop853", DOP853)]
)
def test_coefficients_are_the_published_ones(identifier: str, solver: type) -> None:
    weights, stages = explicit_weights(get_method(identifier).scheme), solver.n_stages
    width = solver.A.shape[1]
    np.testing.assert_allclose(weights.a[:, :width], solver.A[1:stages, :stages], rtol=1e-15)
    np.testing.assert_allclose(weights.b, solver.B, rtol=1e-15)
    np.testing.assert_allclose(weights.c, solver.C[1:stages], rtol=1e-15)
    if identifier != "dop853":
        np.testing.assert_allclose(np.abs(weights.error[0]), np.abs(solver.E), rtol=1e-14)


def test_dop853_error_and_extension_are_the_published_ones() -> None:
    weights = explicit_weights(get_method("dop853").scheme)
    np.testing.assert_allclose(weights.error, [published.E5, published.E3], rtol=1e-15, atol=1e-16)
    np.testing.assert_allclose(weights.dense, published.D, rtol=1e-15)
    np.testing.assert_allclose(weights.extra_a, published.A[13:16], rtol=1e-15)
    np.testing.assert_allclose(weights.extra_c, published.C[13:16], rtol=1e-15)


STEPS = {
    "explicit-euler": (200, 1600),
    "heun": (100, 800),
    "bogacki-shampine-32": (100, 800),
    "rk4": (200, 1600),
    "dormand-prince-54": (40, 240),
    "dop853": (8, 24),
    "symplectic-euler": (400, 3200),
    "stormer-verlet": (200, 1600),
    "implicit-midpoint": (100, 800),
    "variational-midpoint": (100, 800),
    "newmark": (100, 800),
    "gauss-4": (60, 240),
    "gauss-6": (40, 120),
    "radau-5": (60, 240),
    "taylor": (10, 24),
}


FASTER = {"wild-double-pendulum": 2}
NEARER = {("wild-double-pendulum", "taylor"): (110, 124, 141, 160)}  # where a series converges well


@pytest.mark.parametrize("identifier", method_ids())
@pytest.mark.parametrize("name", ["wild-double-pendulum", "driven-by-everything"])
def test_error_falls_with_the_order_stated(identifier: str, name: str) -> None:
    """Slope of log error over log step on a nonlinear and a driven scene, at the end of one second."""
    usual = FASTER.get(name, 1) * np.geomspace(*STEPS[identifier], 4).astype(int)
    scene, counts = get_scene(name), NEARER.get((name, identifier), usual)
    end = trusted(scene, 1.0, 2).values[-1]
    errors = [np.abs(simulated(scene, identifier, 1.0, 2, step=1.0 / n).values[-1] - end).max() for n in counts]
    slope = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert -0.45 < slope - get_method(identifier).order < 0.95, errors


@pytest.mark.parametrize(
    ("identifier", "order"),
    [("rk4", 4), ("dormand-prince-54", 5), ("dop853", 7), ("bogacki-shampine-32", 3), ("gauss-4", 4), ("gauss-6", 6)],
)
def test_samples_between_steps_are_as_good_as_the_extension(identifier: str, order: int) -> None:
    """The largest error over the samples inside the steps falls with the order of the extension, of rates as well."""
    finer = 4 if identifier == "gauss-6" else 1
    scene, counts = get_scene("wild-double-pendulum"), finer * np.geomspace(*STEPS[identifier], 4).astype(int)
    reference = trusted(scene, 1.0, 1018)
    runs = [simulated(scene, identifier, 1.0, 1018, step=1 / n) for n in counts]
    for part in ("values", "rates"):
        errors = [np.abs(getattr(run, part) - getattr(reference, part)).max() for run in runs]
        slope = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
        assert slope > order - 0.5, (part, errors)


@pytest.mark.parametrize(
    ("identifier", "real", "imaginary"),
    [
        ("explicit-euler", 2.0, 0.0),
        ("heun", 2.0, 0.0),
        ("bogacki-shampine-32", 2.513, 1.732),
        ("rk4", 2.785, 2.828),
        ("dormand-prince-54", 3.307, 1.0),
        ("dop853", 6.39, 5.96),
        ("taylor", 4.31, 3.39),
    ],
)
def test_stability_intervals_are_those_of_the_docstrings(identifier: str, real: float, imaginary: float) -> None:
    t = get_method(identifier).scheme
    assert growth(t, -real + 0.01) <= 1 < growth(t, -real - 0.01)
    assert growth(t, 1j * (imaginary + 0.02)) > 1
    assert growth(t, 1j * (imaginary - 0.01)) <= 1 + 1e-12 or imaginary == 0.0
    assert 0.97 * real < real_stability(t) < real


@pytest.mark.parametrize("identifier", ["implicit-midpoint", "variational-midpoint", "gauss-4", "gauss-6", "radau-5"])
def test_implicit_methods_are_a_stable(identifier: str) -> None:
    t, z = get_method(identifier).scheme, np.array([-1e-3, -1.0, -1e3, -1 + 5j, -1e-2 + 100j])
    assert all(growth(t, place) < 1 for place in z)
    on_axis = [growth(t, 1j * y) for y in (0.1, 1.0, 10.0, 1e3)]
    if get_method(identifier).is_symplectic:
        np.testing.assert_allclose(on_axis, 1.0, rtol=1e-12)
    else:
        assert growth(t, -1e9) < 1e-6  # L-stable


def test_newmark_is_average_acceleration() -> None:
    scheme = get_method("newmark").scheme
    assert isinstance(scheme, Newmark)
    assert (float(scheme.beta), float(scheme.gamma)) == (0.25, 0.5)


@pytest.mark.parametrize("identifier", method_ids())
@pytest.mark.parametrize("z", [0.3 + 0.2j, -0.2 + 0.9j, -0.05 + 1.6j, -1.2 + 0.4j, 0.1 + 2.5j])
def test_growth_is_what_a_step_does(identifier: str, z: complex) -> None:
    """The matrix of one step h = 1 of ẍ = 2 Re(z) ẋ − |z|² x, from two runs, has this spectral radius."""
    force = f"{2 * z.real!r}*dot(x) - {abs(z) ** 2!r}*x"
    columns = []
    for x, u in ((1.0, 0.0), (0.0, 1.0)):
        run = simulated(oscillator(f"m*({force})", x=x, u=u), identifier, 1.0, 2, step=1.0)
        columns.append([run.values[-1, 0], run.rates[-1, 0]])
    radius = np.abs(np.linalg.eigvals(np.array(columns).T)).max()
    assert growth(get_method(identifier).scheme, np.complex128(z)) == pytest.approx(radius, rel=1e-7)
