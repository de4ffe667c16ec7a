"""The action: S = ∫ L dt from t₀ to t₁, a functional of the motion q(t).

Source: Hamilton, On a General Method in Dynamics (1834); Landau, Lifshitz, Mechanics, §2.
"""

from __future__ import annotations

from ..action import Action
from ..formula import Called, Quantity
from ..step import Relation, Step

RULE = "action"


def apply(action: Action) -> Step:
    """S = ∫ L dt as the functional of the motion, then with L written out. Sources: bodies, and loads with V."""
    whole = Called(Quantity("integral-functional"), action.on(action.explicit))
    line = Relation((whole, action.on(action.named), action.on(action.explicit)))
    system = action.system
    return Step(RULE, "", (line,), system.body_sources + system.sources_of_lagrangian)
