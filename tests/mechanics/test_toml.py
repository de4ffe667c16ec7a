"""Scene documents in TOML."""

from __future__ import annotations

import pytest

from deltaq.errors import Problem, RequestError
from deltaq.mechanics.toml import read_toml


def test_a_scene_in_the_manner_of_the_files() -> None:
    text = 'format = 1\ntitle = { de = "Pendel" }\n\n[[coordinates]]\nname = "φ"\nvalue = 0.5\n'
    found = read_toml(text)
    assert found == {"format": 1, "title": {"de": "Pendel"}, "coordinates": [{"name": "φ", "value": 0.5}]}


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        pytest.param(
            "a = 1\nb = = 2", Problem("toml-syntax", "", 10, 1, parameters={"line": 2, "column": 5}), id="two"
        ),
        pytest.param("a = [1,", Problem("toml-syntax", "", 7, 1, parameters={"line": 1, "column": 8}), id="end"),
        pytest.param(
            "a = 1\r\na = 2", Problem("toml-syntax", "", 12, 1, parameters={"line": 2, "column": 6}), id="twice"
        ),
        pytest.param("a = " + "[" * 5000, Problem("toml-depth"), id="nested"),
        pytest.param("[x]\nday = 2026-11-21", Problem("toml-value", "/x/day"), id="date"),
        pytest.param('["a/b~c"]\nday = 2026-11-21', Problem("toml-value", "/a~1b~0c/day"), id="pointer is escaped"),
        pytest.param('a = [1.0, inf]\n"b/c" = 1', Problem("toml-value", "/a/1"), id="infinite"),
    ],
)
def test_what_is_no_scene_in_toml(text: str, problem: Problem) -> None:
    with pytest.raises(RequestError) as caught:
        read_toml(text)
    assert caught.value.problems == (problem,)
