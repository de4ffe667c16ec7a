"""A sample of the command `modes_over_sliders`, and that it notices what is wrong."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp
from tests.derivation import modes_over_sliders
from tests.derivation.modes_over_sliders import findings, systems

from deltaq.derivation.linearization import Linearization, linearizations
from deltaq.derivation.spectrum import Spectrum
from deltaq.derivation.system import System

SCENES = ("elastic-pendulum", "double-pendulum", "damped-pendulum", "foucault", "two-mass-oscillator", "wilberforce")


@pytest.mark.parametrize("scene", SCENES)
def test_small_motions_are_right_for_any_slider(scene: str) -> None:
    for system in systems(scene, 4):
        assert any(each.spectrum for each in linearizations(system))
        assert list(findings(system)) == []


def wrong(found: Spectrum) -> Spectrum:
    """The first shape or frequency a millionth off."""
    first = found.modes[0]
    return replace(found, modes=(replace(first, square=first.square * (1 + sp.Rational(1, 10**6))), *found.modes[1:]))


def missing(found: Spectrum) -> Spectrum:
    return replace(found, modes=found.modes[1:])


def bent(found: Spectrum) -> Spectrum:
    first = found.modes[0]
    shape = (*first.shape[:-1], first.shape[-1] + sp.Rational(1, 10**6))
    return replace(found, modes=(replace(first, shape=shape), *found.modes[1:]))


@pytest.mark.parametrize("change", [wrong, missing, bent])
def test_what_is_wrong_is_noticed(change: object, monkeypatch: pytest.MonkeyPatch) -> None:
    def changed(system: System) -> tuple[Linearization, ...]:
        return tuple(
            replace(each, spectrum=change(each.spectrum))
            for each in linearizations(system)  # type: ignore[operator]
        )

    monkeypatch.setattr(modes_over_sliders, "linearizations", changed)
    (system,) = systems("double-pendulum", 1)
    assert list(findings(system)) != []
