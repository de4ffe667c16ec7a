"""What constraints come down to: an expression that is kept at zero; the laws need to know only this."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import Problem
from ..language.expression import Expression
from ..language.memory import hashed_once
from ..language.tree import Call, Negation, Node, Number, Power, Product, Quotient, Rate, Sum, children, walk
from .checks import latex_problem, name_problem

NOT_SMOOTH = ("abs", "sign", "max", "min", "step")


@hashed_once
@dataclass(frozen=True)
class Condition:
    """u = 0, kept by a reaction with the multiplier λ. `source` is the name of the constraint it comes from.

    Holonomic: u = g(q, t), and δW = λ δg = λ Σ ∂g/∂qᵢ δqᵢ. Else u = Σ aᵢ(q, t) q̇ᵢ + b(q, t) is linear in the rates, the
    virtual displacements keep Σ aᵢ δqᵢ = 0, and δW = λ Σ aᵢ δqᵢ.
    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §§1.3, 2.4.
    """

    source: str
    value: Node
    is_holonomic: bool


def name_problems(name: str, multiplier: str, latex: str) -> tuple[Problem | None, ...]:
    """What is wrong with how a constraint and its multiplier are called."""
    of_multiplier = name_problem(multiplier, "/multiplier") if multiplier else None
    return name_problem(name), of_multiplier, latex_problem(latex)


def form_problems(expression: Expression, pointer: str) -> tuple[Problem, ...]:
    """What keeps an expression from being a condition: accelerations, kinks, or rates that are not linear."""
    nodes = tuple(walk(expression.tree))
    faster = [node for node in nodes if isinstance(node, Rate) and node.order > 1]
    kinks = [node for node in nodes if isinstance(node, Call) and node.function in NOT_SMOOTH]
    if faster:
        return (_at(faster[0], "constraint-with-acceleration", pointer, coordinate=faster[0].name),)
    if kinks:
        return (_at(kinks[0], "constraint-not-smooth", pointer, function=kinks[0].function),)
    if degree_in_rates(expression.tree) > 1:
        node = _nonlinear(expression.tree)
        term = expression.text[node.span.offset : node.span.offset + node.span.length]
        return (_at(node, "constraint-not-linear", pointer, term=term[:60]),)
    return ()


def degree_in_rates(node: Node) -> float:
    """The degree of a tree as a polynomial in the rates, as it is written; infinite where it is none."""
    match node:
        case Rate():
            return 1
        case Sum() | Negation():
            return max(map(degree_in_rates, children(node)))
        case Product(factors):
            return sum(map(degree_in_rates, factors))
        case Quotient(numerator, denominator) if not degree_in_rates(denominator):
            return degree_in_rates(numerator)
        case Power(base, Number(value)) if value >= 0 and value.denominator == 1:
            return degree_in_rates(base) * int(value)
    return math.inf if any(isinstance(part, Rate) for part in walk(node)) else 0


def _nonlinear(node: Node) -> Node:
    """The smallest part that is not linear in the rates."""
    return min((part for part in walk(node) if degree_in_rates(part) > 1), key=lambda part: sum(1 for _ in walk(part)))


def _at(node: Node, code: str, pointer: str, **parameters: str) -> Problem:
    return Problem(code, pointer, node.span.offset, node.span.length, parameters)
