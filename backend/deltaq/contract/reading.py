"""Reading requests, and what Pydantic finds wrong with one as our own problems: codes and parameters, no echo of it.

A call of the API says of a bound which side was passed; what Python, the shell and a worker are told names both.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, TypeVar

from pydantic import BaseModel, TypeAdapter, ValidationError

from ..errors import MOST_PROBLEMS, Parameter, Problem, RequestError, escaped
from .base import OF_KIND, NotAbove, Request

R = TypeVar("R", bound=Request)
T = TypeVar("T")
Location = tuple[int | str, ...]

OF_NO_KIND = "union_tag_invalid"  # what Pydantic calls an alternative that there is not
CODES: Mapping[str, str] = MappingProxyType(
    {
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
        "ensemble-unlike": "ensemble-unlike",
        "ensemble-too-large": "ensemble-too-large",
        "ensemble-section-too-large": "ensemble-section-too-large",
        "section-too-large": "section-too-large",
        "uncertainty-too-large": "uncertainty-too-large",
        "bifurcation-too-large": "bifurcation-too-large",
        "basins-too-large": "basins-too-large",
        OF_NO_KIND: "request-not-one-of",
        "string_pattern_mismatch": "request-not-symbol",
        "request-outside": "request-outside",
        "request-not-text": "request-not-text",
        "request-not-number": "request-not-number",
        "assignment-format": "assignment-format",
        "assignment-share": "assignment-share",
        "assignment-time": "assignment-time",
        "assignment-attempts": "assignment-attempts",
        "assignment-no-task": "assignment-no-task",
    }
)
SIDES = ("gt", "ge", "lt", "le")  # of a bound, as Pydantic calls them
OUTSIDE = frozenset({"greater_than", "greater_than_equal", "less_than", "less_than_equal"})
OF_FIELDS = frozenset({"missing-field", "unknown-field"})  # problems whose sentence names the field
FILLING = frozenset(
    {
        *(*SIDES, "min_length", "max_length", "expected", "value", "min", "max", "format"),
        *("runs", "seconds", "most_runs", "most_seconds", "samples", "points", "most_points"),
        *("passages", "most_passages"),
    }
)  # what sentences speak of
_QUOTED = re.compile(r"'([^']*)'")


def read(model: type[R], document: Mapping[str, object]) -> R:
    """The request in a document; a field that is null was not given. Raises RequestError with all that is wrong.

    What is wrong with the fields of the request is told before what is wrong further inside.
    """
    given = {name: value for name, value in document.items() if value is not None or name == "scene"}
    try:
        return model.model_validate(given)
    except ValidationError as error:
        problems = [_told(finding, model, given) for finding in error.errors(include_url=False)]
        raise RequestError(*sorted(problems, key=lambda one: one.pointer.count("/"))[: MOST_PROBLEMS + 1]) from None


def checked(question: Mapping[str, object], model: type[BaseModel]) -> dict[str, Any]:
    """A request as a call of the API takes it. Raises RequestError for what that would refuse."""
    return made_of(question, model).model_dump()


def validated(document: object, wanted: TypeAdapter[Any]) -> Any:
    """What is wanted, made of a document. Raises RequestError with some more problems than are told, at most."""
    try:
        return wanted.validate_python(document)
    except ValidationError as error:
        findings = error.errors(include_url=False, include_input=False)[: MOST_PROBLEMS + 1]
        raise RequestError(*problems_of(findings)) from None


def made_of(document: object, kind: type[T]) -> T:
    """A value of a type that is declared, a dataclass too, from plain data. Raises RequestError with what is wrong."""
    found: T = validated(document, TypeAdapter(kind))
    return found


def plain_data(value: object) -> Any:
    """A value of such a type as plain data, of which `made_of` makes the same again."""
    return TypeAdapter(type(value)).dump_python(value, mode="json")


def problems_of(findings: Iterable[Mapping[str, Any]]) -> Iterator[Problem]:
    """One problem for each finding; `loc` says where in the body it is, `at` of its context at which field of that."""
    for finding in findings:
        is_empty = (finding["type"], finding["loc"]) == ("missing", ())  # there is no body
        code = "request-not-object" if is_empty else CODES.get(finding["type"], "request-invalid")
        at = "/kind" if finding["type"] == OF_NO_KIND else finding.get("ctx", {}).get("at", "")
        place = f"{pointer(finding['loc'])}{at}"
        yield Problem(code, place, parameters=_parameters(code, finding))


def pointer(location: Location) -> str:
    """JSON pointer (RFC 6901) of a place in a document, as Pydantic tells it."""
    return "".join(f"/{escaped(str(part))}" for part in location if not is_internal(part))


def is_internal(part: int | str) -> bool:
    """Whether a part of a location is Pydantic's own: no name or place in the document."""
    return isinstance(part, str) and (part == "[key]" or part.startswith(OF_KIND))


def _told(finding: Mapping[str, Any], model: type[BaseModel], document: Mapping[str, object]) -> Problem:
    """A finding as Python is told it: with both bounds where there are two."""
    (problem,) = problems_of([finding])
    given, bounds = finding["input"], _bounds(model, finding["loc"], document) if finding["type"] in OUTSIDE else ()
    if bounds:
        return Problem("request-outside", problem.pointer, parameters=_outside(given, *bounds))
    if problem.code == "request-not-boolean":
        return Problem("request-not-flag", problem.pointer)
    if problem.code == "request-not-number" and type(given) is int and abs(given) > sys.float_info.max:
        return Problem("request-not-finite", problem.pointer)
    return problem


def _outside(given: float | str, low: float, high: float) -> dict[str, Parameter]:
    """The number and both bounds; of a whole one, however long, no more than its beginning."""
    value = str(given)[:20] if isinstance(low, int) else float(given)
    return {"value": value, "min": low, "max": high}


def _bounds(model: type[BaseModel], location: Location, document: Mapping[str, object]) -> tuple[float, ...]:
    """Both bounds of a field as its declaration has them, whole numbers where the field is one; else none."""
    field = next(one for name, one in model.model_fields.items() if (one.alias or name) == location[0])
    if len(location) > 1:
        kind = field.annotation
        return _bounds(kind, location[1:], document) if isinstance(kind, type) and issubclass(kind, BaseModel) else ()
    ends = [one.bound(document) for one in field.metadata if isinstance(one, NotAbove)]
    ends += [getattr(one, side) for one in field.metadata for side in SIDES if hasattr(one, side)]
    whole = field.annotation is int
    return tuple(sorted(end if whole else float(end) for end in ends)) if len(ends) == 2 else ()


def _parameters(code: str, finding: Mapping[str, Any]) -> dict[str, Any]:
    """What fills the sentence; of the words that are allowed Pydantic makes an English enumeration."""
    if code in OF_FIELDS:
        return {"field": str(finding["loc"][-1])[:64]}
    found = {name: value for name, value in finding.get("ctx", {}).items() if name in FILLING}
    words = _QUOTED.findall(str(found.get("expected", "")))
    words += [tag.removeprefix(OF_KIND) for tag in _QUOTED.findall(finding.get("ctx", {}).get("expected_tags", ""))]
    return {**found, "expected": ", ".join(words)} if words else found
