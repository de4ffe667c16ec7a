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

from ...contract.assignment import AssignmentDocument
from ...errors import Problem, RequestError
from ...language.latex_printer import Typography, latex
from ...language.spelling import in_unicode
from ...mechanics.scene import Scene
from ...mechanics.user_text import UserText, in_language, translated
from ...narration.catalog import text
from ...narration.prose import CatalogText, joined, pieces, words
from ..assignment import resolved
from ..equality import Parts, kept_by_constraints, symmetry, where_kept
from ..equality.frequencies import number_of
from ..feedback import about_texts
from ..partwise import DECIDED, part_share
from ..sampling import close
from ..statement import task_document
from ..task import Task
from ..workbook import Candidate, Workbook
from .answer_tests import (
    ANSWER,
    EMPTY,
    READABLE,
    RIGHT,
    SHARE,
    feedback_variables,
    question_variables,
    same,
    value,
)
from .maxima import maxima_name
from .states import States

VERSION = "2025030700"
MOST_MISCONCEPTIONS = 8
PENALTY = "0.1"
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
    "checkanswertype": "0",
    "mustverify": "1",
    "showvalidation": "1",
    "options": "",
}


@dataclass(frozen=True)
class Node:
    """One node of a potential response tree: what must be true, what it tells then, which score it gives, and answers
    that come to it with the score of each.
    """

    test: str
    note: str
    feedback: str
    score: str = "0"
    tried: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class Asked:
    """A task to be exported, and what it counts if not what its quantity does."""

    workbook: Workbook
    task: Task
    points: float | None = None


def quiz(workbook: Workbook, tasks: Iterable[Task], language: str) -> str:
    """The XML document of several questions about one scene; see `left_out`."""
    return _document([Asked(workbook, task) for task in tasks], language)


def sheet_quiz(sheet: AssignmentDocument, language: str) -> str:
    """The XML document of a whole assignment: its tasks in their order, in a category of its title; see `left_out`."""
    title = in_language(translated(sheet.title), language)
    return _document(asked_in(sheet), language, [_category(title)] if title else [])


def asked_in(sheet: AssignmentDocument) -> list[Asked]:
    """The tasks of an assignment."""
    return [Asked(*resolved(assigned, None), assigned.points) for assigned in sheet.tasks]


def _document(asked: Sequence[Asked], language: str, first: Iterable[Element] = ()) -> str:
    """What STACK cannot judge is named in a comment. Raises RequestError where it can judge nothing."""
    told = left_out(asked)
    if told and len(told) == len(asked):
        raise RequestError(Problem("stack-none", "/tasks", parameters={"tasks": ", ".join(told)}))
    root = Element("quiz")
    if told:
        root.append(Comment(f" {text(language, 'homework.stack.left-out', tasks=', '.join(told))} "))
    root.extend(first)
    root.extend(question(one, language) for one in asked if one.task.id not in told)
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def left_out(asked: Iterable[Asked]) -> list[str]:
    """The tasks whose answers Maxima cannot compare.

    Words, positions, what other integrals may be added to, and what is equal only where constraints are kept.
    """
    return [one.task.id for one in asked if not _is_comparable(one)]


def _is_comparable(asked: Asked) -> bool:
    quantity, bound = asked.task.quantity, bool(asked.workbook.solution.conditions)
    where_kept_only = bound and quantity.equality in (kept_by_constraints, where_kept)
    return quantity.judge is None and quantity.equality is not symmetry and not where_kept_only


def _category(title: UserText) -> Element:
    """Where Moodle puts the questions that follow; a slash would open another category."""
    element = Element("question", type="category")
    _text(element, "category", f"$course$/top/{_in_a_name(words(title)).replace('/', '//')}")
    return element


