"""The small changes by which a place of an answer gets the values wanted of it: what a slip of the pen undoes.

Each function looks at one place and knows one kind of change. `cost` orders the changes that fit: the smaller is the
likelier slip.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from ...language.tree import (
    Call,
    Differential,
    Name,
    Negation,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Rate,
    Sum,
    Variation,
    children,
    walk,
)
from ...vocabulary import SlipKind
from ..sampling import Values
from .lexicon import EXACT, WAVES, Base, Lexicon, Monomial, near, occurring, symbol_kind
from .spots import Path, Spot, Valued, exact, spots, with_children

MOST_TIMES = 24  # of a number that a term is too large or too small by
EXPONENTS = (Fraction(2), Fraction(1, 2), Fraction(3), Fraction(1, 3), Fraction(3, 2), Fraction(2, 3))


@dataclass(frozen=True)
class Edit:
    """A change at a path of a part: its kind, what stands there before and after, and what is `marked` if not all."""

    kind: SlipKind
    path: Path
    node: Node
    after: Node
    cost: float
    marked: Node | None = None


def edits(spot: Spot, lexicon: Lexicon, values: Valued) -> Iterator[Edit]:
    """All small changes that give a place the values wanted of it."""
    if not all(map(math.isfinite, (*spot.wanted, *spot.values))) or near(spot.values, spot.wanted):
        return
    if spot.is_whole and not isinstance(spot.node, Sum):
        yield from _missing_within(spot, lexicon)
    if spot.is_term:
        yield from _of_a_term(spot, lexicon)
    yield from _of_a_factor(spot, lexicon, values)


def _edit(spot: Spot, kind: SlipKind, after: Node, cost: float) -> Edit:
    return Edit(kind, spot.path, spot.node, after, cost)


# --- a term ----------------------------------------------------------------------------------------------------------


def _of_a_term(spot: Spot, lexicon: Lexicon) -> Iterator[Edit]:
    scale = max(map(abs, spot.values))
    if spot.is_addend and all(abs(w) <= EXACT * scale for w in spot.wanted):
        yield _edit(spot, "superfluous", exact(0), 1.25)
        return
    times = constant(spot.ratio)
    if times is not None:
        yield _times(spot, times)
        return
    held = occurring(spot.node)
    for monomial, sign in lexicon.found(spot.ratio):
        if sign > 0:
            yield from _factor_changed(spot, monomial, held)


def _times(spot: Spot, times: Fraction) -> Edit:
    kinds: dict[Fraction, tuple[SlipKind, float]] = {
        Fraction(-1): ("sign", 1.0),
        Fraction(2): ("half", 1.1),
        Fraction(1, 2): ("double", 1.1),
    }
    kind, cost = kinds.get(times, ("factor", 1.5))
    return _edit(spot, kind, Product((Number(times), spot.node)), cost)


def constant(values: Values) -> Fraction | None:
    """The small fraction that all values are, if they are one."""
    if not all(map(math.isfinite, values)) or not near(values, (values[0],) * len(values)):
        return None
    found = Fraction(values[0]).limit_denominator(MOST_TIMES)
    fits = found and abs(found) <= MOST_TIMES and abs(float(found) - values[0]) <= EXACT * abs(values[0])
    return found if fits else None


def _factor_changed(spot: Spot, monomial: Monomial, held: dict[Node, int]) -> Iterator[Edit]:
    """Factors that should be there and are not, or are and should not."""
    after = Product((spot.node, monomial.node))
    missing = [(b, p) for b, p in monomial.powers if p > 0 or held.get(b.node, 0) <= 0]
    surplus = [(b, -p) for b, p in monomial.powers if (b, p) not in missing]
    many = 0.35 * (len(monomial.powers) - 1) + 0.05 * sum(abs(p) - 1 for _, p in monomial.powers)
    if not surplus:
        kind: SlipKind = "power" if all(p > 0 and held.get(b.node, 0) > 0 for b, p in missing) else "factor-missing"
        yield _edit(spot, kind, after, 1.2 + many + (0.0 if all(p > 0 for _, p in missing) else 0.1))
    elif not missing:
        ((base, power), *_) = surplus
        rest = held.get(base.node, 0) - power
        kind = "power" if rest and len(surplus) == 1 else "factor-superfluous"
        yield replace(_edit(spot, kind, after, 1.2 + many), marked=_factor_of(spot.node, base.node))
    elif len(missing) == 1 and len(surplus) == 1:
        yield from _exchanged_factor(spot, after, missing[0], surplus[0])


def _factor_of(term: Node, base: Node) -> Node | None:
    """The factor of a term that is a base or a power of it."""
    wanted = (node for node in walk(term) if node == base or (isinstance(node, Power) and node.base == base))
    return next(wanted, None)


def _exchanged_factor(spot: Spot, after: Node, missing: tuple[Base, int], surplus: tuple[Base, int]) -> Iterator[Edit]:
    """One factor stands where another should."""
    (wanted, power), (there, count) = missing, surplus
    if power != count or power < 0:
        return
    kind, cost = replaced(there.node, wanted.node, (there.unit, wanted.unit))
    yield replace(_edit(spot, kind, after, cost + 0.05), marked=_factor_of(spot.node, there.node))


def replaced(there: Node, wanted: Node, units: tuple[str, str] = ("", "")) -> tuple[SlipKind, float]:
    """What it is called when one symbol or function stands where another should, and what it costs."""
    if isinstance(there, Call) and isinstance(wanted, Call):
        return ("function", 1.0) if there.arguments == wanted.arguments else ("argument", 1.2)
    if isinstance(there, Call) or isinstance(wanted, Call):
        return "function", 1.6
    if symbol_kind(there) == symbol_kind(wanted):
        return "rate", 1.1
    alike = type(there) is type(wanted) and units[0] == units[1]
    same_order = not isinstance(there, Rate) or not isinstance(wanted, Rate) or there.order == wanted.order
    return "name", 1.2 if alike and same_order else 1.45


# --- a factor, a symbol, a bracket -----------------------------------------------------------------------------------


def _of_a_factor(spot: Spot, lexicon: Lexicon, values: Valued) -> Iterator[Edit]:
    match spot.node:
        case Name() | Rate() | Variation() | Differential():
            yield from _symbol(spot, lexicon)
            yield from _power(spot)
        case Call():
            yield from _function(spot, spot.node, lexicon, values)
            yield from _power(spot)
        case Sum():
            yield from _power(spot)
            yield from _missing_within(spot, lexicon)
            yield from _other_orders(spot, values)
        case Power(base, Number() as exponent):
            yield from _exponent(spot, base, exponent.value, values)
            if exponent.value % 2 == 0:
                yield from _squared_bracket(spot, base, int(exponent.value), lexicon, values)
        case Quotient(numerator, denominator):
            if near(spot.wanted, tuple(1 / v if v else math.nan for v in spot.values)):
                yield _edit(spot, "exchanged", Quotient(denominator, numerator), 1.2)
        case _:
            return


def _symbol(spot: Spot, lexicon: Lexicon) -> Iterator[Edit]:
    own = next((base for base in lexicon.bases if base.node == spot.node), None)
    unit = own.unit if own else ""
    for base in lexicon.bases:
        if near(spot.wanted, base.values):
            kind, cost = replaced(spot.node, base.node, (unit, base.unit))
            yield _edit(spot, kind, replace_span(base.node, spot.node), cost)
        elif type(base.node) is type(spot.node) and base.unit == unit and base.node != spot.node:
            yield from _sum_of(spot, base)


def _sum_of(spot: Spot, base: Base) -> Iterator[Edit]:
    """R where R − r should be, M where M + m should."""
    if isinstance(spot.node, Rate) and isinstance(base.node, Rate) and spot.node.order != base.node.order:
        return
    for sign, added in ((1, base.node), (-1, Negation(base.node))):
        if near(spot.difference, tuple(sign * v for v in base.values)):
            yield _edit(spot, "missing", Sum((spot.node, added)), 1.3)


def replace_span(node: Node, there: Node) -> Node:
    """The node at the place of another in the text."""
    return replace(node, span=there.span)


def _power(spot: Spot) -> Iterator[Edit]:
    """x for x², (r − s) for (r − s)²."""
    for exponent in EXPONENTS[:3] if not isinstance(spot.node, Sum) else EXPONENTS[:2]:
        if near(spot.wanted, tuple(abs(v) ** float(exponent) if v else math.nan for v in spot.values)):
            yield _edit(spot, "power", Power(spot.node, Number(exponent)), 1.1)


def _exponent(spot: Spot, base: Node, exponent: Fraction, values: Valued) -> Iterator[Edit]:
    own = values(base)
    for other in (Fraction(1), *EXPONENTS, Fraction(-1), Fraction(-2)):
        if other != exponent and near(
            spot.wanted, tuple(v ** float(other) if v > 0 or (other.denominator == 1 and v) else math.nan for v in own)
        ):
            yield _edit(spot, "power", Power(base, Number(other)), 1.1)


def _function(spot: Spot, call: Call, lexicon: Lexicon, values: Valued) -> Iterator[Edit]:
    if call.function not in WAVES:
        return
    (argument,) = call.arguments
    for name in WAVES:
        if name != call.function and near(spot.wanted, values(Call(name, (argument,)))):
            yield _edit(spot, "function", replace(call, function=name), 1.0)
    if near(spot.wanted, tuple(1 / v if v else math.nan for v in spot.values)):
        yield _edit(spot, "function", Quotient(exact(1), spot.node), 1.1)
    for base in lexicon.symbols(["function"]):
        if isinstance(base.node, Call) and base.node.arguments != call.arguments:
            yield from _other_call(spot, call, base.node, base.values)
    for other in _other_arguments(argument):
        changed = Call(call.function, (other,))
        if near(spot.wanted, values(changed)):
            yield _argument(spot, call, changed)


def _other_call(spot: Spot, call: Call, other: Call, values: Values) -> Iterator[Edit]:
    """Another function of another argument, and the square of one."""
    if near(spot.wanted, values):
        alike = call.function == other.function
        yield _argument(spot, call, other) if alike else _edit(spot, "function", other, 1.7)
    elif near(spot.wanted, tuple(v * v for v in values)):
        yield _edit(spot, "function", Power(other, exact(2)), 1.7)


def _argument(spot: Spot, call: Call, changed: Call) -> Edit:
    """The change within the brackets: what is marked is the argument."""
    argument, other = call.arguments[0], changed.arguments[0]
    symbols = symbol_kind(argument) and symbol_kind(other)
    return Edit("name" if symbols else "argument", (*spot.path, 0), argument, other, 1.2)


def _other_arguments(argument: Node) -> Iterator[Node]:
    """Twice and half as large, and with the sign of one term turned."""
    yield Product((exact(2), argument))
    yield Quotient(argument, exact(2))
    if isinstance(argument, Sum):
        for k, term in enumerate(argument.terms):
            turned = term.operand if isinstance(term, Negation) else Negation(term)
            yield replace(argument, terms=(*argument.terms[:k], turned, *argument.terms[k + 1 :]))


def _missing_within(spot: Spot, lexicon: Lexicon) -> Iterator[Edit]:
    """A term that is missing in a bracket; the whole answer is compared with the terms of the right one instead."""
    if not spot.path:
        return
    for monomial, sign in lexicon.found(spot.difference):
        if spot.is_whole or all(p > 0 for _, p in monomial.powers):
            added = monomial.node if sign > 0 else Negation(monomial.node)
            yield _edit(spot, "missing", Sum((spot.node, added)), 1.35 + 0.2 * (len(monomial.powers) - 1))


def _squared_bracket(spot: Spot, base: Node, power: int, lexicon: Lexicon, values: Valued) -> Iterator[Edit]:
    """One term within a bracket whose even power is known: the bracket itself may have either sign."""
    terms = base.terms if isinstance(base, Sum) else (base,)

    def fits(changed: Node) -> bool:
        return near(spot.wanted, tuple(v**power for v in values(changed)))

    for index, term in enumerate(terms if isinstance(base, Sum) else ()):
        for kind, after, cost in _other_terms(term, lexicon):
            if fits(Sum((*terms[:index], after, *terms[index + 1 :]))):
                # Of two that fit equally, the later term has the sign that was written down.
                yield Edit(kind, (*spot.path, 0, index), term, after, cost - 0.002 * index)
    for added in lexicon.bases:
        for signed in (added.node, Negation(added.node)):
            if added.node not in terms and fits(Sum((*terms, signed))):
                yield Edit("missing", (*spot.path, 0), base, Sum((*terms, signed)), 1.35)


def _other_terms(term: Node, lexicon: Lexicon) -> Iterator[tuple[SlipKind, Node, float]]:
    """What a student may have meant by one short term."""
    bare = term.operand if isinstance(term, Negation) else term
    yield "sign", bare if bare is not term else Negation(term), 1.0
    yield "superfluous", exact(0), 1.25
    yield "half", Product((exact(2), term)), 1.1
    yield "double", Quotient(term, exact(2)), 1.1
    for node in walk(bare):
        if isinstance(node, Call) and node.function in WAVES[:2]:
            other = replace(node, function="cos" if node.function == "sin" else "sin")
            yield "function", _exchanged_node(term, node, other), 1.0
    for base in lexicon.bases:
        if type(base.node) is type(bare) and base.node != bare and not isinstance(bare, Call):
            kind, cost = replaced(bare, base.node)
            yield kind, _exchanged_node(term, bare, base.node), cost


def _exchanged_node(tree: Node, there: Node, wanted: Node) -> Node:
    if tree is there:
        return wanted
    return with_children(tree, [_exchanged_node(part, there, wanted) for part in children(tree)])


def plain_edits(tree: Node, values: Valued) -> Iterator[Edit]:
    """The plainest slips anywhere in a tree, whether they fit or not: a sign, a 2, sine for cosine."""
    for spot in spots(tree, values(tree), values):
        if isinstance(spot.node, Call) and spot.node.function in WAVES[:2]:
            other = "cos" if spot.node.function == "sin" else "sin"
            yield _edit(spot, "function", replace(spot.node, function=other), 1.0)
        elif spot.is_addend or (not spot.path and not isinstance(spot.node, Sum)):
            yield from (_times(spot, times) for times in (Fraction(-1), Fraction(2), Fraction(1, 2)))


def _other_orders(spot: Spot, values: Valued) -> Iterator[Edit]:
    """A bracket of coordinates for one of rates, and the other way round."""
    for step in (1, -1):
        changed = _differentiated(spot.node, step)
        if changed != spot.node and near(spot.wanted, values(changed)):
            yield _edit(spot, "rate", changed, 1.15)


def _differentiated(node: Node, step: int) -> Node:
    """Every coordinate with a dot more or less; what has none to lose stays."""
    match node:
        case Name(name) if step > 0:
            return Rate(name, 1, span=node.span)
        case Rate(name, order) if order + step > 0:
            return Rate(name, order + step, span=node.span)
        case Rate(name, _):
            return Name(name, span=node.span)
        case Call():
            return node
        case _:
            return with_children(node, [_differentiated(part, step) for part in children(node)])
