"""The general proof: from d'Alembert's principle to Lagrange's equations of the second kind, for any r(P, t, q).

Every line is carried out twice: by computer algebra on functions of which nothing is known, and as numbers on a sample
of concrete functions, where no derivative is taken symbolically. It counts as verified if both agree.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import starmap

from flint import arb

from ..language.spelling import spell_rate
from .abstract_motion import MOVING, AbstractMotion, arbitrary, sample
from .carrying_out import GeneralAlgebra
from .points import Point
from .rules import (
    chain_rule_of_direction,
    chain_rule_of_variation,
    dalembert_principle,
    definition_of_generalized_force,
    difference_quotient,
    directional_derivative,
    free_moment,
    gateaux_definition,
    general_cancellation,
    general_decomposition,
    general_exchange,
    general_integral,
    general_integrand,
    general_lagrange_equation,
    general_lagrange_function,
    general_motion,
    general_product_rule,
    identity_functional,
    single_force,
    variation_of_position,
)
from .step import Chapter, Derivation, Step
from .verification import POINTS, verified_step

PROOF = "dalembert-lagrange"
Rule = Callable[[AbstractMotion], Step]
CHAPTERS: Mapping[str, tuple[Rule, ...]] = {
    "directional-derivative": (general_motion.apply, difference_quotient.apply, directional_derivative.apply),
    "first-variation": (
        gateaux_definition.apply,
        identity_functional.apply,
        chain_rule_of_direction.apply,
        chain_rule_of_variation.apply,
        variation_of_position.apply,
    ),
    "generalized-forces": (definition_of_generalized_force.apply, single_force.apply, free_moment.apply),
    "dalembert-principle": (dalembert_principle.apply,),
    "integrand": (
        general_product_rule.apply,
        general_cancellation.apply,
        general_exchange.apply,
        general_integrand.apply,
    ),
    "lagrange-second-kind": (general_integral.apply, general_lagrange_equation.apply),
    "lagrange-function": (general_decomposition.apply, general_lagrange_function.apply),
}


def prove(chapters: Mapping[str, tuple[Rule, ...]] = CHAPTERS) -> Derivation:
    """The proof with every step verified."""
    general, concrete, algebra, points = arbitrary(), sample(), GeneralAlgebra(), _points()

    def proved(rule: Rule) -> Step:
        step = rule(general)
        sound = all(map(algebra.holds, step.relations)) and verified_step(rule(concrete), points).verified
        return replace(step, verified=sound)

    return Derivation(
        PROOF, tuple(starmap(Chapter, ((name, tuple(map(proved, rules))) for name, rules in chapters.items())))
    )


def _points(seed: int = 1) -> tuple[Point, ...]:
    """Exact dyadic values between 1/4 and 7/4 for all symbols of the proof."""
    source = random.Random(seed)
    moving = [spell_rate(name, n) for name in MOVING for n in range(3)]
    others = ("t", "t_0", "P", "h", "X", "V", "a", "phi", "F_x", "F_y", "F_z")
    varied = [f"delta({name})" for name in ("q_1", "q_2", "x", "y", "z", "phi")]
    names = (*moving, *others, *varied)
    return tuple({name: arb(source.randint(2**20, 7 * 2**20)) / 2**22 for name in names} for _ in range(POINTS))
