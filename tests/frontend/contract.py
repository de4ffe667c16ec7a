"""Writes the page's types from the description of the API: `.venv/bin/python -m tests.frontend.contract`."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

from tests.frontend.node import run

from deltaq.api.app import create_app
from deltaq.settings import Settings

FRONTEND = Path(__file__).parents[2] / "frontend"
FILE = FRONTEND / "model" / "contract.d.ts"
OPTIONS = ("--default-non-nullable", "false")


def types() -> str:
    """What openapi-typescript makes of the schemas. The page writes its addresses itself, so paths are left out."""
    document = create_app(Settings(workers=1)).openapi()
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder) / "openapi.json", Path(folder) / "contract.d.ts"
        source.write_text(json.dumps({**document, "paths": {}}), encoding="utf-8")
        program = "node_modules/openapi-typescript/bin/cli.js"
        done = run("node", program, str(source), *OPTIONS, "--output", str(made), cwd=FRONTEND)
        assert done.returncode == 0, done.stdout + done.stderr
        return made.read_text(encoding="utf-8")


if __name__ == "__main__":
    FILE.write_text(types(), encoding="utf-8")
