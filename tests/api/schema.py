"""Requests made from the OpenAPI document, right and wrong, and answers held to it.

Run it for long from the checkout: `python -m tests.api.schema 20000` makes at least so many of them, and an eighth of
that of the experiments, which take seconds each. Loopback only; it ends by itself, with 1 if anything was found.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path

import httpx
from tests.serving import PATIENT, served

# What the document allows may still be refused for its meaning: a scene with an unknown name, say.
TOO_STRICT = "positive_data_acceptance"
LAST = re.compile(r"(\d+) generated")
EXPERIMENTS = "/experiments/"  # each takes seconds where it is not refused
ALL = "examples,coverage,fuzzing"
# An experiment that would take longer is answered as the document says: 504, too large.
DEADLINE = 5  # seconds
# Where the document has 504, that is an answer, if its time has come (see schema_hooks). With one client 503 is none.
SETTINGS = """
[checks.negative_data_rejection]
expected-statuses = [400, 401, 403, 404, 405, 406, 409, 413, 415, 422, 428, 429, "5xx"]

[[operations]]
exclude-path-regex = "/(health|ready|version|metrics|catalogs|methods)"
checks.not_a_server_error.expected-statuses = ["2xx", "3xx", "4xx", "504"]
"""


@dataclass(frozen=True)
class Part:
    """Some of the operations: how they are chosen, how many examples of each in one round, their share of the cases."""

    name: str
    chosen: tuple[str, str]
    examples: int
    share: float


PARTS = (
    Part("all else", ("--exclude-path-regex", EXPERIMENTS), 100, 1.0),
    Part("experiments", ("--include-path-regex", EXPERIMENTS), 30, 0.125),
)


def drive(
    address: str, folder: Path, examples: int, *options: str, closed: Sequence[str] = (), one_in: int = 1, turn: int = 0
) -> subprocess.CompletedProcess[str]:
    """Run schemathesis over the document; it ends with 0 if nothing was found.

    The schemas named `closed` are any object, so that no cases are made of what is inside of them. Of `one_in` cases
    that could be made one is; every `turn` below that has others, and all of them together make all.
    """
    (folder / "schemathesis.toml").write_text(SETTINGS, encoding="utf-8")
    document = httpx.get(f"{address}api/v1/openapi.json", timeout=60).json()  # it may only just begin
    document["components"]["schemas"] |= {name: {"type": "object"} for name in closed}
    (folder / "openapi.json").write_text(json.dumps(document), encoding="utf-8")
    command = [sys.executable, "-m", "schemathesis.cli", "run", "openapi.json", "--url", address, "--no-color"]
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
        "SCHEMATHESIS_HOOKS": "tests.api.schema_hooks",
        "SCHEMA_ONE_IN": str(one_in),
        "SCHEMA_TURN": str(turn),
        "PYTHONPATH": str(Path(__file__).parents[2]),
    }
    whole = [*command, *chosen, *effort]
    return subprocess.run(whole, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def cases(found: subprocess.CompletedProcess[str]) -> int:
    """How many requests were made."""
    said = LAST.search(found.stdout)
    assert said is not None, found.stdout[-10_000:] + found.stderr[-10_000:]
    return int(said[1])


def rounds(address: str, wanted: int, part: Part) -> bool:
    """Round after round with other examples, until there were enough; whether nothing was found."""
    made = 0
    for seed in count(1):
        with tempfile.TemporaryDirectory() as folder:
            options = ["--phases", ALL, "--seed", str(seed), *part.chosen]
            found = drive(address, Path(folder), part.examples, *options)
        made += cases(found)
        print(f"{part.name}: {made} cases, {'something' if found.returncode else 'nothing'} found", flush=True)
        print(found.stderr, end="", flush=True)
        if found.returncode:
            print(found.stdout, flush=True)
        if found.returncode or made >= wanted * part.share:
            return not found.returncode
    raise AssertionError("count ends")


def run(wanted: int, parts: Sequence[Part] = PARTS) -> bool:
    """All parts beside one another; whether nothing was found."""
    with served(experiment_deadline=DEADLINE, **PATIENT) as service, ThreadPoolExecutor() as executor:
        return all(list(executor.map(partial(rounds, service.address, wanted), parts)))


if __name__ == "__main__":
    sys.exit(not run(int(sys.argv[1])))
