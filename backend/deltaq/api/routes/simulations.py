"""Simulations."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from ...contract.simulation import SimulationAnswer, SimulationRequest
from ..body import StrictRoute
from ..costs import expected
from ..responses import packed
from ..service import service_of
from ..workers.job import Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/simulations", tags=["simulations"], route_class=StrictRoute)
SIMULATE = Job("deltaq.api.jobs:simulate", deadline=20.0)
FAST = 8  # degrees of freedom


@router.post("", response_model=SimulationAnswer, responses=COMPUTING)
async def simulate(request: Request, body: SimulationRequest) -> Response:
    """Simulate a scene. A run that fails is an answer too: it says how far it came, why, and what to do."""
    service = service_of(request)
    question = question_of(request, body)
    key = service.key(SIMULATE.target, question)
    await service.kernels.wait(body.method)
    job = expected(SIMULATE.within(service.settings.simulation_deadline), body, FAST)
    return packed(request, key, await service.answer(key, job, {"request": question}))
