"""The answer as it was written, in LaTeX, with the terms marked that are wrong."""

from __future__ import annotations

from collections.abc import Iterable

from ...language.names import Names
from ...language.tree import Span
from ...language.typography import Typography
from ...language.written_latex import written_latex
from ..reading import Reading

CLASS = "slip"


def marked_latex(reading: Reading, text: str, places: Iterable[Span], names: Names) -> str:
    """Each line of the answer with \\htmlClass of KaTeX around the terms at the places."""
    typography = Typography(names)
    lines: list[str] = []
    after = 0
    for source, tree in reading.trees:
        start = max(text.find(source, after), after)
        after = start
        own = {Span(place.offset - start, place.length) for place in places_within(places, start, len(source))}
        lines.append(written_latex(tree, typography, own, CLASS))
    return lines[0] if len(lines) == 1 else r"\begin{gathered} " + r" \\ ".join(lines) + r" \end{gathered}"


def places_within(places: Iterable[Span], start: int, length: int) -> list[Span]:
    """The places in a piece of the text."""
    return [p for p in places if start <= p.offset and p.offset + p.length <= start + length]
