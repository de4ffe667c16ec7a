"""The answer to `POST /expressions`: what a text means, as a formula and as plain text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import cast

from ..errors import InputError, Problem
from ..language.latex_printer import Typography, latex
from ..language.names import Names, Symbol
from ..language.parser import Syntax, parse
from ..language.plain_printer import plain
from ..language.spoken_printer import SpokenPrinter
from ..language.spoken_symbols import SpokenSymbols
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..mechanics.document import names_in
from ..mechanics.library import load_scene
from .catalog import language_in
from .speech import vocabulary

Document = dict[str, object]


def typeset_request(document: Mapping[str, object]) -> Document:
    """{scene, expression, syntax, material} → {latex, plain}. Raises InputError with the offset in the text."""
    return _typeset(_names(document["scene"]), document, language_in(document))


def typeset_all(document: Mapping[str, object]) -> tuple[list[Document], list[tuple[Problem, ...]]]:
    """{scene, expressions} → for each text {latex, plain}, and what is wrong with it; one never spoils another."""
    names = _names(document["scene"])
    texts = cast("Sequence[Mapping[str, object]]", document["expressions"])
    language = language_in(document)
    answers, problems = zip(*(_attempt(names, text, language) for text in texts), strict=True) if texts else ((), ())
    return list(answers), list(problems)


def _attempt(names: Names, text: Mapping[str, object], language: str) -> tuple[Document, tuple[Problem, ...]]:
    try:
        return _typeset(names, text, language), ()
    except InputError as error:
        return {"latex": "", "plain": "", "spoken": ""}, tuple(
            replace(problem, pointer="") for problem in error.problems
        )


def _names(scene: object) -> Names:
    """The names of a built-in scene, or those of a document that may still be faulty elsewhere."""
    return load_scene(scene).names if isinstance(scene, str) else names_in(cast("Mapping[str, object]", scene))


def _typeset(names: Names, document: Mapping[str, object], language: str) -> Document:
    known = _with_material(names, cast("Sequence[str]", document.get("material") or ()))
    try:
        tree = parse(str(document["expression"]), known, cast("Syntax", document["syntax"])).tree
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
