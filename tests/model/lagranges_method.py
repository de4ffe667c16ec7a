"""The equations of motion of a scene by SymPy's own mechanics package, from the texts of the scene: another route."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, Point, ReferenceFrame, dynamicsymbols

from deltaq.language.tree import Node, fold
from deltaq.mechanics.contributions import PointForce
from deltaq.mechanics.scene import Scene


class SympyAlgebra:
    """Just enough of SymPy to read test scenes; guided coordinates are functions of time from the outset."""

    def __init__(self, values: dict[str, Any]) -> None:
        self.values = values

    number = staticmethod(lambda value: sp.Rational(value.numerator, value.denominator))
    sum = staticmethod(lambda terms: sp.Add(*terms))
    product = staticmethod(lambda factors: sp.Mul(*factors))
    quotient = staticmethod(lambda a, b: a / b)
    negation = staticmethod(lambda a: -a)
    power = staticmethod(lambda a, b: a**b)
    call = staticmethod(lambda function, arguments: getattr(sp, function)(*arguments))

    def name(self, name: str) -> Any:
        return self.values[name]

    def rate(self, name: str, order: int) -> Any:
        return self.values[name].diff(dynamicsymbols._t, order)


def lagranges_method(scene: Scene) -> tuple[list[Any], Any, Any]:
    """The inputs (q, q̇, t, parameters) as symbols, M and f."""
    t = dynamicsymbols._t
    q = {c.name: dynamicsymbols(f"Q{i}") for i, c in enumerate(scene.free)}
    parameters = {p.name: sp.Symbol(f"P{i}") for i, p in enumerate(scene.parameters)}
    values: dict[str, Any] = {**q, **parameters, "t": t, "pi": sp.pi}
    for guide in scene.guides:
        values[guide.coordinate] = fold(guide.value.tree, SympyAlgebra(values))

    def read(node: Node) -> Any:
        return fold(node, SympyAlgebra(values))

    frame = ReferenceFrame("N")
    axes = (frame.x, frame.y, frame.z)
    kinetic, potential, forces = sp.Integer(0), sp.Integer(0), []
    for body in scene.bodies:
        kinetic += read(body.mass.tree) * sum(read(x.tree).diff(t) ** 2 for x in body.position) / 2
    for index, part in enumerate(scene.contributions):
        if not isinstance(part, PointForce):
            potential += read(part.energy)
            continue
        point = Point(f"A{index}")
        r = sum((read(x.tree) * e for x, e in zip(scene.place(part.place), axes, strict=False)), 0 * frame.x)
        point.set_vel(frame, r.dt(frame))
        forces.append((point, sum((read(x) * e for x, e in zip(part.force, axes, strict=False)), 0 * frame.x)))
    method = LagrangesMethod(kinetic - potential, list(q.values()), forcelist=forces, frame=frame)
    method.form_lagranges_equations()
    plain = {x.diff(t): sp.Symbol(f"U{i}") for i, x in enumerate(q.values())}
    names = {x: sp.Symbol(f"q{i}") for i, x in enumerate(q.values())}
    inputs = [*names.values(), *plain.values(), t, *parameters.values()]
    return inputs, method.mass_matrix.subs(plain).subs(names), method.forcing.subs(plain).subs(names)
