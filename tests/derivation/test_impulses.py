"""The slope of a step is an impulse: where a continuous potential switches it is zero, and stands in no formula."""

from __future__ import annotations

import json
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from deltaq.handout.service import export_request
from deltaq.language.floats import evaluate
from deltaq.mechanics.document import read_scene
from deltaq.narration.derive import derive_request

# Continuous potentials, as U with rates in them.
ENERGIES = [
    "k*x^2*step(x)",
    "k*x*step(x) + k*x^2",
    "k*max(x, 0)^2",
    "k*x*sign(x) + k*x^2",
    "k*x^3*sign(x) + k*max(x, 1)*x",
    "k*x^2*y*step(x) + k*y^2",
    "k*x*abs(x)*(x - y)*step(x - y)",
    "k*(1 + x)*step(x) - k*step(x)",
    "k*sin(x)*sign(sin(x))",
    "k*sin(2*x)*cos(x)*step(cos(x))",
    "k*(exp(x) - 1)*step(x)",
    "k*(x^2 + y^2 - 1)*step(x^2 + y^2 - 1)",
    "k*x*y*step(x*y)",
    "k*(y - sin(x))*step(y - sin(x))",
    "k*(x - t)^2*step(x - t)",
    "k*x^2/2*(1 - step(x - 3)) + (3*k*x - 4.5*k)*step(x - 3)",
    "2*step(x) + k*(x - 1)*step(x)",  # with k = 2
    "k*x*step(x)*dot(y)",
    "k*x^2*step(x) + k*x^2*step(x)*dot(y)",
]
FORCES = [["-k*sign(x)", "0"], ["k*sign(y)", "0"], ["-k*sign(x - y)", "k*sign(x - y)"], ["k*step(x)*y", "0"]]
PLACES = ((0.3, 0.2), (-0.4, 0.5), (0.05, -0.7), (1.1, 0.9), (3.4, -0.3))


def scene(load: dict[str, object]) -> dict[str, Any]:
    """A particle of mass 1 in the plane, with one load."""
    return {
        "format": 1,
        "id": "impulses",
        "title": {"en": "Impulses"},
        "coordinates": [{"name": "x", "value": -0.7}, {"name": "y", "value": 0.2}],
        "parameters": [{"name": "k", "value": 2.0}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "1", "position": ["x", "y"]}],
        "loads": [load],
    }


def potential(energy: str) -> dict[str, Any]:
    return scene({"kind": "generalized-potential" if "dot" in energy else "potential", "energy": energy})


ASKED = [pytest.param(potential(energy), id=energy) for energy in ENERGIES]
ASKED += [pytest.param(scene({"kind": "force", "at": "bob", "force": force}), id=str(force)) for force in FORCES]
ASKED += [
    pytest.param(
        {
            **scene({"kind": "gravity", "acceleration": ["0", "-k"]}),
            "bodies": [{"name": "bob", "kind": "particle", "mass": "1", "position": ["x", "y + x^2*step(x)"]}],
        },
        id="a bend in a position",
    )
]


@pytest.mark.parametrize("asked", ASKED)
def test_no_impulse_stands_in_a_derivation(asked: dict[str, Any]) -> None:
    answer = derive_request({"scene": asked, "lang": "en"})
    steps = [step for chapter in answer["chapters"] for step in chapter["steps"]]
    assert "Dirac" not in json.dumps(answer)
    assert [step["id"] for step in steps if not step["verified"]] == []


@pytest.mark.parametrize("form", ["markdown", "latex", "python"])
@pytest.mark.parametrize("asked", ASKED)
def test_nor_in_what_is_exported(asked: dict[str, Any], form: str) -> None:
    assert "dirac" not in str(export_request({"form": form, "scene": asked})["text"]).lower()


@pytest.mark.parametrize("energy", [energy for energy in ENERGIES if "dot" not in energy])
def test_a_program_has_the_slope_of_the_potential(energy: str, tmp_path: Path) -> None:
    """f = −∂V/∂q by central differences, on either side of where it switches."""
    file = tmp_path / "motion.py"
    file.write_text(str(export_request({"form": "python", "scene": potential(energy)})["text"]), encoding="utf-8")
    forcing = runpy.run_path(str(file))["forcing"]
    (load,) = read_scene(potential(energy)).contributions

    def value(x: float, y: float) -> float:
        return evaluate(load.energy, {"x": x, "y": y, "t": 0.1, "k": 2.0})  # type: ignore[union-attr]

    h = 1e-6
    for x, y in PLACES:
        slopes = [value(x + h, y) - value(x - h, y), value(x, y + h) - value(x, y - h)]
        np.testing.assert_allclose(forcing(0.1, [x, y], [0.0, 0.0]), -np.array(slopes) / (2 * h), rtol=1e-7, atol=1e-7)
