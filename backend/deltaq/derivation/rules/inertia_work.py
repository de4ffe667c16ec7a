"""From d'Alembert to Lagrange: ∫ ∂r/∂qᵢ · v̇ dm = d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ, both sides computed.

Bodies that turn add ∂ωₖ/∂q̇ᵢ Σ Jₖₗ ω̇ₗ for their axes, in space with Euler's (ω × Jω)ₖ.
Source: Lagrange, Mécanique analytique (1788); Lurie, Analytical Mechanics, ch. 4; the lecture.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ...mechanics.kinetics import Distribution, Kinetics, Rotation, Translation
from ..formula import Dot, Explicit, Formula, Integral, Named, Partial, Plus, Quantity, Rate, Term, Times, minus
from ..step import Relation, Step
from ..system import System

RULE = "inertia-work"


def apply(system: System, coordinate: str) -> Step:
    """The left side of Lagrange's equation of one coordinate, by accelerations and by the kinetic energy."""
    energy = Named(Quantity("kinetic-energy"), system.kinetic_energy)
    by_energy = Plus(
        (
            Term(Rate(Partial(energy, system.rate(coordinate)))),
            minus(Partial(energy, system.q(coordinate))),
        )
    )
    inertia = tuple(
        Term(formula, (f"body:{part.body}",))
        for body in system.scene.bodies
        for part in body.kinetics
        for formula in _inertia(system, part, coordinate)
    )
    value = Explicit(system.inertia_work(coordinate))
    line = Relation((Plus(inertia), value, by_energy))
    about = {"outcome": _outcome(system), "coordinate": coordinate}
    return Step(RULE, coordinate, (line,), system.body_sources, about)


def _outcome(system: System) -> str:
    """Whether bodies turn, and in space."""
    turning = [part for body in system.scene.bodies for part in body.kinetics if isinstance(part, Rotation)]
    in_space = any(len(part.angular_velocity) > 1 for part in turning)
    return "turning-in-space" if in_space else "turning" if turning else "text"


def _inertia(system: System, part: Kinetics, coordinate: str) -> Iterator[Formula]:
    """What one part of a body adds, by its law."""
    match part:
        case Translation(body=body, mass=mass):
            yield Times((Explicit(system.expression(mass)), _tangent_times_acceleration(system, body, coordinate)))
        case Distribution(body=body, density=density, material=material):
            work = _tangent_times_acceleration(system, body, coordinate)
            yield Integral(Times((Explicit(system.expression(density)), work)), system.bounds(material))
        case Rotation():
            yield from _turning(system, part, coordinate)


def _tangent_times_acceleration(system: System, body: str, coordinate: str) -> Dot:
    tangent = Partial(system.named_position(body), system.q(coordinate))
    return Dot(tangent, Rate(system.named_velocity(body)))


def _turning(system: System, part: Rotation, coordinate: str) -> Iterator[Formula]:
    """∂ωₖ/∂q̇ᵢ (Σ Jₖₗ ω̇ₗ + (ω × Jω)ₖ) for every axis."""
    tensor = _tensor(system, part)
    omegas = system.named_angular_velocities(part)
    euler = _gyroscopic(tensor, [omega.value for omega in omegas])
    for k, (omega, extra) in enumerate(zip(omegas, euler, strict=True)):
        lever = Partial(omega, system.rate(coordinate))
        turning = [Times((Explicit(tensor[k, l]), Rate(each))) for l, each in enumerate(omegas) if tensor[k, l] != 0]
        whole: list[Formula] = [*turning, *([Explicit(extra)] if extra != 0 else [])]
        if whole:
            yield Times((lever, whole[0] if len(whole) == 1 else Plus(tuple(map(Term, whole)))))


def _tensor(system: System, part: Rotation) -> sp.Matrix:
    size = len(part.inertia)
    tensor = sp.zeros(size, size)
    for k, l, entry in part.entries:
        tensor[k, l] = tensor[l, k] = system.expression(entry)
    return tensor


def _gyroscopic(tensor: sp.Matrix, omegas: list[sp.Expr]) -> list[sp.Expr]:
    """(ω × Jω)ₖ; nothing in the plane."""
    if len(omegas) == 1:
        return [sp.Integer(0)]
    omega = sp.Matrix(omegas)
    return list(omega.cross(tensor * omega))
