"""A ladder climbed to its end, its findings by kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from deltaq.lab.ladder.climb import climb
from deltaq.lab.ladder.findings import Growth, Ladder, Least, Measured
from deltaq.mechanics.scene import Scene


@dataclass(frozen=True)
class Climbed:
    ladder: Ladder
    measured: Mapping[str, Measured]
    growth: Mapping[str, Growth]
    least: Least
    count: int

    def relative(self, rung: str) -> float:
        deviation = self.measured[rung].deviation
        assert deviation is not None
        return deviation.relative

    def largest(self, rung: str) -> float:
        deviation = self.measured[rung].deviation
        assert deviation is not None
        return deviation.largest


def climbed(scene: Scene, span: float, amplitudes: tuple[float, ...] = (), tolerance: float = 0.01) -> Climbed:
    ladder, *findings = climb(scene, span, amplitudes, tolerance, repeats=1)
    assert isinstance(ladder, Ladder)
    least = findings[-1]
    assert isinstance(least, Least)
    measured = {each.rung: each for each in findings if isinstance(each, Measured)}
    growth = {each.rung: each for each in findings if isinstance(each, Growth)}
    return Climbed(ladder, measured, growth, least, len(findings))
