"""The Pratt parser: tokens of the common alphabet → tree.

Binding, loosest first: `=`, sums, sign, products (written or implied), powers, primes. Where usage is divided
(`1/2 m`, `sin phi l`, `sin phi^2`) the answer is an error that shows both readings, never a guess, unless the caller
brings the choices to be made.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

from .arguments import Arguments
from .bounds import MAX_DEPTH, shape_of
from .choices import Choices
from .cursor import Cursor
from .differentiation import Differentiation
from .names import Names
from .tokens import Token, between, fail
from .tree import Equation, Name, Negation, Node, Number, Power, Product, Quotient, Rate, Span, Sum, Vector, walk

_SUM, _SIGN, _PRODUCT, _POWER = 10, 20, 20, 40
_STARTS = frozenset({"name", "function", "dot", "variation", "differential", "partial", "derivative", "diff", "open"})


class Grammar:
    """One text being read."""

    def __init__(self, text: str, tokens: list[Token], names: Names, choices: Choices | None = None) -> None:
        self.cursor = Cursor(text, tokens, names)
        self.choices = choices
        self.differentiation = Differentiation(self.cursor)
        self.operators = Operators(self)
        self.arguments = Arguments(self)
        self._inside_bars = 0

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
                return self._bracket()
            case "function":
                return self.arguments.call()
            case "operator":
                return self._sign(binding)
            case "end" | "close":
                return self.cursor.unexpected()
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
            return self._absolute(token)
        return self.cursor.unexpected()

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
            return self._times(left, self.expression(_PRODUCT))
        return None

    def starts_factor(self) -> bool:
        """Whether a factor without `*` follows."""
        token = self.cursor.token
        if token.kind == "number":
            fail("missing-operator", token.span, symbol=self.cursor.slice(token.span))
        return token.kind in _STARTS or (token.is_operator("|") and not self._inside_bars)

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
        rate = self.differentiation.quotient_of_differentials(left, right)
        if rate is not None:
            return rate
        if self.starts_factor():
            right = self._denominator(left, right)
        return self.cursor.made(Quotient(left, right, between(left.span, right.span)))

    def _denominator(self, left: Node, right: Node) -> Node:
        """What of the factors that follow `left / right` without a sign stands below the line, by the choice made."""
        if self.choices is None:
            self._ambiguous_quotient(left, right)
        tight, loose = self._factors_below(right)
        loose = tight if isinstance(right, Number) else loose  # nobody reads x/2 m as x/(2m)
        readings = [0, *([tight] if tight else []), *([loose] if loose > tight else [])]
        if len(readings) > 1:
            place = self.cursor.token.span.offset
            taken = readings[self.choices.at(place, len(readings), 2 if tight else 1)]
            for _ in range(taken):
                right = self._times(right, self.factor())
        return right

    def _factors_below(self, right: Node) -> tuple[int, int]:
        """How many factors could stand below the line: those written close to it, and all that are no functions.

        A rate, a function and a bracket after a space are never meant to.
        """
        mark = self.cursor.mark()
        tight = count = 0
        end = right.span.offset + right.span.length
        while (close := self.cursor.token.span.offset == end) or self.cursor.token.kind == "name":
            if not self._may_stand_below(close=close):
                break
            node = self.factor()
            if any(isinstance(part, Rate) for part in walk(node)):
                break
            count += 1
            tight += tight == count - 1 and close
            end = node.span.offset + node.span.length
        self.cursor.rewind(mark)
        return tight, count

    def _may_stand_below(self, *, close: bool) -> bool:
        token = self.cursor.token
        return token.kind == "name" or (token.text == "(" and close)

    def _ambiguous_quotient(self, left: Node, right: Node) -> NoReturn:
        """`1/2 m`: half of m, or one over 2m?"""
        start = self.cursor.token.span
        after = self.factor()
        upper, lower, then = (self.cursor.reading(s) for s in (left.span, right.span, after.span))
        first, second = f"({upper}/{lower})*{then}", f"{upper}/({lower}*{then})"
        fail("ambiguous", between(left.span, between(start, after.span)), first=first, second=second)

    def _times(self, left: Node, right: Node) -> Node:
        span = between(left.span, right.span)
        if isinstance(left, Product):
            return Product((*left.factors, right), span)
        return self.cursor.made(Product((left, right), span))

    def _trailing(self) -> NoReturn:
        if self.cursor.token.is_operator(","):
            self._decimal_comma()
            fail("separating-comma", self.cursor.token.span)
        self.cursor.unexpected()

    def _absolute(self, opening: Token) -> Node:
        self._inside_bars += 1
        content = self.expression()
        self._inside_bars -= 1
        if not self.cursor.token.is_operator("|"):
            fail("unclosed-bracket", opening.span, bracket="|", wanted="|")
        return self.arguments.made("abs", (content,), between(opening.span, self.cursor.take().span))

    def _bracket(self) -> Node:
        opening = self.cursor.take()
        bars, self._inside_bars = self._inside_bars, 0
        if opening.text == "[":
            node = self._vector(opening)
        else:
            node = self.expression()
            if self.choices is not None and self.cursor.token.is_operator(",", ";"):
                node = self._components(opening, node)
            else:
                self._refuse_comma(opening)
                self.cursor.close(opening)
        self._inside_bars = bars
        return replace(node, span=between(opening.span, self.cursor.previous.span))

    def _refuse_comma(self, opening: Token) -> None:
        """`(9,81)` is a decimal comma, `(a, b)` a vector in the wrong brackets."""
        if self.cursor.token.is_operator(","):
            self._decimal_comma()
            fail("vector-brackets", between(opening.span, self.cursor.token.span))
        if self.cursor.token.is_operator("=", ";"):
            self.cursor.unexpected()

    def _vector(self, opening: Token) -> Node:
        return self._components(opening, self.equation())

    def _components(self, opening: Token, first: Node) -> Node:
        """The components from the second one on, and the bracket that ends them."""
        parts = [first]
        while self.cursor.takes(",", ";"):
            parts.append(self.equation())
        span = self.cursor.close(opening)
        if len(parts) == 1:
            return parts[0]
        if self.cursor.takes("T"):
            span = between(span, self.cursor.previous.span)
        return self.cursor.made(Vector(tuple(parts), span))

    def _decimal_comma(self) -> None:
        before, after = self.cursor.previous, self.cursor.ahead()
        if before.kind == "number" and after.kind == "number":
            number = f"{self.cursor.slice(before.span)}.{self.cursor.slice(after.span)}"
            fail("decimal-comma", between(before.span, after.span), suggestion=number)


class Operators:
    """Reads what starts with a name or with a differential operator."""

    def __init__(self, grammar: Grammar) -> None:
        self._grammar = grammar
        self._cursor = grammar.cursor
        self._differentiation = grammar.differentiation

    def name(self) -> Node:
        """A symbol. `phi(t)` is the coordinate φ as a function of time, not φ·t."""
        token = self._cursor.take()
        node = self._cursor.made(Name(token.text, token.span))
        if self._differentiation.kind(token.text) in ("coordinate", "multiplier"):
            self._of_time()
        return node

    def prime(self, operand: Node, span: Span) -> Node:
        """φ′, or φ′(t), which is the rate as a function of time."""
        node = self._differentiation.time_derivative(operand, span)
        self._of_time()
        return node

    def _of_time(self) -> None:
        """Step over `(t)` after what depends on time anyway."""
        ahead = [self._cursor.ahead(i) for i in range(3)]
        if [token.text for token in ahead] == ["(", "t", ")"]:
            for _ in ahead:
                self._cursor.take()

    def operator(self) -> Node:  # noqa: PLR0911 - one case for each kind
        """The operator ahead, applied."""
        token = self._cursor.take()
        match token.kind:
            case "dot":
                return self._dot(token)
            case "variation":
                return self._differentiation.variation(*self._operand(token))
            case "differential" if self._differentiation.is_letter(token):
                return self._cursor.made(Name("d", token.span))
            case "differential":
                return self._differentiation.differential(*self._operand(token))
            case "diff":
                return self._diff(token)
            case "partial":
                return self._partial(token)
            case _:
                return self._derivative(token)

    def _dot(self, token: Token) -> Node:
        node, span = self._operand(token)
        for _ in range(int(token.text)):
            node = self._differentiation.time_derivative(node, span)
        return node

    def _operand(self, token: Token) -> tuple[Node, Span]:
        """What an operator applies to, and where operator and operand stand."""
        ahead = self._cursor.token
        if ahead.kind not in ("name", "open", "dot", "function"):
            fail("operand-expected", token.span, operator=self._cursor.slice(token.span))
        operand = self._grammar.atom()
        return operand, between(token.span, self._cursor.previous.span)

    def _diff(self, token: Token) -> Node:
        """diff(f, x), diff(f, x, y), diff(f, t, 2)."""
        opening = self._cursor.token
        if opening.text != "(":
            fail("brackets-expected", token.span, name="diff")
        self._cursor.take()
        node = self._grammar.expression()
        if not self._cursor.takes(","):
            fail("argument-count", between(token.span, self._cursor.token.span), function="diff", wanted=2, found=1)
        while True:
            variable = self._grammar.expression()
            repeat = self._repeat()
            for _ in range(repeat):
                node = self._derived(node, variable, between(token.span, variable.span))
            if not self._cursor.takes(","):
                break
        self._cursor.close(opening)
        return node

    def _repeat(self) -> int:
        if not (self._cursor.token.is_operator(",") and self._cursor.ahead().kind == "number"):
            return 1
        self._cursor.take()
        token = self._cursor.take()
        if token.value not in (1, 2):
            fail("derivative-order", token.span, order=self._cursor.slice(token.span))
        return int(token.value)

    def _derived(self, node: Node, variable: Node, span: Span) -> Node:
        """The derivative with respect to t is taken along the motion, any other is partial."""
        if variable == Name("t"):
            return self._differentiation.time_derivative(node, span)
        return self._differentiation.partial(node, variable, span)

    def _partial(self, token: Token) -> Node:
        """∂/∂x (…), or ∂(…)/∂x with the function on top."""
        on_top = None if self._cursor.token.is_operator("/") else self._grammar.atom()
        if not self._cursor.takes("/") or self._cursor.token.kind != "partial":
            fail("partial-derivative", token.span)
        self._cursor.take()
        variable = self._grammar.atom()
        while self._cursor.token.is_operator("'"):  # ∂L/∂φ′ is by the rate
            variable = self.prime(variable, between(variable.span, self._cursor.take().span))
        return self._applied(token, "partial", variable, on_top)

    def _derivative(self, token: Token) -> Node:
        """Operator form from a fraction: (variable), perhaps a power of the operator, then the operand."""
        variable = self._grammar.atom()
        order = self._order()
        node = self._applied(token, token.text, variable, None)
        for _ in range(order - 1):
            node = self._once(token.text, node, variable, node.span)
        return node

    def _order(self) -> int:
        if not self._cursor.takes("^"):
            return 1
        power = self._grammar.atom()
        if not isinstance(power, Number) or power.value not in (1, 2):
            fail("derivative-order", power.span, order=self._cursor.slice(power.span))
        return int(power.value)

    def _applied(self, token: Token, kind: str, variable: Node, operand: Node | None) -> Node:
        if operand is None:
            operand = self._derived_operand(token)
        return self._once(kind, operand, variable, between(token.span, self._cursor.previous.span))

    def _once(self, kind: str, operand: Node, variable: Node, span: Span) -> Node:
        if kind == "d":
            if variable != Name("t"):
                fail("total-derivative", variable.span, text=self._cursor.slice(variable.span))
            return self._differentiation.time_derivative(operand, span)
        return self._differentiation.partial(operand, variable, span)

    def _derived_operand(self, token: Token) -> Node:
        """What d/dt applies to: brackets, or one factor if nothing follows that it could apply to as well."""
        opening = self._cursor.token
        self._cursor.takes("*")
        bracketed = opening.kind == "open" and opening.text != ""
        operand = self._grammar.atom() if bracketed else self._grammar.factor()
        following = self._cursor.token
        if not bracketed and self._grammar.choices is not None and self._grammar.starts_factor():
            return self._whole_product(operand)
        divided = following.is_operator("^") if bracketed else following.is_operator("*", "/")
        if divided or (not bracketed and self._grammar.starts_factor()):
            if following.kind == "operator":
                self._cursor.take()
            rest = self._grammar.factor().span
            sign = self._cursor.reading(Span(token.span.offset, operand.span.offset - token.span.offset))
            near, all_ = self._cursor.reading(operand.span), between(operand.span, rest)
            after = self._cursor.reading(between(following.span, rest))
            first, second = f"({sign} {near}) {after}", f"{sign} ({self._cursor.reading(all_)})"
            fail("ambiguous", between(token.span, rest), first=first, second=second)
        return operand

    def _whole_product(self, operand: Node) -> Node:
        """d/dt m l φ′ is the derivative of all of it."""
        while self._grammar.starts_factor():
            factor = self._grammar.factor()
            operand = self._cursor.made(Product((operand, factor), between(operand.span, factor.span)))
        return operand
