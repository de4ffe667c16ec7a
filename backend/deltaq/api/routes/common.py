"""What several routes need."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Depends, Path, Query, Request
from pydantic import BaseModel

from ...errors import UnknownNameError
from ...mechanics.library import load_scene
from ...vocabulary import Language
from ..languages import language_of

PREFIX = "/api/v1"
SceneId = Annotated[str, Path(description="a built-in scene", examples=["pendulum"])]

_MEANINGS = {
    400: "the body is not JSON",
    404: "there is nothing of this name",
    413: "the body is too large",
    422: "the request is not valid",
    429: "the client has used its share of computing time; Retry-After says when to ask again",
    503: "the service is busy; Retry-After says when to ask again",
    504: "the computation is too large",
}


def failures(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """OpenAPI of the problem documents that a route may answer; any other status is one, too."""
    content = {"application/problem+json": {"schema": {"$ref": "#/components/schemas/ProblemDocument"}}}
    of_computing = (429,) if 504 in statuses else ()
    named = sorted((*statuses, *of_computing))
    meanings = {str(status): _MEANINGS[status] for status in named} | {"default": "any other failure"}
    return {status: {"description": meaning, "content": content} for status, meaning in meanings.items()}


COMPUTING = failures(400, 404, 413, 422, 503, 504)


def _choose(
    lang: Annotated[Language | None, Query(description="language of the texts; else Accept-Language decides")] = None,
) -> Language | None:
    return lang  # language_of reads it


LANGUAGE = Depends(_choose)


def question_of(request: Request, body: BaseModel) -> dict[str, Any]:
    """All that an answer depends on: the body and the language. UnknownNameError if there is no such scene."""
    question = body.model_dump()
    scene = question["scene"]
    if isinstance(scene, str):
        try:
            load_scene(scene)
        except UnknownNameError as error:
            raise UnknownNameError(*(problem.below("/scene") for problem in error.problems)) from None
    return question | {"lang": language_of(request)}
