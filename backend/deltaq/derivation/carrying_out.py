"""Carrying a formula out with computer algebra on undefined functions: derivatives taken, sums and integrals formed.

Two formulas are equal in general if what is left has the same normal form: products multiplied out. An integral stands
there as its integrand, in a material coordinate of its own, times a mark: the integral is linear and the body does not
depend on t and qᵢ, so whatever the proof does with an integral is done with the integrand. SymPy would differentiate
integrals of its own many times slower.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce

import sympy as sp

from ..language.memory import cached_method
from . import formula as f
from .abstract_motion import total_rate
from .formula import AtTime, Called, Directional, Each, FunctionFormula, LimitOfQuotient, MassIntegral, Ratio, Summed
from .step import Relation

AT = " at "  # in the symbol of a function's value at an instant
INSIDE = " inside"  # in the symbol of a coordinate that is integrated over
MARK = "integral over "
Values = tuple[sp.Expr, ...]


@dataclass(frozen=True, eq=False)
class GeneralAlgebra:
    """Carries formulas out; what was carried out once is kept, as the kinetic energy returns in many lines."""

    def holds(self, relation: Relation) -> bool:
        """Whether the members agree (or, for ≠, differ) whatever the functions are."""
        first, *others = (tuple(map(self.normal, self.carried_out(member))) for member in relation.members)
        if relation.sign == "≠":
            return any(other != first for other in others)
        return all(other == first for other in others)

    def products(self, formula: f.Formula) -> dict[tuple[int, object], object] | None:
        """The number before each product of the normal form, by component; None where there is no normal form."""
        try:
            values = tuple(map(self.normal, self.carried_out(formula)))
        except (TypeError, ValueError):  # ValueError: one of all instances of an index has more components
            return None
        found = ((place, part.as_coeff_Mul()) for place, value in enumerate(values) for part in sp.Add.make_args(value))
        return {(place, product): number for place, (number, product) in found if number != 0}

    @cached_method
    def carried_out(self, formula: f.Formula) -> Values:  # noqa: PLR0911 - one case for each kind
        """The components of a formula with every operation done."""
        match formula:
            case f.Explicit(value) | f.Named(_, value):
                return tuple(value) if isinstance(value, sp.MatrixBase) else (value,)
            case f.Partial(of, by):
                return tuple(value.diff(by) for value in self.carried_out(of))
            case f.Rate(of):
                return tuple(total_rate(value) for value in self.carried_out(of))
            case f.Times(factors):
                return _product([self.carried_out(factor) for factor in factors])
            case f.Dot(left, right):
                pairs = zip(self.carried_out(left), self.carried_out(right), strict=True)
                return (sp.Add(*(_times(a, b) for a, b in pairs)),)
            case f.Plus(terms):
                return _sum([tuple(term.sign * v for v in self.carried_out(term.formula)) for term in terms])
            case f.Equation(left, right):
                return _sum([self.carried_out(left), tuple(-value for value in self.carried_out(right))])
            case FunctionFormula():
                return self._of_functions(formula)
        raise TypeError(f"{type(formula).__name__} is no part of a general proof")

    def _of_functions(self, formula: FunctionFormula) -> Values:  # noqa: PLR0911 - one case for each kind
        match formula:
            case Called(_, of):
                return self.carried_out(of)
            case Directional(of, along, h) | LimitOfQuotient(of, along, h):
                return tuple(_directional(value, along, h) for value in self.carried_out(of))
            case AtTime(of, time):
                return tuple(_at(value, time) for value in self.carried_out(of))
            case MassIntegral(of, _, _, bounds, weight):
                return tuple(_integral(weight * value, bounds) for value in self.carried_out(of))
            case Ratio(numerator, denominator):
                return (_times(self.carried_out(numerator)[0], 1 / self.carried_out(denominator)[0]),)
            case Summed(_, terms):
                return _sum([self.carried_out(term) for term in terms])
            case Each(_, instances):
                return tuple(value for instance in instances for value in self.carried_out(instance))
        raise TypeError(f"{type(formula).__name__} is no part of a general proof")

    @cached_method
    def normal(self, value: sp.Expr) -> sp.Expr:
        """Multiplied out."""
        return value.expand()


def _directional(value: sp.Expr, along: Mapping[sp.Symbol, sp.Expr], h: sp.Symbol) -> sp.Expr:
    """∂/∂h at h = 0 of the value at x + h v."""
    everywhere = {**along, **_at_instants(value, along)}
    moved = value.subs({symbol: symbol + h * v for symbol, v in everywhere.items()}, simultaneous=True)
    return moved.diff(h).subs(h, 0).doit()


def _at_instants(value: sp.Expr, along: Mapping[sp.Symbol, sp.Expr]) -> dict[sp.Symbol, sp.Expr]:
    """The same directions for the functions' values at instants."""
    instants = [s.name.partition(AT) for s in value.free_symbols if AT in s.name]
    pairs = ((s, v, time) for name, _, time in instants for s, v in along.items() if s.name == name)
    return {_at(s, time): _at(v, time) for s, v, time in pairs}


def _at(value: sp.Expr, time: object) -> sp.Expr:
    """Every function of time at the instant."""
    return value.xreplace({s: sp.Symbol(f"{s.name}{AT}{time}", real=True) for s in value.free_symbols})


def _integral(integrand: sp.Expr, bounds: f.Bounds) -> sp.Expr:
    """∫ integrand: itself, its coordinate renamed so that nobody outside shares it, times the mark of the region."""
    if _is_marked(integrand):
        raise TypeError("an integral of integrals is no part of a general proof")
    inside = sp.Symbol(f"{bounds.symbol}{INSIDE}", real=True)
    mark = sp.Symbol(f"{MARK}{bounds.symbol} from {bounds.lower} to {bounds.upper}", real=True)
    return mark * integrand.xreplace({bounds.symbol: inside})


def _is_marked(value: sp.Expr) -> bool:
    return any(s.name.startswith(MARK) for s in value.free_symbols)


def _times(left: sp.Expr, right: sp.Expr) -> sp.Expr:
    """The product; that of two integrals would be read as one of their integrands."""
    if _is_marked(left) and _is_marked(right):
        raise TypeError("a product of integrals is no part of a general proof")
    return left * right


def _product(factors: list[Values]) -> Values:
    """Scalars times at most one vector."""
    vector = next((factor for factor in factors if len(factor) > 1), (sp.Integer(1),))
    scalar = reduce(_times, (factor[0] for factor in factors if len(factor) == 1), sp.Integer(1))
    return tuple(_times(scalar, part) for part in vector)


def _sum(terms: list[Values]) -> Values:
    return tuple(sp.Add(*parts) for parts in zip(*terms, strict=True))
