"""Rewritings of sines and cosines that several misconceptions make."""

from __future__ import annotations

from typing import TypeVar

import sympy as sp

from ..derivation.calculus import V
from .road import Road

F = TypeVar("F", sp.Expr, sp.ImmutableMatrix)


def swapped(value: V, coordinate: sp.Symbol) -> V:
    """Sine for cosine and cosine for sine, wherever the coordinate is in the argument."""
    found = [f for f in value.atoms(sp.sin, sp.cos) if f.has(coordinate)]
    return value.xreplace({f: (sp.cos if isinstance(f, sp.sin) else sp.sin)(f.args[0]) for f in found})


def waves(value: F, road: Road) -> list[sp.Expr]:
    """The sines and cosines of coordinates; those of the time are not small."""
    moving = {road.q(q) for q in road.free}
    return [f for f in value.atoms(sp.sin, sp.cos) if f.free_symbols & moving]


def unsigned_slope(value: sp.Expr, coordinate: sp.Symbol) -> sp.Expr:
    """∂value/∂q with the derivative of the cosine taken as + sin."""
    cosines = [f for f in value.atoms(sp.cos) if f.has(coordinate)]
    places = {f: sp.Dummy() for f in cosines}
    whole = value.xreplace(places)
    inner = (whole.diff(place) * sp.sin(f.args[0]) * f.args[0].diff(coordinate) for f, place in places.items())
    back = {place: f for f, place in places.items()}
    return (whole.diff(coordinate) + sp.Add(*inner)).xreplace(back)
