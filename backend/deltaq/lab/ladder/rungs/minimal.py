"""Minimal coordinates instead of constraints: as many as there are degrees of freedom, and no multipliers.

Exact: q = X(s, t) keeps the constraints by itself, with fewer equations and nothing that could drift. Told why not
where the constraints have no solution in closed form (`model/minimal.py`), or bind rates and cannot be integrated.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §§1.3, 2.4.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..findings import Part
from ..minimal import minimal
from ..simplification import Kind, SimplificationContext, Simplified


def _offered(context: SimplificationContext) -> Iterator[Part]:
    if context.scene.constraints:
        yield Part("minimal", {})


def _simplify(context: SimplificationContext, _part: Part) -> Simplified:
    found = minimal(context.scene, context.motion)
    return Simplified(found.scene, found.back)


KIND = Kind("minimal", _offered, _simplify, ("linearized", "cyclic", "undamped"), of_constrained=True)
