"""Where bodies lose hold of what they lie on: the events of the standard problems against the angles of books."""

from __future__ import annotations

import pytest
from tests.mechanics.published import read
from tests.mechanics.test_problems import BY_TOPIC, document

from deltaq.simulation.service import run

ENDING = [pytest.param(topic, id=topic) for topic, row in BY_TOPIC.items() if "end" in row]


@pytest.mark.parametrize("topic", ENDING)
def test_a_body_leaves_where_the_book_says(topic: str) -> None:
    answer = run({"scene": document(BY_TOPIC[topic]), "t_end": 60.0, "tolerance": 1e-10, "samples": 11, "lang": "en"})
    assert answer["status"] == "event"
    for q, text in BY_TOPIC[topic]["end"].items():
        assert answer["coordinates"][q][-1] == pytest.approx(float(read(text)), abs=1e-9)
