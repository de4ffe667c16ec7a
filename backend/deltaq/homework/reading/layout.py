"""The layout of an answer: what is no mathematics is blanked out, and the rest is cut into statements `A = B = C`.

Blanks keep every character at its place, so that what is told of a place is true of the text that was typed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ...language.latex_tables import SYSTEMS
from ...language.names import Names

Range = tuple[int, int]
MAX_STATEMENTS = 12
MAX_MEMBERS = 12


@dataclass(frozen=True)
class Statement:
    """`A = B = C` by the places of its members; `follows` tells that an arrow leads from the one before to it."""

    members: tuple[Range, ...]
    follows: bool = False


@dataclass(frozen=True)
class Layout:
    """An answer as it was typed, `text` of the same length without what is no mathematics, and its statements."""

    typed: str
    text: str
    statements: tuple[Statement, ...]

    def slice(self, place: Range) -> str:
        """The text at a place."""
        return self.text[slice(*place)]


_ARROW = r"=>|<=>|⇒|⟹|⇔|→|\\(?:Rightarrow|Longrightarrow|Leftrightarrow|implies|iff|to|rightarrow)(?![A-Za-z])"
_WORDS = r"mit|with|wobei|where|und|and|also|so|hence|somit|daraus"
_SCAN = re.compile(
    rf"""
    (?P<begin>\\begin\s*\{{)|(?P<end>\\end\s*\{{)
  | (?P<arrow>{_ARROW})
  | (?P<lines>\\\\(?:\s*\[[^\]]*\])?|[;\n])
  | (?P<said>\\(?:text|textrm|mathrm)\s*\{{\s*[,;]?\s*(?:{_WORDS})\s*:?\s*\}})
  | (?P<word>(?<![^\s,;])(?:{_WORDS})(?=\s))
  | (?P<wide>\\q?quad(?![A-Za-z])(?:\s*\\q?quad(?![A-Za-z]))*)
  | (?P<command>\\(?:[A-Za-z]+|.))
  | (?P<open>[(\[{{])|(?P<close>[)\]}}])
  | (?P<comma>,)
  | (?P<equals>(?<![<>!=:])=(?!=))
    """,
    re.VERBOSE,
)
_SPACE = r"(?:\s|\\[;,:! ]|\\q?quad(?![A-Za-z]))"
_LEADING = re.compile(rf"{_SPACE}*")
_DECIMAL = re.compile(r"(?<=[0-9]),(?=[0-9])")
_FENCE = re.compile(r"\$+|(?<!\\)\\[\[\]()]")
_FRAME = re.compile(r"\s*\\boxed\s*\{(.*)\}\s*\Z", re.DOTALL)
_ASIDE = re.compile(
    r"\\(?:tag\*?|label)\s*\{[^{}]*\}|\\(?:nonumber|notag|displaystyle|textstyle|limits)(?![A-Za-z])"
    r"|\\hat(?=\s*\{?\s*e(?![A-Za-z]))"
)
_ENVIRONMENT = re.compile(rf"\\(?:begin|end)\s*\{{\s*(?:{'|'.join(map(re.escape, sorted(SYSTEMS)))})\s*\}}")
_ROW = re.compile(r"\s*\[(?P<inside>.*)\]\s*", re.DOTALL)
_COLUMN = re.compile(
    r"\s*\\begin\s*\{[bp]matrix\}(?P<inside>(?:(?!\\begin|\\end).)*)\\end\s*\{[bp]matrix\}\s*", re.DOTALL
)
_SCRIPT = re.compile(r"\\(?:mathcal|mathscr|mathfrak)\s*(?:\{\s*([A-Z])\s*\}|([A-Z]))")
_UNIT = re.compile(
    r"\\(?:hat|widehat)\s*(?:\{\s*\\?([xyzijk])(?:math)?\s*\}|\s\\?([xyz])(?![A-Za-z])|\\([ij])math)(?!\s*_)"
)
_SLOPPY = re.compile(r"(?<![A-Za-z])d(?=[LTVU]\s*/\s*d(?!t\b))|(?<=d[LTVU]/)d(?!t\b)")
_DEFINED = re.compile(r":=|\\coloneqq|≡")
_BULLET = re.compile(
    r"\s*(?:\(\s*(?P<inside>\d{1,2}[a-z]?|\d{1,2}\.\d{1,2}|[IVXivx]{1,4}|[a-z]|\*{1,3})\s*\)(?=\s|\\[;,:! ]|\\q?quad)"
    r"|(?P<loose>\d{1,2}[a-z]?|[a-h]|[ivx]{1,4})\)|\d{1,2}\.(?=\s)"
    r"|(?:\\(?:text|textrm|mathrm|textbf)\s*\{(?P<said>[^{}]{1,24}?):?\s*\}\s*:?|(?P<prefix>[^=:+*/^\n]{1,24}):(?!=)))"
    rf"{_SPACE}*"
)
_NUMBERED = re.compile(rf"{_SPACE}+" r"\(\s*(?:\d{1,2}[a-z]?|\*{1,3}|[IV]{1,4})\s*\)\s*\Z")
_HEADING = re.compile(
    r"\(?(?:[IVXivx]{1,4}|\d{1,2}[a-z]?|[a-h])[.)]?|(?:Gl|Eq|EOM|BGL|DGL|Gleichung|Equation|Ansatz)[A-Za-z]*\.?\s*\(?\d{0,2}\)?"
    r"|(?=[^\\]*[a-zäöü]{4})[A-Za-zÄÖÜäöüß.\-\s]{4,24}",
    re.IGNORECASE,
)


def laid_out(text: str, names: Names, labels: frozenset[str], *, decimal_comma: bool) -> Layout:
    """The statements of an answer. `labels` may head a line; `decimal_comma` tells how 0,5 is meant."""
    clean = _cleaned(text, decimal_comma=decimal_comma)
    statements = []
    for begins, ends, cuts, follows in _stretches(clean):
        clean, start, end = _unnumbered(clean, begins, ends, names, labels)
        members = _members(clean, start, end, cuts)
        if members:
            statements.append(Statement(members, follows))
    return Layout(text, clean, tuple(statements[: MAX_STATEMENTS + 1]))


def _cleaned(text: str, *, decimal_comma: bool) -> str:
    framed = _FRAME.match(text)
    if framed:
        text = " " * framed.start(1) + framed[1] + " " * (len(text) - framed.end(1))
    clean = _blanked(_FENCE, text)
    clean = _SCRIPT.sub(lambda found: _padded(found[1] or found[2], found), clean)
    clean = _UNIT.sub(lambda found: _padded(_axis(found[1] or found[2] or found[3]), found), clean)
    clean = _blanked(_ASIDE, clean)
    clean = _DEFINED.sub(lambda found: _padded("=", found), clean)
    clean = _SLOPPY.sub("∂", clean)
    if _ENVIRONMENT.search(clean):
        clean = _lines_only(clean)
    clean = _listed(clean)
    return _DECIMAL.sub(".", clean) if decimal_comma else clean


def _lines_only(text: str) -> str:
    """Aligned lines without their environment; the & of a matrix in them stays."""
    inside = _blanked(_ENVIRONMENT, text)
    if re.search(r"\\begin\s*\{", inside):
        return re.sub(r"&(?=\s*=)|(?<==)\s?&", lambda found: " " * len(found[0]), inside)
    return inside.replace("&", " ")


def _listed(text: str) -> str:
    """[x = …, y = …] without its brackets; [a, b] stays, and so does a product of matrices."""
    found = _ROW.fullmatch(text) or _COLUMN.fullmatch(text)
    if found is None or "=" not in found["inside"] or not _is_balanced(found["inside"]):
        return text
    start, end = found.span("inside")
    return " " * start + text[start:end] + " " * (len(text) - end)


def _is_balanced(text: str) -> bool:
    """Whether no bracket closes that was not opened in the text."""
    depth = 0
    for found in _SCAN.finditer(text):
        depth += (found.lastgroup in ("open", "begin")) - (found.lastgroup in ("close", "end"))
        if depth < 0:
            return False
    return True


def _axis(letter: str) -> str:
    return f"e_{letter}" if letter in "xyz" else letter


def _padded(text: str, found: re.Match[str]) -> str:
    return text.ljust(len(found[0]))


def _blanked(pattern: re.Pattern[str], text: str) -> str:
    return pattern.sub(lambda found: " " * len(found[0]), text)


Stretch = tuple[int, int, list[int], bool]


def _stretches(text: str) -> Iterator[Stretch]:
    """Start, end and equals signs of each statement, and whether an arrow led to it."""
    depth, start, follows = 0, 0, False
    equals: list[int] = []
    for found in _SCAN.finditer(text):
        kind = found.lastgroup
        depth = max(0, depth + (kind in ("open", "begin")) - (kind in ("close", "end")))
        if kind in ("begin", "end"):
            depth += 1  # the name of the environment closes its own brace
        if depth or kind in ("open", "close", "begin", "end", "command"):
            continue
        if kind == "equals":
            equals.append(found.start())
        elif _separates(kind or "", text, found, equals):
            yield start, found.start(), equals, follows
            start, equals, follows = found.end(), [], kind == "arrow"
    yield start, len(text), equals, follows


def _separates(kind: str, text: str, found: re.Match[str], equals: list[int]) -> bool:
    """A wide space separates two equations, and nothing else."""
    if kind != "wide":
        return True
    return bool(equals) and "=" in text[found.end() :]


def _members(text: str, start: int, end: int, equals: list[int]) -> tuple[Range, ...]:
    cuts = [cut for cut in equals if cut >= start][: MAX_MEMBERS + 1]
    if not cuts and not text[start:end].strip(" .\t"):
        return ()
    starts = [start, *(_leading(text, cut + 1, end) for cut in cuts)]
    ends = [*cuts, end]
    return tuple(zip(starts, ends, strict=True))


def _unnumbered(text: str, start: int, end: int, names: Names, labels: frozenset[str]) -> tuple[str, int, int]:
    """Without the number of an equation in front or behind, and without its heading."""
    tail = _NUMBERED.search(text, start, end)
    if tail and text[start : tail.start()].strip():
        text, end = text[: tail.start()] + " " * (end - tail.start()) + text[end:], tail.start()
    start = _leading(text, start, end)
    for _ in range(2):
        bullet = _BULLET.match(text, start, end)
        if bullet is None or not _is_bullet(bullet, names, labels):
            break
        start = bullet.end()
    return text, start, end


def _leading(text: str, start: int, end: int) -> int:
    found = _LEADING.match(text, start, end)
    return found.end() if found else start


def _is_bullet(bullet: re.Match[str], names: Names, labels: frozenset[str]) -> bool:
    inside = bullet["inside"] or bullet["loose"]
    if inside:
        return names.resolve(inside) is None
    heading = bullet["said"] or bullet["prefix"]
    if heading is None:
        return True
    heading = heading.strip()
    symbol = names.resolve(heading.removesuffix("-Gleichung").strip())
    if symbol is not None:
        return symbol.kind == "coordinate"
    return heading in labels or _HEADING.fullmatch(heading) is not None
