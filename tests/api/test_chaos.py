from __future__ import annotations

import sys

import pytest
from tests.api.chaos import run


@pytest.mark.skipif(sys.platform != "linux", reason="finds the workers in /proc")
def test_no_answer_is_wrong_and_no_service_lost_in_chaos() -> None:
    tally = run(60)
    assert tally.wrong == []
    assert tally.kills >= 60
    assert tally.damages > 20
    assert tally.statuses.keys() <= {200, 503}
    assert tally.statuses[200] > 5 * tally.statuses[503]
