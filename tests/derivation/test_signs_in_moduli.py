"""Signs within moduli, moduli within signs: what a normal form takes a root of stands in no circle."""

from __future__ import annotations

import pytest
from tests.simulation.scenes import document

from deltaq.narration.derive import derive_request


@pytest.mark.parametrize(
    "force",
    [
        "0.1*abs(sign(x)*x)",
        "0.1*abs(sign(x)*x*y)",
        "0.1*abs(x*abs(x))",
        "0.1*abs(sign(x - y)*(x - y))",
        "0.1*abs(sign(abs(x)*x)*x)",
        "0.1*sqrt((sign(x)*x)^2)",
    ],
)
def test_friction_is_derived(force: str) -> None:
    loads = [
        {"kind": "potential", "name": "springs", "energy": "x^2/2 + x^2*y^2"},
        {"kind": "friction", "name": "rubbing", "coordinate": "x", "force": force},
    ]
    position = ["x*cos(y)", "x*sin(y)"]
    scene = document({"x": (1.0, 0.0), "y": (0.2, 0.0)}, {}, {"mass": ("1", position)}, loads)
    steps = [step for chapter in derive_request({"scene": scene})["chapters"] for step in chapter["steps"]]
    assert steps
    assert all(step["verified"] for step in steps if "verified" in step)
