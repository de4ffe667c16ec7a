"""A functional assigns a number to functions: f(x(t)), the value I(x) = f at an instant t₀, or I(x) = ∫ F(x, ẋ, t) dt.

Source: Gelfand, Fomin, Calculus of Variations, §1; the lecture's identity functional I_{t₀}(x) = x(t₀).
"""

from __future__ import annotations

from ..domain import Instant, Interval
from ..formula import Called, Explicit, Formula, Quantity
from ..functional import Functional
from ..step import Relation, Step

RULE = "functional"
KINDS = {Instant: "value", Interval: "integral"}


def apply(functional: Functional) -> Step:
    """The functional under its name = as it was given; an integral has ∫ F dt between them."""
    inside = (functional.on(functional.named),) if isinstance(functional.domain, Interval) else ()
    line = Relation((named(functional), *inside, functional.on(functional.given)))
    return Step(RULE, "", (line,), (), {"outcome": KINDS.get(type(functional.domain), "text")})


def named(functional: Functional) -> Formula:
    """f(x, ẋ, t), or I(x): the whole under its name."""
    if functional.domain is None:
        return functional.named
    functions = tuple(functional.symbols.name(x) for x in functional.present)
    kind = "value-functional" if isinstance(functional.domain, Instant) else "integral-functional"
    return Called(Quantity(kind), functional.on(functional.explicit), functions)


def variation(functional: Functional) -> Called:
    """δf or δI, with the value that the chain rule gives it."""
    kinds = {Instant: "variation-of-value", Interval: "variation-of-integral"}
    kind = kinds.get(type(functional.domain), "variation-of-function")
    return Called(Quantity(kind), functional.on(Explicit(functional.by_chain_rule)))
