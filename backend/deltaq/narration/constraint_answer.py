"""Constraints and reactions as data: expressions as plain text, as LaTeX and in words."""

from __future__ import annotations

from ..derivation.released import Release
from ..derivation.result import Bound
from ..mechanics.release import held
from ..mechanics.scene import Scene
from .expression_writer import ExpressionWriter

Document = dict[str, object]


def constraint(bound: Bound, write: ExpressionWriter) -> Document:
    """A constraint, its multiplier, and the reactions that keep it."""
    return {
        "name": bound.name,
        "kind": bound.kind,
        "holonomic": bound.is_holonomic,
        "equation": write.equated(bound.equation),
        "multiplier": write.written(bound.multiplier),
        "reaction": None if bound.reaction is None else write.written(bound.reaction),
        "forces": [{"coordinate": q, **write.written(force)} for q, force in bound.forces.items()],
    }


def reaction(release: Release, write: ExpressionWriter) -> Document:
    """What holds what was released; of a length also the force of rod or string, which is its negative."""
    force = release.system.display(-release.value) if release.kind == "length" else None
    return {
        "name": release.name,
        "kind": release.kind,
        "reaction": write.written(release.value),
        "closed": release.closed is not None,
        "force": None if force is None else write.written(force),
    }


def releasable(scene: Scene, write: ExpressionWriter) -> list[Document]:
    """What the scene holds fixed."""
    symbols = {symbol.name: symbol.typeset for symbol in scene.names.symbols}
    return [
        {"name": each.name, "kind": each.kind, "latex": symbols[each.name], "spoken": write.speech.name(each.name)}
        for each in held(scene)
    ]
