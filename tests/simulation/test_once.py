"""Properties that are computed when they are first asked for."""

from __future__ import annotations

from dataclasses import dataclass, field

from deltaq.simulation.once import once


@dataclass(frozen=True)
class Square:
    side: float
    asked: list[float] = field(default_factory=list)

    @once
    def area(self) -> float:
        """Side times side."""
        self.asked.append(self.side)
        return self.side * self.side


def test_each_instance_is_asked_once() -> None:
    two, three = Square(2.0), Square(3.0)
    assert [two.area, two.area, three.area] == [4.0, 4.0, 9.0]
    assert (two.asked, three.asked) == ([2.0], [3.0])


def test_the_class_shows_the_property() -> None:
    assert Square.area.__doc__ == "Side times side."
