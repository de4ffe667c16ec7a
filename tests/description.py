"""The API's own description, made once for all processes of a run."""

from __future__ import annotations

import json
import os
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from deltaq.api.app import create_app
from deltaq.api.service import source_digest
from deltaq.settings import Settings

FOLDER = Path(__file__).parents[1] / ".pytest_cache" / "descriptions"
MAKERS = ("fastapi", "pydantic")


@cache
def openapi() -> dict[str, Any]:
    """The OpenAPI document, kept on disk under the names of all that it is made from.

    It is shared: whoever changes it changes a copy.
    """
    kept = FOLDER / ("-".join((source_digest(), *map(version, MAKERS))) + ".json")
    if not kept.exists():
        FOLDER.mkdir(parents=True, exist_ok=True)
        fresh = kept.with_suffix(f".{os.getpid()}")
        fresh.write_text(json.dumps(create_app(Settings(workers=1)).openapi()), encoding="utf-8")
        fresh.replace(kept)
    found: dict[str, Any] = json.loads(kept.read_text(encoding="utf-8"))
    return found
