"""Experiments: streamed as they are measured, or as one answer; as JSON, as a page, or as a table.

All who ask for the same at once share one experiment, and what was measured is kept: a time that was measured here an
hour ago is as good as one that is measured now. Who wants it measured anew says so by `Cache-Control: no-cache`.
"""

from __future__ import annotations

import hashlib
from collections.abc import Awaitable, Callable
from dataclasses import replace
from functools import partial
from json import loads
from typing import Any

from fastapi import APIRouter, Request, Response
from starlette.responses import StreamingResponse

from ..body import StrictRoute
from ..flights import Hear, ignore
from ..languages import language_of
from ..problems import report_of
from ..responses import packed
from ..service import Service, service_of, unpack
from ..streams import MEDIA_TYPE, events
from ..wire.experiment import (
    ChaosRequest,
    ConvergenceRequest,
    EnergyDriftRequest,
    ExperimentAnswer,
    ExperimentRequest,
    FidelityRequest,
    StabilityMapRequest,
    StabilityRequest,
    WorkPrecisionRequest,
)
from ..workers.job import Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/experiments", tags=["experiments"], route_class=StrictRoute)
EXPERIMENT = Job("deltaq.api.jobs:experiment", deadline=180.0, threads=8, pace="slow")
EXPORT = Job("deltaq.api.jobs:export_charts", deadline=30.0, pace="slow")
FILES = {"text/html": "html", "text/csv": "csv"}
ANEW: dict[str, Any] = {
    "parameters": [
        {
            "name": "Cache-Control",
            "in": "header",
            "schema": {"type": "string"},
            "description": "`no-cache` measures anew what was measured before",
        }
    ]
}
ANSWERS: dict[int | str, dict[str, Any]] = {
    200: {"content": {kind: {"schema": {"type": "string"}} for kind in (MEDIA_TYPE, *FILES)}}
}


@router.post("/work-precision", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def work_precision(request: Request, body: WorkPrecisionRequest) -> Response:
    """Speed against accuracy: the error of each method against time and right-hand sides."""
    return await _measured(request, "work-precision", body)


@router.post("/convergence", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def convergence(request: Request, body: ConvergenceRequest) -> Response:
    """Order of convergence: the error of each method against its step."""
    return await _measured(request, "convergence", body)


@router.post("/energy-drift", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def energy_drift(request: Request, body: EnergyDriftRequest) -> Response:
    """Departure of the energy balance over many steps, symplectic methods against others."""
    return await _measured(request, "energy-drift", body)


@router.post("/stability", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def stability(request: Request, body: StabilityRequest) -> Response:
    """Regions of stability with the eigenvalues of the scene, steps of failure, and a series over a stiffness."""
    return await _measured(request, "stability", body)


@router.post("/stability-map", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def stability_map(request: Request, body: StabilityMapRequest) -> Response:
    """Floquet multipliers over two parameters of a scene that something drives periodically."""
    return await _measured(request, "stability-map", body)


@router.post("/chaos", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def chaos(request: Request, body: ChaosRequest) -> Response:
    """Twin runs, Lyapunov exponent, and the horizon of prediction against the tolerance."""
    return await _measured(request, "chaos", body)


@router.post("/fidelity", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS, openapi_extra=ANEW)
async def fidelity(request: Request, body: FidelityRequest) -> Response:
    """The least model that will do: simpler models of the scene, each with its cost and its error."""
    return await _measured(request, "fidelity", body)


async def _measured(request: Request, experiment: str, body: ExperimentRequest) -> Response:
    """What was found, in the form that `Accept` asks for."""
    service = service_of(request)
    question = {"experiment": experiment, **question_of(request, body)}
    job = replace(EXPERIMENT, deadline=service.settings.experiment_deadline)
    key, accepted = service.key(job.target, question), request.headers.get("accept", "")
    measured = partial(service.measurement, key, job, question, anew=_wants_anew(request))
    if MEDIA_TYPE in accepted:
        return _streamed(request, measured)
    answer = await measured(ignore)
    wanted = next((kind for kind in FILES if kind in accepted), None)
    if wanted is None:
        return packed(request, hashlib.sha256(answer).hexdigest()[:32], answer)  # measured anew, it is another
    return await _exported(service, wanted, unpack(answer), question["lang"])


def _wants_anew(request: Request) -> bool:
    """Whether the client will not have what is kept (RFC 9111 §5.2.1.4)."""
    return "no-cache" in request.headers.get("cache-control", "")


def _streamed(request: Request, measured: Callable[[Hear], Awaitable[bytes]]) -> Response:
    async def work(hear: Hear) -> bytes:
        return unpack(await measured(hear))

    def failure(error: Exception) -> dict[str, Any]:
        return report_of(error).document(language_of(request))

    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(events(work, failure), media_type=MEDIA_TYPE, headers=headers)


async def _exported(service: Service, media_type: str, answer: bytes, language: str) -> Response:
    """The charts as a page that needs nothing else, or their numbers as a table."""
    result = loads(answer)
    document = {"charts": result["charts"], "form": FILES[media_type], "lang": language}
    found = loads(await service.run(EXPORT, document))
    name = f"{result['experiment']}-{result['scene']}.{FILES[media_type]}"
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(found["text"], media_type=media_type, headers=headers)
