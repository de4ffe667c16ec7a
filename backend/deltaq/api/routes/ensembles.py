"""Ensembles: as one answer, or streamed in blocks of runs as they are done."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request, Response
from starlette.responses import StreamingResponse

from ...contract.ensemble import EnsembleAnswer, EnsembleRequest
from ...simulation.library import ENSEMBLES
from ..blocks import Blocks
from ..body import StrictRoute
from ..languages import language_of
from ..problems import report_of
from ..responses import packed
from ..service import service_of
from ..streams import MEDIA_TYPE, kept_alive
from ..workers.job import Job
from .common import COMPUTING, question_of

router = APIRouter(prefix="/ensembles", tags=["ensembles"], route_class=StrictRoute)
ENSEMBLE = Job("deltaq.api.jobs:ensemble", deadline=60.0, pace="slow")
JUDGE = Job("deltaq.api.jobs:judge_ensemble", deadline=60.0)
IN_BLOCKS = Job("deltaq.api.jobs:ensemble_in_blocks", deadline=60.0, pace="slow")
KERNELS = ("taylor", ENSEMBLES)
ANSWERS: dict[int | str, dict[str, Any]] = {200: {"content": {MEDIA_TYPE: {"schema": {"type": "string"}}}}}


@router.post("", response_model=EnsembleAnswer, responses=COMPUTING | ANSWERS, response_model_exclude_none=True)
async def run_ensemble(request: Request, body: EnsembleRequest) -> Response:
    """Simulate a scene with many initial values or parameters. Each run has its own status and error.

    Runs come as they are done where `Accept` asks for text/event-stream; what makes no sense is refused before. The
    events: `preparing` with how many `kernels` are there `of` all, where the service still compiles what this takes;
    `waiting` with `place` in the queue (1: the next, 0: begun) and `seconds`; `block` with what the answer tells of
    each run, of `runs` runs from the `first` on, in whatever order they are done; then `result`, which is what it tells
    of all of them together, or `problem` with the runs that are `missing`. Columns of the blocks, put together by
    `first`, are those of the answer.
    """
    service = service_of(request)
    question = question_of(request, body)
    is_streamed = MEDIA_TYPE in request.headers.get("accept", "")
    if is_streamed or any(map(service.kernels.is_compiling, KERNELS)):  # nobody waits to be refused
        await service.answer(service.key(JUDGE.target, question), JUDGE, {"request": question})
    if is_streamed:
        return _streamed(request, question, body.count)
    key = service.key(ENSEMBLE.target, question)
    await service.kernels.wait(*KERNELS)
    return packed(request, key, await service.answer(key, ENSEMBLE, {"request": question}))


def _streamed(request: Request, question: dict[str, Any], count: int) -> Response:
    service, blocks = service_of(request), Blocks(count)

    async def work() -> bytes:
        key = service.key(IN_BLOCKS.target, question)
        return await service.ending.unless(service.blocks(key, IN_BLOCKS, {"request": question}, blocks, KERNELS))

    def failure(error: Exception) -> dict[str, Any]:
        return report_of(error).document(language_of(request))

    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(kept_alive(blocks.events(work, failure)), media_type=MEDIA_TYPE, headers=headers)
