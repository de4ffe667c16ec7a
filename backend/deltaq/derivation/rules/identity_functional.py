"""Identity functional: I(x) = x(t₀). Its first variation is the direction itself, v(t₀); hence the notation δx = v.

Source: the lecture's example of the first variation.
"""

from __future__ import annotations

from ...language.spelling import spell_rate
from ..abstract_motion import T0, AbstractMotion, symbol
from ..formula import AtTime, Called, Directional, Explicit, Quantity
from ..step import Relation, Step
from ._general import H, V, X

RULE = "identity-functional"
# Numbers need the rates as well: a function is known at t₀ from its value and rates at t.
JETS = {symbol(spell_rate("x", n)): symbol(spell_rate("v", n)) for n in range(3)}


def apply(_motion: AbstractMotion) -> Step:
    value, moved = AtTime(Explicit(X), T0), AtTime(Explicit(V), T0)
    whole = Called(Quantity("identity-functional"), value, (X,))
    lines = (
        Relation((whole, value)),
        Relation(
            (
                Called(Quantity("variation-of-identity"), moved),
                Directional(whole, JETS, H),
                Directional(value, JETS, H),
                moved,
            )
        ),
        Relation((Called(Quantity("variation-of-function"), Explicit(V)), Explicit(V))),
    )
    return Step(RULE, "", lines)
