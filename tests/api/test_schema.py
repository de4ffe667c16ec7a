"""The API keeps to its own description, whatever is sent."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from tests.api.schema import drive
from tests.serving import PATIENT, served


@pytest.mark.slow
def test_answers_match_the_document(tmp_path: Path) -> None:
    with served(workers=2, **PATIENT) as service:
        found = drive(service.address, tmp_path, 2, "--phases", "examples,coverage")
    assert found.returncode == 0, found.stdout[-10_000:]
    cases = re.search(r"(\d+) generated, \d+ passed", found.stdout)
    assert cases is not None
    assert int(cases[1]) > 500
