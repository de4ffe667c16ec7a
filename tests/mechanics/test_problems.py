"""Sixty standard problems of courses on analytical mechanics: which can be described, and that they can be derived."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from deltaq.derivation.engine import derive
from deltaq.mechanics.document import examine
from deltaq.mechanics.library import load_scene, scene_ids

PROBLEMS = tomllib.loads(Path(__file__).with_name("problems.toml").read_text(encoding="utf-8"))["problem"]
DESCRIBED = [pytest.param(row, id=row["topic"]) for row in PROBLEMS if "coordinates" in row]


def document(row: Mapping[str, Any]) -> dict[str, object]:
    """The scene document of a row."""
    start, values = row.get("start", {}), row.get("values", {})
    bodies = [
        {"name": name, "kind": "particle", "mass": mass, "position": position}
        for name, (mass, *position) in row.get("particles", {}).items()
    ]
    bodies += [
        {"name": name, "kind": "rigid", "mass": mass, "inertia": inertia, "angle": angle, "position": position}
        for name, (mass, inertia, angle, *position) in row.get("rigids", {}).items()
    ]
    bodies += [
        {
            "name": name,
            "kind": "rigid",
            "mass": mass,
            "inertia": rest[:3],
            "angular_velocity": rest[3:6],
            "position": rest[6:] or ["0", "0", "0"],
        }
        for name, (mass, *rest) in row.get("space", {}).items()
    ]
    loads = [{"kind": "gravity", "acceleration": row["gravity"]}] if "gravity" in row else []
    constraints = [{"kind": "equation", "equation": equation} for equation in row.get("constraints", [])]
    return {
        "dimension": row.get("dimension", 2),
        "coordinates": [{"name": name, "value": start.get(name, 0.7)} for name in row["coordinates"].split()],
        "parameters": [{"name": name, "value": values.get(name, 1.0)} for name in row["parameters"].split()],
        "bodies": bodies,
        "loads": [*loads, *row.get("loads", [])],
        "constraints": constraints,
    }


def test_nine_of_ten_can_be_described() -> None:
    missing = [row["topic"] for row in PROBLEMS if "missing" in row]
    assert len(PROBLEMS) == 60
    assert len({row["topic"] for row in PROBLEMS}) == 60
    assert missing == ["Rocket, whose mass decreases", "Vibrating string as a field", "Relativistic particle"]
    assert {row["scene"] for row in PROBLEMS if "scene" in row} <= set(scene_ids())
    assert all(load_scene(row["scene"]) for row in PROBLEMS if "scene" in row)


@pytest.mark.parametrize("row", DESCRIBED)
def test_a_problem_is_described(row: dict[str, Any]) -> None:
    scene, problems = examine(document(row))
    assert scene is not None
    assert [problem for problem in problems if problem.severity == "error"] == []


@pytest.mark.one_in(9)
@pytest.mark.parametrize("row", DESCRIBED)
def test_a_problem_is_derived(row: dict[str, Any]) -> None:
    scene, _ = examine(document(row))
    assert scene is not None
    _, derivation = derive(scene)
    assert [step.id for step in derivation.steps() if not step.verified] == []
