"""First variations of what a user writes."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from ...contract.variation import VariationAnswer, VariationRequest
from ..body import StrictRoute
from ..languages import language_of
from ..responses import packed
from ..service import service_of
from ..workers.job import Job
from .common import failures

router = APIRouter(prefix="/variations", tags=["variations"], route_class=StrictRoute)
VARY = Job("deltaq.api.jobs:vary", deadline=5.0)


@router.post("", response_model=VariationAnswer, responses=failures(400, 413, 422, 503, 504))
async def vary(request: Request, body: VariationRequest) -> Response:
    """Vary an expression or functional: by the definition and by the chain rule, each step verified."""
    service = service_of(request)
    question = body.model_dump(by_alias=True) | {"lang": language_of(request)}
    key = service.key(VARY.target, question)
    job = VARY.within(service.settings.derivation_deadline)
    return packed(request, key, await service.answer(key, job, {"id": key, "request": question}))
