"""The API keeps to its own description, whatever is sent."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.api.schema import EXPERIMENTS, cases, drive
from tests.serving import PATIENT, Served, served


@pytest.fixture(scope="module")
def service() -> Iterator[Served]:
    with served(workers=2, experiment_deadline=1, **PATIENT) as one:
        yield one


@pytest.mark.slow
@pytest.mark.parametrize(
    ("chosen", "least"),
    [
        pytest.param(["--phases", "examples,coverage", "--exclude-path-regex", EXPERIMENTS], 500, id="right and wrong"),
        pytest.param(
            ["--phases", "coverage", "--mode", "negative", "--include-path-regex", EXPERIMENTS],
            500,
            id="experiments that are refused",  # right ones take seconds each
        ),
    ],
)
def test_answers_match_the_document(service: Served, tmp_path: Path, chosen: list[str], least: int) -> None:
    found = drive(service.address, tmp_path, 2, "--seed", "1", *chosen)
    assert found.returncode == 0, found.stdout[-10_000:]
    assert cases(found) > least
