"""A derivation as Markdown, with formulas between dollar signs as GitHub, GitLab, Jupyter and Pandoc read them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from .document import Handout, Line, Part, Value

_SPECIAL = re.compile(r"([\\`*_{}\[\]<>#|$~&])")


def markdown_file(handout: Handout) -> str:
    """The whole file."""
    lines = [f"# {prose(handout.title)}", "", prose(handout.summary), "", *_values(handout)]
    return "\n".join([*lines, *(line for part in handout.parts for line in _part(part))]).rstrip() + "\n"


def prose(sentence: str) -> str:
    """A sentence with formulas between dollar signs; no other sign of it means anything."""
    pieces = " ".join(sentence.split()).split("$")
    if len(pieces) % 2 == 0:
        return escaped(sentence)
    return "".join(f"${piece}$" if i % 2 else escaped(piece) for i, piece in enumerate(pieces))


def escaped(text: str) -> str:
    """Text as it is, without meaning to Markdown or HTML."""
    return _SPECIAL.sub(r"\\\1", text)


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
        yield from (prose(line.text), "")
    if line.latex:
        yield from ("$$", line.latex.replace("\n", " "), "$$", "")
