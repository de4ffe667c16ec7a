"""The API keeps to its own description, whatever is sent."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.api.schema import EXPERIMENTS, cases, drive
from tests.serving import PATIENT, served


@pytest.mark.slow
def test_answers_match_the_document(tmp_path: Path) -> None:
    with served(workers=2, **PATIENT) as service:
        chosen = ["--phases", "examples,coverage", "--seed", "1", "--exclude-path-regex", EXPERIMENTS]
        found = drive(service.address, tmp_path, 2, *chosen)
    assert found.returncode == 0, found.stdout[-10_000:]
    assert cases(found) > 500
