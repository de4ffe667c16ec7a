"""What a plane in phase space is asked for by: an expression that is zero in it, and a direction."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..contract.experiments.poincare_section import Direction
from ..errors import InputError
from ..errors import Problem as Mistake
from ..language.expression import Expression
from ..language.parser import parse
from ..language.tree import Rate, walk
from ..mechanics.requests import inside
from ..mechanics.scene import Scene

SIGNS: Mapping[Direction, int] = MappingProxyType({"rising": 1, "falling": -1, "both": 0})


def parsed(text: str, scene: Scene, pointer: str) -> Expression:
    """A function of coordinates, rates and the time. Raises InputError, at the pointer, for anything else."""
    with inside(pointer):
        found = parse(text, scene.names)
        if not found.is_scalar:
            raise InputError(Mistake("not-scalar"))
        if found.has_derivatives or any(isinstance(node, Rate) and node.order > 1 for node in walk(found.tree)):
            raise InputError(Mistake("section-derivative"))
    return found
