"""Small oscillations about rest: M₀ ẍ + D ẋ + K x = F(t).

Where the forces are symmetric about rest, the relative error of the motion grows like the amplitude squared, and with
time, since the frequency is wrong by that much: ω/ω₀ = 1 − φ₀²/16 for the pendulum.
Source: Landau, Lifshitz, Mechanics, §23 and §28; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., ch. 6.
"""

from __future__ import annotations

from collections.abc import Iterator

from ....mechanics.coordinate import Coordinate
from ....mechanics.parameter import Parameter
from ....model.linear_laws import is_linear, linear_laws
from ..findings import Part
from ..linear_loads import with_linear_loads
from ..names import fresh, tidied, with_parameters
from ..simplification import Kind, SimplificationContext, Simplified


def _offered(context: SimplificationContext) -> Iterator[Part]:
    scene = context.scene
    if all(each.name in context.centre for each in scene.free) and not is_linear(scene):
        yield Part("linearized", {})


def _simplify(context: SimplificationContext, _part: Part) -> Simplified:
    scene = context.scene
    away = tuple(each for each in scene.free if context.centre[each.name] != 0.0)
    rest = {each.name: fresh(scene, f"{each.name}_rest") for each in away}
    values = tuple(_at_rest(each, rest[each.name], context.centre[each.name]) for each in away)
    laws = linear_laws(with_parameters(scene, values), rest)
    return Simplified(tidied(with_linear_loads(laws, rest), scene.labels))


def _at_rest(coordinate: Coordinate, name: str, value: float) -> Parameter:
    return Parameter(name, unit=coordinate.unit, value=value, positive=False)


KIND = Kind("linearized", _offered, _simplify)