def question(asked: Asked, language: str) -> Element:
    """One task as a question of type stack."""
    workbook, task = asked.workbook, asked.task
    points = task.quantity.points if asked.points is None else asked.points
    told = task_document(task, workbook, language)
    nodes = list(_nodes(workbook, task, language))
    element = Element("question", type="stack")
    _text(element, "name", _name(workbook.scene, words(told["title"]), language))
    _text(element, "questiontext", _statement(workbook, task, words(told["statement"]), language), "html")
    _text(element, "generalfeedback", _solution(workbook, task), "html")
    for name, content in (("defaultgrade", f"{points:g}"), ("penalty", PENALTY), ("hidden", "0")):
        SubElement(element, name).text = content
    SubElement(element, "idnumber").text = ""
    _text(element, "stackversion", VERSION)
    _text(element, "questionvariables", question_variables(workbook, task))
    _text(element, "specificfeedback", "<p>[[feedback:prt1]]</p>", "html")
    _text(element, "questionnote", f"{workbook.scene.id}, {task.id}", "html")
    _text(element, "questiondescription", "", "html")
    for name, content in {**SETTINGS, "decimals": "," if language == "de" else "."}.items():
        SubElement(element, name).text = content
    _input(element, [maxima_name(symbol.name) for symbol in States(workbook, task).symbols])
    _tree(element, feedback_variables(workbook, task), nodes)
    for number, (tried, index) in enumerate(_tried(nodes), 1):
        element.append(_test(number, tried, index, nodes))
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
    """The name of a question, in which Moodle knows no way to quote, and typesets nothing."""
    told = scene.title.get(language) or UserText(scene.id)
    return _in_a_name(joined(": ", [told, title]))


def _in_a_name(sentence: CatalogText) -> str:
    """Words and formulas as one line of signs that mean nothing to Moodle: φ₁ for \\varphi_{1}."""
    told = "".join(in_unicode(each.text) if each.is_formula else each.text for each in pieces(sentence))
    return _MARKUP.sub("", told.replace("＄", "").replace("\\", ""))


def _statement(workbook: Workbook, task: Task, statement: CatalogText, language: str) -> str:
    """What is asked, how its symbols are typed, and the field."""
    typography = Typography(workbook.scene.names)
    symbols = States(workbook, task).symbols
    names = [(maxima_name(s.name), typography.symbol(s.name)) for s in symbols]
    spelling = ", ".join(rf"<code>{escape(name)}</code> \({escape(shown)}\)" for name, shown in names)
    summary = inert(workbook.scene.summary.get(language, UserText("")).line)
    form = text(language, f"homework.stack.forms.{task.quantity.form}")
    write = text(language, "homework.stack.write", form=form)
    return (
        f"<p>{summary}</p>\n<p>{_html(statement)}</p>\n<p>{_html(write)} {spelling}</p>\n"
        f"<p>[[input:{ANSWER}]]</p>\n<div>[[validation:{ANSWER}]]</div>"
    )


def _solution(workbook: Workbook, task: Task) -> str:
    typography = Typography(workbook.scene.names)
    ending = " = 0" if task.quantity.form in ("equation", "equations") else ""
    return "\n".join(rf"<p>\[{escape(latex(part, typography))}{ending}\]</p>" for part in workbook.shown(task))


def _input(parent: Element, names: Sequence[str]) -> None:
    """The field; what is longer than two letters and not named here cannot be typed."""
    element = SubElement(parent, "input")
    allowed = {"allowwords": ",".join(name for name in names if len(name) > 2)}
    for name, content in {"name": ANSWER, "type": "algebraic", "tans": "ta1", **INPUT, **allowed}.items():
        SubElement(element, name).text = content


def _nodes(workbook: Workbook, task: Task, language: str) -> Iterable[Node]:
    """What cannot be read, says nothing, is right, is one misconception after the other, or is right in part."""
    unreadable = _html(text(language, "homework.stack.unreadable"))
    yield Node(f"not {READABLE}", "unreadable", unreadable, tried=(("[]", 0.0),))
    if task.quantity.form in ("equation", "equations") or task.quantity.kind == "conserved":
        empty = ", ".join(["0 = 0"] * len(workbook.right(task)))
        nothing = {"equations": f"[{empty}]", "equation": empty}.get(task.quantity.form, "1")
        yield Node(EMPTY, "degenerate", _html(text(language, "homework.remarks.degenerate")), SHARE, ((nothing, 0.0),))
    right = value(task, workbook.shown(task))
    yield Node(RIGHT, "correct", _html(text(language, "homework.outcomes.correct")), "1", ((right, 1.0),))
    for candidate in islice(_different(workbook, task), MOST_MISCONCEPTIONS):
        wrong = workbook.short(candidate.parts)
        about = about_texts(candidate.solution.about, workbook.scene, language)
        hint = _html(text(language, f"homework.misconceptions.{candidate.solution.id}.hint", **about))
        tried = ((value(task, wrong), part_share(workbook, task, wrong)),)
        yield Node(same(task, wrong), candidate.solution.id, hint, SHARE, tried)
    if parts := tuple(_partly_right(workbook, task)):
        yield Node(f"is({SHARE} > 0)", "partly", _html(text(language, "homework.stack.partly")), SHARE, parts)


