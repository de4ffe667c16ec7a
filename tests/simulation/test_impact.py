"""Several contacts that close at once: whichever is written first, the motion is the same, or it ends there."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from tests.simulation.scenes import document

from deltaq.errors import SceneError
from deltaq.mechanics.document import read_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of, require_no_event
from deltaq.simulation.trajectory import Trajectory

HALF_WIDTH, HALF_HEIGHT, G = 0.5, 0.2, 9.81


def contact(name: str, gap: str, restitution: float) -> Mapping[str, str]:
    return {"name": name, "value": gap, "then": "bounce", "restitution": repr(restitution)}


def box(inertia: float, restitution: float, *, turn: float = 0.0, rise: float = 0.8) -> dict[str, object]:
    """A block of mass 1 above the floor, which its two lower corners meet."""
    lowest = HALF_HEIGHT * math.cos(turn) + HALF_WIDTH * math.sin(abs(turn))
    weight = {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}
    start = {"x": (0.0, 0.0), "y": (lowest + rise, 0.0), "f": (turn, 0.0)}
    found = document(start, {"m": 1.0, "J": inertia, "g": G}, {"box": ("m", ["x", "y"])}, [weight])
    rigid = {"name": "box", "kind": "rigid", "mass": "m", "inertia": "J", "angle": "f", "position": ["x", "y"]}
    corners = [
        contact(name, f"y - {HALF_HEIGHT}*cos(f) {sign} {HALF_WIDTH}*sin(f)", restitution)
        for name, sign in (("left", "-"), ("right", "+"))
    ]
    return found | {"bodies": [rigid], "events": corners}


def point(*contacts: Mapping[str, str]) -> dict[str, object]:
    """A point that comes to the origin from (1, 1) at rates (−1, −1)."""
    found = document({"x": (1.0, -1.0), "y": (1.0, -1.0)}, {"m": 1.0}, {"point": ("m", ["x", "y"])}, [])
    return found | {"events": list(contacts)}


def balls(places: Sequence[float], rates: Sequence[float], masses: Sequence[float], e: float) -> dict[str, object]:
    """Balls of diameter 1 on a line."""
    numbers = range(len(places))
    start = {f"x{k}": (places[k], rates[k]) for k in numbers}
    bodies = {f"b{k}": (f"m{k}", [f"x{k}", "0"]) for k in numbers}
    gaps = [contact(f"c{k}", f"x{k} - x{k - 1} - 1", e) for k in numbers[1:]]
    return document(start, {f"m{k}": masses[k] for k in numbers}, bodies, []) | {"events": gaps}


def run(scene: dict[str, object], t_end: float, method: str = "dop853") -> Trajectory:
    return simulate(problem_of(read_scene(scene), t_end, 21), get_method(method), tolerance=1e-9)


def backwards(scene: dict[str, object]) -> dict[str, object]:
    events = scene["events"]
    assert isinstance(events, list)
    return scene | {"events": events[::-1]}


DETERMINED = [
    # The centre of percussion of one corner is the other one: neither pushes the other.
    pytest.param(box(HALF_WIDTH**2, 0.5), 0.7, (0.0, None, 0.0), id="block of which corners do not feel each other"),
    pytest.param(box(0.5, 0.0), 1.0, (0.0, HALF_HEIGHT, 0.0), id="block that does not rebound"),
    pytest.param(box(0.1, 0.0), 1.0, (0.0, HALF_HEIGHT, 0.0), id="compact block that does not rebound"),
    pytest.param(point(contact("w", "x", 1.0), contact("v", "y", 0.5)), 3.0, (2.0, 1.0), id="right-angled corner"),
    pytest.param(point(contact("w", "x", 0.0), contact("v", "y+x/2", 0.0)), 3.0, (0.0, 0.0), id="corner that catches"),
    pytest.param(balls((0, 2, 3), (1, 0, 0), (1, 1, 1), 1.0), 3.0, (1.0, 2.0, 5.0), id="cradle"),
    pytest.param(
        balls((0, 2, 3, 4, 6), (1, 0, 0, 0, -1), (1, 1, 1, 1, 1), 1.0), 3.0, (-1.0, 2.0, 3.0, 4.0, 7.0), id="both ends"
    ),
]


@pytest.mark.parametrize(("scene", "t_end", "end"), DETERMINED)
@pytest.mark.parametrize("method", ["dop853", "rk4", "gauss-4"])
def test_order_in_the_scene_does_not_matter(
    scene: dict[str, object], t_end: float, end: Sequence[float | None], method: str
) -> None:
    for each in (scene, backwards(scene)):
        found = run(each, t_end, method)
        assert found.outcome.status == "ok"
        assert found.estimate is not None
        assert found.trusted_until == t_end
        for value, expected in zip(found.values[-1], end, strict=True):
            assert expected is None or abs(value - expected) <= found.estimate.errors[-1]


@pytest.mark.parametrize(
    ("scene", "time"),
    [
        pytest.param(box(0.5, 0.5), math.sqrt(1.6 / G), id="flat block"),
        pytest.param(box(0.1, 1.0), math.sqrt(1.6 / G), id="flat elastic block"),
        pytest.param(point(contact("w", "x", 1.0), contact("v", "y + x/2", 1.0)), 1.0, id="acute corner"),
        pytest.param(point(contact("w", "x", 0.5), contact("v", "2*x", 1.0)), 1.0, id="one wall of two restitutions"),
        pytest.param(point(contact("w", "x", 0.5), contact("v", "x + y/2", 0.0)), 1.0, id="only one catches"),
        pytest.param(balls((-1.5, 0, 1.5), (1, 0, -1), (1, 3, 1), 1.0), 0.5, id="squeezed ball"),
        pytest.param(balls((0, 2, 3, 4, 6), (1, 0, 0, 0, -1), (1,) * 5, 0.5), 1.0, id="both ends of a lossy cradle"),
    ],
)
def test_a_motion_ends_where_its_order_matters(scene: dict[str, object], time: float) -> None:
    for each in (scene, backwards(scene)):
        found = run(each, 3.0)
        assert (found.outcome.status, found.outcome.code) == ("unresolved", "contacts_in_any_order")
        assert found.reached == pytest.approx(time, rel=1e-9)
        assert found.times[-1] <= time
        assert not found.transitions
        assert found.estimate is not None
        assert found.estimate.worst < 1e-9


def test_a_start_where_its_order_matters_is_refused() -> None:
    scene = box(0.5, 0.5, rise=0.0)
    coordinates = scene["coordinates"]
    assert isinstance(coordinates, list)
    fallen = [{**each, "rate": -1.0} if each["name"] == "y" else each for each in coordinates]
    begins = read_scene(scene | {"coordinates": fallen})
    with pytest.raises(SceneError) as refused:
        require_no_event(begins, problem_of(begins, 1.0))
    assert [(each.code, each.pointer) for each in refused.value.problems] == [
        ("contacts-in-any-order", "/events/0/value")
    ]


@pytest.mark.parametrize(
    ("scene", "first", "together"),
    [
        pytest.param(balls((0, 2, 3), (1, 0, 0), (1, 1, 1), 1.0), "c1", ("c2",), id="cradle"),
        pytest.param(balls((0, 2, 3, 4), (1, 0, 0, 0), (1, 1, 1, 1), 1.0), "c1", ("c2", "c3"), id="longer cradle"),
        pytest.param(balls((0, 2, 4), (1, 0, 0), (1, 1, 1), 1.0), "c1", (), id="balls apart"),
    ],
)
def test_contacts_that_pushed_are_told_in_their_order(
    scene: dict[str, object], first: str, together: tuple[str, ...]
) -> None:
    found = run(scene, 1.5)
    assert [(each.name, each.together) for each in found.transitions] == [(first, together)]


@pytest.mark.parametrize("inertia", [0.3, 0.5, 1.0, 2.0])
def test_a_block_that_rocks_without_rebound_comes_to_rest(inertia: float) -> None:
    """On a smooth floor the impulse passes vertically through the new corner, about which ḟ J ∓ ẏ b is kept.

    With ẏ = ±b ḟ at the corner that touches, ḟ⁺/ḟ⁻ = (J − b²)/(J + b²); with friction it is Housner's (1963) ratio.
    """
    found = run(box(inertia, 0.0, turn=0.05, rise=0.0), 4.0)
    assert found.outcome.status == "ok"
    left = (inertia - HALF_WIDTH**2) / (inertia + HALF_WIDTH**2)
    swings = [each for each in found.transitions if abs(each.before[5]) > 1e-3]
    assert len(swings) >= 3
    assert [float(each.after[5] / each.before[5]) for each in swings] == pytest.approx([left] * len(swings), rel=1e-8)
    assert np.abs(found.values[-1] - [found.values[-1][0], HALF_HEIGHT, 0.0]).max() < 1e-12
    assert np.abs(found.rates[-1]).max() < 1e-12
    assert found.transitions[-1].time < 4.0
