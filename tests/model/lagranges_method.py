"""The equations of motion of a scene by SymPy's own mechanics package, from the texts of the scene: another route."""

from __future__ import annotations

from typing import Any

import sympy as sp
from tests.derivation.peer import Peer

from deltaq.mechanics.scene import Scene


def lagranges_method(scene: Scene) -> tuple[list[Any], Any, Any]:
    """The inputs (q, q̇, t, parameters) as symbols, M and f, which is without reactions."""
    names = [coordinate.name for coordinate in scene.free]
    equations = sp.Matrix(Peer(scene).equations())
    accelerations = [sp.Symbol(f"ddot({name})") for name in names]
    motion = [sp.Symbol(name) for name in names] + [sp.Symbol(f"dot({name})") for name in names] + [sp.Symbol("t")]
    parameters = [sp.Symbol(parameter.name, positive=True) for parameter in scene.parameters]
    multipliers = [sp.Symbol(symbol.name) for symbol in scene.multipliers]
    forcing = -equations.subs(dict.fromkeys((*accelerations, *multipliers), 0))
    return [*motion, *parameters], equations.jacobian(accelerations), forcing
