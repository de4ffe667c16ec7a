"""What the page draws is what was computed: every library scene, in pixels, against its motion at many more times."""

from __future__ import annotations

import json
import math
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.frontend.node import node_folder

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.writing import write_scene
from deltaq.narration.derive import derive_request
from deltaq.simulation.service import run

# Half a pixel cannot be seen, on plots that fill a projector.
SEEN = 0.5
# Letters for which there is no room at some moments, as part of all: most of them fade where their angle closes.
LEFT_OUT = 0.15
# Symbols of formulas that have a mark in the drawing, as part of all of a scene: 88 to 100 %, and 99 % of all together.
MARKED = 0.85


class Drawing:
    """The page's own code in node, which asks for motions as the page asks the service."""

    def __init__(self, root: Path) -> None:
        folder = node_folder()
        assert folder is not None
        command = [str(folder / "node"), str(root / "tests" / "frontend" / "drawn.js")]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def _say(self, said: object) -> None:
        assert self.process.stdin is not None
        print(json.dumps(said), file=self.process.stdin, flush=True)

    def measured(self, case: dict[str, object]) -> dict[str, Any]:
        """The largest distance in pixels of each curve that is drawn from the motion, and what was told of it."""
        assert self.process.stdout is not None
        self._say(case)
        while "ask" in (said := json.loads(self.process.stdout.readline())):
            self._say(run({key: value for key, value in said["ask"].items() if key != "lang"}))
        return dict(said)


@pytest.fixture(scope="module")
def drawing(root: Path) -> Iterator[Drawing]:
    drawing = Drawing(root)
    with drawing.process:
        yield drawing
        drawing.process.kill()


def kinds_of(worst: dict[str, float]) -> set[str]:
    return {curve.split()[0] for curve in worst}


@pytest.mark.one_in(8)
@pytest.mark.parametrize("scene", scene_ids())
def test_curves_portraits_paths_and_handout(drawing: Drawing, scene: str) -> None:
    derivation = derive_request({"scene": scene, "lang": "en"})
    found = drawing.measured({"scene": write_scene(load_scene(scene)), "derivation": derivation})
    assert {curve: far for curve, far in found["worst"].items() if far is None or not far < SEEN} == {}
    assert kinds_of(found["worst"]) >= {"plot", "phase", "state", "place", "path", "handout"}
    assert not found["coarse"]
    assert found["degrees"] == load_scene(scene).degrees_of_freedom
    # No letter on another, on the head of an arrow or on a body; and nearly all are there, those of δr's parts, too.
    for letters in found["letters"]:
        assert letters["covers"] == {}
        assert letters["hidden"] <= LEFT_OUT * letters["shown"], letters["without"]
    assert found["symbols"]["refused"] == []
    marked, bare = found["symbols"]["marked"], found["symbols"]["bare"]
    assert len(marked) >= MARKED * len(marked + bare), bare


@pytest.mark.parametrize("method", ["rk4", "bogacki-shampine-32"])
def test_other_methods(drawing: Drawing, method: str) -> None:
    """Fixed steps have samples of their own; an adaptive method of low order takes many steps."""
    found = drawing.measured({"scene": write_scene(load_scene("wilberforce")), "method": method})
    assert max(found["worst"].values()) < SEEN


def test_the_portrait_ends_with_the_rate_in_closed_form(drawing: Drawing) -> None:
    """Wilberforce: with equal frequencies z = (z₀/2)(cos ω₊t + cos ω₋t), θ = √(m/J)(z₀/2)(cos ω₊t − cos ω₋t)."""
    mass, inertia, stiffness, coupling, start, t = 0.5, 1e-4, 5.0, 0.02, 0.1, 10.0
    split = coupling / 2 / math.sqrt(mass * inertia)
    fast, slow = (math.sqrt(stiffness / mass + sign * split) for sign in (1, -1))
    rate = -math.sqrt(mass / inertia) * start / 2 * (fast * math.sin(fast * t) - slow * math.sin(slow * t))
    found = drawing.measured({"scene": write_scene(load_scene("wilberforce"))})
    assert found["end"]["theta"] == pytest.approx(rate, rel=2e-3)  # a hundredth of a pixel
