"""The answer to `GET /proofs/{id}`: the general proof from d'Alembert's principle to Lagrange's equations."""

from __future__ import annotations

from collections.abc import Mapping

from ..contract.proof import ProofRequest
from ..contract.reading import read
from ..derivation.abstract_motion import H
from ..derivation.proof import PROOF, prove
from ..errors import Problem, UnknownNameError
from .catalog import language_of, text
from .function_notation import FunctionNotation, FunctionTypography
from .general_symbols import DIRECTIONS, NAMES, GeneralSymbols
from .marks import Wrap, in_class
from .narrator import Narrator

Document = dict[str, object]
PROOFS = (PROOF,)


def proof_request(document: Mapping[str, object]) -> Document:
    """The fields of a ProofRequest → chapters and steps. Raises UnknownNameError if there is no such proof."""
    asked = read(ProofRequest, document)
    if asked.id not in PROOFS:
        parameters = {"name": asked.id[:40], "known": ", ".join(PROOFS)}
        raise UnknownNameError(Problem("unknown-proof", parameters=parameters))
    language = language_of(asked.lang)
    narrator = Narrator(language, _notation(in_class))
    chapters = narrator.chapters(prove())
    return {"id": asked.id, "title": text(language, f"rules.proofs.{asked.id}"), "chapters": chapters}


def _notation(wrap: Wrap) -> FunctionNotation:
    typography = FunctionTypography(NAMES, directions=DIRECTIONS)
    return FunctionNotation(typography, GeneralSymbols(wrap), H)
