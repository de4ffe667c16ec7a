"""What a function is applied to: in brackets, or without them as far as usage is agreed on."""

from __future__ import annotations

from typing import NoReturn, Protocol

from .choices import Choices
from .cursor import Cursor
from .functions import FUNCTIONS
from .tokens import Token, between, fail
from .tree import Call, Name, Negation, Node, Number, Power, Product, Quotient, Rate, Span, walk


class Operands(Protocol):
    """The grammar, as far as an argument needs it."""

    cursor: Cursor
    choices: Choices | None

    def expression(self, binding: int = 0) -> Node:
        """An operand and all that binds to it more tightly than `binding`."""

    def factor(self) -> Node:
        """An atom with its powers and primes."""

    def atom(self) -> Node:
        """An operand alone."""


class Arguments:
    """Reads a function of the allow-list and what it is applied to.

    An argument without brackets is one product of numbers and parameters that ends with the first coordinate or
    time: `sin 2 phi`, `sin omega t`. It ends before another function, δ, a rate or a bracket. If a further name follows
    (`sin phi l`), both readings are shown.
    """

    def __init__(self, grammar: Operands) -> None:
        self._grammar = grammar
        self._cursor = grammar.cursor

    def call(self) -> Node:
        """The call ahead, with the power that may stand after the function's name."""
        token = self._cursor.take()
        power = self._power_after_name(token)
        opening = self._cursor.token
        if opening.kind == "open" and opening.text in ("(", "|"):
            arguments = self._bracketed(token)
            span = between(token.span, self._cursor.previous.span)
        else:
            arguments = (self._bare(token),)
            span = between(token.span, arguments[0].span)
        node = self.made(token.text, arguments, span)
        return node if power is None else self._cursor.made(Power(node, power, span))

    def made(self, function: str, arguments: tuple[Node, ...], span: Span) -> Node:
        """The call, if the number of arguments is right."""
        known = FUNCTIONS[function]
        wanted = known.arguments
        while known.is_associative and len(arguments) > wanted:
            arguments = (self._cursor.made(Call(function, arguments[:2], span)), *arguments[2:])
        if len(arguments) != wanted:
            fail("argument-count", span, function=function, wanted=wanted, found=len(arguments))
        return self._cursor.made(Call(function, arguments, span))

    def _power_after_name(self, token: Token) -> Node | None:
        if not self._cursor.token.is_operator("^"):
            return None
        self._cursor.take()
        power = self._grammar.atom()
        span = between(token.span, power.span)
        if not isinstance(power, Number):
            fail("inverse-function" if _is_minus_one(power) else "function-power", span, function=token.text)
        if power.value.denominator > 1 or not FUNCTIONS[token.text].power_after_name:
            fail("function-power", span, function=token.text)
        return power

    def _bracketed(self, token: Token) -> tuple[Node, ...]:
        opening = self._cursor.take()
        if self._cursor.token.kind == "close":
            fail("argument-count", between(token.span, self._cursor.token.span), function=token.text,
                 wanted=FUNCTIONS[token.text].arguments, found=0)  # fmt: skip
        arguments = [self._grammar.expression()]
        while self._cursor.takes(","):
            arguments.append(self._grammar.expression())
        self._cursor.close(opening)
        return tuple(arguments)

    def _bare(self, token: Token) -> Node:
        if self._cursor.token.kind not in ("name", "number", "dot", "open") or self._cursor.token.text == "[":
            fail("argument-expected", token.span, function=token.text)
        if token.text == "sqrt":
            return self._grammar.atom()
        factors = [self._grammar.atom()]
        while not self._ends(factors) and self._cursor.token.kind in ("name", "open", "dot"):
            if self._cursor.token.kind == "open" and self._cursor.token.text:
                break
            factors.append(self._grammar.atom())
        argument = factors[0]
        if len(factors) > 1:
            argument = self._cursor.made(Product(tuple(factors), between(factors[0].span, factors[-1].span)))
        if self._grammar.choices is not None:
            return self._chosen_end(argument, self._grammar.choices)
        self._check_end(token, argument)
        return argument

    def _chosen_end(self, argument: Node, choices: Choices) -> Node:
        """`sin phi/2`: half of the sine, or the sine of half the angle. Any other rest stands outside."""
        ahead, after = self._cursor.token, self._cursor.ahead()
        if not ahead.is_operator("/") or after.kind != "number" or self._cursor.ahead(2).is_operator("^", "*"):
            return argument
        if choices.at(ahead.span.offset, 2, 2) == 0:
            return argument
        self._cursor.take()
        number = self._grammar.atom()
        return self._cursor.made(Quotient(argument, number, between(argument.span, number.span)))

    def _ends(self, factors: list[Node]) -> bool:
        """Whether the argument is complete: it has a quantity that moves, or a rate follows a parameter."""
        used = {n.name for f in factors for n in walk(f) if isinstance(n, Name)}
        moving = any(isinstance(n, Rate) for f in factors for n in walk(f))
        kinds = {symbol.kind for name in used if (symbol := self._cursor.names.get(name))}
        return moving or bool(kinds & {"coordinate", "time", "material"}) or (
            self._cursor.token.kind == "dot" and bool(used)
        )  # fmt: skip

    def _check_end(self, function: Token, argument: Node) -> None:
        """Refuse what could belong to the argument or to the call: a further name, a bracket, `^`, `/`, a prime."""
        ahead = self._cursor.token
        if ahead.kind in ("name", "open") and not (ahead.kind == "open" and ahead.text == "["):
            rest = self._grammar.factor()
            self._ambiguous(function, argument, f"*{self._cursor.reading(rest.span)}",
                            between(argument.span, rest.span))  # fmt: skip
        if ahead.is_operator("^", "/"):
            self._cursor.take()
            rest = self._grammar.factor()
            self._ambiguous(function, argument, f"{ahead.text}{self._cursor.reading(rest.span)}",
                            between(argument.span, rest.span))  # fmt: skip
        parameters = [n.name for n in walk(argument) if isinstance(n, Name)]
        several = len(set(parameters)) > 1 and not self._ends([argument])
        if several and isinstance(argument, Product):
            near = self._cursor.reading(argument.factors[0].span)
            far = self._cursor.reading(between(argument.factors[1].span, argument.span))
            first, second = f"{function.text}({near})*{far}", f"{function.text}({self._cursor.reading(argument.span)})"
            fail("ambiguous", between(function.span, argument.span), first=first, second=second)

    def _ambiguous(self, function: Token, argument: Node, outside: str, inside: Span) -> NoReturn:
        near = self._cursor.reading(argument.span)
        first, second = f"{function.text}({near}){outside}", f"{function.text}({self._cursor.reading(inside)})"
        fail("ambiguous", between(function.span, inside), first=first, second=second)


def _is_minus_one(node: Node) -> bool:
    return isinstance(node, Negation) and isinstance(node.operand, Number) and node.operand.value == 1
