"""The answer to `POST /expressions`: what a text means, as a formula and as plain text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import cast

from ..contract.expression import ExpressionRequest, ExpressionsRequest, ExpressionText
from ..contract.reading import read
from ..errors import InputError, Problem
from ..language.latex_printer import Typography, latex
from ..language.names import Names, Symbol
from ..language.parser import parse
from ..language.plain_printer import plain
from ..language.spoken_printer import SpokenPrinter
from ..language.spoken_symbols import SpokenSymbols
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..mechanics.document import names_in
from ..mechanics.library import load_scene
from .catalog import language_of
from .speech import vocabulary

Document = dict[str, object]


def typeset_request(document: Mapping[str, object]) -> Document:
    """The fields of an ExpressionRequest → {latex, plain, spoken}. Raises InputError with the offset in the text."""
    asked = read(ExpressionRequest, document)
    return _typeset(_names(asked.scene), asked, language_of(asked.lang))


def typeset_all(document: Mapping[str, object]) -> tuple[list[Document], list[tuple[Problem, ...]]]:
    """The fields of an ExpressionsRequest → for each text its answer, and what is wrong with it.

    One never spoils another.
    """
    asked = read(ExpressionsRequest, document)
    names, language = _names(asked.scene), language_of(asked.lang)
    tried = [_attempt(names, text, language) for text in asked.expressions]
    return [answer for answer, _ in tried], [problems for _, problems in tried]


def _attempt(names: Names, text: ExpressionText, language: str) -> tuple[Document, tuple[Problem, ...]]:
    try:
        return _typeset(names, text, language), ()
    except InputError as error:
        return {"latex": "", "plain": "", "spoken": ""}, tuple(
            replace(problem, pointer="") for problem in error.problems
        )


def _names(scene: object) -> Names:
    """The names of a built-in scene, or those of a document that may still be faulty elsewhere."""
    return load_scene(scene).names if isinstance(scene, str) else names_in(cast("Mapping[str, object]", scene))


def _typeset(names: Names, text: ExpressionText, language: str) -> Document:
    known = _with_material(names, text.material)
    try:
        tree = parse(text.expression, known, text.syntax).tree
        value = to_sympy(tree, Symbols(known))
    except InputError as error:
        raise type(error)(*(problem.below("/expression") for problem in error.problems)) from None
    spoken = SpokenPrinter(SpokenSymbols(known, vocabulary(language))).text(value)
    return {"latex": latex(value, Typography(known)), "plain": plain(value), "spoken": spoken}


def _with_material(names: Names, material: Sequence[str]) -> Names:
    """Material coordinates too; one that cannot be a name is told at its own field, not here."""
    try:
        return Names((*names.symbols[:-2], *(Symbol(name, "material") for name in material)))
    except InputError:
        return names