def _partly_right(workbook: Workbook, task: Task) -> Iterable[tuple[str, float]]:
    """An answer of which one part is right, if there is one."""
    for changed in _one_right(task, workbook.shown(task)):
        share = part_share(workbook, task, changed)
        if 0 < share < 1:
            yield value(task, changed), share
            return


def _one_right(task: Task, parts: Parts) -> Iterable[Parts]:
    """Answers that keep one part: the others are changed, missing, or, where there are none, one too many."""
    if task.quantity.form == "vector":
        for kept in parts:
            yield tuple(part if part in (0, kept) else part + 7 for part in parts)
    elif task.quantity.form in DECIDED:
        yield parts[:1] if len(parts) > 1 else (*parts, 2 * parts[0])


def _different(workbook: Workbook, task: Task) -> Iterable[Candidate]:
    """The candidates whose misconception and whose answer were not there before."""
    seen: list[Candidate] = []
    for candidate in workbook.candidates(task):
        if _can_be_typed(workbook, task, candidate) and not any(_is_alike(candidate, other) for other in seen):
            seen.append(candidate)
            yield candidate


def _can_be_typed(workbook: Workbook, task: Task, candidate: Candidate) -> bool:
    """A set holds no value twice, and zero is no frequency."""
    if task.quantity.form != "set":
        return True
    numbers = {f"{number_of(part, workbook.solution):.6g}" for part in candidate.parts}
    return len(numbers) == len(candidate.parts) and not numbers & {"0", "nan"}


def _is_alike(one: Candidate, other: Candidate) -> bool:
    same_answer = len(one.fingerprint) == len(other.fingerprint) and close(one.fingerprint, other.fingerprint)
    return one.solution.id == other.solution.id or same_answer


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
    head = {"name": str(number), "description": node.note, "answertest": "AlgEquiv", "sans": node.test}
    for name, content in {**head, "tans": "true", "testoptions": "", "quiet": "1"}.items():
        SubElement(element, name).text = content
    branches = (("true", node.score, -1, node.feedback), ("false", "0", following, ""))
    for branch, score, goes, told in branches:
        penalty = "0" if node.note == "correct" and branch == "true" else ""
        values = {"scoremode": "=", "score": score, "penalty": penalty, "nextnode": str(goes)}
        for name, content in {**values, "answernote": _mark(number, branch)}.items():
            SubElement(element, branch + name).text = content
        _text(element, f"{branch}feedback", told, "html")
    return element


def _mark(number: int, branch: str) -> str:
    return f"prt1-{number + 1}-{branch[0].upper()}"


def _tried(nodes: Sequence[Node]) -> Iterable[tuple[tuple[str, float], int]]:
    """The answers that the question is tested with, and the node each comes to."""
    for index, node in enumerate(nodes):
        for tried in node.tried:
            yield tried, index


def _test(number: int, tried: tuple[str, float], index: int, nodes: Sequence[Node]) -> Element:
    """A test of the question, as STACK runs it: an answer, its score, and the note of the branch that it leaves by."""
    typed, score = tried
    element = Element("qtest")
    SubElement(element, "testcase").text = str(number)
    SubElement(element, "description").text = nodes[index].note
    given, expected = SubElement(element, "testinput"), SubElement(element, "expected")
    for name, content in (("name", ANSWER), ("value", typed)):
        SubElement(given, name).text = content
    note, penalty = _mark(index, "true"), "0" if score == 1 else PENALTY
    told = {"score": f"{score:.3f}", "penalty": penalty, "answernote": note}
    SubElement(expected, "name").text = "prt1"
    for name, content in told.items():
        SubElement(expected, f"expected{name}").text = content
    return element
