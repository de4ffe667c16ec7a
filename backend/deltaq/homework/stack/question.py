"""Questions as Moodle XML: statement, input, model answer and a potential response tree made of the misconceptions.

Source: STACK documentation and the questions that STACK itself exports (element names and their order).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from itertools import islice
from xml.etree.ElementTree import Comment, Element, SubElement, indent, tostring

from ...errors import Problem, RequestError
from ...language.latex_printer import Typography, latex
from ...mechanics.scene import Scene
from ...mechanics.user_text import UserText
from ...narration.catalog import text
from ...narration.prose import CatalogText, joined, pieces, plain, words
from ..equality import symmetry
from ..feedback import about_texts
from ..statement import task_document
from ..task import Task
from ..workbook import Candidate, Workbook
from .answer_tests import ANSWER, degenerate, difference, preparation, value
from .maxima import maxima_name

VERSION = "2025030700"
MOST_MISCONCEPTIONS = 8
_MARKUP = re.compile(r"[\[\]{}@#$<>&\"'`|~]")
_TYPESET = str.maketrans(
    {"$": "＄", "\\": "＼"}
)  # entities do not hide these, for formulas are sought in the finished page
SETTINGS = {
    "questionsimplify": "1",
    "assumepositive": "0",
    "assumereal": "1",
    "decimals": ".",
    "scientificnotation": "*10",
    "multiplicationsign": "dot",
    "sqrtsign": "1",
    "complexno": "i",
    "inversetrig": "cos-1",
    "logicsymbol": "lang",
    "matrixparens": "[",
    "variantsselectionseed": "",
}
INPUT = {
    "boxsize": "60",
    "strictsyntax": "1",
    "insertstars": "1",
    "syntaxhint": "",
    "syntaxattribute": "0",
    "forbidwords": "",
    "allowwords": "",
    "forbidfloat": "0",
    "requirelowestterms": "0",
    "checkanswertype": "1",
    "mustverify": "1",
    "showvalidation": "1",
    "options": "",
}


@dataclass(frozen=True)
class Node:
    """One node of a potential response tree: a test, what it tells, the score if it holds, and where to go else."""

    sans: str
    tans: str
    note: str
    feedback: str
    score: str = "0"


def quiz(workbook: Workbook, tasks: Sequence[Task], language: str) -> str:
    """The XML document of several questions. Those that STACK cannot judge are named in a comment.

    Raises RequestError where it can judge none.
    """
    told = left_out(tasks)
    if told and len(told) == len(tasks):
        raise RequestError(Problem("stack-none", "/tasks", parameters={"tasks": ", ".join(told)}))
    root = Element("quiz")
    if told:
        root.append(Comment(f" {text(language, 'homework.stack.left-out', tasks=', '.join(told))} "))
    for task in tasks:
        if task.id not in told:
            root.append(question(workbook, task, language))
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def left_out(tasks: Iterable[Task]) -> list[str]:
    """The tasks whose answers Maxima cannot compare: words, positions, and what other integrals may be added to."""
    return [task.id for task in tasks if task.quantity.judge is not None or task.quantity.equality is symmetry]


def question(workbook: Workbook, task: Task, language: str) -> Element:
    """One task as a question of type stack."""
    told = task_document(task, workbook, language)
    right = workbook.shown(task)
    element = Element("question", type="stack")
    _text(element, "name", _name(workbook.scene, words(told["title"]), language))
    _text(element, "questiontext", _statement(workbook, task, words(told["statement"]), language), "html")
    _text(element, "generalfeedback", _solution(workbook, task), "html")
    for name, content in (("defaultgrade", f"{task.quantity.points:g}"), ("penalty", "0.1"), ("hidden", "0")):
        SubElement(element, name).text = content
    SubElement(element, "idnumber").text = ""
    _text(element, "stackversion", VERSION)
    _text(element, "questionvariables", f"ta1: {value(task, right)};")
    _text(element, "specificfeedback", "<p>[[feedback:prt1]]</p>", "html")
    _text(element, "questionnote", f"{workbook.scene.id}, {task.id}", "html")
    _text(element, "questiondescription", "", "html")
    for name, content in SETTINGS.items():
        SubElement(element, name).text = content
    _input(element)
    _tree(element, preparation(task), list(_nodes(workbook, task, language)))
    return element


def _text(parent: Element, name: str, content: str, form: str = "") -> None:
    element = SubElement(parent, name, {"format": form} if form else {})
    SubElement(element, "text").text = content


def _html(sentence: CatalogText) -> str:
    """A sentence of the catalogs: formulas stand between \\(…\\) in Moodle, the rest is plain text."""
    return "".join(rf"\({escape(each.text)}\)" if each.is_formula else inert(each.text) for each in pieces(sentence))


def inert(text: str) -> str:
    """Words that mean nothing to CASText, to HTML, to the filters of Moodle, and to what typesets the page at last."""
    return _MARKUP.sub(lambda sign: f"&#{ord(sign[0])};", text.translate(_TYPESET))


def _name(scene: Scene, title: CatalogText, language: str) -> str:
    """The name of a question, in which Moodle knows no way to quote."""
    told = scene.title.get(language) or UserText(scene.id)
    return _MARKUP.sub("", joined(": ", [told, plain(title)]).replace("＄", "").replace("\\", ""))


def _statement(workbook: Workbook, task: Task, statement: CatalogText, language: str) -> str:
    """What is asked, how its symbols are typed, and the field."""
    typography = Typography(workbook.scene.names)
    used = {s for part in workbook.shown(task) for s in part.free_symbols}
    names = sorted((maxima_name(s.name), typography.symbol(s.name)) for s in used)
    spelling = ", ".join(rf"<code>{escape(name)}</code> \({escape(shown)}\)" for name, shown in names)
    summary = inert(workbook.scene.summary.get(language, UserText("")).line)
    form = text(language, f"homework.forms.{'list' if task.quantity.form == 'equations' else task.quantity.form}")
    write = text(language, "homework.stack.write", form=form if task.quantity.form != "set" else "{a, b}")
    return (
        f"<p>{summary}</p>\n<p>{_html(statement)}</p>\n<p>{_html(write)} {spelling}</p>\n"
        f"<p>[[input:{ANSWER}]]</p>\n<div>[[validation:{ANSWER}]]</div>"
    )


def _solution(workbook: Workbook, task: Task) -> str:
    typography = Typography(workbook.scene.names)
    ending = " = 0" if task.quantity.form in ("equation", "equations") else ""
    return "\n".join(rf"<p>\[{escape(latex(part, typography))}{ending}\]</p>" for part in workbook.shown(task))


def _input(parent: Element) -> None:
    element = SubElement(parent, "input")
    for name, content in {"name": ANSWER, "type": "algebraic", "tans": "ta1", **INPUT}.items():
        SubElement(element, name).text = content


def _nodes(workbook: Workbook, task: Task, language: str) -> Iterable[Node]:
    """What says nothing, what is right, then one misconception after the other."""
    empty = degenerate(task, workbook.solution)
    if empty is not None:
        yield Node(*empty, "degenerate", _html(text(language, "homework.remarks.degenerate")))
    right = difference(task, workbook.shown(task), workbook.solution)
    yield Node(*right, "correct", _html(text(language, "homework.outcomes.correct")), "1")
    for candidate in islice(_different(workbook, task), MOST_MISCONCEPTIONS):
        wrong = difference(task, workbook.short(candidate.parts), workbook.solution)
        about = about_texts(candidate.solution.about, workbook.scene, language)
        hint = text(language, f"homework.misconceptions.{candidate.solution.id}.hint", **about)
        yield Node(*wrong, candidate.solution.id, _html(hint))


def _different(workbook: Workbook, task: Task) -> Iterable[Candidate]:
    """The candidates whose misconception was not there before."""
    seen: set[str] = set()
    for candidate in workbook.candidates(task):
        if candidate.solution.id not in seen:
            seen.add(candidate.solution.id)
            yield candidate


def _tree(parent: Element, variables: str, nodes: Sequence[Node]) -> None:
    element = SubElement(parent, "prt")
    for name, content in (("name", "prt1"), ("value", "1"), ("autosimplify", "1"), ("feedbackstyle", "1")):
        SubElement(element, name).text = content
    _text(element, "feedbackvariables", variables)
    for number, node in enumerate(nodes):
        last = number == len(nodes) - 1
        element.append(_node(number, node, -1 if last else number + 1))


def _node(number: int, node: Node, following: int) -> Element:
    element = Element("node")
    head = {"name": str(number), "description": node.note, "answertest": "AlgEquiv", "sans": node.sans}
    for name, content in {**head, "tans": node.tans, "testoptions": "", "quiet": "1"}.items():
        SubElement(element, name).text = content
    branches = (("true", node.score, -1, node.feedback), ("false", "0", following, ""))
    for branch, score, goes, told in branches:
        mark = f"prt1-{number}-{'T' if branch == 'true' else 'F'}"
        values = {"scoremode": "=", "score": score, "penalty": "", "nextnode": str(goes), "answernote": mark}
        for name, content in values.items():
            SubElement(element, branch + name).text = content
        _text(element, f"{branch}feedback", told, "html")
    return element
