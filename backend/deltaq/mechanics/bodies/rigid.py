"""Rigid bodies, with the kinetic energy m/2 v·v + ½ Σ Jₖ ωₖ²."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression
from ...language.tree import Node, Product, TimeDerivative
from ..checks import demand, name_problem
from ..contributions import PointForce
from ..kinetics import Rotation, Translation
from ..material import Material
from ..reader import Reader


@dataclass(frozen=True)
class RigidBody:
    """A rigid body of mass m with its centre of mass at r(q, t): E = m/2 v·v + 1/2 Σ Jₖ ωₖ² (König's theorem).

    In the plane: one moment of inertia about the centre of mass and the `angle` the body turns by. In space: three
    principal moments and the components of the angular velocity in the body frame of the principal axes.
    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §5.3.
    """

    kind: ClassVar[str] = "rigid"
    material: ClassVar[tuple[Material, ...]] = ()

    name: str
    mass: Expression = field(metadata={"unit": "kg"})
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})
    inertia: Expression | tuple[Expression, ...] = field(metadata={"unit": "kg m^2"})
    angle: Expression | None = field(default=None, metadata={"unit": "rad"})
    angular_velocity: tuple[Expression, ...] | None = field(default=None, metadata={"unit": "rad/s"})

    def __post_init__(self) -> None:
        plane = self.angle is not None
        fits = plane is isinstance(self.inertia, Expression) and plane is (self.angular_velocity is None)
        demand(name_problem(self.name), None if fits else Problem("rigid-body-in-plane-or-space"))

    @classmethod
    def read(cls, table: Reader) -> RigidBody:
        name, mass, position = table.name(), table.expression("mass"), table.position("position")
        if table.named.dimension == 2:
            return cls(name, mass, position, table.expression("inertia"), table.angle("angle"))
        inertia, omega = table.vector("inertia"), table.vector("angular_velocity")
        return cls(name, mass, position, inertia, None, omega)

    @property
    def kinetics(self) -> tuple[Translation, Rotation]:
        translation = Translation(self.name, self.mass.tree, tuple(x.tree for x in self.position))
        return translation, Rotation(self.name, self._moments, self._angular_velocity)

    @property
    def _moments(self) -> tuple[Node, ...]:
        moments = self.inertia if isinstance(self.inertia, tuple) else (self.inertia,)
        return tuple(moment.tree for moment in moments)

    @property
    def _angular_velocity(self) -> tuple[Node, ...]:
        if self.angle is not None:
            return (TimeDerivative(self.angle.tree),)
        return tuple(component.tree for component in self.angular_velocity or ())

    def weight(self, source: str, acceleration: tuple[Expression, ...]) -> PointForce:
        """m g at the centre of mass."""
        return PointForce(source, self.name, tuple(Product((self.mass.tree, g.tree)) for g in acceleration))
