"""Terms by the rates they hold: what several misconceptions leave out."""

from __future__ import annotations

import sympy as sp

from .road import Road


def _degrees(term: sp.Expr, road: Road) -> list[int]:
    powers = term.as_powers_dict()
    found = (powers.get(road.rate(q), 0) for q in road.free)
    return sorted(int(power) for power in found if power == int(power))


def without(equation: sp.Expr, road: Road, *, mixed: bool) -> sp.Expr:
    """The equation without products of two rates (mixed), or without squares of one."""
    wanted = [1, 1] if mixed else [2]
    terms = sp.Add.make_args(equation.expand())
    return sp.Add(*(t for t in terms if [d for d in _degrees(t, road) if d] != wanted))


def scaled_mixed(energy: sp.Expr, road: Road, factor: sp.Expr) -> sp.Expr:
    """The energy with its products of different rates (and of a rate with a guide's speed) times a factor."""
    terms = sp.Add.make_args(energy.expand())
    return sp.Add(*(t * factor if _is_mixed(t, road) else t for t in terms))


def _is_mixed(term: sp.Expr, road: Road) -> bool:
    degrees = [d for d in _degrees(term, road) if d]
    return degrees == [1, 1] or (degrees == [1] and term.has(road.t))
