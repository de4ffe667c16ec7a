"""The API's own description, made once for all tests of a process."""

from __future__ import annotations

from functools import cache
from typing import Any

from deltaq.api.app import create_app
from deltaq.settings import Settings


@cache
def openapi() -> dict[str, Any]:
    """The OpenAPI document. It is shared: whoever changes it changes a copy."""
    return create_app(Settings(workers=1)).openapi()
