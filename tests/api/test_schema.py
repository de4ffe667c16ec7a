"""The API keeps to its own description, whatever is sent."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from tests.api.schema import EXPERIMENTS, cases, drive
from tests.order import place_of_the_commit
from tests.serving import PATIENT, Served, served


@pytest.fixture(scope="module")
def service() -> Iterator[Served]:
    with served(workers=2, experiment_deadline=1, **PATIENT) as one:
        yield one


SHARE = 6  # of so many requests a run makes one, unless all cases are asked for; which ones, the commit tells
DOCUMENTS = ("SceneDocument", "AssignmentDocument")  # one reader for all operations: it is enough to be asked once
READING = "/(scenes/validate|assignments)$"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("chosen", "closed", "least"),
    [
        pytest.param(
            ["--phases", "examples,coverage", "--exclude-path-regex", EXPERIMENTS], DOCUMENTS, 150, id="right and wrong"
        ),
        pytest.param(
            ["--phases", "coverage", "--mode", "negative", "--include-path-regex", EXPERIMENTS],
            DOCUMENTS,
            150,
            id="experiments that are refused",  # right ones take seconds each
        ),
        pytest.param(["--phases", "coverage", "--include-path-regex", READING], [], 150, id="documents"),
    ],
)
def test_answers_match_the_document(
    service: Served,
    tmp_path: Path,
    root: Path,
    request: pytest.FixtureRequest,
    chosen: list[str],
    closed: Sequence[str],
    least: int,
) -> None:
    share = 1 if request.config.getoption("--every-case") else SHARE
    turn = int(SHARE * place_of_the_commit(root))
    found = drive(service.address, tmp_path, 2, "--seed", "1", *chosen, closed=closed, one_in=share, turn=turn)
    assert found.returncode == 0, "\n".join(line[:500] for line in found.stdout.splitlines())
    assert cases(found) > least
