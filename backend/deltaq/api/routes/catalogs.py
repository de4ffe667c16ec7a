"""The sentences of the page and the service, by language."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response

from ...contract.catalog import Sentences
from ...errors import Problem, UnknownNameError
from ...narration.catalog import catalog
from ..body import HeadedRoute
from ..languages import LANGUAGES
from ..responses import tagged
from .common import failures

router = APIRouter(prefix="/catalogs", tags=["catalogs"], route_class=HeadedRoute)


@router.get("/{lang}", response_model=dict[str, Sentences], responses=failures(404, 422))
def get_catalog(
    request: Request,
    lang: Annotated[str, Path(description=f"language: {' or '.join(LANGUAGES)}", examples=["en"])],
    sections: Annotated[str, Query(description="only these, by commas", examples=["methods,statuses"])] = "",
) -> Response:
    """All sentences of a language by sections (rules, errors, statuses, page, methods …), or only some sections."""
    known = next((one for one in LANGUAGES if one == lang), None)
    if known is None:
        parameters = {"name": lang[:16], "known": ", ".join(LANGUAGES)}
        raise UnknownNameError(Problem("request-unknown-language", parameters=parameters))
    wanted = set(sections[:200].split(",")) if sections else set(catalog(known))
    return tagged(request, {name: part for name, part in catalog(known).items() if name in wanted})
