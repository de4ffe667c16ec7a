"""General proofs: computed once, then cached."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Request, Response

from ...contract.proof import ProofAnswer, ProofList
from ...narration.catalog import keys, text
from ..body import StrictRoute
from ..languages import language_of
from ..responses import packed, tagged
from ..service import service_of
from ..workers.job import Job
from .common import LANGUAGE, failures

router = APIRouter(prefix="/proofs", tags=["proofs"], route_class=StrictRoute)
PROVE = Job("deltaq.narration.proof:proof_request", deadline=60.0, pace="slow")


@router.get("", response_model=ProofList, responses=failures(422), dependencies=[LANGUAGE])
def list_proofs(request: Request) -> Response:
    """The proofs there are, titles in the language asked for."""
    language = language_of(request)
    entries = [{"id": name, "title": text(language, f"rules.proofs.{name}")} for name in keys(language, "rules.proofs")]
    return tagged(request, {"proofs": entries})


@router.get(
    "/{identifier}", response_model=ProofAnswer, responses=failures(404, 422, 503, 504), dependencies=[LANGUAGE]
)
async def get_proof(
    request: Request, identifier: Annotated[str, Path(description="id of the proof", examples=["dalembert-lagrange"])]
) -> Response:
    """A proof by its id: `dalembert-lagrange` leads from d'Alembert's principle to Lagrange's equations."""
    service = service_of(request)
    question = {"id": identifier[:64], "lang": language_of(request)}
    key = service.key(PROVE.target, question)
    return packed(request, key, await service.answer(key, PROVE, question))
