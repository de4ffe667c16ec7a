"""What Pydantic finds wrong with a request, as our own problems: codes and parameters, and no echo of the input."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, TypeAdapter, ValidationError

from ..errors import MOST_PROBLEMS, Problem, RequestError, escaped

_CODES = {
    "missing": "missing-field",
    "extra_forbidden": "unknown-field",
    "model_type": "request-not-object",
    "model_attributes_type": "request-not-object",
    "dict_type": "request-not-object",
    "list_type": "request-not-array",
    "tuple_type": "request-not-array",
    "string_type": "request-not-text",
    "float_type": "request-not-number",
    "float_parsing": "request-not-number",
    "int_type": "request-not-integer",
    "int_parsing": "request-not-integer",
    "int_from_float": "request-not-integer",
    "bool_type": "request-not-boolean",
    "bool_parsing": "request-not-boolean",
    "finite_number": "request-not-finite",
    "greater_than_equal": "request-too-small",
    "greater_than": "request-not-above",
    "less_than_equal": "request-too-large",
    "less_than": "request-not-below",
    "literal_error": "request-not-one-of",
    "string_too_long": "request-text-too-long",
    "string_too_short": "request-text-too-short",
    "too_long": "request-too-many",
    "too_short": "request-too-few",
    "request-scene-type": "request-scene-type",
    "request-step-and-tolerance": "request-step-and-tolerance",
}
WHOLE = ("body",)  # where a body is missing
_QUOTED = re.compile(r"'([^']*)'")


def checked(question: Mapping[str, object], model: type[BaseModel]) -> dict[str, Any]:
    """A request as a call of the API takes it. Raises RequestError for what that would refuse."""
    found: BaseModel = validated(question, TypeAdapter(model))
    return found.model_dump()


def validated(document: object, wanted: TypeAdapter[Any]) -> Any:
    """What is wanted, made of a document. Raises RequestError with some more problems than are told, at most."""
    try:
        return wanted.validate_python(document)
    except ValidationError as error:
        findings = error.errors(include_url=False, include_input=False)[: MOST_PROBLEMS + 1]
        located = [{**finding, "loc": ("body", *finding["loc"])} for finding in findings]
        raise RequestError(*problems_of(RequestValidationError(located))) from None


def problems_of(error: RequestValidationError) -> Iterator[Problem]:
    """One problem for each finding."""
    for finding in error.errors():
        is_empty = (finding["type"], finding["loc"]) == ("missing", WHOLE)
        code = "request-not-object" if is_empty else _CODES.get(finding["type"], "request-invalid")
        parameters = {"field": str(finding["loc"][-1])[:64], **_parameters(finding.get("ctx", {}))}
        yield Problem(code, pointer(finding["loc"]), parameters=parameters)


def pointer(location: tuple[int | str, ...]) -> str:
    """JSON pointer (RFC 6901) of a Pydantic location, whose first part says body, query or path."""
    return "".join(f"/{escaped(str(part))}" for part in location[1:] if part != "[key]")


def _parameters(context: dict[str, Any]) -> dict[str, Any]:
    """What fills the sentence; of the words that are allowed Pydantic makes an English enumeration."""
    found = {name: value for name, value in context.items() if isinstance(value, (str, int, float))}
    words = _QUOTED.findall(str(found.get("expected", "")))
    return {**found, "expected": ", ".join(words)} if words else found
