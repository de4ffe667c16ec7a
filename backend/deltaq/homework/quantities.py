"""What can be asked for: each quantity with the form of its answer, its kind of equality and its value on a road."""

from __future__ import annotations

from typing import cast

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
from .quantity import Quantity
from .road import Road
from .subjects import bodies, coordinates, coupled, loaded, numbered, oscillating, resting, whole, with_potential


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
        bodies,
        "configuration",
        ("r", "x"),
        steps=("guided-position:{subject}", "position:{subject}"),
    ),
    Quantity(
        "virtual-displacement",
        "vector",
        EXACT,
        lambda road, body: _vector(road.virtual_displacement(body)),
        bodies,
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
        loaded,
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
        whole,
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
        with_potential,
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
        whole,
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
        coordinates,
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
        coordinates,
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
        coupled,
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
        resting,
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
        oscillating,
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
        numbered,
        "model",
        ("p", "h", "H", "E"),
        ("lagrangian", "momentum"),
        steps=("cyclic-coordinate:{cyclic}", "jacobi-energy"),
    ),
)


def quantity_of(kind: str) -> Quantity | None:
    """The quantity of a task of this kind, if there is one."""
    return next((quantity for quantity in QUANTITIES if quantity.kind == kind), None)
