"""Homework: the tasks of a scene, and answers checked."""

from __future__ import annotations

import asyncio
import hashlib
from json import dumps, loads
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response
from starlette.responses import StreamingResponse

from ...contract.base import SceneWithChanges
from ...contract.check import (
    BatchRequest,
    CheckRequest,
    LinesRequest,
    ReadingRequest,
    RowQuestion,
    SingleCheck,
    TableRequest,
)
from ...contract.task import (
    AssignmentAnswer,
    AssignmentRequest,
    PollAnswer,
    PollRequest,
    PracticeAnswer,
    PracticeRequest,
    SolutionAnswer,
    SolutionRequest,
    StackRequest,
    TaskList,
    TasksRequest,
)
from ...contract.verdict import (
    BatchAnswer,
    LinesAnswer,
    MotionAnswer,
    ReadingAnswer,
    RowVerdict,
    TableAnswer,
    VerdictAnswer,
)
from ...homework.gradebook import Plan
from ..batches import LONGEST as BATCH_LONGEST
from ..batches import checked
from ..body import StrictRoute
from ..costs import expected
from ..languages import language_of
from ..marking import LONGEST as STREAM_LONGEST
from ..marking import Marking, streamed
from ..packing import pack, unpack
from ..problems import report_of
from ..responses import packed
from ..service import service_of
from ..streams import MEDIA_TYPE as EVENTS
from ..streams import kept_alive
from ..workers.job import Job
from .common import COMPUTING, LANGUAGE, SceneId, failures, question_of

router = APIRouter(tags=["homework"], route_class=StrictRoute)
XMLS = ("application/xml", "text/xml")  # the same for programs, and as text (RFC 7303)
XML: dict[int | str, dict[str, Any]] = {200: {"content": {kind: {"schema": {"type": "string"}} for kind in XMLS}}}
TABLE: dict[int | str, dict[str, Any]] = {
    200: {"content": {kind: {"schema": {"type": "string"}} for kind in (EVENTS, "text/csv")}}
}
UNKEPT = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
FAST = 3  # degrees of freedom
TASKS = Job("deltaq.homework.service:tasks_request", deadline=8.0)
CHECK = Job("deltaq.homework.service:check_request", deadline=15.0)
CHECK_IN_BATCH = CHECK.within(5.0)
READING = Job("deltaq.homework.service:reading_request", deadline=4.0)
SOLUTION = Job("deltaq.homework.service:solution_request", deadline=8.0)
POLL = Job("deltaq.homework.service:poll_request", deadline=15.0)
MOTION = Job("deltaq.homework.service:motion_request", deadline=8.0)
ASSIGNMENT = Job("deltaq.homework.service:assignment_request", deadline=30.0, pace="slow", processor=15.0)
PRACTICE = Job("deltaq.homework.service:practice_request", deadline=15.0)
STACK = Job("deltaq.homework.service:stack_request", deadline=60.0, pace="slow", processor=30.0)
PLAN = Job("deltaq.homework.service:table_request", deadline=30.0, processor=15.0)
ROW = Job("deltaq.homework.grading:row_verdict", deadline=15.0).within(5.0)
LINES = Job("deltaq.homework.service:lines_request", deadline=30.0, pace="slow", processor=15.0)


@router.get(
    "/scenes/{identifier}/tasks",
    response_model=TaskList,
    responses=failures(404, 422, 503, 504),
    dependencies=[LANGUAGE],
)
async def list_tasks_of_scene(
    request: Request,
    identifier: SceneId,
    *,
    seed: Annotated[str | None, Query(max_length=64, description="draws parameter values for one student")] = None,
) -> Response:
    """The tasks of a built-in scene."""
    return await list_tasks(request, TasksRequest(scene=identifier, seed=seed))


@router.post("/tasks", response_model=TaskList, responses=COMPUTING)
async def list_tasks(request: Request, body: TasksRequest) -> Response:
    """The tasks of a scene that the request brings or changes."""
    return await _answered(request, TASKS, body)


@router.post("/tasks/stack", response_class=Response, responses=XML | COMPUTING)
async def export_stack(request: Request, body: StackRequest) -> Response:
    """Tasks as questions of STACK (Moodle XML): input, model answer, feedback tree made of the misconceptions."""
    answer = await service_of(request).run(STACK, question_of(request, body))
    is_text = XMLS[1] in request.headers.get("accept", "") and XMLS[0] not in request.headers["accept"]
    return Response(loads(answer)["xml"], media_type=XMLS[is_text])


@router.post("/assignments", response_model=AssignmentAnswer, responses=COMPUTING)
async def open_assignment(request: Request, body: AssignmentRequest) -> Response:
    """The tasks of an assignment; with `individual` the seed draws the student's own values."""
    return await _cached(request, ASSIGNMENT, body.model_dump() | {"lang": language_of(request)})


@router.post("/practice", response_model=PracticeAnswer, responses=COMPUTING)
async def practise(request: Request, body: PracticeRequest) -> Response:
    """An exercise drawn at random: a system and a task about it, answered by `/checks` with the scene document."""
    return await _cached(request, PRACTICE, body.model_dump() | {"lang": language_of(request)})


