"""Reading what a request wants to vary. Problems point at the field and, in an expression, at the character."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..contract.variation import IntegralFunctional, NamedFunction, ValueFunctional, VariationRequest
from ..derivation.domain import Instant, Interval
from ..derivation.functional import Functional
from ..errors import ExpressionError, InputError, Problem, RequestError
from ..language.expression import Expression
from ..language.names import Kind, Names, Symbol
from ..language.parser import Syntax, parse
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..language.tree import Node, Rate, Vector, walk

HIGHEST = 2


@dataclass(frozen=True)
class Question:
    """What to vary, and what the user calls the direction of each function ("" for δ of its name)."""

    functional: Functional
    directions: Mapping[str, str]


def read_question(asked: VariationRequest) -> Question:
    """The question of a request. Raises RequestError for names and expressions that cannot be read."""
    names = _names(asked)
    tree = _parsed(asked.expression, names, asked.syntax, "/expression").tree
    domain = _domain(asked.functional, names, asked.syntax)
    components = tree.components if isinstance(tree, Vector) else (tree,)
    problems = [*_component_problems(components, domain)]
    if problems:
        raise RequestError(*problems)
    functional = Functional(names, components, domain)
    if not functional.along:
        known = ", ".join(names.coordinates)
        raise RequestError(Problem("nothing-varied", "/expression", parameters={"names": known}))
    return Question(functional, _directions(asked.direction, names))


def _names(asked: VariationRequest) -> Names:
    """Functions behave like coordinates. Raises RequestError for names that cannot be or are taken."""
    symbols: list[Symbol] = []
    problems: list[Problem] = []
    for field, wanted in (
        ("functions", [_symbol(entry, "coordinate") for entry in asked.functions]),
        ("parameters", [_symbol(entry, "parameter") for entry in asked.parameters]),
    ):
        for index, symbol in enumerate(wanted):
            problems += _name_problems(symbol.name, symbols, f"/{field}/{index}")
            symbols.append(symbol)
    if problems:
        raise RequestError(*problems)
    return Names(tuple(symbols))


def _symbol(entry: str | NamedFunction, kind: Kind) -> Symbol:
    return Symbol(entry, kind) if isinstance(entry, str) else Symbol(entry.name, kind, entry.latex or "")


def _name_problems(name: str, known: Sequence[Symbol], pointer: str) -> Iterator[Problem]:
    if name in {symbol.name for symbol in known}:
        yield Problem("duplicate-name", pointer, parameters={"name": name})
    try:
        Names((Symbol(name, "parameter"),))
    except InputError as error:
        yield from (problem.below(pointer) for problem in error.problems)


def _directions(given: Sequence[str], names: Names) -> Mapping[str, str]:
    """Each function with the name of its direction."""
    if not given:
        return dict.fromkeys(names.coordinates, "")
    if len(given) != len(names.coordinates):
        parameters = {"functions": len(names.coordinates), "found": len(given)}
        raise RequestError(Problem("direction-count", "/direction", parameters=parameters))
    problems: list[Problem] = []
    known = list(names.symbols)
    for index, name in enumerate(given):
        problems += _name_problems(name, known, f"/direction/{index}")
        known.append(Symbol(name, "coordinate"))
    if problems:
        raise RequestError(*problems)
    return dict(zip(names.coordinates, given, strict=True))


def _parsed(text: str, names: Names, syntax: Syntax, pointer: str) -> Expression:
    try:
        expression = parse(text, names, syntax)
        to_sympy(expression.tree, Symbols(names))
    except ExpressionError as error:
        raise RequestError(*(problem.below(pointer) for problem in error.problems)) from None
    return expression


def _component_problems(components: tuple[Node, ...], domain: Instant | Interval | None) -> Iterator[Problem]:
    """Scalars in the functions and their rates; an integral has one only."""
    parts = [Expression("", component) for component in components]
    if not all(part.is_scalar for part in parts) or (isinstance(domain, Interval) and len(parts) > 1):
        yield Problem("not-scalar", "/expression")
    elif any(part.has_derivatives for part in parts):
        yield Problem("derivative-in-scene", "/expression")
    else:
        for component in components:
            yield from _order_problems(component)


def _order_problems(varied: Node) -> Iterator[Problem]:
    """Integration by parts is carried out twice at most: what is varied holds functions and two of their rates."""
    high = next((node for node in walk(varied) if isinstance(node, Rate) and node.order > HIGHEST), None)
    if high is not None:
        yield Problem(
            "integrand-order", "/expression", high.span.offset, high.span.length, parameters={"name": high.name}
        )


def _domain(
    asked: ValueFunctional | IntegralFunctional | None, names: Names, syntax: Syntax
) -> Instant | Interval | None:
    """Where the functional looks: an instant, an interval, or anywhere."""
    if asked is None:
        return None
    if isinstance(asked, ValueFunctional):
        return Instant(_constant(asked.at, "at", names, syntax))
    lower, upper = (_constant(asked.start, "from", names, syntax), _constant(asked.to, "to", names, syntax))
    if lower == upper:
        raise RequestError(Problem("empty-interval", "/functional/to"))
    return Interval(lower, upper, asked.ends)


def _constant(text: str, field: str, names: Names, syntax: Syntax) -> Node:
    """An instant: a number or an expression of parameters."""
    pointer = f"/functional/{field}"
    expression = _parsed(text, names, syntax, pointer)
    moving = sorted(expression.names & {*names.coordinates, "t"})
    if moving:
        raise RequestError(Problem("instant-not-constant", pointer, parameters={"name": moving[0]}))
    if not expression.is_scalar:
        raise RequestError(Problem("not-scalar", pointer))
    return expression.tree
