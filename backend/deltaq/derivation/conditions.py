"""For which parameters an equilibrium exists, and for which it is stable, as inequalities.

A value arccos u or arcsin u is real for |u| < 1, a root for a positive radicand. A potential with the second
derivatives K has a strict minimum if all leading minors of K are positive (Sylvester); where one is negative the
equilibrium is unstable. So the sign of each minor that does not have one by itself is a condition.
Source: Gantmacher, The Theory of Matrices, vol. 1, ch. X §4; Merkin, Introduction to the Theory of Stability, §3.2.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp

from .conservation import is_passive
from .dissipation import remaining_loads
from .equilibria import Equilibrium, free_coordinates
from .factoring import factor_list
from .linearization import Linearization
from .system import System

LONGEST = 30  # operations in an inequality that is still read
MOST = 6  # minors


@dataclass(frozen=True)
class Comparison:
    """smaller < larger, which holds at the scene's values."""

    smaller: sp.Expr
    larger: sp.Expr


@dataclass(frozen=True)
class Conditions:
    """When the equilibrium exists, and when it is what it was found to be: stable or unstable.

    Nothing in them: for all parameters that make sense.
    """

    existence: tuple[Comparison, ...]
    stability: tuple[Comparison, ...]


def conditions(system: System, linear: Linearization) -> Conditions | None:
    """Both; None where they are not to be had, so that the verdict holds at the scene's values only."""
    if not linear.equilibrium.exact:
        return None
    there = list(_existence(system, linear.equilibrium))
    decided = _stability(system, linear)
    if decided is None or not all(map(_is_short, (*there, *decided))):
        return None
    return Conditions(tuple(dict.fromkeys(there)), tuple(dict.fromkeys(decided)))


def _is_short(each: Comparison) -> bool:
    return int(each.smaller.count_ops() + each.larger.count_ops()) <= LONGEST


def _existence(system: System, equilibrium: Equilibrium) -> Iterator[Comparison]:
    for value in equilibrium.values.values():
        for wave in sorted(value.atoms(sp.asin, sp.acos), key=str):
            upper, lower = sp.fraction(sp.together(wave.args[0]))
            yield Comparison(system.display(sp.Abs(upper)), system.display(sp.Abs(lower)))
        for root in sorted(value.atoms(sp.Pow), key=str):
            if root.exp.is_Rational and root.exp.q % 2 == 0:
                yield from _signed(system, root.base) or ()


def _stability(system: System, linear: Linearization) -> list[Comparison] | None:
    """Of each leading minor that decides: its sign."""
    kept = _kept(system, linear)
    passive = is_passive(system) or not remaining_loads(system)
    decides = linear.stability != "undecided" and linear.verdict.derivative <= 1 and not linear.verdict.kind
    if not passive or not decides or not 0 < len(kept) <= MOST:
        return None
    minors = [linear.stiffness.extract(kept[:n], kept[:n]).det(method="berkowitz") for n in range(1, len(kept) + 1)]
    signs = [_sign_of(system, minor) for minor in minors]
    if linear.stability == "stable":
        chosen = minors if all(sign > 0 for sign in signs) else []
    else:
        chosen = [minor for minor, sign in zip(minors, signs, strict=True) if sign < 0][:1]
    found = [_signed(system, minor) for minor in chosen]
    return [each for one in found if one for each in one] if chosen and all(one is not None for one in found) else None


def _kept(system: System, linear: Linearization) -> list[int]:
    """The places of the coordinates that forces depend on; on constraints, all that may be chosen."""
    if linear.tangent:
        return list(range(len(linear.tangent.independent)))
    free = free_coordinates(system)
    return [i for i, q in enumerate(system.free) if q not in free]


def _sign_of(system: System, value: sp.Expr) -> int:
    number = sp.N(value.xreplace(dict(system.parameter_values)), 30)
    return int(sp.sign(number)) if number.is_Float or number.is_Integer else 0


def _signed(system: System, value: sp.Expr) -> list[Comparison] | None:
    """The sign that an expression has at the scene's values, as an inequality; none if it has no other.

    Factors with a sign of their own are left out; None where several others remain.
    """
    upper, lower = sp.fraction(sp.together(system.display(value)))
    try:
        powers = [*factor_list(upper)[1], *factor_list(lower)[1]]
    except sp.PolynomialError:
        return None
    open_ones = [base for base, times in powers if times % 2 and not (base.is_positive or base.is_negative)]
    if not open_ones:
        return []
    if len(open_ones) > 1:
        return None
    parts = sp.Add.make_args(open_ones[0].expand())
    sides = {1: sp.Integer(0), -1: sp.Integer(0)}
    for part in parts:
        sides[1 if part.as_coeff_Mul()[0] > 0 else -1] += part
    one, other = system.display(sides[1]), system.display(-sides[-1])
    return [Comparison(other, one) if _sign_of(system, open_ones[0]) > 0 else Comparison(one, other)]
