"""The API keeps to its own description, whatever is sent: requests made from the OpenAPI document, right and wrong."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.serving import served

# What the document allows may still be refused for its meaning: a scene with an unknown name, say.
TOO_STRICT = "positive_data_acceptance"
# Experiments take seconds each; TOML has no serializer. Both have tests of their own.
LEFT_OUT = "/experiments/|/scenes/toml"


def drive(address: str, folder: Path, examples: int, *options: str) -> subprocess.CompletedProcess[str]:
    """Run schemathesis over the whole document; it ends with 0 if nothing was found."""
    command = [sys.executable, "-m", "schemathesis.cli", "run", f"{address}api/v1/openapi.json", "--no-color"]
    chosen = ["--checks", "all", "--exclude-checks", TOO_STRICT, "--exclude-path-regex", LEFT_OUT]
    effort = ["--max-examples", str(examples), "--seed", "1", "--continue-on-failure", *options]
    return subprocess.run([*command, *chosen, *effort], cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_answers_match_the_document(tmp_path: Path) -> None:
    with served(workers=2) as service:
        found = drive(service.address, tmp_path, 2, "--phases", "examples,coverage")
    assert found.returncode == 0, found.stdout[-10_000:]
    cases = re.search(r"(\d+) generated, \d+ passed", found.stdout)
    assert cases is not None
    assert int(cases[1]) > 500
