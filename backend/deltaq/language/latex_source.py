"""A stretch of LaTeX text and the reading position in it: spaces, arguments, groups, environments, cells, d and ∂."""

from __future__ import annotations

import re
from itertools import pairwise

from .tokens import fail
from .tree import Span

_SPACE = re.compile(
    r"(?:[\s~\u200b\u2060-\u2064]|\\[,;:!> ]|\\(?:thinspace|medspace|thickspace|negthinspace|displaystyle"
    r"|textstyle|limits|nolimits|nonumber|notag|hfill|allowbreak)(?![A-Za-z]))+"
)
_COMMAND = re.compile(r"\\(?:[A-Za-z]+\*?|.)", re.DOTALL)
# A row may end with a star and the distance to the next one, \\[2pt]; a bracket without a length opens the next row.
_DISTANCE = re.compile(r"\*?\s*\[\s*[-+]?(?:\d+\.?\d*|\.\d+)\s*(?:pt|mm|cm|in|ex|em|bp|pc|mu|sp|dd|cc)\s*\]|\*")
# Two backslashes end a row, also before the letters "end".
_ENVIRONMENT = re.compile(r"\\\\|\\(begin|end)\s*\{([A-Za-z*]{1,20})\}")

_D = re.compile(
    r"\s*(?:(?P<total>d|\\(?:mathrm|text|operatorname|mathit)\s*(?:\{\s*d\s*\}|d)|\\differentialD(?![A-Za-z])|\\dd(?![A-Za-z]))"
    r"|(?P<partial>\\partial(?![A-Za-z])|∂))\s*(?:\^\s*(?P<order>\{\s*\d\s*\}|\d))?(?:\\[,;!: ]|\s)*"
)
ONLY_VARIABLES = re.compile(r"[^+\-*/=]*\Z|\s*[({].*\Z", re.DOTALL)
_ORDER = re.compile(r"\s*\^\s*(?:\{\s*(\d)\s*\}|(\d))\s*\Z")

Range = tuple[int, int]


class Source:
    """Text between two offsets."""

    def __init__(self, text: str, start: int, end: int) -> None:
        self.text = text
        self.at = start
        self.end = end

    def skip_space(self) -> None:
        """Step over spaces and spacing commands."""
        match = _SPACE.match(self.text, self.at, self.end)
        if match:
            self.at = match.end()

    @property
    def rest(self) -> bool:
        """Whether anything is left."""
        return self.at < self.end

    def next(self) -> str:
        """The character ahead after spaces, "" at the end."""
        self.skip_space()
        return self.text[self.at] if self.rest else ""

    def match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """Step over a pattern if it is ahead."""
        found = pattern.match(self.text, self.at, self.end)
        if found:
            self.at = found.end()
        return found

    def command(self) -> str:
        """Step over the command ahead, and the distance behind the end of a row; its name without backslash, "" for
        a lone backslash at the end.
        """
        found = self.match(_COMMAND)
        self.at += found is None
        name = found[0][1:] if found else ""
        if name == "\\":
            self.match(_DISTANCE)
        return name

    def argument(self, owner: Span, name: str) -> Range:
        """Step over an argument; where its content stands: a group, a command with its arguments, a character."""
        ahead = self.next()
        start = self.at
        if ahead == "{":
            return self.group()
        if ahead == "\\":
            command = self.command()
            if command in (
                "mathrm",
                "text",
                "mathit",
                "operatorname",
                "dot",
                "ddot",
                "dddot",
                "ddddot",
                "sqrt",
                "mathsf",
                "mathbf",
            ):
                self.argument(owner, command)
            elif command in ("right", "end", "\\"):
                fail("missing-argument", owner, name=name)
            return start, self.at
        if ahead in ("", "}", "&", "^", "_", ")", "]"):
            fail("missing-argument", owner, name=name)
        self.at += 1
        return start, self.at

    def group(self) -> Range:
        """Step over {…}; where its content stands."""
        start, depth = self.at, 0
        position = start
        while position < self.end:
            character = self.text[position]
            if character == "\\":
                position += 1
            elif character == "{":
                depth += 1
            elif character == "}":
                depth -= 1
                if depth == 0:
                    self.at = position + 1
                    return start + 1, position
            position += 1
        fail("unclosed-group", Span(start, 1))

    def optional(self) -> Range | None:
        """Step over […] after a command, if it is there."""
        if self.next() != "[":
            return None
        close = self.text.find("]", self.at, self.end)
        if close < 0:
            fail("unclosed-bracket", Span(self.at, 1), bracket="[", wanted="]")
        inside = self.at + 1, close
        self.at = close + 1
        return inside

    def environment(self, start: int) -> tuple[str, Range]:
        """Step over \\begin{name}…\\end{name}, which starts at `start`; its name and where its content stands."""
        self.at = start
        opening = self.match(_ENVIRONMENT)
        if opening is None or opening[1] != "begin":
            fail("unclosed-environment", Span(start, 6), name="")
        depth, name = 1, opening[2]
        for found in _ENVIRONMENT.finditer(self.text, opening.end(), self.end):
            depth += {"begin": 1, "end": -1}.get(found[1], 0)
            if depth == 0:
                if found[2] != name:
                    break
                self.at = found.end()
                return name, (opening.end(), found.start())
        fail("unclosed-environment", Span(start, opening.end() - start), name=name)


def cells(text: str, inside: Range) -> list[list[Range]]:
    """Rows and cells between & and \\\\, not looking into groups and inner environments."""
    source = Source(text, *inside)
    rows: list[list[Range]] = [[]]
    start = source.at
    while source.rest:
        character = source.text[source.at]
        if character == "{":
            source.group()
        elif character == "&":
            rows[-1].append((start, source.at))
            source.at += 1
            start = source.at
        elif character == "\\":
            at = source.at
            command = source.command()
            if command == "begin":
                source.environment(at)
            elif command == "\\":
                rows[-1].append((start, at))
                rows.append([])
                start = source.at
        else:
            source.at += 1
    rows[-1].append((start, source.end))
    return rows


def separators(parts: list[Range]) -> list[Span]:
    """Where the & or \\\\ between neighbouring cells or rows stands."""
    return [Span(one[1], other[0] - one[1]) for one, other in pairwise(parts)]


def differential_head(text: str, inside: Range) -> tuple[str, int, Range] | None:
    """Kind and order of the d or ∂ that starts a stretch, and what follows it."""
    match = _D.match(text, *inside)
    if match is None:
        return None
    order = int((match["order"] or "1").strip("{} "))
    return ("d" if match["total"] else "partial"), order, (match.end(), inside[1])


def differential_variables(text: str, inside: Range, span: Span) -> list[tuple[Range, int]]:
    """The variables below the line: x, x^2, or x ∂y."""
    found: list[tuple[Range, int]] = []
    start, end = inside
    while start < end:
        following = next((m for m in _D.finditer(text, start, end) if m["partial"]), None)
        stop = following.start() if following else end
        order = _ORDER.search(text[start:stop])
        times = int(order[1] or order[2]) if order else 1
        found.append(((start, start + order.start() if order else stop), times))
        start = following.end() if following else end
    if not found or not 1 <= sum(times for _, times in found) <= 3:
        fail("derivative-variable", span, text=text[slice(*inside)])
    return found
