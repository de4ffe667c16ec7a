"""What can be asked for: each quantity with the form of its answer, its kind of equality and its value."""

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
    kept_by_constraints,
    lagrangian,
    stated,
    symmetry,
    up_to_constant,
    where_kept,
)
from .model_questions import positions, stability, steady
from .ordering import judge as ordering
from .ordering.blocks import EQUATION, LAGRANGIAN, is_short
from .quantity import Quantity, Subjects
from .solution import Solution
from .subjects import (
    bodies,
    carrying,
    contact_of,
    coordinate_of,
    coordinates,
    coupled,
    loaded,
    numbered,
    oscillating,
    reacting,
    resting,
    struck,
    symmetric,
    whole,
    with_potential,
)


def _vector(value: sp.ImmutableMatrix) -> Parts:
    return tuple(value)


def _virtual_work(solution: Solution, _: str) -> Parts:
    return (sum(map(solution.virtual_work, solution.scene.contributions), solution.zero),)


def _true(solution: Solution) -> Solution:
    """The way to the right answer, also where a law is got wrong: equilibria and the like are not led on from that."""
    return cast("Solution", getattr(solution, "true", solution))


def _conserved_value(solution: Solution, number: str) -> Parts:
    return (solution.conserved(_true(solution).conserved_of[int(number) - 1]),)


EXACT, CONSTANT, GAUGE, ONE, SET, NUMBERS, MULTIPLE, MADE_OF, STATED, KEPT, WHERE_KEPT = (
    cast("Equality", module)
    for module in (
        expression,
        up_to_constant,
        lagrangian,
        equation,
        equations,
        frequencies,
        conserved,
        symmetry,
        stated,
        kept_by_constraints,
        where_kept,
    )
)


def _ordering(goal: str, step: str, subjects: Subjects) -> Quantity:
    """The steps of the derivation that lead to a goal, to be put in order."""
    return Quantity(
        f"order-{goal}",
        "order",
        STATED,
        lambda solution, subject: ordering.value(_true(solution), goal, subject),
        lambda solution: subjects(solution) if is_short(_true(solution)) and not solution.conditions else (),
        "lagrange",
        points=2.0,
        steps=(step,),
        judge=ordering.Ordering(goal),
    )


QUANTITIES: tuple[Quantity, ...] = (
    Quantity(
        "position",
        "vector",
        EXACT,
        lambda solution, body: _vector(solution.position(body)),
        bodies,
        "configuration",
        ("r", "x"),
        steps=("guided-position:{subject}", "position:{subject}"),
    ),
    Quantity(
        "virtual-displacement",
        "vector",
        EXACT,
        lambda solution, body: _vector(solution.virtual_displacement(body)),
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
        lambda solution, q: (solution.generalized_force(q),),
        lambda solution: solution.free if solution.load_names else (),
        "virtual-work",
        ("Q",),
        ("virtual-work",),
        steps=("generalized-forces",),
    ),
    Quantity(
        "kinetic-energy",
        "expression",
        EXACT,
        lambda solution, _: (solution.kinetic_energy,),
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
        lambda solution, _: (solution.potential_energy,),
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
        lambda solution, _: (solution.lagrangian,),
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
        lambda solution, q: (solution.momentum(q),),
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
        lambda solution, q: (solution.equation(q),),
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
        lambda solution, _: tuple(map(solution.equation, solution.free)),
        coupled,
        "lagrange",
        (),
        ("lagrangian", "kinetic-energy", "potential-energy", "equation"),
        4.0,
        steps=("matrix-form",),
    ),
    Quantity(
        "constraint-force",
        "expression",
        KEPT,
        lambda solution, name: (solution.constraint_force(name),),
        reacting,
        "constraints",
        ("lambda", "λ", "S", "N", "Z"),
        ("equation",),
        2.0,
        steps=("multiplier:{subject}", "work-of-reaction:{subject}"),
    ),
    Quantity(
        "rest-reaction",
        "expression",
        EXACT,
        lambda solution, name: (solution.rest_reaction(name),),
        carrying,
        "model",
        ("lambda", "λ", "S", "N", "Z"),
        ("equation", "equilibria"),
        steps=("equilibrium:1",),
    ),
    Quantity(
        "impulse",
        "expression",
        WHERE_KEPT,
        lambda solution, contact: (solution.impact_impulse(contact),),
        lambda solution: solution.bounces,
        "contact",
        ("Lambda", "Λ", "P"),
        ("kinetic-energy", "momentum"),
        2.0,
        steps=("impact-law:{subject}",),
    ),
    Quantity(
        "momentum-behind",
        "expression",
        WHERE_KEPT,
        lambda solution, name: (solution.momentum_behind(contact_of(_true(solution), name), coordinate_of(name)),),
        struck,
        "contact",
        ("p",),
        ("momentum", "impulse"),
        2.0,
        steps=("impact-law:{contact}",),
    ),
    Quantity(
        "impact-loss",
        "expression",
        WHERE_KEPT,
        lambda solution, contact: (solution.impact_loss(contact),),
        lambda solution: solution.bounces,
        "contact",
        ("DeltaE", "ΔE"),
        ("kinetic-energy", "impulse"),
        2.0,
        steps=("impact-law:{subject}",),
    ),
    Quantity(
        "linearized",
        "equation",
        ONE,
        lambda solution, q: (solution.linear_equation(q),),
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
        lambda solution, _: solution.frequencies,
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
    Quantity(
        "equilibria",
        "positions",
        STATED,
        lambda solution, _: positions.value(_true(solution)),
        lambda solution: ("",) if positions.asked(_true(solution)) else (),
        "model",
        needs=("equation", "potential-energy"),
        points=2.0,
        steps=("equilibrium:1", "equilibrium-condition"),
        judge=positions.Positions(),
    ),
    Quantity(
        "stability",
        "stability",
        STATED,
        lambda solution, number: stability.value(_true(solution), number),
        lambda solution: stability.asked(_true(solution)),
        "model",
        needs=("equilibria", "potential-energy"),
        steps=("stability-condition:{subject}", "equilibrium:{subject}"),
        judge=stability.Stability(),
    ),
    Quantity(
        "symmetry",
        "expression",
        MADE_OF,
        lambda solution, number: (_true(solution).symmetries[number].value,),
        symmetric,
        "model",
        ("I", "p", "Q", "C"),
        ("lagrangian", "conserved"),
        2.0,
        steps=("noether:{subject}",),
    ),
    Quantity(
        "steady-motion",
        "rate",
        STATED,
        lambda solution, turning: steady.value(_true(solution), turning),
        lambda solution: steady.asked(_true(solution)),
        "model",
        needs=("lagrangian", "conserved"),
        points=2.0,
        steps=("relative-equilibrium:1", "routh-function"),
        judge=steady.Steady(),
    ),
    _ordering(LAGRANGIAN, "lagrangian", whole),
    _ordering(EQUATION, "equation:{subject}", lambda solution: solution.free[:1]),
)


def quantity_of(kind: str) -> Quantity | None:
    """The quantity of a task of this kind, if there is one."""
    return next((quantity for quantity in QUANTITIES if quantity.kind == kind), None)
