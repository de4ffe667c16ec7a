"""Expressions, read in the names of a scene: as a formula to be looked at, and as plain text."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from ..body import StrictRoute
from ..responses import packed
from ..service import service_of
from ..wire.expression import ExpressionAnswer, ExpressionRequest, ExpressionsAnswer, ExpressionsRequest
from ..workers.job import Job
from .common import failures, question_of

router = APIRouter(prefix="/expressions", tags=["expressions"], route_class=StrictRoute)
ONE = Job("deltaq.api.jobs:typeset", deadline=2.0)
ALL = Job("deltaq.api.jobs:typeset_all", deadline=4.0)


@router.post("", response_model=ExpressionAnswer, responses=failures(400, 404, 413, 422, 503, 504))
async def typeset(request: Request, body: ExpressionRequest) -> Response:
    """What a text means: LaTeX, and plain text that can be read back."""
    return await _answer(request, body, ONE)


@router.post("/batch", response_model=ExpressionsAnswer, responses=failures(400, 404, 413, 422, 503, 504))
async def typeset_all(request: Request, body: ExpressionsRequest) -> Response:
    """What each of several texts means; one that cannot be read says why and spoils no other."""
    return await _answer(request, body, ALL)


async def _answer(request: Request, body: ExpressionRequest | ExpressionsRequest, job: Job) -> Response:
    service = service_of(request)
    question = question_of(request, body)
    key = service.key(job.target, question)
    return packed(request, key, await service.answer(key, job, question))
