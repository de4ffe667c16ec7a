"""Scene documents in TOML."""

from __future__ import annotations

import pytest

from deltaq.errors import Problem, RequestError
from deltaq.mechanics.toml import LONGEST, MOST_ENTRIES, read_toml

TOO_LARGE = Problem("toml-too-large", parameters={"limit": LONGEST, "most": MOST_ENTRIES})


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
        pytest.param("a = " + "9" * 5000, Problem("toml-digits"), id="digits"),
        pytest.param("a = 0x1" + "f" * 256, Problem("toml-value", "/a"), id="whole number beyond all others"),
        pytest.param("a" + ".b" * 16 + " = 1", Problem("toml-depth"), id="long key"),
        pytest.param("a" + ' . "b.c"' * 16 + " = 1", Problem("toml-depth"), id="long key of texts"),
        pytest.param("#" * (LONGEST + 1), TOO_LARGE, id="long"),
        pytest.param("a = 1\n" * (MOST_ENTRIES + 1), TOO_LARGE, id="many entries"),
    ],
)
def test_what_is_no_scene_in_toml(text: str, problem: Problem) -> None:
    with pytest.raises(RequestError) as caught:
        read_toml(text)
    assert caught.value.problems == (problem,)


@pytest.mark.parametrize(
    "text",
    [
        pytest.param('a.b.c.d = "{}"', id="quotes"),
        pytest.param("a = '{}'", id="single quotes"),
        pytest.param('a = """\n{}\n\\"""{}"""', id="three quotes"),
        pytest.param("a = '''{}\n'''", id="three single quotes"),
        pytest.param('# it\'s "{}\na = "b"  # {}', id="comments"),
    ],
)
def test_texts_and_comments_may_have_dots_and_commas(text: str) -> None:
    dots, commas = "1. " * 20 + "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t", "[{=,}]" * MOST_ENTRIES
    assert read_toml(text.replace("{}", dots))["a"]
    assert read_toml(text.replace("{}", commas, 1).replace("{}", ""))["a"]
