"""A verdict as a document, with its texts in one language."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..errors import ExpressionError, Problem
from ..language.latex_printer import Typography, latex
from ..language.parser import parse
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..mechanics.scene import Scene
from ..narration.catalog import message, sentence, text, with_decimal_mark
from ..narration.matrix_writing import number_latex
from ..narration.prose import CatalogText, formula, joined
from ..narration.things import called
from .verdict import BlockTold, Counterexample, ShownReading, Slip, Verdict

AXES = "xyz"
Document = dict[str, object]


def verdict_document(verdict: Verdict, scene: Scene, language: str) -> Document:
    """{outcome, understood_as, feedback, misconception?, misconceptions?, offset?, counterexample? …}"""
    problems = problem_documents(verdict.problems, language)
    document: Document = {
        "outcome": verdict.outcome,
        "understood_as": verdict.understood_as,
        "feedback": joined(" ", _sentences(verdict, scene, language)),
        "remark": verdict.remark or None,
        "misconception": verdict.misconceptions[0] if verdict.misconceptions else None,
        "misconceptions": [_named(each, verdict, scene, language) for each in verdict.misconceptions],
        "slip": verdict.slip.kind if verdict.slip else None,
        "slips": [_slip(slip, language) for slip in verdict.slips],
        "marked": verdict.marked,
        "parts": list(verdict.parts),
        "share": 1.0 if verdict.outcome == "correct" else verdict.partial,
        "problems": problems,
        "offset": problems[0]["offset"] if problems else None,
        "counterexample": _example(verdict.counterexample, scene),
        "readings": reading_documents(verdict.readings),
        "blocks": [block.id for block in verdict.blocks],
    }
    return document


def reading_documents(readings: Iterable[ShownReading]) -> list[Document]:
    """The ways to read an answer, where there is more than one."""
    return [{"latex": one.latex, "plain": one.plain, "taken": one.taken} for one in readings]


def problem_documents(problems: Iterable[Problem], language: str) -> list[Document]:
    """Why an answer cannot be read, and where in its text."""
    return [{"code": p.code, "offset": p.offset, "length": p.length, "message": message(language, p)} for p in problems]


def _slip(slip: Slip, language: str) -> Document:
    return {
        "kind": slip.kind,
        "title": text(language, f"homework.summary.slips.{slip.kind}"),
        "latex": slip.term,
        "part": slip.part,
        "offset": slip.place.offset if slip.place else None,
        "length": slip.place.length if slip.place else None,
    }


def _named(identifier: str, verdict: Verdict, scene: Scene, language: str) -> Document:
    values = _about(verdict, scene, language)
    return {"id": identifier, "title": text(language, f"homework.misconceptions.{identifier}.title", **values)}


def _sentences(verdict: Verdict, scene: Scene, language: str) -> list[CatalogText]:
    """The outcome, what can be said of it, and the hint that leads on; never the right answer."""
    sentences = [text(language, f"homework.outcomes.{verdict.outcome}")]
    sentences += [sentence(language, problem) for problem in verdict.problems]
    if verdict.remark:
        sentences.append(_remark(verdict, scene, language))
    if verdict.misconceptions:
        key = f"homework.misconceptions.{verdict.misconceptions[0]}.hint"
        sentences.append(text(language, key, **_about(verdict, scene, language)))
    sentences += [_slip_sentence(slip, verdict, language) for slip in verdict.slips]
    if verdict.counterexample and not (verdict.misconceptions or verdict.slips):
        sentences.append(_told(verdict.counterexample, scene, language))
    return sentences


def _slip_sentence(slip: Slip, verdict: Verdict, language: str) -> CatalogText:
    """What is wrong with one term; after the hint of a misconception just which term it is in."""
    if not slip.term:
        return text(language, f"homework.slips-somewhere.{slip.kind}")
    where = "homework.feedback.terms" if slip.is_sum else "homework.feedback.term"
    key = where if verdict.misconceptions else f"homework.slips.{slip.kind}"
    return text(language, key, term=formula(slip.term))


def _remark(verdict: Verdict, scene: Scene, language: str) -> CatalogText:
    """In which sense an answer is right or wrong, with what that is on."""
    key = f"homework.remarks.{verdict.remark}"
    if verdict.remark == "divided" and verdict.nonzero:
        factors = joined(", ", (formula(rf"{factor} \neq 0") for factor in verdict.nonzero))
        return text(language, "homework.remarks.divided-by", factors=factors)
    if "member" in verdict.parameters:
        return text(language, key, member=formula(verdict.parameters["member"]))
    if verdict.blocks:
        return text(language, key, **_blocks(verdict.blocks, scene, language))
    lines = joined(", ", (_title(task, scene, language) for task in verdict.source))
    return text(language, key, **_about(verdict, scene, language), lines=lines)


def _blocks(blocks: tuple[BlockTold, ...], scene: Scene, language: str) -> dict[str, CatalogText]:
    """The block that is wrong, and the one that it needs, by their titles and letters."""
    called = (step_title(block.rule, block.about, scene, language) for block in blocks)
    named = (
        text(language, "homework.ordering.block", title=title, letter=block.id)
        for title, block in zip(called, blocks, strict=True)
    )
    return dict(zip(("block", "needed"), named, strict=False))


def step_title(rule: str, about: Mapping[str, str], scene: Scene, language: str) -> CatalogText:
    """The title of a step of the derivation."""
    names = {
        key: joined(", ", (label(one, scene, language) for one in value.split(", "))) for key, value in about.items()
    }
    return text(language, f"rules.steps.{rule}.title", **names)


def _title(task: str, scene: Scene, language: str) -> CatalogText:
    """What a task asks for, as its title says it."""
    kind, _, subject = task.partition(":")
    first, _, last = subject.rpartition(":")
    event, named = (label(name, scene, language) for name in (first or last, last))
    subjects = {"subject": named, "number": subject, "event": event} if subject else {}
    return text(language, f"homework.tasks.{kind}.title", **subjects)


def _told(example: Counterexample, scene: Scene, language: str) -> CatalogText:
    values = (f"{_typeset(name, scene)} = {_number(v, language)}" for name, v in example.state.items())
    state = joined(", ", map(formula, values))
    what = f"{_typeset(example.of, scene)} = " if example.of and not example.of.isdecimal() else ""
    yours, right = (formula(f"{what}{_number(value, language)}") for value in (example.yours, example.right))
    told = {"state": state, "yours": yours, "right": right}
    if example.of.isdecimal():
        component = formula(AXES[int(example.of) - 1])
        return text(language, "homework.feedback.counterexample-component", component=component, **told)
    if example.reference:
        values = (f"{_typeset(name, scene)} = {_number(v, language)}" for name, v in example.reference.items())
        return text(
            language, "homework.feedback.counterexample-constant", reference=joined(", ", map(formula, values)), **told
        )
    return text(language, "homework.feedback.counterexample", **told)


def _number(value: float, language: str) -> str:
    """With the decimal sign of the language, as LaTeX."""
    return with_decimal_mark(language, number_latex(value))


def _about(verdict: Verdict, scene: Scene, language: str) -> dict[str, str | CatalogText]:
    """What the texts of a misconception may speak of."""
    return {**about_texts(verdict.about, scene, language), **verdict.parameters}


def about_texts(about: str, scene: Scene, language: str) -> dict[str, CatalogText]:
    """Two names mixed up (a/b), the body of a load (load:body), or one name, as a sentence calls them."""
    parts = [label(part, scene, language) for part in about.replace(":", "/").split("/") if part]
    return {"about": joined(", ", parts[-2:] if "/" in about else parts[-1:])}


def label(name: str, scene: Scene, language: str) -> CatalogText:
    """A coordinate or parameter as a formula, a body or load by its label."""
    symbol = scene.names.get(name)
    return formula(symbol.typeset) if symbol else called(scene, name, language)


def _example(example: Counterexample | None, scene: Scene) -> Document | None:
    if example is None:
        return None
    names = [*example.state, *([example.of] if example.of else [])]
    return {
        "values": dict(example.state),
        "of": example.of,
        "yours": example.yours,
        "right": example.right,
        "reference": dict(example.reference),
        "latex": {name: _typeset(name, scene) for name in names},
    }


def _typeset(name: str, scene: Scene) -> str:
    """A symbol as the counterexample names it: phi, ddot(phi), delta(phi)."""
    try:
        tree = parse(name, scene.names, "plain").tree
    except ExpressionError:
        return name
    return latex(to_sympy(tree, Symbols(scene.names)), Typography(scene.names))
