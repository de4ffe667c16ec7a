"""The answer to `POST /derivations`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Mapping

from ..contract.derivation import DerivationRequest
from ..contract.reading import read
from ..derivation.engine import derive
from ..derivation.result import result_of
from ..derivation.result_history import result_origins
from ..derivation.step import Derivation
from ..derivation.system import System
from ..language.latex_printer import Typography
from ..mechanics.requests import changed_scene, inside
from .catalog import language_of
from .expression_writer import ExpressionWriter
from .letters import letters_of
from .marks import by_coordinate, in_class
from .narrator import Narrator
from .notation import Notation
from .result_answer import written
from .speech import Speech
from .symbols import QuantitySymbols

Document = dict[str, object]


def derive_request(document: Mapping[str, object]) -> Document:
    """Derives what the request names, all but its id. Raises InputError for what cannot be read.

    `document`: the fields of a DerivationRequest.
    """
    asked = read(DerivationRequest, document)
    scene = changed_scene(asked)
    with inside("/scene"):
        system, derivation = derive(scene, asked.formulation, canonical=asked.canonical)
    narrator = narrator_of(system, language_of(asked.lang))
    return {
        "scene": scene.id,
        "formulation": asked.formulation,
        "chapters": narrator.chapters(derivation),
        "result": _result(system, derivation, narrator.speech),
    }


def _result(system: System, derivation: Derivation, speech: Speech) -> Document:
    result, scene = result_of(system), system.scene
    writer = ExpressionWriter(Typography(scene.names, decimals=scene.writes_decimals), speech)
    return written(result, result_origins(derivation, system, result.terms), writer)


def notation_of(system: System, language: str) -> Notation:
    """How a scene's quantities are written in a derivation, with the classes of the page."""
    typography = Typography(
        system.scene.names, by_coordinate(system.scene, in_class), decimals=system.scene.writes_decimals
    )
    names = {symbol.name: symbol.typeset for symbol in system.scene.names.symbols if symbol.kind == "coordinate"}
    return Notation(typography, QuantitySymbols(system.scene, language, names, in_class), system.h)


def narrator_of(system: System, language: str) -> Narrator:
    """Who tells the derivation of a scene, in letters that the scene has not taken."""
    notation = notation_of(system, language)
    small = {"h": notation.value(system.h), r"\omega": notation.value(system.omega)}
    own = {letter: latex.replace("{", "{{").replace("}", "}}") for letter, latex in small.items()}
    return Narrator(language, notation, {**letters_of(system.scene.names), **own})
