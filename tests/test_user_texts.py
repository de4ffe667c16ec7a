"""What users write is words in every form: whatever it is, a document holds the same live parts as with plain words.

Each payload stands in every text of a scene at once: title, summary, labels of a point, a body and two loads, the title
of an event, units.
"""

from __future__ import annotations

import ast
import copy
import csv
import io
import json
import tokenize
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from string import Formatter
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from tests.hostile import CONSTRUCTS, KINDS
from tests.live import castext_live, html_live, markdown_live, tex_live

from deltaq.commands.derive import _notebook
from deltaq.derivation.engine import USUAL, derive
from deltaq.derivation.step import Derivation
from deltaq.derivation.system import System
from deltaq.handout.document import Handout, written_down
from deltaq.handout.latex import latex_file
from deltaq.handout.markdown import markdown_file
from deltaq.handout.script import script
from deltaq.homework.results import Graded, results_csv
from deltaq.homework.stack.question import quiz
from deltaq.homework.statement import task_document
from deltaq.homework.table import Style
from deltaq.homework.workbook import Workbook, workbook_of
from deltaq.lab.charts.chart import chart
from deltaq.lab.charts.words import words as chart_words
from deltaq.lab.export import page, table
from deltaq.mechanics.document import examine, read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.user_text import FORMULA, UserText, translated
from deltaq.mechanics.writing import write_scene
from deltaq.narration.catalog import LANGUAGES, catalog, template, text
from deltaq.narration.outcome import explained
from deltaq.narration.prose import CatalogText, formula, joined, pieces, words

