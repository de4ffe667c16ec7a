"""The jobs that run in workers: JSON document in, JSON document out; here SymPy and Numba begin."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import InputError
from ..mechanics.document import read_scene
from ..narration.catalog import text
from .problems import describe

Document = dict[str, Any]


def derive(document: Document) -> Document:
    """A derivation with its content hash."""
    answer: Document = import_module("deltaq.narration.derive").derive_request(document["request"])
    return {**answer, "id": document["id"]}


def simulate(document: Document) -> Document:
    """A trajectory; why it ended, and what to do about it, said in the language asked for."""
    answer: Document = import_module("deltaq.simulation.service").run(document["request"])
    return answer | explained(answer, document["request"]["lang"])


def explained(answer: Document, language: str) -> Document:
    """`reason` and `remedy` as sentences, from the code and parameters that the simulation gave."""
    code, parameters = answer["reason"]["code"], answer["reason"]["parameters"]
    return {part: text(language, f"statuses.{code}.{part}", **parameters) for part in ("reason", "remedy")}


def validate(document: Document) -> Document:
    """Whether a scene document can be read, and if not, everything that is wrong with it."""
    try:
        read_scene(document["scene"])
    except InputError as error:
        return {"valid": False, "problems": describe(error.problems, document["lang"])}
    return {"valid": True, "problems": []}


def warm(document: Document) -> Document:
    """Bring the compiled kernels to disk and into this worker, so that nobody waits for a compiler."""
    import_module("deltaq.simulation.service").warm()
    return document
