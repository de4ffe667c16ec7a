"""Exports: files to take away, made from a scene."""

from __future__ import annotations

from json import loads
from typing import Annotated, Any

from fastapi import APIRouter, Path, Request, Response

from ...contract.export import ExportRequest, Form
from ..body import StrictRoute
from ..costs import expected
from ..packing import unpack
from ..service import service_of
from ..workers.job import Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/exports", tags=["exports"], route_class=StrictRoute)
EXPORT = Job("deltaq.handout.service:export_request", deadline=5.0)
FAST = 4  # degrees of freedom
MEDIA_TYPES = {"latex": "application/x-tex", "markdown": "text/markdown", "python": "text/x-python"}
FILES: dict[int | str, dict[str, Any]] = {
    200: {"content": {media_type: {"schema": {"type": "string"}} for media_type in MEDIA_TYPES.values()}}
}


@router.post("/{form}", response_class=Response, responses=COMPUTING | FILES)
async def export_derivation(
    request: Request, form: Annotated[Form, Path(description="kind of file")], body: ExportRequest
) -> Response:
    """The derivation as a LaTeX or Markdown file, or a Python program that computes the motion with SciPy."""
    service = service_of(request)
    question = {"form": form, **question_of(request, body)}
    job = expected(EXPORT.within(service.settings.derivation_deadline), body, FAST)
    answer = await service.answer(service.key(EXPORT.target, question), job, question)
    file = loads(unpack(answer))
    headers = {"Content-Disposition": f'attachment; filename="{file["name"]}"', "Vary": "Accept-Language"}
    return Response(file["text"], media_type=f"{MEDIA_TYPES[form]}; charset=utf-8", headers=headers)
