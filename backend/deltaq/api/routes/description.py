"""The OpenAPI document."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from ..body import HeadedRoute
from ..responses import tagged

router = APIRouter(route_class=HeadedRoute)


@router.get("/openapi.json", include_in_schema=False)
def get_description(request: Request) -> Response:
    """The description of the API, for programs: made at the first request, in a thread, which takes a second."""
    return tagged(request, request.app.openapi())
