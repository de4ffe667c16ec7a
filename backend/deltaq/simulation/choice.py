"""Which method `auto` takes, and why."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

from ..language.tree import Call, Node, walk
from ..mechanics.contributions import Contribution
from ..mechanics.scene import Scene
from .library import get_method
from .method import Method

AUTO = "auto"
KINKED = frozenset({"abs", "sign"})


@dataclass(frozen=True)
class Choice:
    """A method, and the code of the reason in the catalog; None if the user chose."""

    method: Method
    reason: str | None = None


def choose(wanted: str, scene: Scene, step: float | None) -> Choice:
    """The method wanted, or the one that suits the scene. Raises UnknownNameError for one that does not exist.

    Measured on the library: for smooth motions order 8 with step control costs least at every tolerance from 1e-3
    down; above, the largest step allowed rules, and the methods cost about the same.
    """
    if wanted != AUTO:
        return Choice(get_method(wanted))
    if step is not None:
        return Choice(get_method("rk4"), "auto_fixed_step")
    if _has_kinks(scene):
        return Choice(get_method("dormand-prince-54"), "auto_kinks")
    return Choice(get_method("dop853"), "auto_smooth")


def _has_kinks(scene: Scene) -> bool:
    """Whether forces jump or bend, which high orders do not profit from."""
    guides = [guide.value.tree for guide in scene.guides]
    forces = [node for part in scene.contributions for node in _nodes(part)]
    return any(isinstance(n, Call) and n.function in KINKED for tree in guides + forces for n in walk(tree))


def _nodes(part: Contribution) -> Iterator[Node]:
    """All expressions of a contribution, whatever its kind."""
    for item in fields(part):
        value = getattr(part, item.name)
        yield from (node for node in (value if isinstance(value, tuple) else (value,)) if isinstance(node, Node))
