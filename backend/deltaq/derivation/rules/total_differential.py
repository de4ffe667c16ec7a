"""Total differential: dr = ∂r/∂qᵢ dqᵢ + ∂r/∂t dt. Unlike δr it follows the motion in time, so the last term stays.

Source: Lanczos, The Variational Principles of Mechanics, ch. II.2; the lecture's comparison of δr and dr.
"""

from __future__ import annotations

from ...language.derivatives import diff
from ..formula import Explicit, Named, Partial, Plus, Quantity, Term, Times
from ..step import Relation, Step
from ..system import System

RULE = "total-differential"


def apply(system: System, place: str) -> Step:
    """dr at a place: Σ ∂r/∂qᵢ dqᵢ + ∂r/∂t dt by the letters, with the derivatives put in, and collected.

    The term of dt has the role `time-term` and is there only if r depends on t. A place that is fixed has dr = 0.
    """
    position = system.named_position(place)
    pairs = [(system.q(q), system.symbols.differential(q), "") for q in system.coordinates_of(place)]
    if position.value.has(system.t):
        pairs.append((system.t, system.symbols.differential("t"), "time-term"))
    formal = tuple(Term(Times((Partial(position, by), Explicit(d))), (), 1, role) for by, d, role in pairs)
    written = tuple(
        Term(Times((Explicit(system.derivative(position.value, by)), Explicit(d))), (), 1, role)
        for by, d, role in pairs
    )
    total = system.display(sum((diff(position.value, by) * d for by, d, _ in pairs), position.value * 0))
    left = Named(Quantity("differential", place), total, position.arguments)
    lines = (Plus(formal), Plus(written)) if pairs else ()
    line = Relation((left, *lines, Explicit(total)))
    return Step(RULE, place, (line,), (system.source(place),), {"place": place})
