"""Equivalent rewrites stay right, mutations become wrong; the script beside does it by the thousand."""

from __future__ import annotations

from .rewriting import verdicts


def test_rewrites_stay_right_and_mutations_become_wrong() -> None:
    failures = [
        (sample, outcome)
        for sample, outcome, _ in verdicts(60, seed=7)
        if outcome != ("correct" if sample.right else "wrong")
    ]
    assert failures == []
