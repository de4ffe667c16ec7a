"""Derivations: computed once, then known by their content hash.

The longest of the built-in ones, twelve links, takes 7 s of a processor; nearly all others less than 0.5 s.
"""

from __future__ import annotations

import re
from typing import Annotated, Any

from fastapi import APIRouter, Path, Request, Response

from ...contract.derivation import DerivationAnswer, DerivationRequest
from ...errors import Problem, UnknownNameError
from ..body import StrictRoute
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
    question = question_of(request, body)
    identifier = derivation_id(question)
    job = expected(DERIVE.within(service.settings.derivation_deadline), body, FAST)
    answer = await service.answer(_key(identifier), job, {"id": identifier, "request": question})
    return packed(request, identifier, answer, f"{PREFIX}/derivations/{identifier}")


@router.get("/{identifier}", response_model=DerivationAnswer, responses=failures(404), openapi_extra=BY_ID)
async def get_derivation(
    request: Request, identifier: Annotated[str, Path(description="the id that the derivation came with")]
) -> Response:
    """A derivation that was asked for before. It never changes; one that is no longer kept must be asked for again."""
    answer = await service_of(request).cache.find(_key(identifier)) if ID.fullmatch(identifier) else None
    if answer is None:
        raise UnknownNameError(Problem("unknown-derivation"))
    return packed(request, identifier, answer, f"{PREFIX}/derivations/{identifier}")


def derivation_id(question: dict[str, Any]) -> str:
    """The id of the derivation that a request asks for, in whatever way it is asked: the hash of request and code."""
    return Service.key(DERIVE.target, question)


def _key(identifier: str) -> str:
    """Where the cache has it: answers of other kinds are under no id."""
    return f"{identifier}.derivation"
