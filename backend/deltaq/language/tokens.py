"""The common alphabet: both lexers yield these tokens, and the one parser reads nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, NoReturn

from ..errors import ExpressionError, Parameter, Problem
from .tree import Span

Kind = Literal[
    "number",  # value: Fraction
    "name",  # text: the symbol's name
    "function",  # text: name in the allow-list
    "dot",  # text: number of time derivatives, "1" to "4"; applies to the atom that follows
    "variation",  # δ, applies to the atom that follows
    "differential",  # d, applies to the atom that follows
    "partial",  # ∂ of the plain syntax: ∂/∂x (…)
    "derivative",  # text: "d" or "partial"; then (variable) and the operand
    "diff",  # diff(expression, variable, …)
    "open",  # text: "(" or "[" or "" for a group without a bracket of its own, such as a fraction
    "close",
    "operator",  # + - * / ^ , ; = | ' and T for the transpose
    "end",
]


@dataclass(frozen=True)
class Token:
    """One token and where it stands."""

    kind: Kind
    text: str
    span: Span
    value: Fraction = Fraction(0)

    def is_operator(self, *texts: str) -> bool:
        """Whether it is one of these operators."""
        return self.kind == "operator" and self.text in texts


def between(first: Span, last: Span) -> Span:
    """The stretch of text from the start of one span to the end of another."""
    return Span(first.offset, max(last.offset + last.length - first.offset, 0))


def fail(code: str, span: Span, **parameters: Parameter) -> NoReturn:
    """Stop reading: the text is wrong at `span`."""
    raise ExpressionError(Problem(code, "", span.offset, span.length, parameters))


def has_comma(tokens: list[Token]) -> bool:
    """Whether a comma or semicolon stands outside all brackets."""
    depth = 0
    for token in tokens:
        depth += (token.kind == "open") - (token.kind == "close")
        if depth == 0 and token.is_operator(",", ";"):
            return True
    return False


def vector_tokens(parts: list[list[Token]], separators: list[Span], span: Span) -> list[Token]:
    """[a, b, …] of the tokens of its components; `separators` are the places between them."""
    tokens = [Token("open", "[", Span(span.offset, 1)), *parts[0]]
    for separator, part in zip(separators, parts[1:], strict=True):
        tokens += [Token("operator", ",", separator), *part]
    return [*tokens, Token("close", "]", Span(span.offset + span.length - 1, 1))]
