"""Experiments: streamed as they are measured, or as one answer; as JSON, as a page, or as a table.

All who ask for the same at once share one experiment, and what was measured is kept: with it, where it has times, when
and at which load of the machine. Who wants it measured anew says so, `fresh` or by `Cache-Control: no-cache`.
Figures have no language: charts are drawn from them in each that is asked for; the parts of a shared stream are in that
of who began it. Where an experiment has to wait, its stream tells first for what: `preparing`, how many `kernels` are
there `of` all, where the service still compiles what it takes; then its place in the queue: `waiting`, with `place` (1:
the next, 0: begun) and the `seconds` until it should begin.

There is a call for whatever stands in `lab/experiments/`; what may be asked of it stands in `contract/experiments/`.
"""

from __future__ import annotations

import hashlib
from collections.abc import Awaitable, Callable
from dataclasses import replace
from functools import cache
from inspect import getdoc
from json import loads
from typing import Any

from fastapi import APIRouter, Request, Response
from starlette.responses import StreamingResponse

from ...contract.experiment import ExperimentRequest, request_of
from ...contract.menu import ExperimentEntry, ExperimentList, options_of
from ...lab.library import experiment_ids
from ..body import StrictRoute
from ..ending import Ending
from ..flights import OnUpdate
from ..languages import language_of
from ..packing import unpack
from ..problems import report_of
from ..responses import packed, tagged
from ..service import Service, service_of
from ..streams import MEDIA_TYPE, events, kept_alive
from ..workers.job import Job
from .common import COMPUTING, failures, question_of

EXPERIMENT = Job("deltaq.api.jobs:experiment", deadline=180.0, threads=8, pace="slow")
CHARTS = Job("deltaq.api.jobs:draw_charts", deadline=30.0)
EXPORT = Job("deltaq.api.jobs:export_charts", deadline=30.0)
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


def list_experiments(request: Request) -> Response:
    """The experiments there are, and what may be asked of each besides its scene, with defaults and bounds."""
    return tagged(request, _menu())


@cache
def _menu() -> dict[str, Any]:
    entries = [
        ExperimentEntry(id=one, description=getdoc(request_of(one)) or "", options=tuple(options_of(request_of(one))))
        for one in experiment_ids()
    ]
    return ExperimentList(experiments=tuple(entries)).model_dump()


def _router() -> APIRouter:
    """A call for each experiment there is."""
    router = APIRouter(prefix="/experiments", tags=["experiments"], route_class=StrictRoute)
    router.add_api_route("", list_experiments, response_model=ExperimentList, responses=failures(422))
    for identifier in experiment_ids():
        asked = request_of(identifier)
        router.add_api_route(
            f"/{identifier}",
            _call_of(identifier, asked),
            methods=["POST"],
            name=identifier.replace("-", "_"),
            description=getdoc(asked),
            response_model=asked.answer,
            responses=COMPUTING | ANSWERS,
            openapi_extra=ANEW,
        )
    return router


def _call_of(experiment: str, asked: type) -> Callable[[Request, ExperimentRequest], Awaitable[Response]]:
    """What answers such a question: FastAPI reads from the annotation of the body what may be asked."""

    async def call(request: Request, body: ExperimentRequest) -> Response:
        return await _measured(request, experiment, body)

    call.__annotations__["body"] = asked
    return call


async def _measured(request: Request, experiment: str, body: ExperimentRequest) -> Response:
    """What was found, in the form that `Accept` asks for."""
    service = service_of(request)
    question = {"experiment": experiment, **question_of(request, body)}
    anew = question.pop("fresh") or _wants_anew(request)  # no part of the question: the answer is kept for all
    job = replace(EXPERIMENT, deadline=service.settings.experiment_deadline, name=experiment)
    key, accepted = service.key(job.target, question | {"lang": ""}), request.headers.get("accept", "")

    async def measured(hear: OnUpdate | None) -> bytes:
        result = await service.measurement(key, job, question, hear, anew=anew, kernels=body.kernels)
        return await _drawn(service, result, question["lang"])

    if MEDIA_TYPE in accepted:
        return _streamed(request, measured, service.ending)
    answer = await measured(None)
    wanted = next((kind for kind in FILES if kind in accepted), None)
    if wanted is None:
        return packed(request, hashlib.sha256(answer).hexdigest()[:32], answer)  # measured anew, it is another
    return await _exported(service, wanted, unpack(answer), question["lang"])


async def _drawn(service: Service, result: bytes, language: str) -> bytes:
    """A kept result with its charts, kept themselves by what was measured."""
    key = service.key(CHARTS.target, hashlib.sha256(result).hexdigest(), language)
    return await service.answer(key, CHARTS, {"result": unpack(result).decode(), "lang": language})


def _wants_anew(request: Request) -> bool:
    """Whether the client will not have what is kept (RFC 9111 §5.2.1.4)."""
    return "no-cache" in request.headers.get("cache-control", "")


def _streamed(request: Request, measured: Callable[[OnUpdate], Awaitable[bytes]], ending: Ending) -> Response:
    async def work(hear: OnUpdate) -> bytes:
        return unpack(await ending.unless(measured(hear)))

    def failure(error: Exception) -> dict[str, Any]:
        return report_of(error).document(language_of(request))

    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(kept_alive(events(work, failure)), media_type=MEDIA_TYPE, headers=headers)


async def _exported(service: Service, media_type: str, answer: bytes, language: str) -> Response:
    """The charts as a page that needs nothing else, or their numbers as a table."""
    result = loads(answer)
    document = {"charts": result["charts"], "form": FILES[media_type], "lang": language}
    found = loads(await service.run(EXPORT, document))
    name = f"{result['experiment']}-{result['scene']}.{FILES[media_type]}"
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(found["text"], media_type=media_type, headers=headers)


router = _router()
