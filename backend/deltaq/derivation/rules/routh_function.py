"""Routh's function: with the cyclic rates put in by their constant momenta, R = L − Σ pᵢ q̇ᵢ is the Lagrange function of
what is left to move.

Source: Whittaker, A Treatise on the Analytical Dynamics of Particles and Rigid Bodies, §38; Goldstein, Poole, Safko,
Classical Mechanics, 3rd ed., §8.3 (with the opposite sign).
"""

from __future__ import annotations

import sympy as sp

from ..conservation import Reduction
from ..formula import Explicit, Inserted, Named, Plus, Quantity, Term, Times, minus
from ..step import Relation, Step
from ..system import System

RULE = "routh-function"


def apply(system: System, reduction: Reduction) -> Step:
    """The cyclic rates by their momenta, and R without them."""
    momenta: dict[sp.Symbol, sp.Expr] = {p: system.momentum(q) for q, p in reduction.momenta.items()}
    rates = tuple(
        Relation((Explicit(system.rate(q)), Inserted(Explicit(rate), momenta))) for q, rate in reduction.rates.items()
    )
    products = (Times((Explicit(p), Explicit(system.rate(q)))) for q, p in reduction.momenta.items())
    law = Plus((Term(Named(Quantity("lagrangian"), system.lagrangian)), *(minus(product) for product in products)))
    name = Inserted(Named(Quantity("routh-function"), reduction.function), momenta)
    line = Relation((name, Inserted(law, momenta), Inserted(Explicit(reduction.function), momenta)))
    return Step(RULE, "", (*rates, line), (), {"coordinate": ", ".join(reduction.momenta)})
