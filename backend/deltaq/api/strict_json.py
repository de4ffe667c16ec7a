"""JSON as RFC 8259 has it, read so that every bad body is the client's mistake and named, and none takes long.

How many values a body has is counted before it is read, in passes over its bytes that take a millisecond for each
megabyte; what is within the bounds is then read by a parser that is fast on all of them. Of two members of one name it
keeps the last, so that colons outside of texts are counted as well: there are as many as members, unless one is lost.
"""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from itertools import islice
from operator import attrgetter
from typing import Any

from pydantic_core import from_json

from ..errors import MOST_PROBLEMS, Problem, RequestError, escaped

LONGEST_NUMBER = 400
DEEPEST = 64
MOST_VALUES = 20_000  # in a body; the largest scene of the menu has 375, so 64 checks of it would be too many
MOST_ENTRIES = 1_000  # in a list
MOST_MEMBERS = 300  # in a table
LONGEST_TEXT = 10_000  # characters; the longest that any request may have is an expression of 4,000
MOST_LINES = 50_000  # up to which a mistake is looked for

_NO_UNICODE = re.compile("unicode|surrogate|end of hex escape")
_PLACE = re.compile(r"at line (\d+) column (\d+)$")
_DIGITS = bytes.maketrans(b"123456789.eE+-", b"0" * 14)  # as far as the length of a number goes they are alike

_REPEATED = object()  # in the place of a value whose name comes twice

Step = tuple[Any, str | int]  # the steps to what encloses a value, None at the top, and its name there


class JsonError(RequestError):
    """The body cannot be read as JSON."""


def loads(body: bytes) -> Any:
    """The document, with Unicode text and bounded in number, nesting and size of its values.

    JsonError with code and offset if it is not JSON; RequestError with pointers if numbers in it are not finite, if a
    list or table is too long, if a table has a name twice, or if there are too many values.
    """
    between = _outside_texts(body)
    try:
        document = from_json(body, cache_strings="none")
    except ValueError as error:
        raise JsonError(_mistake(body, str(error))) from None
    if _is_suspicious(document, between.count(b":")):
        found = tuple(islice(_problems(document), MOST_PROBLEMS + 1)) or _repeated(body)
        if found:
            raise RequestError(*sorted(found, key=attrgetter("pointer")))
    return document


def _outside_texts(body: bytes) -> bytes:
    """The body without its texts. RequestError: too many values; JsonError: a number too long, too many brackets."""
    plain = body.replace(rb"\\", b"").replace(rb"\"", b"") if b"\\" in body else body
    if plain.count(b'"') > 4 * MOST_VALUES:  # a value has at most a name and a text
        raise _too_many_values()
    between = b"".join(plain.split(b'"')[::2])  # what is no text
    if b"[" * (DEEPEST + 1) in between:
        raise JsonError(Problem("json-too-deep"))
    if between.count(b",") + between.count(b"[") + between.count(b"{") >= MOST_VALUES:
        raise _too_many_values()
    if b"0" * (LONGEST_NUMBER + 1) in between.translate(_DIGITS):
        raise JsonError(Problem("json-number-too-long"))
    return between


def _too_many_values() -> RequestError:
    return RequestError(Problem("request-too-many-values", parameters={"limit": MOST_VALUES}))


def _mistake(body: bytes, reason: str) -> Problem:
    """Why the parser stopped, and where."""
    if _NO_UNICODE.search(reason):
        return Problem("json-not-unicode")
    if "recursion" in reason:
        return Problem("json-too-deep")
    return Problem("json-syntax", offset=_offset(body, reason))


def _offset(body: bytes, reason: str) -> int | None:
    """The character at which the parser stopped; None if it is too far down to be looked for."""
    if reason.startswith("EOF"):
        return len(body.decode("utf-8", "replace"))
    place = _PLACE.search(reason)
    line, column = (int(place[1]), int(place[2])) if place else (MOST_LINES, 0)
    if line >= MOST_LINES:
        return None
    rest = body.split(b"\n", line - 1)[-1]
    return len(body[: len(body) - len(rest) + column - 1].decode("utf-8", "replace"))


def _is_suspicious(document: Any, members: int) -> bool:
    """Whether there is a problem, in the shortest time; level by level, so that no depth exhausts the stack.

    `members` are as many as the body has in all of its tables.
    """
    level: list[Any] = [[document]]
    for _ in range(DEEPEST + 1):
        members -= sum(len(part) for part in level if part.__class__ is dict)
        values = [value for part in level for value in (part.values() if isinstance(part, dict) else part)]
        if any(value.__class__ is float and not math.isfinite(value) for value in values):
            return True
        if any(value.__class__ is str and len(value) > LONGEST_TEXT for value in values):
            return True
        if any(part.__class__ is dict and max(map(len, part), default=0) > LONGEST_TEXT for part in level):
            return True
        level = [value for value in values if value.__class__ is dict or value.__class__ is list]
        if any(len(part) > MOST_MEMBERS and len(part) > _most(part) for part in level):
            return True
        if not level:
            return members != 0
    return True


def _most(part: Any) -> int:
    return MOST_MEMBERS if isinstance(part, dict) else MOST_ENTRIES


def _problems(document: Any) -> Iterator[Problem]:
    """What is wrong; of a list or table that is too long no more than that."""
    level: list[tuple[Step | None, Any]] = [(None, document)]
    for _ in range(DEEPEST + 1):
        inner: list[tuple[Step | None, Any]] = []
        for steps, part in level:
            if isinstance(part, float) and not math.isfinite(part):
                yield Problem("json-not-finite", _pointer(steps))
            elif part is _REPEATED:
                yield Problem("json-repeated-name", _pointer(steps))
            elif isinstance(part, str) and len(part) > LONGEST_TEXT:
                yield Problem("request-text-too-long", _pointer(steps), parameters={"max_length": LONGEST_TEXT})
            elif isinstance(part, (dict, list)):
                if len(part) > _most(part):
                    yield Problem("request-too-many", _pointer(steps), parameters={"max_length": _most(part)})
                elif isinstance(part, dict) and max(map(len, part), default=0) > LONGEST_TEXT:
                    yield Problem("request-text-too-long", _pointer(steps), parameters={"max_length": LONGEST_TEXT})
                else:
                    members = part.items() if isinstance(part, dict) else enumerate(part)
                    inner += [((steps, name), value) for name, value in members]
        if not inner:
            return
        level = inner
    raise JsonError(Problem("json-too-deep"))


def _repeated(body: bytes) -> tuple[Problem, ...]:
    """The names that a table has more than once; by a parser that tells, which is slower."""

    def table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) < len(pairs):
            found |= {name: _REPEATED for name, count in Counter(name for name, _ in pairs).items() if count > 1}
        return found

    return tuple(islice(_problems(json.loads(body, object_pairs_hook=table)), MOST_PROBLEMS + 1))


def _pointer(steps: Step | None) -> str:
    """JSON pointer (RFC 6901) of a value."""
    names: list[str] = []
    while steps is not None:
        steps, name = steps
        names.append(escaped(str(name)))
    return "".join(f"/{name}" for name in reversed(names))
