"""Charts: valid figures, and a text for every state in both languages."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from functools import cache
from typing import Any

import plotly.graph_objects as go
import pytest
from pydantic import BaseModel

from deltaq.contract.experiment import ExperimentRequest
from deltaq.contract.figure import Chart
from deltaq.lab.charts.chart import look
from deltaq.lab.charts.words import called, in_symbols, spoken, words
from deltaq.lab.charts.work_precision import STORY
from deltaq.lab.experiment import drawn
from deltaq.lab.export import page, table
from deltaq.lab.library import experiment_ids, get_experiment
from deltaq.lab.peers import PEERS
from deltaq.lab.report import Report
from deltaq.lab.subject import subject_of
from deltaq.narration.catalog import keys, text
from deltaq.simulation.library import method_ids
from deltaq.simulation.outcome import NO_DIRECTION, outcome_of

AXES = {
    "x": {"parameter": "omega", "from": 20.0, "to": 80.0, "count": 8},
    "y": {"parameter": "y0", "from": 0.02, "to": 0.1, "count": 8},
}
# Questions that take little time; an experiment that is not named is asked for the motion of a pendulum.
QUESTIONS: dict[str, dict[str, Any]] = {key: {"scene": "pendulum", "t_end": 1.0} for key in experiment_ids()} | {
    "work-precision": {"scene": "pendulum", "t_end": 1.0, "methods": ["rk4", "explicit-euler", "radau-5"]},
    "convergence": {"scene": "elastic-pendulum", "t_end": 1.0, "parameters": {"k": 5000.0}},
    "energy-drift": {"scene": "pendulum", "steps": 1000},
    "stability": {"scene": "elastic-pendulum", "t_end": 1.0, "methods": ["rk4", "stormer-verlet"]},
    "stability-map": {"scene": "kapitza", **AXES},
    "chaos": {"scene": "double-pendulum", "t_end": 2.0, "map": True, "count": 16},
    "fidelity": {"scene": "elastic-pendulum", "t_end": 2.0},
    "bifurcation": {
        "scene": "driven-pendulum",
        "sweep": {"parameter": "gamma", "from": 1.06, "to": 1.07, "count": 8},
        "crossings": 6,
        "skip": 20,
        "folds": 1,
    },
    "poincare-section": {"scene": "coupled-pendulums", "t_end": 6.0, "count": 2, "crossings": 5},
    "uncertainty": {"scene": "coupled-pendulums", "t_end": 6.0, "runs": 70},
    "basins": {"scene": "magnetic-pendulum", "count": 12, "pairs": 30, "t_end": 10.0},
}


@cache
def reports(name: str) -> tuple[Report, ...]:
    return tuple(get_experiment(name).run(QUESTIONS[name]))


@pytest.mark.one_in(4)
@pytest.mark.parametrize("name", QUESTIONS)
@pytest.mark.parametrize("lang", ["de", "en"])
def test_charts_are_valid_figures_from_the_first_report_on(name: str, lang: str) -> None:
    experiment, say = get_experiment(name), words(text, lang)
    first, *_, last = reports(name)
    for report in (first, reports(name)[len(reports(name)) // 2], last):
        for chart in experiment.charts(report.result, say):
            go.Figure({"data": chart["data"], "layout": chart["layout"]})  # Plotly refuses what it does not know
    charts = drawn(experiment, last.result, text, lang)
    assert all(chart["subject"].startswith(last.result["title"][lang]) for chart in charts)  # type: ignore[index]
    assert table(charts).count("\n") > 10
    assert page(charts, lang).count("<figure>") == len(charts)


@pytest.mark.parametrize("name", QUESTIONS)
def test_charts_have_no_member_of_which_their_description_is_silent(name: str) -> None:
    experiment = get_experiment(name)
    *_, last = reports(name)
    charts = json.loads(json.dumps(drawn(experiment, last.result, text, "en")))
    assert charts
    assert [place for chart in charts for place in silent(Chart.model_validate(chart), "chart")] == []


def silent(found: object, place: str) -> Iterator[str]:
    """Where in an answer there is a member that is not declared."""
    if isinstance(found, BaseModel):
        yield from (f"{place}.{name}" for name in found.model_extra or {})
        for name in type(found).model_fields:
            yield from silent(getattr(found, name), f"{place}.{name}")
    elif isinstance(found, tuple):
        for one in found:
            yield from silent(one, place)


def mentions(found: object, key: str) -> bool:
    """Whether a document has such a member anywhere."""
    if isinstance(found, dict):
        return key in found or any(mentions(one, key) for one in found.values())
    return isinstance(found, list) and any(mentions(one, key) for one in found)


@pytest.mark.parametrize("name", list(QUESTIONS))
def test_a_time_says_when_and_under_which_load_it_was_measured(name: str) -> None:
    before = datetime.now(UTC).replace(microsecond=0)
    result = next(get_experiment(name).run(QUESTIONS[name])).result
    if not mentions(result, "time"):
        return
    measured = result["taken"]
    assert isinstance(measured, dict)
    assert before <= datetime.fromisoformat(measured["date"]) <= datetime.now(UTC)
    assert measured["load"] is None or measured["load"] >= 0.0
    assert measured["repetitions"] >= 1
    assert measured["processors"] == os.cpu_count()


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        pytest.param("phi1", "φ₁", id="a coordinate"),
        pytest.param("dot(phi1)", "φ̇₁", id="its rate"),
        pytest.param("dot(phi1)^2 - 2*phi2", "φ̇₁² - 2·φ₂", id="both in a formula"),
        pytest.param("sin(omega*t) + phi", "sin(ω·t) + phi", id="functions, and what the scene does not know"),
        pytest.param("phi1^12 - x_phi1", "φ₁¹² - x_phi1", id="a name within another is none"),
        pytest.param("bob", "bob", id="a part that has a word, no symbol"),
    ],
)
def test_expressions_are_shown_by_the_symbols_of_the_scene(written: str, shown: str) -> None:
    names = {"phi1": "φ₁", "phi2": "φ₂", "omega": "ω", "bob": {"de": "Kugel", "en": "bob"}}
    assert in_symbols({"names": names}, written) == shown


def test_the_plane_of_a_section_and_its_energy_are_told_with_symbol_and_unit() -> None:
    *_, last = reports("poincare-section")
    for lang, told in (("en", "J where φ₁ = 0"), ("de", "J, wo φ₁ = 0 ist")):
        (chart, *_) = get_experiment("poincare-section").charts(last.result, words(text, lang))
        assert told in chart["caption"]
        assert chart["layout"]["yaxis"]["title"]["text"] == "φ̇₂"


@pytest.mark.parametrize("lang", ["de", "en"])
def test_date_and_load_stand_in_the_caption_also_where_no_load_is_known(
    lang: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def unknown() -> tuple[float, float, float]:
        raise OSError

    monkeypatch.setattr(os, "getloadavg", unknown)
    experiment = get_experiment("work-precision")
    result = next(experiment.run(QUESTIONS["work-precision"])).result
    measured = result["taken"]
    assert isinstance(measured, dict)
    assert measured["load"] is None
    caption = experiment.charts(result, words(text, lang))[0]["caption"]
    assert f"{measured['date'][:10]} {measured['date'][11:16]} UTC" in caption
    assert " – " in caption


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", ["convergence", "work-precision"])
def test_a_run_without_a_result_has_no_number_in_the_table(name: str) -> None:
    stiff = {"scene": "elastic-pendulum", "t_end": 0.2, "parameters": {"k": 1e8}, "methods": ["explicit-euler", "rk4"]}
    *_, last = get_experiment(name).run(stiff)
    rows = list(csv.DictReader(io.StringIO(table(drawn(get_experiment(name), last.result, text, "en")))))
    assert [row for row in rows if not row["curve"]] == []
    failed = [row for row in rows if row["curve"].endswith(": no result")]
    assert "Explicit Euler: no result" in {row["curve"] for row in failed}
    assert {row["y"] for row in failed} == {""}


def test_charts_write_symbols_and_the_words_of_the_scene() -> None:
    names = {"omega": "ω", "phi": "q₂", "suspension": {"de": "Feder", "en": "spring"}}
    result = {"names": names}
    assert [called(result, name) for name in ("omega", "omega, phi", "other")] == ["ω", "ω, q₂", "other"]
    assert [spoken(called(result, "suspension"), lang) for lang in ("de", "en", "fr")] == ["Feder", "spring", "Feder"]
    subject = subject_of(ExperimentRequest(scene="elastic-pendulum"))
    assert {name: subject.described["names"][name] for name in ("phi", "l", "suspension")} == {
        "phi": "q₂",
        "l": "ℓ",
        "suspension": {"de": "Feder", "en": "spring"},
    }


def test_methods_are_told_apart_by_look() -> None:
    colors = [look(name)["color"] for name in method_ids()] + [look(name)["color"] for name in PEERS]
    assert len(set(colors)) == len(colors)
    assert len({(look(name)["symbol"], look(name)["dash"]) for name in method_ids()}) == len(method_ids())


def point_of(method: str) -> dict[str, Any]:
    return {
        "method": method,
        "tolerance": 0.1,
        "status": "ok",
        "error": 0.01,
        "evaluations": 9,
        "time": 1e-4,
        "times": [],
    }


@pytest.mark.parametrize(
    ("methods", "hidden"),
    [
        pytest.param(method_ids(), set(method_ids()) - set(STORY), id="all"),
        pytest.param((*method_ids(), "scipy-RK45"), set(method_ids()) - set(STORY), id="with peers"),
        pytest.param(("heun", "rk4", "newmark"), set(), id="few"),
        pytest.param(tuple(set(method_ids()) - set(STORY[1:])), set(), id="no story"),
    ],
)
def test_of_many_methods_five_are_shown_and_the_others_are_a_click_away(
    methods: Sequence[str], hidden: set[str]
) -> None:
    *_, last = reports("work-precision")
    result = last.result | {"points": [point_of(method) for method in methods], "orders": {}}
    for chart in get_experiment("work-precision").charts(result, words(text, "en")):
        away = {trace["legendgroup"] for trace in chart["data"] if trace.get("visible") == "legendonly"}
        assert away == hidden
        assert ("a click on its name" in chart["caption"]) == bool(hidden)


def test_peers_are_told_apart_by_symbol() -> None:
    assert len({look(name)["symbol"] for name in PEERS}) == len({look(name)["color"] for name in PEERS}) == len(PEERS)


def test_what_a_peer_compiled_is_told_apart() -> None:
    *_, last = reports("work-precision")
    point = point_of("heyoka") | {"preparation": 0.75}
    result = last.result | {"points": [*last.result["points"], point], "orders": {}}
    by_time, by_work = get_experiment("work-precision").charts(result, words(text, "en"))
    assert "heyoka compiled for 0.75 s" in by_time["caption"]
    assert "compiled for" not in by_work["caption"]
    (trace,) = (trace for trace in by_time["data"] if trace["legendgroup"] == "heyoka")
    assert trace["name"] == "heyoka"
    assert "compiled for 0.75 s before" in trace["text"][0]


def test_every_way_to_end_has_its_words_and_no_word_is_left_over() -> None:
    ends = {outcome_of(kernel, {}).status for kernel in range(NO_DIRECTION + 1)}
    seen = {"unresolved", "step_blind", "guide_jumps", "horizon_reached", "tolerance_missed", "too_slow", "singular"}
    assert set(keys("en", "labs.status")) == ends | seen


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        pytest.param(None, "–", id="none"),
        pytest.param(0.0, "0", id="zero"),
        pytest.param(-0.0, "0", id="zero from below"),
        pytest.param(1.5, "1,5", id="comma"),
        pytest.param(7, 7, id="whole"),
        pytest.param("dop853", "dop853", id="word"),
        pytest.param(1e-14, "1·10⁻¹⁴", id="small"),
        pytest.param(12345.0, "1,23·10⁴", id="large"),
        pytest.param(-2e-7, "−2·10⁻⁷", id="negative"),
    ],
)
def test_numbers_are_written_as_they_are_printed(number: object, expected: object) -> None:
    assert spoken(number, "de") == expected
