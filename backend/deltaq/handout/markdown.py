"""A derivation as Markdown, with formulas between dollar signs as GitHub, GitLab, Jupyter and Pandoc read them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..narration.prose import CatalogText, pieces
from .document import Handout, Line, Part, Value

# With a meaning anywhere; a colon or dot where an address would be found without any mark.
_SPECIAL = re.compile(r"[`*_{}\[\]<>#|~&^@]|:(?=//)|(?<=www)\.", re.IGNORECASE)
_AT_START = re.compile(r"(?P<number>\d+)(?P<sign>[.)])|[-+=:%]")
# Viewers look for these once more in the finished page, where a backslash before them is gone.
_INERT = str.maketrans({"$": "＄", "\\": "＼"})


def markdown_file(handout: Handout) -> str:
    """The whole file."""
    lines = [f"# {escaped(handout.title.line)}", "", _paragraph(escaped(handout.summary.line)), "", *_values(handout)]
    return "\n".join([*lines, *(line for part in handout.parts for line in _part(part))]).rstrip() + "\n"


def prose(sentence: CatalogText) -> str:
    """A sentence with its formulas; no other sign of it means anything."""
    return "".join(f"${each.text}$" if each.is_formula else escaped(each.text) for each in pieces(sentence))


def escaped(text: str) -> str:
    """Text as it is, without meaning to Markdown, HTML or mathematics."""
    return _SPECIAL.sub(r"\\\g<0>", text.translate(_INERT))


def _paragraph(text: str) -> str:
    """A paragraph whose first signs open no list, no line and no definition."""
    found = _AT_START.match(text)
    place = found.start("sign") if found and found["sign"] else 0
    return f"{text[:place]}\\{text[place:]}" if found else text


def _values(handout: Handout) -> Iterator[str]:
    rows = [*handout.parameters, *handout.coordinates]
    yield f"| {escaped(handout.say('quantity'))} | {escaped(handout.say('unit'))} |"
    yield "|---|---|"
    yield from (_row(value) for value in rows)
    yield ""


def _row(value: Value) -> str:
    return f"| ${value.equation}$ | {escaped(value.unit)} |"


def _part(part: Part) -> Iterator[str]:
    yield f"## {prose(part.title)}"
    yield ""
    for line in part.lines:
        yield from _line(line)


def _line(line: Line) -> Iterator[str]:
    title = f"{line.number} {prose(line.title)}".rstrip()
    yield f"### {title}" if line.depth == 0 else f"**{title}**"
    yield ""
    if line.text:
        yield from (_paragraph(prose(line.text)), "")
    if line.latex:
        yield from ("$$", line.latex.replace("\n", " "), "$$", "")
