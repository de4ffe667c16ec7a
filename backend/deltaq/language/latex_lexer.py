"""LaTeX, as MathLive and people write it → tokens of the common alphabet."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from types import MappingProxyType

from .bounds import MAX_DEPTH
from .functions import SPELLINGS
from .latex_source import ONLY_VARIABLES, Range, Source, cells, differential_head, differential_variables, separators
from .latex_tables import (
    BAR,
    DIFFERENTIAL,
    INDEX,
    LETTER,
    LETTERS,
    MARKS,
    MATRICES,
    NUMBER,
    OPERATORS,
    PREFIX,
    PRIMED,
    QUANTITIES,
    SINGLE,
    SIZES,
    SYSTEMS,
    TRANSPOSE,
    UPRIGHT,
    sides_of_bars,
)
from .names import Names, is_differential
from .plain_lexer import number_token, operator_tokens
from .spelling import GREEK, GREEK_NAMES, SUPERSCRIPTS, dotted, key
from .tokens import Kind, Token, fail, has_comma, vector_tokens
from .tree import Span
from .words import UNITS, word_tokens

UPRIGHT_D = "upright d"  # a differential, also where a symbol is called d
FENCES = (("$$", "$$"), ("$", "$"), (r"\[", r"\]"), (r"\(", r"\)"))


def latex_tokens(text: str, names: Names) -> Iterator[Token]:
    """Yield the tokens of LaTeX `text`, an "end" token last."""
    stripped = text.strip()
    end = (start := text.find(stripped)) + len(stripped)
    for opening, closing in FENCES:
        if len(stripped) > 2 * len(opening) and stripped.startswith(opening) and stripped.endswith(closing):
            start, end = start + len(opening), end - len(closing)
            break
    yield from LatexLexer(text, names, (start, end), 0, sides_of_bars(text)).tokens()
    yield Token("end", "", Span(len(text), 0))


class LatexLexer:
    """Reads one stretch of LaTeX; arguments and groups are read by lexers of their own."""

    def __init__(self, text: str, names: Names, inside: Range, depth: int, sides: Mapping[int, Kind]) -> None:
        if depth > MAX_DEPTH:
            fail("too-deep", Span(inside[0], inside[1] - inside[0]), limit=MAX_DEPTH)
        self.source = Source(text, *inside)
        self.names, self.sides = names, sides
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
        return LatexLexer(self.source.text, self.names, inside, self._depth + 1, self.sides).tokens()

    def grouped(self, inside: Range, bracket: str = "") -> list[Token]:
        """The tokens of a part as one group."""
        opening, closing = Span(inside[0], 0), Span(inside[1], 0)
        close = {"": "", "(": ")", "[": "]"}[bracket]
        return [Token("open", bracket, opening), *self.within(inside), Token("close", close, closing)]

    def since(self, start: int) -> Span:
        """The stretch from `start` to the reading position, without spaces at its end."""
        return Span(start, len(self.source.text[start : self.source.at].rstrip()))

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
            fail("number-format", Span(start, len(prefix[0])), number=prefix[0][:40])
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
        elif character in "+-*/=,;'\"()[]|·⋅×∗−–÷∕′’´″”√δ∂":
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
        else:
            if content.strip() in ("\\circ", "°"):
                fail("unit", span, name="°")
            primed = PRIMED.match(content)
            end = primed.end() if primed else 0
            head = content[:end].rstrip(" ^")
            stands = Span(start, inside[0] - start + len(head)) if end < len(content) else span
            self.found += [Token("operator", "'", stands)] * len(re.findall("'|prime", head))
            if not primed or end < len(content):
                self.found += [Token("operator", "^", Span(start, 1)), *self.grouped((inside[0] + end, inside[1]))]

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
            self.found.append(Token("differential", UPRIGHT_D, span))
        elif name in SIZES:
            read_sized(self, name, start)
        else:
            self._unknown(name, span)

    def _unknown(self, name: str, span: Span) -> None:
        if name in QUANTITIES:
            fail("unit", span, name="\\" + name)
        suggestions = difflib.get_close_matches(name[:40], [*SPELLINGS, *sorted(GREEK_NAMES)], n=1, cutoff=0.75)
        likeliest = {"suggestion": "\\" + suggestions[0]} if suggestions else {}
        fail("unknown-command", span, name="\\" + name[:40], **likeliest)


def close_bracket(lexer: LatexLexer, opening: int) -> None:
    """Square brackets without a comma are parentheses."""
    first, last = lexer.found[opening], lexer.found[-1]
    if (first.text, last.text) == ("[", "]") and not has_comma(lexer.found[opening + 1 : -1]):
        lexer.found[opening] = Token("open", "(", first.span)
        lexer.found[-1] = Token("close", ")", last.span)


def separate(lexer: LatexLexer) -> None:
    """A wide space separates the components of a row in square brackets: [F_x \\quad F_y]^T."""
    if lexer.brackets and lexer.found[lexer.brackets[-1]].text == "[" and not lexer.found[-1].is_operator(","):
        lexer.found.append(Token("operator", ",", Span(lexer.source.at, 0)))


def read_sized(lexer: LatexLexer, size: str, start: int) -> None:
    """\\left, \\right and the like: what they enlarge follows."""
    character = lexer.source.next()
    right = size in ("right", "mright")
    if character == ".":
        lexer.source.at += 1
        if right and lexer.brackets:
            _end_system(lexer)
    elif lexer.source.match(BAR):
        read_bar(lexer, size, start)
    elif character == "" or character not in "()[]\\":
        fail("missing-argument", Span(start, len(size) + 1), name="\\" + size)


def _end_system(lexer: LatexLexer) -> None:
    """A brace before the lines of a system needs no other; a parenthesis without the other is a slip that is told."""
    span = lexer.found[lexer.brackets[-1]].span
    if lexer.source.text[span.offset : span.offset + span.length] in ("\\{", "\\lbrace"):
        del lexer.found[lexer.brackets.pop()]


def read_bar(lexer: LatexLexer, _name: str, start: int) -> None:
    """A bar that opens, one that closes, or one that does not say which."""
    kind, span = lexer.sides.get(start, "operator"), lexer.since(start)
    function = [Token("function", "abs", span)] if kind == "open" else []
    lexer.found += [*function, Token(kind, "|", span)]


def read_letters(lexer: LatexLexer) -> None:
    """A run of letters: one symbol for each letter, or one word if only that makes sense."""
    start = lexer.source.at
    match = lexer.source.match(LETTERS)
    run = match[0] if match else ""
    if run and lexer.source.rest and lexer.source.text[lexer.source.at] in "\u0307\u0308":
        if len(run) == 1:
            read_symbol(lexer, run, start)
            return
        lexer.source.at -= 1  # the dot stands over the last letter alone
        run = run[:-1]
    if run == "e" and lexer.source.next() == "^" and lexer.names.get("e") is None:
        read_exponential_power(lexer, start)
        return
    letters_end = lexer.source.at
    index, power, span = _index_and_power(lexer, start)
    if len(run) > 1:
        single = [lexer.names.resolve(letter) for letter in run[:-1]] + [lexer.names.resolve(run[-1] + index)]
        whole = lexer.names.candidates(run + index) or (run in SPELLINGS and not index)
        if all(single) and not is_differential(run, single):
            if whole:
                product = "*".join(symbol.name for symbol in single if symbol)
                fail("ambiguous-product", span, text=run + index, first=product, second=run + index)
            if lexer.after_number() and run in UNITS:
                fail("unit", span, name=run)
            for i, symbol in enumerate(single):
                last = Span(letters_end - 1, span.offset + span.length - letters_end + 1)
                where = Span(start + i, 1) if i < len(run) - 1 else last
                lexer.found.append(Token("name", symbol.name if symbol else "", where))
            lexer.found += power
            return
    lexer.found += word_tokens(run + index, span, lexer.names, after_number=lexer.after_number())
    lexer.found += power


def read_symbol(lexer: LatexLexer, base: str, start: int, before: tuple[Token, ...] = ()) -> None:
    """A single letter or Greek name with its index and power; `before` are the tokens of an accent."""
    simple = SINGLE.match(base if base.startswith("\\") or len(base) == 1 else "\\" + base)
    if simple is None or (simple[1] and simple[1] not in GREEK_NAMES):
        fail("indexed-operator", lexer.since(start), name=base.strip()[:40])
    dots = lexer.source.match(MARKS)
    if dots:
        order = sum(1 if mark == "\u0307" else 2 for mark in dots[0])
        if order > 2:
            fail("derivative-order", lexer.since(start), order=order)
        before = (*before, Token("dot", str(order), lexer.since(start)))
    index, power, span = _index_and_power(lexer, start)
    word = key(base.strip().removeprefix("\\")) + index
    lexer.found += [*before, *word_tokens(word, span, lexer.names), *power]


def _index_and_power(lexer: LatexLexer, begin: int) -> tuple[str, list[Token], Span]:
    """The index and the power after a symbol, in either order; where the symbol stands without its power."""
    index = _index(lexer)
    span = lexer.since(begin)
    if lexer.source.next() != "^":
        return index, [], span
    mark = len(lexer.found)
    start = lexer.source.at
    lexer.source.at += 1
    lexer.superscript(start)
    power = lexer.found[mark:]
    del lexer.found[mark:]
    return index or _index(lexer), power, span


def _index(lexer: LatexLexer) -> str:
    if lexer.source.next() != "_":
        return ""
    start = lexer.source.at
    lexer.source.at += 1
    inside = lexer.source.argument(Span(start, 1), "_")
    content = lexer.source.text[slice(*inside)]
    if not INDEX.match(content):
        fail("unexpected-symbol", Span(inside[0], inside[1] - inside[0]), symbol=content.strip()[:40])
    return "_" + key(content).replace(",", "")


def read_accent(lexer: LatexLexer, name: str, start: int) -> None:
    """\\dot to \\ddddot over a symbol, whose index stands outside or inside, or over an expression."""
    inside = lexer.source.argument(lexer.since(start), "\\" + name)
    span = lexer.since(start)
    accent = Token("dot", str(name.count("d")), span)
    content = lexer.source.text[slice(*inside)]
    simple = SINGLE.match(content)
    if simple and (simple[2] or simple[3] or simple[1] in GREEK_NAMES):
        read_symbol(lexer, content.strip(), start, (accent,))
    else:
        lexer.found += [accent, *lexer.grouped(inside)]


def read_upright(lexer: LatexLexer, start: int) -> None:
    """\\mathrm{…}, \\text{…}, \\operatorname{…}: d, e, a function, a symbol; a unit is refused."""
    inside = lexer.source.argument(lexer.since(start), "\\mathrm")
    word = lexer.source.text[slice(*inside)].strip()
    span = lexer.since(start)
    if word == "d":
        lexer.found.append(Token("differential", UPRIGHT_D, span))
    elif word == "e" and lexer.source.next() == "^":
        read_exponential_power(lexer, start)
    elif word in SPELLINGS:
        lexer.found.append(Token("function", SPELLINGS[word].name, span))
    elif word in UNITS and lexer.source.next() != "_" and not _is_typeset_upright(lexer, word):
        fail("unit", span, name=word)
    else:
        _read_upright_symbol(lexer, word, inside, start)


def _is_typeset_upright(lexer: LatexLexer, word: str) -> bool:
    """Whether the scene itself writes this symbol upright; else upright letters are units."""
    return any("rm" in s.typeset for s in lexer.names.candidates(word))


def _read_upright_symbol(lexer: LatexLexer, word: str, inside: Range, start: int) -> None:
    if not re.fullmatch(r"\\?[A-Za-z][A-Za-z0-9]*", word):
        units = re.findall(r"(?<![A-Za-z\\])[A-Za-z]+", word)
        if units and UNITS.issuperset(units):
            fail("unit", Span(inside[0], inside[1] - inside[0]), name=units[0])
        fail("unexpected-symbol", Span(inside[0], max(inside[1] - inside[0], 1)), symbol=word[:40])
    index, power, span = _index_and_power(lexer, start)
    lexer.found += [*word_tokens(key(word) + index, span, lexer.names), *power]


def read_exponential_power(lexer: LatexLexer, start: int) -> None:
    """e^{…}: the exponential function."""
    lexer.source.skip_space()
    lexer.source.at += 1
    inside = lexer.source.argument(lexer.since(start), "e^")
    lexer.found += [Token("function", "exp", Span(start, inside[0] - start)), *lexer.grouped(inside, "(")]


def read_fraction(lexer: LatexLexer, name: str, start: int) -> None:
    """\\frac{a}{b}, \\frac12 and the derivatives \\frac{d}{dt}, \\frac{d x}{dt}, \\frac{\\partial f}{\\partial q}."""
    owner = lexer.since(start)
    upper = lexer.source.argument(owner, "\\" + name)
    lower = lexer.source.argument(owner, "\\" + name)
    if _read_derivative(lexer, upper, lower, lexer.since(start)):
        return
    span = lexer.since(start)
    lexer.found += [
        Token("open", "", Span(start, 0)),
        *lexer.grouped(upper),
        Token("operator", "/", Span(lower[0], 0)),
        *lexer.grouped(lower),
        Token("close", "", Span(span.offset + span.length, 0)),
    ]


def _read_derivative(lexer: LatexLexer, upper: Range, lower: Range, span: Span) -> bool:
    text = lexer.source.text
    above, below = differential_head(text, upper), differential_head(text, lower)
    if above is None or below is None:
        return False
    kind, order, rest = above
    if kind != below[0] or not ONLY_VARIABLES.match(text, *below[2]):
        return False
    variables = differential_variables(text, below[2], span)
    if sum(times for _, times in variables) != order or order > 2:
        fail("derivative-order", span, order=max(order, sum(times for _, times in variables)))
    function = lexer.grouped(rest, "(") if lexer.source.text[slice(*rest)].strip() else []
    tokens = function
    for inside, times in reversed(variables):
        for _ in range(times):
            tokens = [Token("derivative", kind, span), *lexer.grouped(inside), *tokens]
            if function and (inside, times) != variables[0]:
                tokens = [Token("open", "(", span), *tokens, Token("close", ")", span)]
    lexer.found += tokens
    return True


def read_root(lexer: LatexLexer, name: str, start: int) -> None:
    """\\sqrt{x} and \\sqrt[3]{x}."""
    index = lexer.source.optional()
    inside = lexer.source.argument(lexer.since(start), "\\" + name)
    span = lexer.since(start)
    if index is None:
        lexer.found += [Token("function", "sqrt", Span(start, inside[0] - start)), *lexer.grouped(inside, "(")]
        return
    one = lexer.grouped(index)
    lexer.found += [
        *(Token("open", "", Span(start, 0)), *lexer.grouped(inside, "("), Token("operator", "^", span)),
        *(Token("open", "", span), Token("number", "1", span, Fraction(1)), Token("operator", "/", span), *one),
        *(Token("close", "", span), Token("close", "", Span(lexer.source.at, 0))),
    ]


def read_exponential(lexer: LatexLexer, _name: str, start: int) -> None:
    """\\exponentialE^{…}"""
    if lexer.source.next() != "^":
        fail("euler-number", lexer.since(start), name="e")
    read_exponential_power(lexer, start)


def read_boxed(lexer: LatexLexer, name: str, start: int) -> None:
    """\\boxed{…}: a frame around a result says nothing about it."""
    lexer.found += lexer.within(lexer.source.argument(lexer.since(start), "\\" + name))


def read_environment(lexer: LatexLexer, _name: str, start: int) -> None:
    """Matrices become vectors; aligned equations and cases a system."""
    name, inside = lexer.source.environment(start)
    span = lexer.since(start)
    if name in SYSTEMS:
        _read_system(lexer, inside)
    elif name in MATRICES:
        _read_matrix(lexer, name, inside, span)
    else:
        fail("unknown-environment", span, name=name)


def _read_system(lexer: LatexLexer, inside: Range) -> None:
    rows = [(row[0][0], row[-1][1]) for row in cells(lexer.source.text, inside)]
    filled = [row for row in rows if lexer.source.text[slice(*row)].strip()]
    for row, separator in zip(filled, (None, *separators(filled)), strict=True):
        lexer.found += [Token("operator", ";", separator)] if separator else []
        lexer.found += lexer.within(row)


def _read_matrix(lexer: LatexLexer, name: str, inside: Range, span: Span) -> None:
    if name == "array":
        source = Source(lexer.source.text, *inside)
        source.argument(span, "array")
        inside = source.at, inside[1]
    rows = [row for row in cells(lexer.source.text, inside) if lexer.source.text[row[0][0] : row[-1][1]].strip()]
    if not rows:
        fail("empty", span)
    if len(rows) == 1 or all(len(row) == 1 for row in rows):
        lexer.found += _vector(lexer, [cell for row in rows for cell in row], span)
    else:
        between = separators([(row[0][0], row[-1][1]) for row in rows])
        lexer.found += vector_tokens([_vector(lexer, row, span) for row in rows], between, span)


def _vector(lexer: LatexLexer, parts: list[Range], span: Span) -> list[Token]:
    return vector_tokens([lexer.within(part) for part in parts], separators(parts), span)


_HANDLERS: Mapping[str, Callable[[LatexLexer, str, int], None]] = MappingProxyType(
    {
        **dict.fromkeys(("frac", "tfrac", "dfrac", "cfrac"), read_fraction),
        "sqrt": read_root,
        **dict.fromkeys(("dot", "ddot", "dddot", "ddddot"), read_accent),
        "begin": read_environment,
        "exponentialE": read_exponential,
        "boxed": read_boxed,
        **dict.fromkeys(("vert", "lvert", "rvert"), read_bar),
        **dict.fromkeys(("quad", "qquad"), lambda lexer, _name, _start: separate(lexer)),
    }
)
