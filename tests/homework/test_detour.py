"""A mistake in any law goes on into every answer that follows from the law."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from inspect import getattr_static
from typing import Any

import pytest
import sympy as sp

from deltaq.homework.detour import Detour, misconceptions
from deltaq.homework.road import Road
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene

SCENES = ("rolling-disc", "guided-pendulum", "damped-pendulum")
# Said to come from the true road, whatever the mistake is: so what only they ask for does not come up.
TRUE = {"rest", "is_conservative", "has_potential"}
MEMBERS = sorted(
    name
    for name in dir(Road)
    if not name.startswith("__")
    and (callable(getattr(Road, name)) or isinstance(getattr_static(Road, name), property | cached_property))
)


def listening(kind: type[Road], name: str, heard: list[str]) -> type[Road]:
    """The road with one law stated anew: it notes that it was asked for, and says what it said before."""

    def again(self: Road, *given: object) -> Any:
        heard.append(name)
        above = getattr(super(one, self), name)
        return above(*given) if callable(above) else above

    is_value = isinstance(getattr_static(Road, name), property | cached_property)
    one: type[Road] = type("Listening", (kind,), {name: property(again) if is_value else again})
    return one


def answers(road: Road) -> Iterator[object]:
    """What tasks ask for."""
    yield road.lagrangian
    for part in road.scene.contributions:
        yield road.virtual_work(part)
    for q in road.free:
        yield from (road.equation(q), road.generalized_force(q), road.momentum(q))


def asked(road: Callable[[], Road], heard: list[str]) -> bool:
    heard.clear()
    list(answers(road()))
    return bool(heard)


@pytest.mark.parametrize("identifier", SCENES)
def test_what_an_answer_follows_from_is_asked_of_the_road_with_the_mistake(identifier: str) -> None:
    """For every law there is, those that no misconception gets wrong yet among them."""
    scene = load_scene(identifier)
    found = {name: _asked_on_both(scene, name) for name in MEMBERS}
    assert {name for name, (right, wrong) in found.items() if right and not wrong} <= TRUE
    assert {"position", "velocity", "dot", "expression", "mass", "guides"} <= {
        name for name, (_, wrong) in found.items() if wrong
    }


def _asked_on_both(scene: Scene, name: str) -> tuple[bool, bool]:
    heard: list[str] = []
    plain, detour = listening(Road, name, heard), listening(Detour, name, heard)
    true = Road(scene)
    return asked(lambda: plain(scene), heard), asked(lambda: detour(scene, true), heard)  # type: ignore[call-arg]


def test_a_wrong_mass_and_a_wrong_angular_velocity_reach_the_equation() -> None:
    """A disc that rolls: m s̈ for its centre, and J s̈/R² = m s̈/2 for its turning with s/R."""
    scene = load_scene("rolling-disc")
    true = Road(scene)

    class TwiceTheMass(Detour):
        def mass(self, body: Any) -> Any:
            return 2 * super().mass(body)

    class TwiceAsFast(Detour):
        def angular_velocity(self, part: Any) -> Any:
            return tuple(2 * rate for rate in super().angular_velocity(part))

    right, *wrong = (road.equation("s") for road in (true, TwiceTheMass(scene, true), TwiceAsFast(scene, true)))
    inertia = [sp.simplify(one.diff(true.acceleration("s")) / true.q("m")) for one in (right, *wrong)]
    assert inertia == [1 + sp.Rational(1, 2), 2 + sp.Rational(1, 2), 1 + 4 * sp.Rational(1, 2)]


def test_a_misconception_states_some_law_otherwise() -> None:
    """A law misspelt would be no law of the road, and the mistake would not be made."""
    for kind in misconceptions():
        classes = kind.__mro__[: kind.__mro__.index(Detour)]
        assert any(hasattr(Road, name) for one in classes for name in vars(one) if not name.startswith("__")), kind
