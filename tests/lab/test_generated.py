"""Scenes drawn at random through labs of nonlinear dynamics: each runs, and its mirror image has mirrored answers."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest
from tests.simulation.scenes import document

from deltaq.lab.library import get_experiment
from deltaq.vocabulary import Status

SQUARE = {"x_from": -1.5, "x_to": 1.5, "y_from": -1.5, "y_to": 1.5}


def drawn(seed: int, *, is_mirrored: bool) -> tuple[dict[str, Any], dict[str, float]]:
    """A particle in a well of one or two places that leans to a side, driven and damped, or its mirror image."""
    random, sign = np.random.default_rng(seed), -1.0 if is_mirrored else 1.0
    values = {"m": 1.0, "k": random.uniform(-1, 1), "b": random.uniform(0.5, 2), "c": random.uniform(0.2, 0.6)}
    values |= {"a": sign * random.uniform(-0.3, 0.3), "F": sign * random.uniform(0.1, 0.6)}
    values |= {"omega": random.uniform(0.7, 1.6)}
    well = {"kind": "potential", "name": "well", "energy": "k*x^2/2 + b*x^4/4 + a*x"}
    push = {"kind": "force", "name": "push", "at": "p", "force": ["F*cos(omega*t)", "0"]}
    drag = {"kind": "dissipation", "name": "drag", "function": "c*dot(x)^2/2"}
    start = {"x": (sign * random.uniform(0.2, 1.0), 0.0)}
    return document(start, values, {"p": ("m", ["x", "0"])}, [well, push, drag]), values


def both(lab: str, seed: int, **fields: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """The results of a scene and of its mirror image."""
    found = []
    for is_mirrored in (False, True):
        scene, _ = drawn(seed, is_mirrored=is_mirrored)
        *_, last = get_experiment(lab).run({"scene": scene, **fields})
        found.append(last.result)
    return found[0], found[1]  # type: ignore[return-value]


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", range(6))
def test_bifurcations_of_the_mirror_image_are_at_the_same_values(seed: int) -> None:
    _, values = drawn(seed, is_mirrored=False)
    sweep = {"parameter": "c", "from": 0.8 * values["c"], "to": 1.5 * values["c"], "count": 8}
    one, other = both("bifurcation", seed, sweep=sweep, crossings=8, skip=40)
    for way in ("up", "down"):
        for here, there in zip(one[way], other[way], strict=True):
            assert here["status"] in get_args(Status)
            assert (here["value"], here["folds"], here["status"]) == (there["value"], there["folds"], there["status"])
            np.testing.assert_allclose(here["seen"], np.negative(there["seen"]), atol=1e-6)
    places = [sorted((each["kind"], each["value"]) for each in found["bifurcations"]) for found in (one, other)]
    assert [kind for kind, _ in places[0]] == [kind for kind, _ in places[1]]
    np.testing.assert_allclose([at for _, at in places[0]], [at for _, at in places[1]], atol=1e-8)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", range(6))
def test_the_uncertainty_of_the_mirror_image_is_the_same(seed: int) -> None:
    one, other = both("uncertainty", seed, t_end=4.0, runs=40, tolerances={"x": 1e-3, "k": 1e-3})
    (here,), (there,) = one["coordinates"], other["coordinates"]
    assert one["statuses"] == other["statuses"] == {"ok": 40}
    np.testing.assert_allclose(here["linear"], there["linear"], rtol=1e-5)
    np.testing.assert_allclose(here["reference"], np.negative(there["reference"]), atol=2e-6)
    assert np.isfinite(here["deviation"]).all()


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", range(6))
def test_the_basins_of_the_mirror_image_are_mirrored(seed: int) -> None:
    one, other = both("basins", seed, **SQUARE, t_end=60.0, count=8, pairs=0)
    shares = []
    for found in (one, other):
        assert sum(each["share"] for each in found["attractors"]) == pytest.approx(
            1.0 - found["unsettled"] - found["unsure"], abs=1e-4
        )
        places = [each["state"]["x"]["value"] for each in found["attractors"]]
        shares.append(np.array([*places, np.nan])[np.array(found["basins"])])
    known = np.isfinite(shares[0]) & np.isfinite(shares[1][::-1, ::-1])
    np.testing.assert_allclose(shares[0][known], -shares[1][::-1, ::-1][known], atol=1e-4)
    assert known.mean() > 0.8 or one["unsettled"] > 0.1
