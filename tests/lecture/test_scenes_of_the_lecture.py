"""The lecture's examples as scenes: time is not varied, terms know where they come from."""

from __future__ import annotations

from tests.lecture.answers import answer, steps


def test_the_variation_of_the_guided_position_leaves_time_alone() -> None:
    result = answer("guided-pendulum")["result"]
    assert result["virtual_displacements"]["bob"]["plain"] == ["l*cos(phi)*delta(phi)", "-l*sin(phi)*delta(phi)"]
    assert "omega" not in "".join(result["virtual_displacements"]["bob"]["plain"])


def test_terms_know_their_sources() -> None:
    equation = steps("elastic-pendulum")["equation:y"]
    assert sorted(equation["sources"]) == ["body:bob", "load:drive", "load:suspension", "load:weight"]
    assert r"\htmlClass{load-suspension " in equation["marked"]
    assert r"\htmlClass" not in equation["latex"]


def test_the_term_of_time_is_marked() -> None:
    assert r"\htmlClass{time-term " in steps("guided-pendulum")["total-differential:bob"]["marked"]
    assert r"time-term" not in steps("base-pendulum")["total-differential:bob"]["marked"]
