"""First integrals: what is constant along every solution of the Euler–Lagrange equations.

If F does not hold the time, H = Σ ẋ ∂F/∂ẋ − F is, since dH/dt = −Σ ẋ (∂F/∂x − d/dt ∂F/∂ẋ) (Beltrami's identity);
if F does not hold x, ∂F/∂ẋ is, since its rate is all of the equation.
With ẍ in F it is H = Σ ẋ (∂F/∂ẋ − d/dt ∂F/∂ẍ) + ẍ ∂F/∂ẍ − F, and ∂F/∂ẋ − d/dt ∂F/∂ẍ.
Source: Beltrami (1868); Gelfand, Fomin, Calculus of Variations, §4 (cases 1 and 2) and §18.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..clearing import constant_of_motion
from ..formula import Called, Equation, Explicit, Formula, Named, Plus, Power, Quantity, Rate, Term, Times, minus
from ..functional import Functional
from ..step import Relation, Step
from .collected_variation import euler_expression
from .integration_by_parts import momentum

BELTRAMI = "beltrami-identity"
CYCLIC = "cyclic-function"


def steps(functional: Functional) -> Iterator[Step]:
    """Those that there are."""
    for function in functional.ignorable:
        yield cyclic(functional, function)
    if functional.has_energy:
        yield beltrami(functional)


def cyclic(functional: Functional, function: str) -> Step:
    law, written = momentum(functional, function, 0), functional.momentum(function)
    name = Called(Quantity("first-momentum", function), Explicit(written))
    zero = Explicit(sp.Integer(0))
    equation = Equation(euler_expression(functional, function), zero)
    same = Relation((equation, Equation(Plus((minus(Rate(name)),)), zero)), "⇔")
    lines = (Relation((name, law, Explicit(written))), same, *constant(functional, name))
    return Step(CYCLIC, function, lines, (), {"coordinate": function})


def beltrami(functional: Functional) -> Step:
    name = Called(Quantity("first-energy"), Explicit(functional.energy))
    rates = ((x, Explicit(functional.symbols.rate(x, 1))) for x in functional.moving)
    change = Plus(tuple(minus(Times((rate, euler_expression(functional, x)))) for x, rate in rates))
    lines = (Relation((name, _energy(functional), Explicit(functional.energy))), Relation((Rate(name), change)))
    return Step(BELTRAMI, "", (*lines, *constant(functional, name)))


def _energy(functional: Functional) -> Plus:
    """Σ pₙ x⁽ⁿ⁺¹⁾ − F"""
    products = (
        Times((Explicit(functional.symbols.rate(x, n + 1)), momentum(functional, x, n))) for x, n in functional.boundary
    )
    return Plus((*map(Term, products), minus(functional.named)))


def constant(functional: Functional, name: Called) -> Iterator[Relation]:
    """The shortest that is constant with it, and that it is."""
    if not isinstance(name.of, Explicit) or not isinstance(name.of.value, sp.Expr):
        raise TypeError("a first integral is a number that is written out")
    shown, power, factor = constant_of_motion(name.of.value, functional.symbols)
    if shown != name.of.value:
        raised: Formula = name if power == 1 else Power(name, power)
        left = raised if factor == 1 else Times((Explicit(factor), raised))
        yield Relation((left, Explicit(shown)))
    yield Relation((Explicit(shown), Named(Quantity("constant"), shown)))
