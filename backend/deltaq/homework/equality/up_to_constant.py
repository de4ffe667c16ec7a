"""Potentials: equal up to what does not depend on the coordinates, which no force can tell."""

from __future__ import annotations

from ...language.canonical import is_zero
from ..road import Road
from ..sampling import Sampler, defined
from . import Fingerprint, Match, Parts, weakest


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values less the one at the first point."""
    values = sampler.values(parts[0])
    return tuple(value - values[0] for value in values[1:]) if defined(values) else None


def same(given: Parts, right: Parts, road: Road) -> Match:
    difference = given[0] - right[0]
    moving = sorted(difference.free_symbols - {road.q(p.name) for p in road.scene.parameters} - {road.t}, key=str)
    equal = weakest([is_zero(difference.diff(symbol), road.symbols) for symbol in moving])
    literal = equal is True and is_zero(difference, road.symbols) is True
    if not equal or literal:
        return Match(equal)
    return Match(equal, "function-of-time" if difference.has(road.t) else "constant")
