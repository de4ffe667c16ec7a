"""What can be asked for: each quantity with the form of its answer, its kind of equality and its value on a road."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal, cast

import sympy as sp

from .equality import (
    Equality,
    Parts,
    conserved,
    equation,
    equations,
    expression,
    frequencies,
    lagrangian,
    up_to_constant,
)
from .road import Road

Form = Literal["expression", "vector", "equation", "equations", "set"]
Subjects = Callable[[Road], Iterable[str]]


@dataclass(frozen=True)
class Quantity:
    """One kind of task: `subjects` lists what it can be asked of, `value` are the parts of its answer.

    `needs` are the quantities it is derived from, `chapter` is where the derivation shows it and `steps` the steps that
    do, the likeliest first. `labels` are the symbols that may stand on the left of the answer, and `points` is what it
    counts if nobody says otherwise.
    """

    kind: str
    form: Form
    equality: Equality
    value: Callable[[Road, str], Parts]
    subjects: Subjects
    chapter: str
    labels: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    points: float = 1.0
    steps: tuple[str, ...] = ()

    @property
    def up_to_constant(self) -> bool:
        """Whether an added constant makes no difference."""
        return self.equality in (up_to_constant, lagrangian, conserved)


def _bodies(road: Road) -> list[str]:
    return [body.name for body in road.scene.bodies]


def _coordinates(road: Road) -> tuple[str, ...]:
    return road.free


def _one(_road: Road) -> tuple[str, ...]:
    return ("",)


def _loaded(road: Road) -> tuple[str, ...]:
    return ("",) if road.load_names else ()


def _with_potential(road: Road) -> tuple[str, ...]:
    return ("",) if any(map(road.is_conservative, road.load_names)) else ()


def _coupled(road: Road) -> tuple[str, ...]:
    return ("",) if len(road.free) > 1 else ()


def _resting(road: Road) -> tuple[str, ...]:
    return road.free if road.rest is not None else ()


def _oscillating(road: Road) -> tuple[str, ...]:
    return ("",) if road.rest is not None and _positive(road) else ()


def _positive(road: Road) -> bool:
    return bool(road.frequencies) and all(frequencies.number_of(each, road) > 1e-9 for each in road.frequencies)


def _conserved(road: Road) -> list[str]:
    return [str(n) for n, _ in enumerate(road.conserved_of, 1)]


def _vector(value: sp.ImmutableMatrix) -> Parts:
    return tuple(value)


def _virtual_work(road: Road, _: str) -> Parts:
    return (sum(map(road.virtual_work, road.scene.contributions), road.zero),)


def _conserved_value(road: Road, number: str) -> Parts:
    true = getattr(road, "true", road)
    return (road.conserved(true.conserved_of[int(number) - 1]),)


EXACT, CONSTANT, GAUGE, ONE, SET, NUMBERS, MULTIPLE = (
    cast("Equality", module)
    for module in (expression, up_to_constant, lagrangian, equation, equations, frequencies, conserved)
)

QUANTITIES: tuple[Quantity, ...] = (
    Quantity(
        "position",
        "vector",
        EXACT,
        lambda road, body: _vector(road.position(body)),
        _bodies,
        "configuration",
        ("r", "x"),
        steps=("guided-position:{subject}", "position:{subject}"),
    ),
    Quantity(
        "virtual-displacement",
        "vector",
        EXACT,
        lambda road, body: _vector(road.virtual_displacement(body)),
        _bodies,
        "variation",
        ("deltar", "δr"),
        ("position",),
        steps=("virtual-displacement:{subject}",),
    ),
    Quantity(
        "virtual-work",
        "expression",
        EXACT,
        _virtual_work,
        _loaded,
        "virtual-work",
        ("deltaW", "δW", "deltaA"),
        ("virtual-displacement",),
        2.0,
        steps=("virtual-work",),
    ),
    Quantity(
        "generalized-force",
        "expression",
        EXACT,
        lambda road, q: (road.generalized_force(q),),
        lambda road: road.free if road.load_names else (),
        "virtual-work",
        ("Q",),
        ("virtual-work",),
        steps=("generalized-forces",),
    ),
    Quantity(
        "kinetic-energy",
        "expression",
        EXACT,
        lambda road, _: (road.kinetic_energy,),
        _one,
        "kinetic-energy",
        ("E", "T", "K", "Ekin", "E_kin"),
        ("position",),
        2.0,
        steps=("kinetic-energy",),
    ),
    Quantity(
        "potential-energy",
        "expression",
        CONSTANT,
        lambda road, _: (road.potential_energy,),
        _with_potential,
        "decomposition",
        ("V", "U", "E_pot", "Epot"),
        ("position",),
        steps=("decomposition",),
    ),
    Quantity(
        "lagrangian",
        "expression",
        GAUGE,
        lambda road, _: (road.lagrangian,),
        _one,
        "lagrange",
        ("L",),
        ("kinetic-energy", "potential-energy"),
        steps=("lagrangian",),
    ),
    Quantity(
        "momentum",
        "expression",
        EXACT,
        lambda road, q: (road.momentum(q),),
        _coordinates,
        "lagrange",
        ("p",),
        ("lagrangian", "kinetic-energy"),
        steps=("equation:{subject}",),
    ),
    Quantity(
        "equation",
        "equation",
        ONE,
        lambda road, q: (road.equation(q),),
        _coordinates,
        "lagrange",
        (),
        ("lagrangian", "kinetic-energy", "potential-energy", "generalized-force", "momentum"),
        3.0,
        steps=("equation:{subject}",),
    ),
    Quantity(
        "equations",
        "equations",
        SET,
        lambda road, _: tuple(map(road.equation, road.free)),
        _coupled,
        "lagrange",
        (),
        ("lagrangian", "kinetic-energy", "potential-energy", "equation"),
        4.0,
        steps=("matrix-form",),
    ),
    Quantity(
        "linearized",
        "equation",
        ONE,
        lambda road, q: (road.linear_equation(q),),
        _resting,
        "model",
        (),
        ("equation",),
        2.0,
        steps=("linearization:1",),
    ),
    Quantity(
        "eigenfrequencies",
        "set",
        NUMBERS,
        lambda road, _: road.frequencies,
        _oscillating,
        "model",
        (),
        ("linearized",),
        2.0,
        steps=("eigenfrequencies:1",),
    ),
    Quantity(
        "conserved",
        "expression",
        MULTIPLE,
        _conserved_value,
        _conserved,
        "model",
        ("p", "h", "H", "E"),
        ("lagrangian", "momentum"),
        steps=("cyclic-coordinate:{cyclic}", "jacobi-energy"),
    ),
)


def quantity_of(kind: str) -> Quantity | None:
    return next((quantity for quantity in QUANTITIES if quantity.kind == kind), None)
