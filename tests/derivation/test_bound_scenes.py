"""Random scenes with constraints and contacts go through derivation, equilibria, impacts and tasks."""

from __future__ import annotations

import pytest
import sympy as sp
from tests.derivation.bound_scenes import bound_scene, faults

from deltaq.derivation import impacts


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", range(1, 7))
def test_what_is_said_of_a_random_scene_is_true(seed: int) -> None:
    assert faults(bound_scene(seed)) == []


def test_a_contact_that_constraints_do_not_answer_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """What compares impacts with a linear system solved in numbers is not blind to M Δq̇ = Λ ∂g/∂q alone."""
    monkeypatch.setattr(impacts, "simplified", lambda _system, value: sp.Rational(101, 100) * value)
    assert any(": rate" in fault or "impulse" in fault for fault in faults(bound_scene(1)))
