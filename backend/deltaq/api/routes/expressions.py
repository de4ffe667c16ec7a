"""Expressions, read in the names of a scene: as a formula to be looked at, and as plain text.

To read and write one costs 1 to 5 ms of a processor. The worst texts within the bounds of the language (sixty arcus
tangents of two arguments; thirty fractions within one another) cost 0.15 s in a worker that has never seen their like,
so 0.2 s is what each may cost. By the clock it has longer, for a busy machine may take the processor away.
"""

from __future__ import annotations

from dataclasses import replace

from fastapi import APIRouter, Request, Response

from ...contract.expression import ExpressionAnswer, ExpressionRequest, ExpressionsAnswer, ExpressionsRequest
from ..body import StrictRoute
from ..responses import packed
from ..service import service_of
from ..workers.job import Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/expressions", tags=["expressions"], route_class=StrictRoute)
READING = 0.2  # seconds of a processor for one text
MOST = 4.0  # for all of many
ONE = Job("deltaq.narration.expressions:typeset_request", deadline=5.0, processor=READING)
ALL = Job("deltaq.api.jobs:typeset_all", deadline=10.0)


@router.post("", response_model=ExpressionAnswer, responses=COMPUTING)
async def typeset(request: Request, body: ExpressionRequest) -> Response:
    """What a text means: LaTeX, and plain text that can be read back."""
    return await _answer(request, body, ONE)


@router.post("/batch", response_model=ExpressionsAnswer, responses=COMPUTING)
async def typeset_all(request: Request, body: ExpressionsRequest) -> Response:
    """What each of several texts means; one that cannot be read says why and spoils no other."""
    return await _answer(request, body, replace(ALL, processor=min(MOST, READING * max(1, len(body.expressions)))))


async def _answer(request: Request, body: ExpressionRequest | ExpressionsRequest, job: Job) -> Response:
    service = service_of(request)
    question = question_of(request, body)
    key = service.key(job.target, question)
    return packed(request, key, await service.answer(key, job, question))
