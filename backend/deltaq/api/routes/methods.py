"""Integration methods."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request, Response

from ...contract.method import MethodList
from ...narration.catalog import text
from ...simulation.library import get_method, method_ids
from ...vocabulary import Language
from ..body import HeadedRoute
from ..languages import language_of
from ..responses import tagged
from .common import LANGUAGE, failures

router = APIRouter(prefix="/methods", tags=["methods"], route_class=HeadedRoute)


@router.get("", response_model=MethodList, responses=failures(422), dependencies=[LANGUAGE])
def list_methods(request: Request) -> Response:
    """The integration methods by rising order, titles in the language asked for."""
    language = language_of(request)
    return tagged(request, {"methods": [_entry(identifier, language) for identifier in method_ids()]})


def _entry(identifier: str, language: Language) -> dict[str, Any]:
    method = get_method(identifier)
    return {
        "id": method.id,
        "title": text(language, f"methods.{method.id}.title"),
        "summary": text(language, f"methods.{method.id}.summary"),
        "order": method.order,
        "stages": method.scheme.stages,
        "family": method.family,
        "adaptive": method.is_adaptive,
        "symplectic": method.is_symplectic,
    }
