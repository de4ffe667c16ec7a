"""The answer to `GET /proofs/{id}`: the general proof from d'Alembert's principle to Lagrange's equations."""

from __future__ import annotations

from collections.abc import Mapping

from ..derivation.abstract_motion import H
from ..derivation.proof import PROOF, prove
from ..errors import Problem, UnknownNameError
from .catalog import language_in, text
from .function_notation import FunctionNotation, FunctionTypography
from .general_symbols import DIRECTIONS, NAMES, GeneralSymbols
from .marks import Wrap, in_class
from .narrator import Narrator

Document = dict[str, object]
PROOFS = (PROOF,)


def proof_request(document: Mapping[str, object]) -> Document:
    """{id?, lang?} → chapters and steps. Raises UnknownNameError if there is no such proof."""
    identifier = str(document.get("id") or PROOF)
    if identifier not in PROOFS:
        parameters = {"name": identifier[:40], "known": ", ".join(PROOFS)}
        raise UnknownNameError(Problem("unknown-proof", parameters=parameters))
    language = language_in(document)
    narrator = Narrator(language, _notation(in_class))
    chapters = narrator.chapters(prove())
    return {"id": identifier, "title": text(language, f"rules.proofs.{identifier}"), "chapters": chapters}


def _notation(wrap: Wrap) -> FunctionNotation:
    typography = FunctionTypography(NAMES, directions=DIRECTIONS)
    return FunctionNotation(typography, GeneralSymbols(wrap), H)
