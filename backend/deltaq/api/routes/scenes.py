"""Built-in scenes, and checking one's own."""

from __future__ import annotations

from functools import cache
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Request, Response

from ...mechanics.library import load_scene, scene_ids
from ...mechanics.writing import write_scene
from ..body import StrictRoute
from ..languages import language_of
from ..responses import JSON, tagged
from ..service import service_of
from ..wire.scene import EXAMPLE, SceneDocument, SceneList, SceneText, SceneValidity
from ..workers.job import Job
from .common import failures

router = APIRouter(prefix="/scenes", tags=["scenes"], route_class=StrictRoute)
TOML = {"requestBody": {"required": True, "content": {"application/toml": {"schema": {"type": "string"}}}}}
READ = Job("deltaq.api.jobs:read_scene_toml", deadline=2.0)
VALIDATE = Job("deltaq.api.jobs:validate", deadline=2.0)


@cache
def _entries() -> tuple[dict[str, Any], ...]:
    scenes = [load_scene(identifier) for identifier in scene_ids()]
    return tuple(
        {
            "id": scene.id,
            "title": dict(scene.title),
            "summary": dict(scene.summary),
            "degrees_of_freedom": len(scene.free),
        }
        for scene in scenes
    )


@router.get("", response_model=SceneList, responses=failures())
def list_scenes(
    request: Request, *, summaries: Annotated[bool, Query(description="whether to tell what each is about")] = True
) -> Response:
    """The built-in scenes, titles in all languages."""
    left_out = () if summaries else ("summary",)
    entries = [{key: value for key, value in entry.items() if key not in left_out} for entry in _entries()]
    return tagged(request, {"scenes": entries})


@router.get("/{identifier}", responses=failures(404))
def get_scene(request: Request, identifier: str) -> Response:
    """The document of a built-in scene, format 1."""
    return tagged(request, write_scene(load_scene(identifier)))


@router.post("/validate", response_model=SceneValidity, responses=failures(400, 413, 422, 503, 504))
async def validate_scene(request: Request, scene: Annotated[SceneDocument, Body(examples=[EXAMPLE])]) -> Response:
    """Whether a scene document describes a mechanical system, and all that is wrong with it."""
    document = {"scene": scene, "lang": language_of(request)}
    return Response(await service_of(request).pool.run(VALIDATE, document), media_type=JSON)


@router.post("/toml", response_model=SceneText, responses=failures(400, 413, 422, 503, 504), openapi_extra=TOML)
async def read_toml_scene(request: Request) -> Response:
    """A scene document written in TOML, as JSON. Whether it describes a mechanical system, `/scenes/validate` says."""
    text = (await request.body()).decode("utf-8", errors="replace")
    return Response(
        await service_of(request).pool.run(READ, {"text": text, "lang": language_of(request)}), media_type=JSON
    )
