"""Experiments: streamed as they are measured, or as one answer; as JSON, as a page, or as a table."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
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
from ..wire.experiment import REQUESTS, ExperimentAnswer
from ..workers.job import Job
from .common import failures, question_of

router = APIRouter(prefix="/experiments", tags=["experiments"], route_class=StrictRoute)
EXPERIMENT = Job("deltaq.api.jobs:experiment", deadline=180.0, threads=8, pace="slow")
EXPORT = Job("deltaq.api.jobs:export_charts", deadline=30.0, pace="slow")
FILES = {"text/html": "html", "text/csv": "csv"}
Endpoint = Callable[..., Coroutine[Any, Any, Response]]


def _endpoint(name: str, model: type) -> Endpoint:
    """The call of one experiment: `Accept` says in which form the answer is wanted."""

    async def experiment(request: Request, body: Any) -> Response:
        service = service_of(request)
        question = {"experiment": name, **question_of(request, body)}
        key, accepted = service.key(EXPERIMENT.target, question), request.headers.get("accept", "")
        if MEDIA_TYPE in accepted:
            return _streamed(request, service, key, question)
        answer = await _answer(service, key, question, lambda _: None)
        wanted = next((kind for kind in FILES if kind in accepted), None)
        if wanted is None:
            return packed(request, key, answer)
        return await _exported(service, wanted, unpack(answer), question["lang"])

    experiment.__annotations__["body"] = model
    experiment.__doc__ = model.__doc__
    experiment.__name__ = name.replace("-", "_")
    return experiment


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


for _name, _model in REQUESTS.items():
    router.add_api_route(
        f"/{_name}",
        _endpoint(_name, _model),
        methods=["POST"],
        response_model=ExperimentAnswer,
        responses=failures(400, 404, 413, 422, 503, 504)
        | {200: {"content": {MEDIA_TYPE: {}, **{kind: {} for kind in FILES}}}},
    )
