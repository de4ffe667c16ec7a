"""A functional along x + h v for functions that are given: g(h), in doubles and in balls, from the same trees.

The functions and their rates are rounded to doubles first and taken as exact from there; an integral is the Gauss sum
with 24 nodes. So the two differ by the rounding of the evaluation alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp
from flint import arb, ctx

from ..language import floats
from ..language.spelling import spell_rate
from .difference_quotient import Line
from .domain import Instant, Interval
from .functional import Functional
from .program import number
from .tree_evaluation import tree_value
from .verification import BITS

NODES = 24


@dataclass(frozen=True)
class Motion:
    """Each function and each direction as an expression of the time, with values for the parameters."""

    functions: Mapping[str, sp.Expr]
    directions: Mapping[str, sp.Expr]
    parameters: Mapping[str, float]


def line_of(functional: Functional, motion: Motion, time: float) -> Line:
    """g(h) = f(x + h v); `time` is where f is looked at, unless the functional says so itself."""
    with ctx.workprec(BITS):
        nodes = _nodes(functional, motion, time)
        sampled = [(weight, _jets(functional, motion, at)) for weight, at in nodes]
    (tree,) = functional.trees
    names = [symbol.name for symbol in functional.along]

    def rounded(h: float) -> float:
        moved = ({**jet, **{n: jet[n] + h * jet[f"h {n}"] for n in names}} for _, jet in sampled)
        pairs = zip(sampled, moved, strict=True)
        return sum(weight * floats.evaluate(tree, jet) for (weight, _), jet in pairs)

    def exact(h: arb) -> arb:
        points = [({**jet, **{n: jet[n] + h * jet[f"h {n}"] for n in names}}) for jet in balls]
        return sum((arb(w) * tree_value(tree, p) for (w, _), p in zip(sampled, points, strict=True)), arb(0))

    balls = [{name: arb(value) for name, value in jet.items()} for _, jet in sampled]
    return Line(rounded, exact)


def _nodes(functional: Functional, motion: Motion, time: float) -> list[tuple[float, float]]:
    """Weights and instants."""
    point = {name: arb(value) for name, value in motion.parameters.items()}
    match functional.domain:
        case Instant(at):
            return [(1.0, float(number(functional.expression(at), point)))]
        case Interval():
            bounds = functional.interval
            lower, upper = number(bounds.lower, point), number(bounds.upper, point)
            half, middle = (upper - lower) / 2, (upper + lower) / 2
            roots = (arb.legendre_p_root(NODES, k, weight=True) for k in range(NODES))
            return [(float(half * weight), float(middle + half * root)) for root, weight in roots]
        case _:
            return [(1.0, time)]


def _jets(functional: Functional, motion: Motion, time: float) -> dict[str, float]:
    """Values of all names at an instant; `h x` is what x is moved by."""
    point = {**{name: arb(value) for name, value in motion.parameters.items()}, "t": arb(time)}
    t = functional.symbols.time
    jets = {**motion.parameters, "t": time}
    for x in functional.functions:
        for order in range(3):
            name = spell_rate(x, order)
            jets[name] = float(number(motion.functions[x].diff(t, order), point))
            jets[f"h {name}"] = float(number(motion.directions[x].diff(t, order), point))
    return jets
