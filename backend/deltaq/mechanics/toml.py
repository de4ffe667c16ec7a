"""Scene documents in TOML 1.0, as the scene files are written."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence

from ..errors import Problem, RequestError, escaped

Document = dict[str, object]
_PLACE = re.compile(r"^(.*?) \(at line (\d+), column (\d+)\)$", re.DOTALL)


def read_toml(text: str) -> Document:
    """The table that a text describes, in the values that JSON has. Raises RequestError with line and column."""
    try:
        document: Document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise RequestError(_syntax(text, str(error))) from None
    except RecursionError:
        raise RequestError(Problem("toml-depth")) from None
    problems = [Problem("toml-value", pointer) for pointer in _strangers(document, "")]
    if problems:
        raise RequestError(*problems)
    return document


def _syntax(text: str, reason: str) -> Problem:
    found = _PLACE.match(reason)
    lines = text.splitlines() or [""]
    line, column = (int(found[2]), int(found[3])) if found else (len(lines), len(lines[-1]) + 1)
    offset = sum(len(one) for one in text.splitlines(keepends=True)[: line - 1]) + column - 1
    return Problem("toml-syntax", "", offset, 1, parameters={"line": line, "column": column})


def _strangers(value: object, pointer: str) -> Iterator[str]:
    """Pointers of dates, times and numbers that are none."""
    match value:
        case Mapping():
            for key, one in value.items():
                yield from _strangers(one, f"{pointer}/{escaped(str(key))}")
        case str() | bool() | int():
            return
        case Sequence():
            for index, one in enumerate(value):
                yield from _strangers(one, f"{pointer}/{index}")
        case float() if math.isfinite(value):
            return
        case _:
            yield pointer
