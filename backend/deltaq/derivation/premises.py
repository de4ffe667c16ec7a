"""Which steps a step rests on: those that gave a value to what it speaks of.

A relation `E = … = ½ m l² φ̇²` says what E is. Whoever speaks of E later rests on that step; the same for δr, d/dt p and
∂L/∂q where a step said what they are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, TypeAlias, get_args

from . import formula as f
from .step import Relation, Step

KINDS = get_args(f.Formula)
# A quantity, or what is done with it: ("Gateaux", r), ("Partial", L, "phi").
Signature: TypeAlias = tuple[Any, ...]


def signature(formula: f.Formula) -> Signature | None:
    """What a formula is called, whatever its value; None for what has no name."""
    match formula:
        case f.Named(quantity) | f.Called(quantity):
            return ("of", quantity)
        case f.Rate(of) | f.Gateaux(of):
            inner = signature(of)
            return inner and (type(formula).__name__, inner)
        case f.Partial(of, by):
            inner = signature(of)
            return inner and ("Partial", inner, by.name)
        case f.Plus(terms):
            inside = [(term.sign, signature(term.formula)) for term in terms]
            return ("Plus", *inside) if len(inside) > 1 and all(name for _, name in inside) else None
    return None


def concluded(relation: Relation) -> tuple[Signature, ...]:
    """What a relation gives a value to: all that has a name before its last member; of an equation its left side.

    `p = ∂L/∂q̇ = m l² φ̇` says what p is, and what ∂L/∂q̇ is.
    """
    if relation.sign in ("≠", "<", "≤"):
        return ()
    sides = (member.left if isinstance(member, f.Equation) else member for member in relation.members[:-1])
    return tuple(name for name in map(signature, sides) if name is not None)


@dataclass
class Names:
    """What is known by which names; `same` leads from each name to one that stands for all that mean the same."""

    same: dict[Signature, Signature] = field(default_factory=dict)

    def one(self, name: Signature) -> Signature:
        """The name that stands for this one: d/dt ∂L/∂q̇ is d/dt p where p = ∂L/∂q̇."""
        match name:
            case ("Rate" | "Gateaux" | "Partial" as kind, inner, *by):
                name = (kind, self.one(inner), *by)
            case ("Plus", *inside):
                name = ("Plus", *((signed[0], self.one(signed[1])) for signed in inside))
        return self.same.get(name, name)

    def join(self, names: tuple[Signature, ...]) -> Signature | None:
        """These mean the same from here on; the first one stands for all."""
        if not names:
            return None
        first, *others = map(self.one, names)
        self.same |= {other: first for other in others if other != first}
        return first


def parts(formula: f.Formula) -> Iterator[f.Formula]:
    """The formulas inside, one level down."""
    for one in fields(formula):
        value = getattr(formula, one.name)
        for each in value if isinstance(value, tuple) else (value,):
            if isinstance(each, f.Term):
                yield each.formula
            elif isinstance(each, KINDS):
                yield each


def premises(step: Step, names: Names, known: Mapping[Signature, str]) -> tuple[str, ...]:
    """The steps, by their ids, that gave values to what the relations of a step speak of; `known` tells which did.

    A step that names nothing which is known rests on what first spoke of its bodies and loads.
    """
    own = dict.fromkeys(names.one(name) for relation in step.relations for name in concluded(relation))
    members = (member for relation in step.relations for member in relation.members)
    found = (known[name] for member in members for name in _outermost(member, names, known) if name not in own)
    again = (known[name] for name in own if name in known)
    named = dict.fromkeys(one for one in (*step.premises, *found) if one != step.id) or dict.fromkeys(again)
    return tuple(named) or tuple(dict.fromkeys(known[s,] for s in step.sources if known.get((s,), step.id) != step.id))


def _outermost(formula: f.Formula, names: Names, known: Mapping[Signature, str]) -> Iterator[Signature]:
    """What is known of a formula; of d/dt p, where that is known, and not of p besides."""
    name = signature(formula)
    if name is not None and names.one(name) in known:
        yield names.one(name)
        return
    for part in parts(formula):
        yield from _outermost(part, names, known)
