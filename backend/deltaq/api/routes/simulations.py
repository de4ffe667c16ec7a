"""Simulations."""

from __future__ import annotations

import gzip
from typing import Any

from fastapi import APIRouter, Request, Response

from ...contract.simulation import SimulationAnswer, SimulationRequest
from ..body import StrictRoute
from ..costs import expected
from ..responses import packed
from ..service import Service, service_of
from ..workers.job import Job, JobError
from .common import COMPUTING, question_of

router = APIRouter(prefix="/simulations", tags=["simulations"], route_class=StrictRoute)
SIMULATE = Job("deltaq.api.jobs:simulate", deadline=20.0)
SIMULATE_AT_ONCE = Job("deltaq.api.jobs:simulate_at_once", deadline=20.0)
SIMULATE_MEANWHILE = Job("deltaq.api.jobs:simulate_meanwhile", deadline=90.0, pace="slow")
NOTHING = b"null"
FAST = 8  # degrees of freedom


@router.post("", response_model=SimulationAnswer, responses=COMPUTING)
async def simulate(request: Request, body: SimulationRequest) -> Response:
    """Simulate a scene. A run that fails is an answer too: it says how far it came, why, and what to do."""
    service = service_of(request)
    question = question_of(request, body)
    count, job = 0, expected(SIMULATE_AT_ONCE, body, FAST)
    while service.kernels.is_compiling(body.method):
        early = await _early(service, question, job, count)
        if early is not None:
            return packed(request, *early)
        # to interpret for some seconds takes a part of what it takes to compile the loops of a method
        is_first, job = job.target == SIMULATE_AT_ONCE.target, SIMULATE_MEANWHILE
        count = 0 if is_first else await service.kernels.more(body.method, count)
    key = service.key(SIMULATE.target, question)
    await service.kernels.wait(body.method)
    job = expected(SIMULATE.within(service.settings.simulation_deadline), body, FAST)
    return packed(request, key, await service.answer(key, job, {"request": question}))


async def _early(service: Service, question: Any, job: Job, count: int) -> tuple[str, bytes] | None:
    """The answer by the kernels that are there, and the others interpreted, under a key of its own.

    None if that takes too long, or no worker is free. `count` are those known to be there.
    """
    key = service.key(job.target, question, count)
    try:
        answer = await service.answer(key, job, {"request": question})
    except JobError:
        return None
    return None if gzip.decompress(answer) == NOTHING else (key, answer)
