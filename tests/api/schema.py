"""Requests made from the OpenAPI document, right and wrong, and answers held to it.

Run it for long from the checkout: `python -m tests.api.schema 20000` makes at least so many of them. Loopback only; it
ends by itself, with 1 if anything was found.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.serving import PATIENT, served

# What the document allows may still be refused for its meaning: a scene with an unknown name, say.
TOO_STRICT = "positive_data_acceptance"
LAST = re.compile(r"(\d+) generated")
EXPERIMENTS = "/experiments/"  # each takes seconds where it is not refused
ALL = "examples,coverage,fuzzing"
FIRST = 100  # examples of each operation
# An experiment that would take longer is answered as the document says: 504, too large.
DEADLINE = 15  # seconds
SETTINGS = """
[[operations]]
include-path-regex = "/experiments/"
checks.not_a_server_error.expected-statuses = ["2xx", "3xx", "4xx", "504"]
"""


def drive(address: str, folder: Path, examples: int, *options: str) -> subprocess.CompletedProcess[str]:
    """Run schemathesis over the whole document; it ends with 0 if nothing was found."""
    (folder / "schemathesis.toml").write_text(SETTINGS, encoding="utf-8")
    command = [sys.executable, "-m", "schemathesis.cli", "run", f"{address}api/v1/openapi.json", "--no-color"]
    chosen = [
        "--checks",
        "all",
        "--exclude-checks",
        TOO_STRICT,
        "--request-timeout",
        "300",
        "--max-response-time",
        "120",
    ]
    effort = ["--max-examples", str(examples), "--continue-on-failure", *options]
    environment = os.environ | {
        "SCHEMATHESIS_HOOKS": "tests.api.toml_bodies",
        "PYTHONPATH": str(Path(__file__).parents[2]),
    }
    whole = [*command, *chosen, *effort]
    return subprocess.run(whole, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def cases(found: subprocess.CompletedProcess[str]) -> int:
    """How many requests were made."""
    said = LAST.search(found.stdout)
    assert said is not None, found.stdout[-10_000:] + found.stderr[-10_000:]
    return int(said[1])


def run(wanted: int) -> bool:
    """Round after round with other examples, until there were enough; whether nothing was found."""
    made, seed = 0, 0
    with served(experiment_deadline=DEADLINE, **PATIENT) as service, tempfile.TemporaryDirectory() as name:
        while made < wanted:
            seed += 1
            for part, examples in (("--exclude-path-regex", FIRST), ("--include-path-regex", FIRST // 10)):
                chosen = ["--phases", ALL, "--seed", str(seed), part, EXPERIMENTS]
                found = drive(service.address, Path(name), examples, *chosen)
                made += cases(found)
                print(f"{made} cases, {'nothing' if found.returncode == 0 else 'something'} found", flush=True)
                if found.returncode:
                    print(found.stdout)
                    return False
    return True


if __name__ == "__main__":
    sys.exit(not run(int(sys.argv[1])))
