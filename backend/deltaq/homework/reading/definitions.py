"""Definitions in an answer: `ω₀² = g/ℓ` and `J = mℓ²` say what a name means, and the name means it everywhere."""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace

from ...language.tree import Call, Name, Rate, Variation, walk
from .glossary import AXES, symbol_in, symbols_in
from .labels import SQUARED, axis_of, is_frequency
from .layout import Statement
from .reader import Reader, refuse, scalar


def defined(reader: Reader) -> tuple[list[Statement], Reader]:
    """The statements that are no definitions, and a reader that knows what was defined."""
    statements = list(reader.layout.statements)
    pending: dict[str, Statement] = {}
    for one in statements:
        name = _definition(reader, one, statements)
        if name in pending:
            raise refuse("answer-defined-twice", name=name)
        if name:
            pending[name] = one
    kept = [one for one in statements if one not in pending.values()]
    if not kept:  # everything is defined by something else: what the task asks for cannot be told
        raise refuse("answer-several")
    while pending:
        ready = next((name for name in pending if not _uses(reader, pending[name], pending.keys() - {name})), None)
        if ready is None:
            raise refuse("answer-circular", name=next(iter(pending)))
        reader = _with_definition(reader, ready, pending.pop(ready))
    return kept, reader


def _definition(reader: Reader, statement: Statement, statements: Sequence[Statement]) -> str:
    """The name that a statement defines for another one; "" if it is none."""
    if len(statement.members) != 2 or statement.follows:
        return ""
    name = symbol_in(SQUARED.sub("", reader.text(statement.members[0])))
    if not name or name in reader.glossary.asked or reader.solution.scene.names.candidates(name):
        return ""
    if reader.task.quantity.form == "vector" and name[0] in AXES and axis_of(reader, statement):
        return ""
    if reader.task.quantity.form == "set" and is_frequency(name):
        return ""
    others = [one for one in statements if one is not statement]
    return name if any(_uses(reader, one, {name}) for one in others) else ""


def _uses(reader: Reader, statement: Statement, names: AbstractSet[str]) -> bool:
    """Whether a statement speaks of one of these names, on its right where it has a name on its left."""
    named = len(statement.members) > 1 and symbol_in(SQUARED.sub("", reader.text(statement.members[0]))) != ""
    return any(symbols_in(reader.text(place)) & names for place in statement.members[named:])


def _with_definition(reader: Reader, name: str, statement: Statement) -> Reader:
    left, right = statement.members
    member = reader.member(right)
    squared = SQUARED.search(reader.text(left)) is not None
    if squared:
        scalar(member.value)
    tree = Call("sqrt", (member.tree,)) if squared else member.tree
    moving = any(
        isinstance(n, Rate | Variation) or (isinstance(n, Name) and _moves(reader, n.name)) for n in walk(member.tree)
    )
    glossary = reader.glossary.with_definition(name, tree, moves=moving)
    if not member.explicit:
        glossary = replace(glossary, true=glossary.true | {name})
    return replace(reader, glossary=glossary)


def _moves(reader: Reader, name: str) -> bool:
    symbol = reader.glossary.names.get(name)
    return symbol is not None and symbol.kind in ("coordinate", "time")
