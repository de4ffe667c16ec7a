"""Built-in scenes, and checking one's own."""

from __future__ import annotations

from functools import cache
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Request, Response

from ...contract.document import EXAMPLE, GivenDraft, SceneDocument
from ...contract.scene import TOML_EXAMPLE, SceneList, SceneText, SceneValidity
from ...errors import Problem, RequestError
from ...mechanics.library import family_of, load_scene, scene_ids
from ...mechanics.scene import Scene
from ...mechanics.toml import LONGEST
from ...mechanics.user_text import plainly
from ...mechanics.writing import write_scene
from ..body import BodyError, StrictRoute, demand_kind
from ..languages import language_of
from ..responses import JSON, tagged
from ..service import service_of
from ..workers.job import Job
from .common import LANGUAGE, SceneId, failures

router = APIRouter(prefix="/scenes", tags=["scenes"], route_class=StrictRoute)
TOML_BODY = {"schema": {"type": "string", "examples": [TOML_EXAMPLE]}}
BYTES = "application/octet-stream"  # what clients send who do not know TOML by name
BYTES_BODY = {"schema": {"type": "string", "format": "binary", "examples": [TOML_EXAMPLE]}}
TOML = {"requestBody": {"required": True, "content": {"application/toml": TOML_BODY, BYTES: BYTES_BODY}}}
READ = Job("deltaq.api.jobs:read_scene_toml", deadline=5.0, processor=2.0)
VALIDATE = Job("deltaq.api.jobs:validate", deadline=5.0, processor=2.0)


@cache
def _entries() -> tuple[dict[str, Any], ...]:
    return tuple(_entry(load_scene(identifier)) for identifier in scene_ids())


def _entry(scene: Scene) -> dict[str, Any]:
    """What the list says of a scene; of a family also which whole number chooses its member, with its bounds."""
    titles = {"title": plainly(scene.title), "summary": plainly(scene.summary)}
    entry = {"id": scene.id, **titles, "degrees_of_freedom": scene.degrees_of_freedom}
    family = family_of(scene.id)
    if family is None:
        return entry
    bounds = {"parameter": family.parameter, "min": family.least, "max": family.most, "value": family.default}
    return entry | {"family": bounds}


@router.get("", response_model=SceneList, responses=failures(422))
def list_scenes(
    request: Request, *, summaries: Annotated[bool, Query(description="whether to tell what each is about")] = True
) -> Response:
    """The built-in scenes, titles in all languages."""
    left_out = () if summaries else ("summary",)
    entries = [{key: value for key, value in entry.items() if key not in left_out} for entry in _entries()]
    return tagged(request, {"scenes": entries})


@router.post(
    "/validate",
    response_model=SceneValidity,
    responses=failures(400, 413, 422, 503, 504),
    dependencies=[LANGUAGE],
)
async def validate_scene(request: Request, scene: Annotated[GivenDraft, Body(examples=[EXAMPLE])]) -> Response:
    """Whether a scene document describes a mechanical system, and all that is wrong with it."""
    document = {"scene": scene, "lang": language_of(request)}
    return Response(await service_of(request).run(VALIDATE, document), media_type=JSON)


@router.post(
    "/toml",
    response_model=SceneText,
    responses=failures(400, 413, 422, 503, 504),
    dependencies=[LANGUAGE],
    openapi_extra=TOML,
)
async def read_toml_scene(request: Request) -> Response:
    """A scene document written in TOML, as JSON. Whether it describes a mechanical system, `/scenes/validate` says."""
    demand_kind(request, "TOML", BYTES)
    body = await request.body()
    if len(body) > LONGEST:
        raise BodyError(413, limit=LONGEST)
    text = body.decode("utf-8", errors="replace")
    if not text:
        raise RequestError(Problem("missing-field", parameters={"field": "body"}))
    return Response(await service_of(request).run(READ, {"text": text, "lang": language_of(request)}), media_type=JSON)


@router.get("/{identifier}", response_model=SceneDocument, responses=failures(404, 422), dependencies=[LANGUAGE])
def get_scene(
    request: Request,
    identifier: SceneId,
    n: Annotated[int | None, Query(description="members of a chain")] = None,
) -> Response:
    """The document of a built-in scene, format 1; of a family the member with `n` links, or its usual one."""
    return tagged(request, write_scene(load_scene(identifier, n)))
