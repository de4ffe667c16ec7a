"""Homework: the tasks of a scene, and answers checked."""

from __future__ import annotations

import asyncio
import hashlib
from json import loads
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response

from ..batches import checked
from ..body import StrictRoute
from ..costs import expected
from ..languages import language_of
from ..responses import packed
from ..service import pack, service_of, unpack
from ..wire.check import BatchRequest, CheckRequest, LinesRequest, ReadingRequest, SingleCheck
from ..wire.task import (
    AssignmentAnswer,
    AssignmentRequest,
    SolutionAnswer,
    SolutionRequest,
    StackRequest,
    TaskList,
    TasksRequest,
)
from ..wire.verdict import BatchAnswer, LinesAnswer, MotionAnswer, ReadingAnswer, VerdictAnswer
from ..workers.job import Job
from .common import COMPUTING, LANGUAGE, SceneId, failures, question_of

router = APIRouter(tags=["homework"], route_class=StrictRoute)
XML: dict[int | str, dict[str, Any]] = {200: {"content": {"application/xml": {"schema": {"type": "string"}}}}}
FAST = 3  # degrees of freedom
TASKS = Job("deltaq.homework.service:tasks_request", deadline=8.0)
CHECK = Job("deltaq.homework.service:check_request", deadline=15.0)
CHECK_IN_BATCH = CHECK.within(5.0)
READING = Job("deltaq.homework.service:reading_request", deadline=4.0)
SOLUTION = Job("deltaq.homework.service:solution_request", deadline=8.0)
MOTION = Job("deltaq.homework.service:motion_request", deadline=8.0)
ASSIGNMENT = Job("deltaq.homework.service:assignment_request", deadline=30.0, pace="slow", processor=15.0)
STACK = Job("deltaq.homework.service:stack_request", deadline=60.0, pace="slow", processor=30.0)
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
    return await _answered(request, TASKS, question_of(request, body))


@router.post("/tasks/stack", response_class=Response, responses=XML | COMPUTING)
async def export_stack(request: Request, body: StackRequest) -> Response:
    """Tasks as questions of STACK (Moodle XML): input, model answer, feedback tree made of the misconceptions."""
    answer = await service_of(request).run(STACK, question_of(request, body))
    return Response(loads(answer)["xml"], media_type="application/xml")


@router.post("/assignments", response_model=AssignmentAnswer, responses=COMPUTING)
async def open_assignment(request: Request, body: AssignmentRequest) -> Response:
    """The tasks of an assignment; with `individual` the seed draws the student's own values."""
    return await _answered(request, ASSIGNMENT, body.model_dump() | {"lang": language_of(request)})


@router.post("/checks", response_model=VerdictAnswer, responses=COMPUTING)
async def check(request: Request, body: CheckRequest) -> Response:
    """Check one answer: any equivalent form is right, and a mistake is looked for where it is not."""
    return await _answered(request, CHECK, question_of(request, body))


@router.post("/checks/reading", response_model=ReadingAnswer, responses=COMPUTING)
async def read_answer(request: Request, body: ReadingRequest) -> Response:
    """What an answer is understood as, while it is written; without a verdict."""
    return await _answered(request, READING, question_of(request, body))


@router.post("/checks/motion", response_model=MotionAnswer, responses=COMPUTING)
async def answered_motion(request: Request, body: ReadingRequest) -> Response:
    """The scene that moves as an answer says: simulated beside the right one, it shows what a mistake does."""
    return await _answered(request, MOTION, question_of(request, body))


@router.post("/tasks/solution", response_model=SolutionAnswer, responses=COMPUTING)
async def solve_task(request: Request, body: SolutionRequest) -> Response:
    """The right answer to a task."""
    return await _answered(request, SOLUTION, question_of(request, body))


@router.post("/checks/lines", response_model=LinesAnswer, responses=COMPUTING)
async def check_lines(request: Request, body: LinesRequest) -> Response:
    """Check a whole working line by line: the first mistake, and what follows correctly from it."""
    return await _answered(request, LINES, question_of(request, body))


@router.post("/checks/batch", response_model=BatchAnswer, responses=COMPUTING)
async def check_batch(request: Request, body: BatchRequest) -> Response:
    """Check several answers, of the same or of different scenes. One that takes too long is left undecided."""
    service, language = service_of(request), language_of(request)

    async def verdict(asked: SingleCheck) -> bytes:
        question = question_of(request, asked)
        job = expected(CHECK_IN_BATCH, question, FAST)
        return unpack(await service.answer(service.key(job.target, question), job, question))

    answer = await asyncio.to_thread(pack, await checked(body.checks, verdict, language))
    return packed(request, hashlib.sha256(answer).hexdigest()[:32], answer)


async def _answered(request: Request, job: Job, question: dict[str, Any]) -> Response:
    service = service_of(request)
    key = service.key(job.target, question)
    expectation = expected(job, question, FAST) if job.pace == "fast" else job
    return packed(request, key, await service.answer(key, expectation, question))