PLAIN = "plain words"
COMMON = [*KINDS["markup"], *KINDS["LaTeX"], *KINDS["LaTeX tricks"]]
CORPUS = list(dict.fromkeys([*CONSTRUCTS, *COMMON[::3]]))
PARTS = [pytest.param(CORPUS[n::8], id=f"{n}, {n + 8} …") for n in range(8)]
DOCUMENT: dict[str, Any] = {
    "format": 1,
    "id": "texts",
    "coordinates": [{"name": "x", "value": 0.5}],
    "parameters": [{"name": "m"}, {"name": "k"}, {"name": "c"}],
    "points": [{"name": "wall", "position": ["0", "0"]}],
    "bodies": [{"name": "block", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
    "loads": [
        {"name": "push", "kind": "force", "at": "block", "force": ["-c*dot(x)", "0"]},
        {"name": "pull", "kind": "potential", "energy": "k*x^2/2"},
    ],
    "events": [{"name": "end", "value": "1 - x"}],
}


def scene_with(payload: str) -> Scene:
    """The scene with the payload in all of its texts."""
    both = translated(payload)
    return replace(
        bare(),
        title=both,
        summary=both,
        labels=dict.fromkeys(("wall", "block", "push", "pull"), both),
        coordinates=tuple(replace(each, unit=payload) for each in bare().coordinates),
        parameters=tuple(replace(each, unit=payload) for each in bare().parameters),
        events=tuple(replace(each, title=both) for each in bare().events),
    )


@cache
def bare() -> Scene:
    return read_scene(DOCUMENT)


@cache
def derived() -> Derivation:
    """The steps that speak of a thing by its name; which there are does not hang on what it is called."""
    whole = derive(scene_with(PLAIN), USUAL)[1]
    named = {step.rule: step for step in whole.steps() if {"place", "load"} & step.about.keys()}
    assert len(named) > 5
    steps = tuple(replace(step, substeps=()) for step in named.values())
    return replace(whole, chapters=(replace(whole.chapters[0], steps=steps),))


@cache
def book() -> Workbook:
    workbook = workbook_of({"scene": write_scene(scene_with(PLAIN))})
    quiz(workbook, wanted(workbook), "en")
    return workbook


def wanted(workbook: Workbook) -> list[Any]:
    return [workbook.task(identifier) for identifier in ("position:block", "virtual-work")]


def handout(payload: str, language: str) -> Handout:
    return written_down(System(scene_with(payload)), derived(), language)


def latex(told: Handout) -> object:
    """Line by line, for each of them is whole; before the first come the commands of the file."""
    head, _, body = latex_file(told).partition("\n\\title")
    return [tex_live(line) for line in (head, *f"\\title{body}".split("\n"))]


def markdown(told: Handout) -> object:
    return markdown_live(markdown_file(told))


def notebook(told: Handout) -> object:
    """Kinds of cells; each is a part of the Markdown."""
    text = markdown_file(told)
    cells = json.loads(_notebook(text, "pass"))["cells"]
    assert "\n".join("".join(cell["source"]) for cell in cells[:-1]) == text
    return [cell["cell_type"] for cell in cells]


def narration(told: Handout) -> object:
    """The formulas of all sentences, with those that the page typesets beside them."""
    lines = [line for part in told.parts for line in part.lines]
    spoken = [[p.text for p in pieces(s) if p.is_formula] for line in lines for s in (line.title, line.text)]
    return spoken, [tex_live(line.latex) for line in lines]


FORMS: dict[str, Callable[[Handout], object]] = {form.__name__: form for form in (latex, markdown, notebook, narration)}


def forms_of(told: Handout) -> dict[str, object]:
    return {name: form(told) for name, form in FORMS.items()}


def harmless_like(payload: str) -> str:
    """A text of signs that cannot be seen is none."""
    return PLAIN if UserText(payload).line else ""


def language_for(payload: str) -> str:
    """Both are looked at, one for each payload."""
    return LANGUAGES[CORPUS.index(payload) % 2]


def test_there_are_many_payloads() -> None:
    assert len(CORPUS) >= 200


@pytest.mark.one_in(8)
@pytest.mark.parametrize("part", PARTS)
def test_no_payload_is_live_in_a_derivation(part: list[str]) -> None:
    harmless = {(lang, plain): forms_of(handout(plain, lang)) for lang in LANGUAGES for plain in (PLAIN, "")}
    for payload in part:
        language = language_for(payload)
        assert forms_of(handout(payload, language)) == harmless[language, harmless_like(payload)], payload


def program(payload: str) -> tuple[str, list[str]]:
    """What Python makes of the program, and its tokens without comments."""
    source = script(scene_with(payload), language_for(payload) if payload in CORPUS else "en", 1.0)
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return ast.dump(ast.parse(source)), [token.string for token in tokens if token.type != tokenize.COMMENT]


@pytest.mark.one_in(4)
@pytest.mark.parametrize("part", PARTS)
def test_no_payload_leaves_its_comment_in_a_program(part: list[str]) -> None:
    harmless = program(PLAIN)
    for payload in part:
        assert program(payload) == harmless, payload


def asked(payload: str) -> Workbook:
    """The workbook of the scene with the payload; what was computed for the scene does not hang on its texts."""
    workbook = copy.copy(book())
    object.__setattr__(workbook, "scene", scene_with(payload))
    return workbook


def stack(payload: str, language: str) -> object:
    root = ET.fromstring(quiz(asked(payload), wanted(asked(payload)), language))
    texts = [(each.tag, castext_live("".join(each.itertext()))) for each in root.iter() if each.get("format") == "html"]
    names = [castext_live("".join(each.itertext())) for each in root.iter("name")]
    others = [each.text for each in root.iter() if not len(each) and each.tag not in ("text", "questiontext")]
    return texts, names, others


def statements(payload: str, language: str) -> list[str]:
    told = [task_document(task, asked(payload), language) for task in wanted(asked(payload))]
    sentences = [words(text) for one in told for text in (one["title"], one["statement"], *_hints(one))]
    return [piece.text for sentence in sentences for piece in pieces(sentence) if piece.is_formula]


def _hints(told: Mapping[str, object]) -> list[object]:
    hints = told["hints"]
    assert isinstance(hints, list)
    return hints


@pytest.mark.one_in(8)
@pytest.mark.parametrize("part", PARTS)
def test_no_payload_is_live_in_questions(part: list[str]) -> None:
    harmless = {(lang, text): (stack(text, lang), statements(text, lang)) for lang in LANGUAGES for text in (PLAIN, "")}
    for payload in part:
        language = language_for(payload)
        found = stack(payload, language), statements(payload, language)
        assert found == harmless[language, harmless_like(payload)], payload


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_no_payload_is_a_formula_of_a_spreadsheet(separator: str) -> None:
    told = [[payload] * 5 + [1.0, 2.0] + [payload] * 5 + [2, "", payload, 0] + [payload] * 3 for payload in CORPUS]
    rows = [Graded(*each, 1, False, 1.0, 1.0) for each in told]  # type: ignore[arg-type]
    written = results_csv(rows, Style(separator), dated=True).decode()
    read = list(csv.reader(io.StringIO(written, newline=""), delimiter=separator))
    assert len(read) == len(CORPUS) + 1
    for row, payload in zip(read[1:], CORPUS, strict=True):
        lines = payload.replace("\r\n", "\n").replace("\r", "\n").encode(errors="replace").decode()
        assert len(row) == 15
        assert {row[place] for place in (0, 4, 9, 10, 14)} <= {lines, f"'{lines}"}, payload
    assert [cell for row in read for cell in row if cell.strip(" \u00a0").startswith(FORMULA)] == []


RIGID = "ladder.kinds.rigid.title"


def charts(payload: str) -> list[dict[str, Any]]:
    """A chart with a curve that bears a name of the scene's, as the labs draw them."""
    say = chart_words(text, "en")
    title = say(RIGID, **{field: {"en": payload} for field in placeholders(RIGID)})
    trace = {"type": "scatter", "name": title, "text": [title], "x": [1.0], "y": [2.0]}
    return [chart("texts", title, title, [trace], xaxis={"title": {"text": title}}) | {"subject": payload}]


def placeholders(key: str) -> set[str]:
    return {field for _, field, _, _ in Formatter().parse(template("en", key)) if field}


def test_no_payload_is_live_in_charts() -> None:
    assert placeholders(RIGID)
    every = [one for payload in CORPUS for one in charts(payload)]
    harmless = [one for _ in CORPUS for one in charts(PLAIN)]
    drawn = [text for one in every for text in (one["data"][0]["name"], one["layout"]["xaxis"]["title"]["text"])]
    assert [text for text in drawn if "<" in text or ">" in text] == []
    assert html_live(page(every[::4], "en")) == html_live(page(harmless[::4], "en"))
    cells = [cell for row in csv.reader(io.StringIO(table(every), newline="")) for cell in row]
    assert [cell for cell in cells if cell.strip(" \u00a0").startswith(FORMULA)] == []


def test_what_happened_is_told_in_words() -> None:
    """The title of an event stands in a sentence that nobody typesets: it is there as it was written."""
    reason = {"code": "event", "parameters": {"t": 1.0, "name": "end"}}
    for payload in CORPUS:
        answer = {"reason": reason, "event": {"name": "end", "title": {"en": payload}}, "choice": None}
        assert (payload or "end") in explained(answer, "en")["reason"] or "＄" in payload


SYMBOLS = [
    r"^^5cinput{x}",
    r"^^5cinput{^^2fetc^^2fpasswd}",
    "x^",
    "x_",
    "x^{}^",
    r"\mathrm",
    r"x_\bar",
    r"\text}",
    "x^^",
    "_",
    "{x^}",
]


@pytest.mark.parametrize("key", ["coordinates", "parameters"])
def test_symbols_of_a_user_are_symbols(key: str) -> None:
    """The LaTeX of a coordinate or parameter is refused, or does nothing but set letters, also with a power to it."""
    document = copy.deepcopy(DOCUMENT)
    for latex in [*SYMBOLS, *CORPUS]:
        document[key][0]["latex"] = latex
        scene, problems = examine(document)
        refused = {problem.pointer for problem in problems if problem.severity == "error"}
        assert (scene is None) == (refused == {f"/{key}/0/latex"}), latex
        raised = {kind for kind, _ in tex_live(f"{latex}^{{2}}_{{3}}")}
        assert scene is None or not {"hidden", "comment", "parameter", "active", "unmatched"} & raised, latex
        assert scene is None or latex not in SYMBOLS, latex


def test_a_users_text_does_not_become_a_string_by_itself() -> None:
    for joining in (str, "{}".format, lambda text: f"{text}", "%s".__mod__):
        with pytest.raises(TypeError):
            joining(UserText("x"))


def test_only_the_catalogs_hold_formulas() -> None:
    assert [piece.is_formula for piece in pieces(joined("$", [formula("x"), UserText("$y$"), "$z$"]))] == [True, False]
    assert not isinstance(CatalogText("$x$").replace("x", "$"), CatalogText)
    with pytest.raises(ValueError, match="dollar"):
        formula("x$ y $z")


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_placeholder_stands_in_a_formula(language: str) -> None:
    """What is put in there would be typeset whatever it is."""

    def texts(entry: object) -> list[str]:
        return (
            [found for value in entry.values() for found in texts(value)]
            if isinstance(entry, Mapping)
            else [str(entry)]
        )

    for sentence in texts(catalog(language)):
        bare = sentence.replace("{{", "").replace("}}", "")
        assert not any("{" in part and "\\" not in part for part in bare.split("$")[1::2]), sentence
