"""Scene documents in TOML 1.0, as the scene files are written."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence

from ..errors import Problem, RequestError, escaped

Document = dict[str, object]
LONGEST = 2**16  # characters; the largest scene of the menu has 7,000 as JSON
MOST_ENTRIES = 5_000  # keys, values and tables; that scene has 375 values
DEEPEST = 64
LARGEST = 2**1023  # of whole numbers; as far as floating numbers go
_TEXT = re.compile(
    r"""
    \"{3}(?:\\.|.)*?(?:"{3}|\Z) | '{3}.*?(?:'{3}|\Z) | "(?:\\.|[^"\\\n])*"? | '[^'\n]*'? | \#[^\n]*
    """,
    re.VERBOSE | re.DOTALL,
)  # in quotes of any kind, or a comment; one without an end counts too, so that none is looked through twice
_LONG_KEY = re.compile(r"(?:\.[ \t]*[\w-]+[ \t]*){16}")
_PLACE = re.compile(r"^(.*?) \(at line (\d+), column (\d+)\)$", re.DOTALL)


def read_toml(text: str) -> Document:
    """The table that a text describes, in the values that JSON has. Raises RequestError with line and column."""
    _check_size(text)
    try:
        document: Document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise RequestError(_syntax(text, str(error))) from None
    except ValueError:  # from int(), which bounds its digits
        raise RequestError(Problem("toml-digits")) from None
    except RecursionError:
        raise RequestError(Problem("toml-depth")) from None
    problems = [Problem("toml-value", pointer) for pointer in _strangers(document, "")]
    if problems:
        raise RequestError(*problems)
    return document


def _check_size(text: str) -> None:
    """Raises RequestError for what would take long: many entries, and keys of many parts, which cost their square."""
    size = {"limit": LONGEST, "most": MOST_ENTRIES}
    if len(text) > LONGEST:
        raise RequestError(Problem("toml-too-large", parameters=size))
    bare = _TEXT.sub("x", text)
    if _LONG_KEY.search(bare) or "[" * DEEPEST in bare:
        raise RequestError(Problem("toml-depth"))
    if sum(map(bare.count, "=,[{")) > MOST_ENTRIES:
        raise RequestError(Problem("toml-too-large", parameters=size))


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
        case int() if abs(value) > LARGEST:
            yield pointer
        case str() | bool() | int():
            return
        case Sequence():
            for index, one in enumerate(value):
                yield from _strangers(one, f"{pointer}/{index}")
        case float() if math.isfinite(value):
            return
        case _:
            yield pointer
