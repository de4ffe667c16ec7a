"""Equilibria, verdicts and eigenfrequencies of textbook systems, against what the books say."""

from __future__ import annotations

import math

import pytest
from tests.derivation.textbook_systems import SYSTEMS, Published, Rest

from deltaq.derivation.equilibria import is_angle, search
from deltaq.derivation.linearization import Linearization, linearizations, numeric_point
from deltaq.derivation.system import System

INCOMPLETE = {"Ziegler's pendulum, P = 2.0 c/l", "Ziegler's pendulum, P = 2.2 c/l"}


def test_there_are_enough_of_them() -> None:
    assert len(SYSTEMS) >= 50
    assert len({each.name for each in SYSTEMS}) == len(SYSTEMS)
    assert all(each.source for each in SYSTEMS)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("book", SYSTEMS, ids=lambda book: book.name)
def test_what_the_book_says(book: Published) -> None:
    system = System(book.scene)
    known, found = search(system), list(linearizations(system))
    assert known is not None
    for rest in book.rests:
        here = [each for each in found if is_at(system, each, rest)]
        assert len(here) == 1, f"{rest.at} is not among {[each.equilibrium.values for each in found]}"
        assert (here[0].stability, here[0].verdict.kind) == (rest.stability, rest.kind)
        if rest.squares is not None:
            assert squares(here[0]) == pytest.approx(sorted(rest.squares), rel=1e-9, abs=1e-12)
    if book.whole:
        assert len(found) == len(book.rests) == known.count
    assert known.complete or book.name in INCOMPLETE


def is_at(system: System, linear: Linearization, rest: Rest) -> bool:
    """Whether an equilibrium is the published one: coordinates that the book leaves free are free here."""
    point = numeric_point(system, linear.equilibrium)
    if {q.name for q in linear.equilibrium.values} != set(rest.at):
        return False
    gaps = ((q, float(point[q]) - value) for q, value in rest.at.items())
    turned = (math.remainder(gap, 2 * math.pi) if is_angle(system, system.q(q)) else gap for q, gap in gaps)
    return all(abs(gap) < 1e-8 for gap in turned)


def squares(linear: Linearization) -> list[float]:
    assert linear.spectrum is not None
    return sorted(float(mode.square) for mode in linear.spectrum.modes)
