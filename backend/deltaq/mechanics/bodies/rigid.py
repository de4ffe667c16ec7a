"""Rigid bodies, with the kinetic energy m/2 v·v + ½ Σ Jₖₗ ωₖ ωₗ."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression, expressions_in
from ...language.tree import Node, Product, TimeDerivative
from ..checks import demand, name_problem
from ..contributions import PointForce
from ..kinetics import PAIRS, Rotation, Translation
from ..material import Material
from ..reader import Reader

Vector = tuple[Expression, ...]
Tensor = tuple[Vector, ...]


@dataclass(frozen=True)
class RigidBody:
    """A rigid body of mass m with its centre of mass at r(q, t): E = m/2 v·v + 1/2 Σ Jₖₗ ωₖ ωₗ (König's theorem).

    In the plane: one moment of inertia about the centre of mass and the `angle` the body turns by. In space: three
    principal moments, or the rows of the symmetric tensor of inertia about the centre of mass, and the components of
    the angular velocity along the same axes, which are fixed in the body.
    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §5.3.
    """

    kind: ClassVar[str] = "rigid"
    material: ClassVar[tuple[Material, ...]] = ()

    name: str
    mass: Expression = field(metadata={"unit": "kg"})
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})
    inertia: Expression | Vector | Tensor = field(metadata={"unit": "kg m^2"})
    angle: Expression | None = field(default=None, metadata={"unit": "rad"})
    angular_velocity: tuple[Expression, ...] | None = field(default=None, metadata={"unit": "rad/s"})

    def __post_init__(self) -> None:
        plane = self.angle is not None
        fits = plane is isinstance(self.inertia, Expression) and plane is (self.angular_velocity is None)
        demand(name_problem(self.name), None if fits else Problem("rigid-body-in-plane-or-space"), self._asymmetry())

    def _asymmetry(self) -> Problem | None:
        """The first entry of a tensor that differs from the one across its diagonal."""
        for k, l in PAIRS if self._rows else ():
            upper, lower = self._rows[k][l], self._rows[l][k]
            if upper.tree != lower.tree:
                parameters = {"name": self.name, "upper": upper.text, "lower": lower.text}
                return Problem("inertia-not-symmetric", f"/inertia/{l}/{k}", parameters=parameters)
        return None

    @classmethod
    def read(cls, table: Reader) -> RigidBody:
        name, mass, position = table.name(), table.expression("mass"), table.position("position")
        if table.named.dimension == 2:
            return cls(name, mass, position, table.expression("inertia"), table.angle("angle"))
        inertia, omega = table.vector_or_tensor("inertia"), table.vector("angular_velocity")
        return cls(name, mass, position, inertia, None, omega)

    @property
    def kinetics(self) -> tuple[Translation, Rotation]:
        translation = Translation(self.name, self.mass.tree, tuple(x.tree for x in self.position))
        products = tuple(self._rows[k][l].tree for k, l in PAIRS) if self._rows else ()
        return translation, Rotation(self.name, self._moments, self._angular_velocity, products)

    @property
    def _rows(self) -> tuple[Vector, ...]:
        """The rows of a tensor; nothing where the axes are principal ones."""
        given = self.inertia if isinstance(self.inertia, tuple) else ()
        return tuple(row for row in given if isinstance(row, tuple))

    @property
    def _moments(self) -> tuple[Node, ...]:
        if self._rows:
            return tuple(row[k].tree for k, row in enumerate(self._rows))
        return tuple(moment.tree for moment in expressions_in(self.inertia))

    @property
    def _angular_velocity(self) -> tuple[Node, ...]:
        if self.angle is not None:
            return (TimeDerivative(self.angle.tree),)
        return tuple(component.tree for component in self.angular_velocity or ())

    def weight(self, source: str, acceleration: tuple[Expression, ...]) -> PointForce:
        """m g at the centre of mass."""
        return PointForce(source, self.name, tuple(Product((self.mass.tree, g.tree)) for g in acceleration))
