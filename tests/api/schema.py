"""Requests made from the OpenAPI document, right and wrong, and answers held to it.

Run it for long from the checkout: `python -m tests.api.schema 200` makes some 20,000 of them. Loopback only; it ends by
itself, with 1 if anything was found.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from tests.serving import PATIENT, served

# What the document allows may still be refused for its meaning: a scene with an unknown name, say.
TOO_STRICT = "positive_data_acceptance"
# Experiments take seconds each; TOML has no serializer. Both have tests of their own.
LEFT_OUT = "/experiments/|/scenes/toml"


def drive(address: str, folder: Path, examples: int, *options: str) -> subprocess.CompletedProcess[str]:
    """Run schemathesis over the whole document; it ends with 0 if nothing was found."""
    command = [sys.executable, "-m", "schemathesis.cli", "run", f"{address}api/v1/openapi.json", "--no-color"]
    chosen = ["--checks", "all", "--exclude-checks", TOO_STRICT, "--exclude-path-regex", LEFT_OUT]
    patience = ["--request-timeout", "300"]
    effort = ["--max-examples", str(examples), "--seed", "1", "--continue-on-failure", *patience, *options]
    return subprocess.run([*command, *chosen, *effort], cwd=folder, capture_output=True, text=True, check=False)


if __name__ == "__main__":
    with served(**PATIENT) as service, tempfile.TemporaryDirectory() as name:
        found = drive(service.address, Path(name), int(sys.argv[1]), "--phases", "examples,coverage,fuzzing")
    print(found.stdout)
    sys.exit(found.returncode)
