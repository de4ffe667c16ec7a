"""The Pratt parser: tokens of the common alphabet → tree.

Binding, loosest first: `=`, sums, sign, products (written or implied), powers, primes. Where usage is divided
(`1/2 m`, `sin phi l`, `sin phi^2`) the answer is an error that shows both readings, never a guess.
"""

from __future__ import annotations

from typing import NoReturn

from .arguments import Arguments
from .bounds import MAX_DEPTH, shape_of
from .brackets import Brackets
from .cursor import Cursor
from .names import Names
from .operators import Operators
from .tokens import Token, between, fail
from .tree import Equation, Negation, Node, Number, Power, Product, Quotient, Span, Sum, Vector

_SUM, _SIGN, _PRODUCT, _POWER = 10, 20, 20, 40
_STARTS = frozenset({"name", "function", "dot", "variation", "differential", "partial", "derivative", "diff", "open"})


class Grammar:
    """One text being read."""

    def __init__(self, text: str, tokens: list[Token], names: Names) -> None:
        self.cursor = Cursor(text, tokens, names)
        self.operators = Operators(self)
        self.arguments = Arguments(self)
        self.brackets = Brackets(self)

    def whole(self) -> Node:
        """All of the text: an expression, an equation, or several of them separated by `;`."""
        if self.cursor.at_end():
            fail("empty", Span(0, 0))
        parts = [self.equation()]
        while self.cursor.takes(";") and not self.cursor.at_end():
            parts.append(self.equation())
        if not self.cursor.at_end():
            self._trailing()
        first, last = parts[0].span, parts[-1].span
        return parts[0] if len(parts) == 1 else self.cursor.made(Vector(tuple(parts), between(first, last)))

    def equation(self) -> Node:
        """An expression, or `left = right`."""
        left = self.expression()
        if not self.cursor.takes("="):
            return left
        right = self.expression()
        if self.cursor.token.is_operator("="):
            fail("chained-equation", self.cursor.token.span)
        return self.cursor.made(Equation(left, right, between(left.span, right.span)))

    def expression(self, binding: int = 0) -> Node:
        """An operand and all that binds to it more tightly than `binding`."""
        self.cursor.descend()
        left = self._operand(binding)
        nested = 0
        while True:
            nested += self.cursor.token.is_operator("/", "^", "'")
            following = self._follow(left, binding)
            if following is None:
                break
            left = following
            if nested > MAX_DEPTH:
                fail("too-deep", left.span, limit=MAX_DEPTH)
        self.cursor.depth -= 1
        return left

    def factor(self) -> Node:
        """An atom with its powers and primes."""
        return self.expression(_POWER - 1)

    def atom(self) -> Node:
        """An operand alone: a name, a number, something in brackets."""
        self.cursor.descend()
        node = self._operand(_POWER)
        self.cursor.depth -= 1
        return node

    def _operand(self, binding: int) -> Node:  # noqa: PLR0911 - one case for each kind of token
        token = self.cursor.token
        match token.kind:
            case "number":
                self.cursor.take()
                return self.cursor.made(Number(token.value, token.span))
            case "name":
                return self.operators.name()
            case "open":
                return self.brackets.bracket()
            case "function":
                return self.arguments.call()
            case "operator":
                return self._sign(binding)
            case "end" | "close":
                return self.unexpected()
            case _:
                return self.operators.operator()

    def _sign(self, binding: int) -> Node:
        token = self.cursor.token
        if self.cursor.takes("-"):
            operand = self.expression(max(_SIGN, binding))
            return self.cursor.made(Negation(operand, between(token.span, operand.span)))
        if self.cursor.takes("+"):
            return self.expression(max(_SIGN, binding))
        if self.cursor.takes("|"):
            return self.brackets.absolute(token)
        return self.unexpected()

    def _follow(self, left: Node, binding: int) -> Node | None:
        """`left` with one more operator and operand, or None if nothing binds tightly enough."""
        token = self.cursor.token
        if token.is_operator("^") and binding < _POWER:
            return self._power(left)
        if token.is_operator("'"):
            return self._prime(left)
        if token.is_operator("*", "×", "/") and binding < _PRODUCT:
            return self._product_or_quotient(left)
        if token.is_operator("+", "-") and binding < _SUM:
            return self._sum(left)
        if binding < _PRODUCT and self.starts_factor():
            return self._implied_product(left)
        return None

    def starts_factor(self) -> bool:
        """Whether a factor without `*` follows."""
        token = self.cursor.token
        if token.kind == "number":
            fail("missing-operator", token.span, symbol=self.cursor.slice(token.span))
        return token.kind in _STARTS or (token.is_operator("|") and not self.brackets.inside_bars)

    def _power(self, base: Node) -> Node:
        self.cursor.take()
        exponent = self.expression(_POWER - 1)
        return self.cursor.made(Power(base, exponent, between(base.span, exponent.span)))

    def _prime(self, operand: Node) -> Node:
        span = between(operand.span, self.cursor.take().span)
        if isinstance(operand, Number):
            fail("prime-of-number", span)
        return self.operators.prime(operand, span)

    def _sum(self, left: Node) -> Node:
        terms = [left]
        while self.cursor.token.is_operator("+", "-"):
            sign = self.cursor.take()
            term = self.expression(_SUM)
            if sign.text == "-":
                term = self.cursor.made(Negation(term, between(sign.span, term.span)))
            terms.append(term)
        return self.cursor.made(Sum(tuple(terms), between(left.span, terms[-1].span)))

    def _product_or_quotient(self, left: Node) -> Node:
        sign = self.cursor.take()
        right = self.expression(_PRODUCT)
        if sign.text == "×" and shape_of(left) and shape_of(right):
            fail("cross-product", sign.span)
        if sign.text != "/":
            return self._times(left, right)
        rate = self.operators.quotient_of_differentials(left, right)
        if rate is not None:
            return rate
        quotient = self.cursor.made(Quotient(left, right, between(left.span, right.span)))
        if self.starts_factor():
            self._ambiguous_quotient(left, right)
        return quotient

    def _ambiguous_quotient(self, left: Node, right: Node) -> NoReturn:
        """`1/2 m`: half of m, or one over 2m?"""
        start = self.cursor.token.span
        after = self.factor()
        upper, lower, then = (self.cursor.reading(s) for s in (left.span, right.span, after.span))
        first, second = f"({upper}/{lower})*{then}", f"{upper}/({lower}*{then})"
        fail("ambiguous", between(left.span, between(start, after.span)), first=first, second=second)

    def _implied_product(self, left: Node) -> Node:
        return self._times(left, self.expression(_PRODUCT))

    def _times(self, left: Node, right: Node) -> Node:
        span = between(left.span, right.span)
        if isinstance(left, Product):
            return Product((*left.factors, right), span)
        return self.cursor.made(Product((left, right), span))

    def _trailing(self) -> NoReturn:
        if self.cursor.token.is_operator(","):
            self.brackets.decimal_comma()
            fail("separating-comma", self.cursor.token.span)
        self.unexpected()

    def unexpected(self) -> NoReturn:
        """Report the token ahead, which cannot stand here."""
        self.cursor.unexpected()
