"""Experiments: streamed as they are measured, or as one answer; as JSON, as a page, or as a table."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from json import loads
from typing import Any

from fastapi import APIRouter, Request, Response
from starlette.responses import StreamingResponse

from ..body import StrictRoute
from ..clients import ACCOUNT
from ..languages import language_of
from ..problems import report_of
from ..responses import packed
from ..service import Service, pack, service_of, unpack
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
ANSWERS: dict[int | str, dict[str, Any]] = {
    200: {"content": {kind: {"schema": {"type": "string"}} for kind in (MEDIA_TYPE, *FILES)}}
}


@router.post("/work-precision", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def work_precision(request: Request, body: WorkPrecisionRequest) -> Response:
    """Speed against accuracy: the error of each method against time and right-hand sides."""
    return await _measured(request, "work-precision", body)


@router.post("/convergence", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def convergence(request: Request, body: ConvergenceRequest) -> Response:
    """Order of convergence: the error of each method against its step."""
    return await _measured(request, "convergence", body)


@router.post("/energy-drift", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def energy_drift(request: Request, body: EnergyDriftRequest) -> Response:
    """Departure of the energy balance over many steps, symplectic methods against others."""
    return await _measured(request, "energy-drift", body)


@router.post("/stability", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def stability(request: Request, body: StabilityRequest) -> Response:
    """Regions of stability with the eigenvalues of the scene, steps of failure, and a series over a stiffness."""
    return await _measured(request, "stability", body)


@router.post("/stability-map", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def stability_map(request: Request, body: StabilityMapRequest) -> Response:
    """Floquet multipliers over two parameters of a scene that something drives periodically."""
    return await _measured(request, "stability-map", body)


@router.post("/chaos", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def chaos(request: Request, body: ChaosRequest) -> Response:
    """Twin runs, Lyapunov exponent, and the horizon of prediction against the tolerance."""
    return await _measured(request, "chaos", body)


@router.post("/fidelity", response_model=ExperimentAnswer, responses=COMPUTING | ANSWERS)
async def fidelity(request: Request, body: FidelityRequest) -> Response:
    """The least model that will do: simpler models of the scene, each with its cost and its error."""
    return await _measured(request, "fidelity", body)


async def _measured(request: Request, experiment: str, body: ExperimentRequest) -> Response:
    """What was found, in the form that `Accept` asks for."""
    service = service_of(request)
    question = {"experiment": experiment, **question_of(request, body)}
    key, accepted = service.key(EXPERIMENT.target, question), request.headers.get("accept", "")
    if MEDIA_TYPE in accepted:
        return _streamed(request, service, key, question)
    answer = await _answer(service, key, question, lambda _: None)
    wanted = next((kind for kind in FILES if kind in accepted), None)
    if wanted is None:
        return packed(request, key, answer)
    return await _exported(service, wanted, unpack(answer), question["lang"])


def _streamed(request: Request, service: Service, key: str, question: dict[str, Any]) -> Response:
    async def work(hear: Callable[[bytes], object]) -> bytes:
        return unpack(await _answer(service, key, question, hear))

    def failure(error: Exception) -> dict[str, Any]:
        return report_of(error).document(language_of(request))

    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(events(work, failure), media_type=MEDIA_TYPE, headers=headers)


async def _answer(service: Service, key: str, question: dict[str, Any], hear: Callable[[bytes], object]) -> bytes:
    """From the cache, or measured; what nobody waits for any more is not measured to its end."""
    kept = await service.cache.find(key)
    if kept is not None:
        return kept
    await service.kernels.wait()
    job = replace(EXPERIMENT, deadline=service.settings.experiment_deadline)
    answer = pack(await service.laboratory.run(job, question, hear, ACCOUNT.get()))
    await service.cache.keep(key, answer)
    return answer


async def _exported(service: Service, media_type: str, answer: bytes, language: str) -> Response:
    """The charts as a page that needs nothing else, or their numbers as a table."""
    result = loads(answer)
    document = {"charts": result["charts"], "form": FILES[media_type], "lang": language}
    found = loads(await service.run(EXPORT, document))
    name = f"{result['experiment']}-{result['scene']}.{FILES[media_type]}"
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(found["text"], media_type=media_type, headers=headers)
