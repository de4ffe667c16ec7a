"""JSON as RFC 8259 has it, read so that every bad body is the client's mistake and named."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator
from typing import Any

from ..errors import Problem, RequestError, escaped

LONGEST_NUMBER = 400
DEEPEST = 64


class JsonError(RequestError):
    """The body cannot be read as JSON."""


def loads(body: bytes) -> Any:
    """The document, with Unicode text and bounded nesting.

    JsonError with code and offset if it is not JSON; RequestError with pointers if numbers in it are not finite.
    """
    document = _read(body)
    if infinite := sorted(_check(document)):
        raise RequestError(*(Problem("json-not-finite", pointer) for pointer in infinite))
    return document


def _read(body: bytes) -> Any:
    try:
        text = body.decode("utf-8")
        document = json.loads(text, parse_float=_float, parse_int=_int)
        if "\\u" in text:
            json.dumps(document, ensure_ascii=False).encode("utf-8")  # a lone surrogate has no UTF-8
    except json.JSONDecodeError as error:
        raise JsonError(Problem("json-syntax", offset=error.pos)) from None
    except UnicodeError:
        raise JsonError(Problem("json-not-unicode")) from None
    except RecursionError:
        raise JsonError(Problem("json-too-deep")) from None
    return document


def _float(text: str) -> float:
    return float(_short(text))


def _int(text: str) -> int:
    return int(_short(text))


def _short(text: str) -> str:
    if len(text) > LONGEST_NUMBER:
        raise JsonError(Problem("json-number-too-long"))
    return text


def _check(document: Any) -> Iterator[str]:
    """Pointers of the numbers that are not finite; level by level, so that no depth exhausts the stack."""
    level: list[tuple[str, Any]] = [("", document)]
    for _ in range(DEEPEST + 1):
        yield from (pointer for pointer, part in level if isinstance(part, float) and not math.isfinite(part))
        level = [child for pointer, part in level for child in _children(pointer, part)]
        if not level:
            return
    raise JsonError(Problem("json-too-deep"))


def _children(pointer: str, part: Any) -> Iterator[tuple[str, Any]]:
    if not isinstance(part, (dict, list)):
        return
    members: Iterable[tuple[Any, Any]] = part.items() if isinstance(part, dict) else enumerate(part)
    for name, value in members:
        yield f"{pointer}/{escaped(str(name))}", value
