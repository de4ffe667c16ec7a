"""Statements → a reading, by the form that a task asks for: expression, vector, equation, equations, frequencies."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from types import MappingProxyType
from typing import Any

import sympy as sp

from ...errors import ExpressionError
from ...language.bounds import check_bounds
from ...language.symbols import Symbols
from ...language.tree import Equation, Name, Number, Power
from ..equality import Parts
from .glossary import AXES, symbol_in
from .labels import SQUARED, Factor, asked_in, axis_of, factor_of, is_formal, is_frequency, is_label, solved
from .layout import Range, Statement
from .reader import Claim, Member, Reader, Reading, refuse, scalar, typed

InForm = Callable[[Reader, Any], Parts]


def _expression(reader: Reader, statements: Sequence[Statement]) -> Reading:
    return _by_chains(reader, statements, _scalar)


def _by_chains(reader: Reader, statements: Sequence[Statement], form: InForm) -> Reading:
    statement, earlier = _only(statements)
    read = _chain(reader, statement, form)
    claims = [claim for one in earlier for claim in _all_members(_chain(reader, one, form))]
    return replace(read, claims=(*claims, *read.claims))


def _all_members(read: Reading) -> tuple[Claim, ...]:
    return (*read.claims, Claim(read.parts, (0, 0), read.shown))


def _only(statements: Sequence[Statement]) -> tuple[Statement, Sequence[Statement]]:
    """The statement that answers, and those from which it was said to follow."""
    if any(not one.follows for one in statements[1:]):
        raise refuse("answer-several")
    return statements[-1], statements[:-1]


def _chain(reader: Reader, statement: Statement, form: InForm) -> Reading:
    """A = B = C: its last explicit member is the answer, the others have to agree with it."""
    places, factor, left = _without_label(reader, statement)
    members = [reader.member(place) for place in places if len(places) == 1 or not is_formal(reader, place)]
    explicit = [member for member in members if member.explicit]
    if not explicit:
        raise _implicit(reader, statement)
    answer = explicit[-1]
    parts = {member.place: form(reader, solved(member.value, factor)) for member in members}
    claims = tuple(Claim(parts[m.place], m.place, m.value) for m in members if m is not answer)
    shown = answer.value if left is None else sp.Eq(left.value, answer.value, evaluate=False)
    if form is _vector and not isinstance(answer.value, sp.MatrixBase):
        shown = sp.ImmutableMatrix(parts[answer.place])
    if not factor[0].is_number:
        return Reading(parts[answer.place], shown, (), claims)
    return Reading(parts[answer.place], shown, typed(reader, answer), claims, (answer.tree,))


def _without_label(reader: Reader, statement: Statement) -> tuple[Sequence[Range], Factor, Member | None]:
    """The members without the name of what is asked for; what it is multiplied with, and the side this stands on."""
    places, alone = statement.members, (sp.S.One, sp.S.Zero)
    if len(places) < 2:
        return places, alone, None
    if is_label(reader, places[0]):
        return places[1:], alone, None
    asked = asked_in(reader, places[0])
    if asked:
        return places[1:], *factor_of(reader, places[0], asked)
    return places[:-1] if is_label(reader, places[-1]) else places, alone, None


def _implicit(reader: Reader, statement: Statement) -> ExpressionError:
    """Only names of results stand there: a single one of them may well be a misspelt name."""
    if len(statement.members) == 1:
        own = replace(reader.glossary, names=reader.solution.scene.names)
        try:
            replace(reader, glossary=own).parsed(statement.members[0])
        except ExpressionError as error:
            return error
    return refuse("answer-implicit")


def _scalar(_reader: Reader, value: Any) -> Parts:
    return (scalar(value),)


# --- vectors ---------------------------------------------------------------------------------------------------------


def _vectors(reader: Reader, statements: Sequence[Statement]) -> Reading:
    count = reader.solution.scene.dimension
    if len(statements) == count and count > 1 and not any(one.follows for one in statements):
        axes = [axis_of(reader, one) for one in statements]
        if sorted(axes) == list(AXES[:count]) or (not any(axes) and all(len(one.members) == 1 for one in statements)):
            ordered = [one for _, one in sorted(zip(axes, statements, strict=True), key=lambda pair: pair[0])]
            return _by_components(reader, ordered)
    return _by_chains(reader, statements, _vector)


def _by_components(reader: Reader, statements: Sequence[Statement]) -> Reading:
    last = [[reader.member(place) for place in (one.members[1:] or one.members)] for one in statements]
    answers = [members[-1] for members in last]
    if not all(member.explicit for member in answers):
        raise refuse("answer-implicit")
    parts = tuple(scalar(member.value) for member in answers)
    claims = tuple(
        Claim((*parts[:n], scalar(member.value), *parts[n + 1 :]), member.place, member.value)
        for n, members in enumerate(last)
        for member in members[:-1]
    )
    trees = tuple(tree for member in answers for tree in typed(reader, member))
    return Reading(parts, sp.ImmutableMatrix(parts), trees, claims, tuple(member.tree for member in answers))


def _vector(reader: Reader, value: Any) -> Parts:
    count = reader.solution.scene.dimension
    if not isinstance(value, (sp.MatrixBase, sp.Eq, sp.Tuple)) and reader.glossary.axes:
        return _along_axes(reader, value)
    if not isinstance(value, sp.MatrixBase):
        raise refuse("answer-not-vector", count=count)
    if len(value) != count:
        raise refuse("answer-components", count=count, found=len(value))
    return tuple(value)


def _along_axes(reader: Reader, value: sp.Expr) -> Parts:
    """The components of a sum of multiples of unit vectors. Raises ExpressionError for what is none."""
    symbols = Symbols(reader.glossary.names)
    axes = [symbols.name(axis) for axis in reader.glossary.axes]
    parts = tuple(value.diff(axis) for axis in axes)
    nothing = value.subs(dict.fromkeys(axes, 0))
    if nothing != 0 or any(part.has(*axes) for part in parts):
        raise refuse("answer-not-vector", count=len(axes))
    return parts


# --- equations -------------------------------------------------------------------------------------------------------


def _equation(reader: Reader, statements: Sequence[Statement]) -> Reading:
    reads = [_equality(reader, one) for one in statements]
    if any(not one.follows for one in statements[1:]) or len(reads[-1].parts) != 1:
        raise refuse("answer-one-equation", count=1, found=max(len(reads), len(reads[-1].parts)))
    claims = tuple(claim for read in reads[:-1] for claim in _all_members(read))
    return replace(reads[-1], claims=(*claims, *reads[-1].claims))


def _equations(reader: Reader, statements: Sequence[Statement]) -> Reading:
    return _joined([_equality(reader, one) for one in statements])


def _together(values: list[Any]) -> Any:
    return sp.Tuple(*(value if isinstance(value, sp.Eq) else sp.Eq(value, 0, evaluate=False) for value in values))


def _equality(reader: Reader, statement: Statement) -> Reading:
    """A = B = C = 0: each equality is an identity or the equation; one that is explicit has to be the equation."""
    members = [reader.member(place) for place in statement.members]
    if len(members) == 1:
        if not members[0].explicit:
            raise _implicit(reader, statement)
        parts = tuple(map(_residual, _listed(members[0].value)))
        return Reading(parts, members[0].value, typed(reader, members[0]), (), (members[0].tree,))
    pairs = [_pair(a, b) for a, b in pairwise(members)]
    if len(pairs) == 1:
        return _of_pair(reader, members[0], members[1], pairs[0])
    return _of_pairs(reader, members, pairs)


def _pair(left: Member, right: Member) -> Any:
    check_bounds(Equation(left.tree, right.tree))
    value = right.value
    if isinstance(left.value, sp.MatrixBase) and not isinstance(value, sp.MatrixBase):
        value = sp.ImmutableMatrix.zeros(*left.value.shape)
    return sp.Eq(left.value, value, evaluate=False)


def _of_pair(reader: Reader, left: Member, right: Member, pair: Any) -> Reading:
    if not (left.explicit and right.explicit):
        raise refuse("answer-implicit")
    tree = Equation(left.tree, right.tree)
    as_typed = left.typed is left.tree and right.typed is right.tree
    trees = ((reader.layout.typed, tree),) if as_typed else ()
    return Reading(tuple(map(_residual, _listed(pair))), pair, trees, (), (tree,))


def _of_pairs(reader: Reader, members: list[Member], pairs: list[Any]) -> Reading:
    """The last equality of explicit members that is no identity answers; every other that is none is a claim."""
    own = [member for member in members if member.explicit]
    said = [(b, _pair(a, b)) for a, b in pairwise(own) if not _holds(reader, _pair(a, b))]
    if not said:
        raise refuse("answer-implicit")
    answer = said[-1][1]
    others = [(b, pair) for (_, b), pair in zip(pairwise(members), pairs, strict=True) if not _holds(reader, pair)]
    claims = tuple(
        Claim(tuple(map(_residual, _listed(pair))), member.place, pair)
        for member, pair in (*said[:-1], *others)
        if pair != answer
    )
    left, right = next((a, b) for a, b in pairwise(own) if _pair(a, b) == answer)
    parts = tuple(map(_residual, _listed(answer)))
    return Reading(parts, answer, (), claims, (Equation(left.tree, right.tree),))


def _holds(reader: Reader, pair: Any) -> bool:
    return all(reader.solution.is_zero(_residual(one)) for one in _listed(pair))


def _listed(value: Any) -> list[Any]:
    """The members of a list, a column or a system."""
    if isinstance(value, sp.Eq) and isinstance(value.lhs, sp.MatrixBase):
        if value.lhs.shape != value.rhs.shape:
            raise refuse("answer-not-scalar")
        return [sp.Eq(a, b, evaluate=False) for a, b in zip(value.lhs, value.rhs, strict=True)]
    return list(value) if isinstance(value, (sp.Tuple, sp.MatrixBase)) else [value]


def _residual(value: Any) -> sp.Expr:
    return value.lhs - value.rhs if isinstance(value, sp.Eq) else scalar(value)


# --- frequencies -----------------------------------------------------------------------------------------------------


def _frequencies(reader: Reader, statements: Sequence[Statement]) -> Reading:
    """Each ω once: what follows from an earlier line on the same ω takes its place, and both have to hold."""
    reads: dict[str, Reading] = {}
    claims: list[Claim] = []
    for number, one in enumerate(statements):
        name, read = _frequency(reader, one)
        before = reads.pop(name, None) if one.follows else None
        claims += [*read.claims, *(_all_members(before) if before else ())]
        reads[name if name and name not in reads else f"{name} {number}"] = replace(read, claims=())
    return replace(_joined(list(reads.values())), claims=tuple(claims))


def _joined(reads: list[Reading]) -> Reading:
    return Reading(
        tuple(part for read in reads for part in read.parts),
        reads[0].shown if len(reads) == 1 else _together([read.shown for read in reads]),
        tuple(tree for read in reads for tree in read.trees),
        tuple(claim for read in reads for claim in read.claims),
        tuple(tree for read in reads for tree in read.measured),
    )


def _frequency(reader: Reader, statement: Statement) -> tuple[str, Reading]:
    """ω = …, ω² = …, or a list of values."""
    places = statement.members
    if len(places) == 1:
        member = reader.member(places[0])
        parts = tuple(map(scalar, _listed(member.value)))
        return "", Reading(parts, member.value, typed(reader, member), (), (member.tree,))
    left = reader.text(places[0])
    squared = SQUARED.search(left) is not None
    name = symbol_in(SQUARED.sub("", left))
    if not is_frequency(name):
        raise refuse("answer-not-frequency")
    members = [reader.member(place) for place in places[1:] if not is_frequency(symbol_in(reader.text(place)))]
    if not members:
        raise refuse("answer-implicit")
    values = [sp.sqrt(scalar(m.value)) if squared else scalar(m.value) for m in members]
    omega = sp.Symbol("omega" + re.sub(r"^(omega|w)", "", name), real=True, positive=True)
    shown = sp.Eq(omega**2 if squared else omega, members[-1].value, evaluate=False)
    claims = tuple(Claim((v,), m.place, m.value) for v, m in zip(values[:-1], members[:-1], strict=True))
    left_tree = Power(Name("omega"), Number(Fraction(2))) if squared else Name("omega")
    trees = tuple((source, Equation(left_tree, tree)) for source, tree in typed(reader, members[-1]))
    return name, Reading((values[-1],), shown, trees, claims, (members[-1].tree,))


FORMS: Mapping[str, Callable[[Reader, Sequence[Statement]], Reading]] = MappingProxyType(
    {
        "expression": _expression,
        "vector": _vectors,
        "equation": _equation,
        "equations": _equations,
        "set": _frequencies,
    }
)
