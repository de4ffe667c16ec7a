"""A mistake in any law goes on into every answer that follows from the law."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from inspect import getattr_static
from typing import Any

import pytest
import sympy as sp

from deltaq.homework.faulty_solution import FaultySolution, misconceptions
from deltaq.homework.solution import Solution
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene

SCENES = ("rolling-disc", "guided-pendulum", "damped-pendulum")
# Said to come from the true solution, whatever the mistake is: so what only they ask for does not come up.
TRUE = {"rest", "is_conservative", "has_potential", "curl", "_is_given"}
MEMBERS = sorted(
    name
    for name in dir(Solution)
    if not name.startswith("__")
    and (callable(getattr(Solution, name)) or isinstance(getattr_static(Solution, name), property | cached_property))
)


def listening(kind: type[Solution], name: str, heard: list[str]) -> type[Solution]:
    """The solution with one law stated anew: it notes that it was asked for, and says what it said before."""

    def again(self: Solution, *given: object) -> Any:
        heard.append(name)
        above = getattr(super(one, self), name)
        return above(*given) if callable(above) else above

    is_value = isinstance(getattr_static(Solution, name), property | cached_property)
    one: type[Solution] = type("Listening", (kind,), {name: property(again) if is_value else again})
    return one


def answers(solution: Solution) -> Iterator[object]:
    """What tasks ask for."""
    yield solution.lagrangian
    for part in solution.scene.contributions:
        yield solution.virtual_work(part)
    for q in solution.free:
        yield from (solution.equation(q), solution.generalized_force(q), solution.momentum(q))


def asked(solution: Callable[[], Solution], heard: list[str]) -> bool:
    heard.clear()
    list(answers(solution()))
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
    plain, faulty = listening(Solution, name, heard), listening(FaultySolution, name, heard)
    true = Solution(scene)
    return asked(lambda: plain(scene), heard), asked(lambda: faulty(scene, true), heard)  # type: ignore[call-arg]


def test_a_wrong_mass_and_a_wrong_angular_velocity_reach_the_equation() -> None:
    """A disc that rolls: m s̈ for its centre, and J s̈/R² = m s̈/2 for its turning with s/R."""
    scene = load_scene("rolling-disc")
    true = Solution(scene)

    class TwiceTheMass(FaultySolution):
        def mass(self, body: Any) -> Any:
            return 2 * super().mass(body)

    class TwiceAsFast(FaultySolution):
        def angular_velocity(self, part: Any) -> Any:
            return tuple(2 * rate for rate in super().angular_velocity(part))

    right, *wrong = (solution.equation("s") for solution in (true, TwiceTheMass(scene, true), TwiceAsFast(scene, true)))
    inertia = [sp.simplify(one.diff(true.acceleration("s")) / true.q("m")) for one in (right, *wrong)]
    assert inertia == [1 + sp.Rational(1, 2), 2 + sp.Rational(1, 2), 1 + 4 * sp.Rational(1, 2)]


def test_a_misconception_states_some_law_otherwise() -> None:
    """A law misspelt would be no law of the solution, and the mistake would not be made."""
    for kind in misconceptions():
        classes = kind.__mro__[: kind.__mro__.index(FaultySolution)]
        assert any(hasattr(Solution, name) for one in classes for name in vars(one) if not name.startswith("__")), kind
