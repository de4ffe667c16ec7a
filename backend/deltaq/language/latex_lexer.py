"""LaTeX, as MathLive and people write it → tokens of the common alphabet."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from . import latex_structures as structures
from .bounds import MAX_DEPTH
from .functions import SPELLINGS
from .latex_delimiters import close_bracket, read_sized, separate
from .latex_source import Range, Source
from .latex_symbols import dotted, read_accent, read_letters, read_symbol, read_upright
from .latex_tables import DIFFERENTIAL, LETTER, NUMBER, OPERATORS, PREFIX, PRIMES, QUANTITIES, SIZES, TRANSPOSE, UPRIGHT
from .names import Names
from .plain_lexer import number_token, operator_tokens
from .spelling import GREEK, GREEK_NAMES, SUPERSCRIPTS
from .tokens import Token, fail
from .tree import Span

FENCES = (("$$", "$$"), ("$", "$"), (r"\[", r"\]"), (r"\(", r"\)"))


def latex_tokens(text: str, names: Names) -> Iterator[Token]:
    """Yield the tokens of LaTeX `text`, an "end" token last."""
    stripped = text.strip()
    start = text.find(stripped) if stripped else 0
    end = start + len(stripped)
    for opening, closing in FENCES:
        if len(stripped) > 2 * len(opening) and stripped.startswith(opening) and stripped.endswith(closing):
            start, end = start + len(opening), end - len(closing)
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
        self.brackets: list[int] = []

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
        elif LETTER.match(character):
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
        prefix = PREFIX.match(self.source.text, start, self.source.end)
        if prefix:
            fail("number-format", Span(start, len(prefix[0])), number=prefix[0])
        match = self.source.match(NUMBER)
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
            self._raised(start)
        elif character in "+-*/=,;'()[]|·⋅×∗−–÷∕′’″√δ∂":
            self._operator(character, Span(start, 1))
        elif character == "°":
            fail("unit", Span(start, 1), name="°")
        else:
            fail("unexpected-character", Span(start, 1), character=character)

    def _raised(self, start: int) -> None:
        """x¹²: a run of raised digits is one power."""
        while self.source.rest and self.source.text[self.source.at] in SUPERSCRIPTS:
            self.source.at += 1
        span = self.since(start)
        digits = "".join(SUPERSCRIPTS[c] for c in self.source.text[start : self.source.at])
        self.found += [Token("operator", "^", span), number_token(digits, span)]

    def _operator(self, text: str, span: Span) -> None:
        if text in ("(", "["):
            self.brackets.append(len(self.found))
        self.found += operator_tokens(text, span)
        if text in (")", "]") and self.brackets:
            close_bracket(self, self.brackets.pop())

    def superscript(self, start: int) -> None:
        """^ and its argument, the sign itself already read."""
        inside = self.source.argument(Span(start, 1), "^")
        content = self.source.text[slice(*inside)]
        span = self.since(start)
        if TRANSPOSE.match(content):
            self.found.append(Token("operator", "T", span))
        elif PRIMES.match(content):
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
        elif name in OPERATORS:
            self._operator(OPERATORS[name], span)
        elif name in UPRIGHT:
            read_upright(self, start)
        elif name in DIFFERENTIAL:
            self.found.append(Token("differential", "d", span))
        elif name in SIZES:
            read_sized(self, name, start)
        else:
            self._unknown(name, span)

    def _unknown(self, name: str, span: Span) -> None:
        if name in QUANTITIES:
            fail("unit", span, name="\\" + name)
        suggestions = difflib.get_close_matches(name[:40], [*SPELLINGS, *sorted(GREEK_NAMES)], n=1, cutoff=0.75)
        if suggestions:
            fail("unknown-command", span, name="\\" + name, suggestion="\\" + suggestions[0])
        fail("unknown-command", span, name="\\" + name)


_HANDLERS: Mapping[str, Callable[[LatexLexer, str, int], None]] = MappingProxyType(
    {
        **dict.fromkeys(("frac", "tfrac", "dfrac", "cfrac"), structures.read_fraction),
        "sqrt": structures.read_root,
        **dict.fromkeys(("dot", "ddot", "dddot"), read_accent),
        "begin": structures.read_environment,
        "exponentialE": structures.read_exponential,
        "boxed": structures.read_boxed,
        **dict.fromkeys(("quad", "qquad"), lambda lexer, _name, _start: separate(lexer)),
    }
)
