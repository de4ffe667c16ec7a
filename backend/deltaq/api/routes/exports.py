"""Exports: files to take away, made from a scene."""

from __future__ import annotations

from json import loads
from typing import Annotated, Any

from fastapi import APIRouter, Path, Request, Response

from ...contract.export import ExportRequest, Form
from ..body import StrictRoute
from ..costs import expected
from ..flights import Update
from ..packing import unpack
from ..service import Service, service_of
from ..workers.job import DeadlineExceeded, Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/exports", tags=["exports"], route_class=StrictRoute)
EXPORT = Job("deltaq.api.jobs:export", deadline=5.0)
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
    document = {"request": question, "seconds": service.settings.derivation_deadline}
    file = await _file(service, service.key(EXPORT.target, question), job, document)
    headers = {"Content-Disposition": f'attachment; filename="{file["name"]}"', "Vary": "Accept-Language"}
    return Response(file["text"], media_type=f"{MEDIA_TYPES[form]}; charset=utf-8", headers=headers)


async def _file(service: Service, key: str, job: Job, document: dict[str, Any]) -> dict[str, str]:
    """Name and text; where there was no time for all of it, the file without that, which is not kept."""
    heard: list[bytes] = []

    def hear(update: Update) -> None:
        if update.kind == "part":
            heard[:] = [update.data]

    try:
        found: dict[str, str] = loads(unpack(await service.parts(key, job, document, hear)))
    except DeadlineExceeded:
        if not heard:
            raise
        found = loads(heard[0])
    return found
