"""Derivations: computed once, then known by their content hash.

The longest of the built-in ones, twelve links, takes 7 s of a processor; nearly all others less than 0.5 s.
"""

from __future__ import annotations

import re
from functools import partial
from typing import Annotated, Any

from fastapi import APIRouter, Path, Request, Response

from ...contract.derivation import DerivationAnswer, DerivationRequest
from ...errors import Problem, UnknownNameError
from ..body import StrictRoute
from ..chapters import Chapters
from ..costs import expected
from ..responses import packed
from ..samples import BY_ID
from ..service import Service, service_of
from ..workers.job import Job
from .common import COMPUTING, PREFIX, failures, question_of

ID = re.compile("[0-9a-f]{32}")
router = APIRouter(prefix="/derivations", tags=["derivations"], route_class=StrictRoute)
DERIVE = Job("deltaq.api.jobs:derive", deadline=5.0)
FAST = 6  # degrees of freedom


@router.post("", response_model=DerivationAnswer, responses=COMPUTING)
async def derive(request: Request, body: DerivationRequest) -> Response:
    """Derive the equations of motion of a scene, step by step."""
    service = service_of(request)
    identifier, question = named(question_of(request, body))
    job = expected(DERIVE.within(service.settings.derivation_deadline), body, FAST)
    document = {"id": identifier, "request": question, "seconds": service.settings.derivation_deadline}
    compute = partial(service.parts, _key(identifier), job, document)
    found = await Chapters(identifier, question["lang"], service.cache, compute).answer(body.chapters)
    if found.name == "all":
        return packed(request, identifier, found.answer, f"{PREFIX}/derivations/{identifier}")
    return packed(request, f"{identifier}-{found.name}", found.answer)


@router.get("/{identifier}", response_model=DerivationAnswer, responses=failures(404), openapi_extra=BY_ID)
async def get_derivation(
    request: Request, identifier: Annotated[str, Path(description="the id that the derivation came with")]
) -> Response:
    """A derivation that was asked for before. It never changes; one that is no longer kept must be asked for again."""
    answer = await service_of(request).cache.find(_key(identifier)) if ID.fullmatch(identifier) else None
    if answer is None:
        raise UnknownNameError(Problem("unknown-derivation"))
    return packed(request, identifier, answer, f"{PREFIX}/derivations/{identifier}")


def named(question: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """The id of the derivation that a request asks for, and the request without which chapters are asked for."""
    whole = {key: value for key, value in question.items() if key != "chapters"}
    return derivation_id(whole), whole


def derivation_id(question: dict[str, Any]) -> str:
    """The id of a derivation, in whatever way it is asked for: the hash of request and code."""
    return Service.key(DERIVE.target, question)


def _key(identifier: str) -> str:
    """Where the cache has it: answers of other kinds are under no id."""
    return f"{identifier}.derivation"
