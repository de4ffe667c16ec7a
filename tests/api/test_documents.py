"""The schema of scene documents and the reader agree: what the description knows is what scenes are written in."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any, get_args

import jsonschema_rs
import pytest
from tests.description import openapi

import deltaq
from deltaq.contract.document import SceneBody, SceneLoad
from deltaq.mechanics.document import examine
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.writing import write_scene
from deltaq.packages import classes_of

SCENES = Path(deltaq.__file__).parent / "scenes"
SCHEMAS = openapi()["components"]["schemas"]


def closed(schema: Any) -> Any:
    """A schema that knows no fields besides those it names, and whose references lead into itself."""
    if isinstance(schema, list):
        return [closed(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    found = {key: closed(value) for key, value in schema.items() if key != "examples"}
    if schema.get("additionalProperties") is True and "properties" in schema:
        found["additionalProperties"] = False
    if "$ref" in found:
        found["$ref"] = found["$ref"].replace("#/components/schemas/", "#/$defs/")
    return found


@pytest.fixture(scope="module")
def validator() -> Any:
    schema = {"$ref": "#/$defs/Scene", "$defs": closed(SCHEMAS)}
    return jsonschema_rs.Draft202012Validator(schema)


@pytest.mark.parametrize("identifier", scene_ids())
def test_built_in_scenes_are_in_the_schema(validator: Any, identifier: str) -> None:
    assert [*validator.iter_errors(write_scene(load_scene(identifier)))] == []
    assert validator.is_valid(identifier)


@pytest.mark.parametrize("file", sorted(SCENES.glob("*.toml")), ids=lambda file: file.stem)
def test_scenes_as_they_are_written_by_hand_are_in_the_schema(validator: Any, file: Path) -> None:
    document = tomllib.loads(file.read_text(encoding="utf-8"))
    document.pop("family", None)  # of the file alone: documents are members of it
    assert [*validator.iter_errors(document)] == []


@pytest.mark.parametrize("field", sorted(write_scene(load_scene("pendulum"))))
def test_the_schema_demands_no_more_than_the_reader(validator: Any, field: str) -> None:
    document = write_scene(load_scene("pendulum"))
    del document[field]
    is_accepted = not [problem for problem in examine(document)[1] if problem.severity == "error"]
    assert validator.is_valid(document) or not is_accepted


@pytest.mark.parametrize(("model", "folder"), [(SceneBody, "bodies"), (SceneLoad, "loads")])
def test_the_schema_knows_every_kind(model: type, folder: str) -> None:
    kinds = get_args(model.model_fields["kind"].annotation)  # type: ignore[attr-defined]
    assert set(kinds) == set(classes_of(f"deltaq.mechanics.{folder}", "kind"))
