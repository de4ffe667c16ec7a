"""Ensembles."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from ...contract.ensemble import EnsembleAnswer, EnsembleRequest
from ...simulation.library import ENSEMBLES
from ..body import StrictRoute
from ..responses import packed
from ..service import service_of
from ..workers.job import Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/ensembles", tags=["ensembles"], route_class=StrictRoute)
ENSEMBLE = Job("deltaq.api.jobs:ensemble", deadline=60.0, pace="slow")


@router.post("", response_model=EnsembleAnswer, responses=COMPUTING, response_model_exclude_none=True)
async def run_ensemble(request: Request, body: EnsembleRequest) -> Response:
    """Simulate a scene with many initial values or parameters. Each run has its own status and error."""
    service = service_of(request)
    question = question_of(request, body)
    key = service.key(ENSEMBLE.target, question)
    await service.kernels.wait("taylor", ENSEMBLES)
    return packed(request, key, await service.answer(key, ENSEMBLE, {"request": question}))