@router.post("/checks", response_model=VerdictAnswer, responses=COMPUTING)
async def check(request: Request, body: CheckRequest) -> Response:
    """Check one answer: any equivalent form is right, and a mistake is looked for where it is not."""
    return await _answered(request, CHECK, body)


@router.post("/checks/reading", response_model=ReadingAnswer, responses=COMPUTING)
async def read_answer(request: Request, body: ReadingRequest) -> Response:
    """What an answer is understood as, while it is written; without a verdict."""
    return await _answered(request, READING, body)


@router.post("/checks/motion", response_model=MotionAnswer, responses=COMPUTING)
async def answered_motion(request: Request, body: ReadingRequest) -> Response:
    """The scene that moves as an answer says: simulated beside the right one, it shows what a mistake does."""
    return await _answered(request, MOTION, body)


@router.post("/tasks/solution", response_model=SolutionAnswer, responses=COMPUTING)
async def solve_task(request: Request, body: SolutionRequest) -> Response:
    """The right answer to a task."""
    return await _answered(request, SOLUTION, body)


@router.post("/tasks/poll", response_model=PollAnswer, responses=COMPUTING)
async def ask_a_hall(request: Request, body: PollRequest) -> Response:
    """The result of a step among wrong ones that misconceptions lead to; nothing is counted here."""
    return await _answered(request, POLL, body)


@router.post("/checks/lines", response_model=LinesAnswer, responses=COMPUTING)
async def check_lines(request: Request, body: LinesRequest) -> Response:
    """Check a whole working line by line: the first mistake, and what follows correctly from it."""
    return await _answered(request, LINES, body)


@router.post("/checks/batch", response_model=BatchAnswer, responses=COMPUTING)
async def check_batch(request: Request, body: BatchRequest) -> Response:
    """Check several answers, of the same or of different scenes. One that takes too long is left undecided."""
    service, language = service_of(request), language_of(request)

    async def verdict(asked: SingleCheck) -> bytes:
        question = question_of(request, asked)
        job = expected(CHECK_IN_BATCH, asked, FAST)
        return unpack(await service.answer(service.key(job.target, question), job, question))

    answer = await asyncio.to_thread(pack, await checked(body.checks, verdict, language))
    return packed(request, hashlib.sha256(answer).hexdigest()[:32], answer)


@router.post("/checks/table", response_model=TableAnswer, responses=COMPUTING | TABLE)
async def check_table(request: Request, body: TableRequest) -> Response:
    """Mark the answers of a class. Rows come as they are marked where `Accept` asks for text/event-stream.

    The events: `begun` with the number of `rows`; `refused` with the `files` of a zip that could not be taken; `row`,
    as in `rows`, with its `index`; `waiting` with the `seconds` until it goes on, where the service is busy; `totals`
    of what is marked so far; then `result`, which is all but `rows`, or `problem`. text/csv gives the table of
    results. One answer that takes too long is left undecided, and without a stream what is not marked within 40 s.

    A task earns its points once: of several answers of a student the best counts. With a column `line` the rows of a
    student on a scene are a working in the order of these numbers, and what follows correctly from the last answer to
    each task before earns its share. A row that makes no sense says so, with its `row` and `column`.
    """
    service, language = service_of(request), language_of(request)
    question = body.model_dump() | {"lang": language}
    written = await service.run(PLAN, question)
    plan = await asyncio.to_thread(lambda: Plan.read(loads(written)))

    async def verdict_on(asked: RowQuestion) -> RowVerdict:
        row = asked.model_dump() | {"lang": language}
        answering = service.answer(service.key(ROW.target, row), expected(ROW, asked, FAST), row)
        return RowVerdict.model_validate_json(unpack(await service.ending.unless(answering)))

    accepted = request.headers.get("accept", "")
    if EVENTS in accepted:
        events = streamed(
            Marking(plan, verdict_on, language, STREAM_LONGEST), lambda e: report_of(e).document(language)
        )
        return StreamingResponse(kept_alive(events), media_type=EVENTS, headers=UNKEPT)
    marking = Marking(plan, verdict_on, language, BATCH_LONGEST)
    async for _ in marking.events():
        pass  # nobody watches
    if "text/csv" in accepted:
        file = {"Content-Disposition": 'attachment; filename="results.csv"'}
        return Response(await asyncio.to_thread(marking.csv), media_type="text/csv", headers=file)
    answer = await asyncio.to_thread(_packed_table, marking)
    return packed(request, hashlib.sha256(answer).hexdigest()[:32], answer)


def _packed_table(marking: Marking) -> bytes:
    return pack(dumps({"rows": marking.rows(), **marking.result()}, ensure_ascii=False).encode(errors="replace"))


async def _answered(request: Request, job: Job, body: SceneWithChanges) -> Response:
    expectation = expected(job, body, FAST) if job.pace == "fast" else job
    return await _cached(request, expectation, question_of(request, body))


async def _cached(request: Request, job: Job, question: dict[str, Any]) -> Response:
    service = service_of(request)
    key = service.key(job.target, question)
    return packed(request, key, await service.answer(key, job, question))
