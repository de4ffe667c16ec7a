"""Chain rule of the first variation: δf = ∂f/∂xᵢ δxᵢ + ∂f/∂ẋᵢ δẋᵢ + …, since δẋ = d/dt δx; the time is not varied.

Source: Lanczos, The Variational Principles of Mechanics, ch. II; the lecture's chain rule.
"""

from __future__ import annotations

import sympy as sp

from ..formula import Explicit, Formula, Partial, Plus, Term, Times, Value
from ..functional import Functional
from ..step import Relation, Step
from .functional import variation

RULE = "variation-by-chain-rule"
SLOPE = "partial-derivative"


def apply(functional: Functional) -> Step:
    """δf = Σ ∂f/∂x⁽ⁿ⁾ δx⁽ⁿ⁾ by the letters, then with the slopes put in; its substeps are the slopes one by one."""
    pairs = functional.along.items()
    formal = Plus(tuple(Term(Times((Partial(functional.named, by), Explicit(v)))) for by, v in pairs))
    written = Plus(tuple(Term(_times(functional.slopes[by], v)) for by, v in pairs))
    lines = (functional.on(formal), functional.on(written)) if functional.along else ()
    members = (variation(functional), *lines, functional.on(Explicit(functional.by_chain_rule)))
    return Step(RULE, "", (Relation(members),)).with_substeps(*_slopes(functional))


def _times(slope: Value, v: sp.Symbol) -> Formula:
    """The slope times δx; a factor 1 is not written."""
    return Explicit(v) if slope == 1 else Times((Explicit(slope), Explicit(v)))


def _slopes(functional: Functional) -> tuple[Step, ...]:
    """∂f/∂x, ∂f/∂ẋ … one by one."""
    return tuple(
        Step(SLOPE, _subject(by.name), (Relation((Partial(functional.named, by), Explicit(slope))),))
        for by, slope in functional.slopes.items()
    )


def _subject(name: str) -> str:
    """dot(x) as it may stand in a URL."""
    return name.replace("(", "-").replace(")", "")
