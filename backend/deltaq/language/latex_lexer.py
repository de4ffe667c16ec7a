"""LaTeX, as MathLive and people write it → tokens of the common alphabet."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from . import latex_structures as structures
from .bounds import MAX_DEPTH
from .functions import SPELLINGS
from .latex_source import Range, Source
from .latex_symbols import dotted, read_accent, read_letters, read_symbol, read_upright
from .names import Names
from .plain_lexer import number_token, operator_tokens
from .spelling import GREEK, GREEK_NAMES, SUPERSCRIPTS
from .tokens import Token, fail
from .tree import Span

_NUMBER = re.compile(r"(?:\d+(?:(?:\.|\{,\})\d*)?|\.\d+)(?:[eE][+-]?\d+)?(?P<again>\.\d*)?", re.ASCII)
_PREFIX = re.compile(r"0[xXbBoO][0-9A-Fa-f]+")
_LETTER = re.compile(r"[A-Za-z]")
_TRANSPOSE = re.compile(r"\s*(?:T|\\top|\\intercal|\\(?:mathrm|mathsf|text)\s*(?:\{\s*T\s*\}|T))\s*\Z")
_PRIMES = re.compile(r"\s*((?:\\prime|')\s*)+\Z")

_OPERATORS: Mapping[str, str] = MappingProxyType(
    {
        "cdot": "*",
        "ast": "*",
        "times": "×",
        "div": "/",
        "lbrack": "[",
        "rbrack": "]",
        "lparen": "(",
        "rparen": ")",
        "prime": "'",
        "{": "(",
        "}": ")",
        "lbrace": "(",
        "rbrace": ")",
        "\\": ";",
        "lvert": "|",
        "rvert": "|",
        "vert": "|",
        "mid": "|",
        "minus": "-",
        "partial": "∂",
        "delta": "δ",
        "variation": "δ",
    }
)
_SIZES = frozenset(
    [
        "left",
        "right",
        "mleft",
        "mright",
        "big",
        "Big",
        "bigg",
        "Bigg",
        "bigl",
        "bigr",
        "Bigl",
        "Bigr",
        "biggl",
        "biggr",
        "Biggl",
        "Biggr",
    ]
)
_UPRIGHT = frozenset(
    [
        "mathrm",
        "text",
        "textrm",
        "operatorname",
        "operatorname*",
        "mathit",
        "mathsf",
        "mathbf",
        "mathnormal",
        "boldsymbol",
        "vec",
    ]
)
_DIFFERENTIAL = frozenset({"differentialD", "dd"})


def latex_tokens(text: str, names: Names) -> Iterator[Token]:
    """Yield the tokens of LaTeX `text`, an "end" token last."""
    stripped = text.strip()
    start = text.find(stripped) if stripped else 0
    end = start + len(stripped)
    for fence in ("$$", "$"):
        if len(stripped) > 2 * len(fence) and stripped.startswith(fence) and stripped.endswith(fence):
            start, end = start + len(fence), end - len(fence)
            break
    yield from LatexLexer(text, names, (start, end), 0).tokens()
    yield Token("end", "", Span(len(text), 0))


class LatexLexer:
    """Reads one stretch of LaTeX; arguments and groups are read by lexers of their own."""

    def __init__(self, text: str, names: Names, inside: Range, depth: int) -> None:
        if depth > MAX_DEPTH:
            fail("too-deep", Span(inside[0], inside[1] - inside[0]), limit=MAX_DEPTH)
        self.source = Source(text, *inside)
        self.names = names
        self.found: list[Token] = []
        self._depth = depth
        self._brackets: list[int] = []

    def tokens(self) -> list[Token]:
        """All tokens of the stretch."""
        while self.source.next():
            self._item()
        return self.found

    def within(self, inside: Range) -> list[Token]:
        """The tokens of a part."""
        return LatexLexer(self.source.text, self.names, inside, self._depth + 1).tokens()

    def grouped(self, inside: Range, bracket: str = "") -> list[Token]:
        """The tokens of a part as one group."""
        opening, closing = Span(inside[0], 0), Span(inside[1], 0)
        close = {"": "", "(": ")", "[": "]"}[bracket]
        return [Token("open", bracket, opening), *self.within(inside), Token("close", close, closing)]

    def since(self, start: int) -> Span:
        """The stretch from `start` to the reading position."""
        return Span(start, self.source.at - start)

    def after_number(self) -> bool:
        """Whether a number was read last."""
        return bool(self.found) and self.found[-1].kind == "number"

    def _item(self) -> None:
        character = self.source.text[self.source.at]
        start = self.source.at
        if character == "\\":
            self._command(start)
        elif character.isascii() and (character.isdigit() or character == "."):
            self._number(start)
        elif _LETTER.match(character):
            read_letters(self)
        elif character == "{":
            self._group()
        elif character == "^":
            self.source.at += 1
            self.superscript(start)
        elif character == "_":
            fail("indexed-operator", Span(start, 1), name="_")
        elif character == "&":
            self.source.at += 1
        else:
            self._other(character, start)

    def _number(self, start: int) -> None:
        prefix = _PREFIX.match(self.source.text, start, self.source.end)
        if prefix:
            fail("number-format", Span(start, len(prefix[0])), number=prefix[0])
        match = self.source.match(_NUMBER)
        if match is None:
            fail("unexpected-character", Span(start, 1), character=".")
        self.found.append(number_token(match[0].replace("{,}", "."), self.since(start)))

    def _group(self) -> None:
        """{…}: with an index it is a symbol, else a group."""
        start = self.source.at
        inside = self.source.group()
        if self.source.next() == "_":
            read_symbol(self, self.source.text[slice(*inside)], start)
        elif self.source.text[slice(*inside)].strip():
            self.found += self.grouped(inside)

    def _other(self, character: str, start: int) -> None:
        self.source.at += 1
        base, dots = dotted(character)
        if dots:
            read_symbol(self, base, start, (Token("dot", str(dots), Span(start, 1)),))
        elif character in GREEK and character != "δ":
            read_symbol(self, GREEK[character], start)
        elif character in SUPERSCRIPTS:
            self.found += [
                Token("operator", "^", Span(start, 1)),
                number_token(SUPERSCRIPTS[character], Span(start, 1)),
            ]
        elif character in "+-*/=,;'()[]|·⋅×∗−–÷∕′’″√δ∂":
            self._operator(character, Span(start, 1))
        elif character == "°":
            fail("unit", Span(start, 1), name="°")
        else:
            fail("unexpected-character", Span(start, 1), character=character)

    def _operator(self, text: str, span: Span) -> None:
        if text in ("(", "["):
            self._brackets.append(len(self.found))
        self.found += operator_tokens(text, span)
        if text in (")", "]") and self._brackets:
            self._close(self._brackets.pop())

    def _close(self, opening: int) -> None:
        """Square brackets without a comma are parentheses."""
        first, last = self.found[opening], self.found[-1]
        if (first.text, last.text) == ("[", "]") and not _has_comma(self.found[opening + 1 : -1]):
            self.found[opening] = Token("open", "(", first.span)
            self.found[-1] = Token("close", ")", last.span)

    def superscript(self, start: int) -> None:
        """^ and its argument, the sign itself already read."""
        inside = self.source.argument(Span(start, 1), "^")
        content = self.source.text[slice(*inside)]
        span = self.since(start)
        if _TRANSPOSE.match(content):
            self.found.append(Token("operator", "T", span))
        elif _PRIMES.match(content):
            self.found += [Token("operator", "'", span)] * (content.count("'") + content.count("prime"))
        elif content.strip() in ("\\circ", "°"):
            fail("unit", span, name="°")
        else:
            self.found += [Token("operator", "^", Span(start, 1)), *self.grouped(inside)]

    def _command(self, start: int) -> None:
        name = self.source.command()
        span = self.since(start)
        handler = _HANDLERS.get(name)
        if handler is not None:
            handler(self, name, start)
        elif name in GREEK_NAMES - {"delta"}:
            read_symbol(self, name, start)
        elif name in SPELLINGS:
            self.found.append(Token("function", SPELLINGS[name].name, span))
        elif name in _OPERATORS:
            self._operator(_OPERATORS[name], span)
        elif name in _UPRIGHT:
            read_upright(self, start)
        elif name in _DIFFERENTIAL:
            self.found.append(Token("differential", "d", span))
        elif name in _SIZES:
            self._sized(name, start)
        else:
            self._unknown(name, span)

    def _unknown(self, name: str, span: Span) -> None:
        suggestions = difflib.get_close_matches(name[:40], [*SPELLINGS, *sorted(GREEK_NAMES)], n=1, cutoff=0.75)
        if suggestions:
            fail("unknown-command", span, name="\\" + name, suggestion="\\" + suggestions[0])
        fail("unknown-command", span, name="\\" + name)

    def separate(self) -> None:
        """A wide space separates the components of a row in square brackets: [F_x \\quad F_y]^T."""
        if self._brackets and self.found[self._brackets[-1]].text == "[" and not self.found[-1].is_operator(","):
            self.found.append(Token("operator", ",", Span(self.source.at, 0)))

    def _sized(self, size: str, start: int) -> None:
        """\\left, \\right and the like: what they enlarge follows."""
        character = self.source.next()
        right = size in ("right", "mright")
        if character == "." and right and self._brackets:
            self.source.at += 1
            del self.found[self._brackets.pop()]
        elif character == "|" or self.source.peek_command() in ("vert", "lvert", "rvert"):
            self.source.at += 1 if character == "|" else len(self.source.peek_command()) + 1
            self._bar(size, self.since(start))
        elif character == "" or character not in "()[]\\":
            fail("missing-argument", Span(start, len(size) + 1), name="\\" + size)

    def _bar(self, size: str, span: Span) -> None:
        if size in ("left", "mleft"):
            self.found += [Token("function", "abs", span), Token("open", "|", span)]
        elif size in ("right", "mright"):
            self.found.append(Token("close", "|", span))
        else:
            self.found.append(Token("operator", "|", span))


def _has_comma(tokens: list[Token]) -> bool:
    depth = 0
    for token in tokens:
        depth += (token.kind == "open") - (token.kind == "close")
        if depth == 0 and token.is_operator(",", ";"):
            return True
    return False


_HANDLERS: Mapping[str, Callable[[LatexLexer, str, int], None]] = MappingProxyType(
    {
        **dict.fromkeys(("frac", "tfrac", "dfrac", "cfrac"), structures.read_fraction),
        "sqrt": structures.read_root,
        **dict.fromkeys(("dot", "ddot", "dddot"), read_accent),
        "begin": structures.read_environment,
        "exponentialE": structures.read_exponential,
        **dict.fromkeys(("quad", "qquad"), lambda lexer, _name, _start: lexer.separate()),
    }
)
