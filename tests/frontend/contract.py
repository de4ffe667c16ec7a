"""Writes the page's types from the description of the API: `.venv/bin/python -m tests.frontend.contract`."""

from __future__ import annotations

import copy
import json
import tempfile
from pathlib import Path
from typing import Any

from tests.description import openapi
from tests.frontend.node import run

FRONTEND = Path(__file__).parents[2] / "frontend"
FILE = FRONTEND / "model" / "contract.d.ts"


def described() -> dict[str, Any]:
    """The description of the API as far as the page may rely on it.

    Left out are failures, which are all problem documents, and that later versions may add members to an answer: to the
    page, a member of another name is a mistake.
    """
    document = copy.deepcopy(openapi())
    for operation in (one for methods in document["paths"].values() for one in methods.values()):
        operation["responses"] = {"200": operation["responses"]["200"]}
    for schema in document["components"]["schemas"].values():
        if schema.get("additionalProperties") is True and "properties" in schema:
            del schema["additionalProperties"]
    return document


def types() -> str:
    """What openapi-typescript makes of it."""
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder) / "openapi.json", Path(folder) / "contract.d.ts"
        source.write_text(json.dumps(described()), encoding="utf-8")
        program = "node_modules/openapi-typescript/bin/cli.js"
        done = run("node", program, str(source), "--output", str(made), cwd=FRONTEND)
        assert done.returncode == 0, done.stdout + done.stderr
        return made.read_text(encoding="utf-8")


if __name__ == "__main__":
    FILE.write_text(types(), encoding="utf-8")
