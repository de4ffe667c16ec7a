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
from . import general_lagrange as lagrange
from . import general_variations as variations
from .abstract_motion import MOVING, AbstractMotion, arbitrary, sample
from .carrying_out import GeneralAlgebra
from .grounds import Grounds
from .points import Point
from .step import Chapter, Derivation, Step
from .verification import POINTS, SAMPLED, verified_step

PROOF = "dalembert-lagrange"
Rule = Callable[[AbstractMotion], Step]
CHAPTERS: Mapping[str, tuple[Rule, ...]] = {
    "directional-derivative": (
        variations.configuration,
        variations.difference_quotient,
        variations.directional_derivative,
    ),
    "first-variation": (
        variations.gateaux_definition,
        variations.identity_functional,
        variations.chain_rule_of_direction,
        variations.chain_rule_of_variation,
        variations.variation_of_position,
    ),
    "generalized-forces": (variations.definition_of_generalized_force, variations.single_force, variations.free_moment),
    "dalembert-principle": (lagrange.dalembert_principle,),
    "integrand": (
        lagrange.product_rule,
        lagrange.cancellation,
        lagrange.exchange,
        lagrange.integrand,
    ),
    "lagrange-second-kind": (lagrange.integral, lagrange.lagrange_equation),
    "lagrange-function": (lagrange.decomposition, lagrange.lagrange_function),
}


def prove(chapters: Mapping[str, tuple[Rule, ...]] = CHAPTERS) -> Derivation:
    """The proof with every step verified."""
    general, concrete, algebra, points = arbitrary(), sample(), GeneralAlgebra(), _points()

    def proved(rule: Rule) -> Step:
        step = rule(general)
        sound = all(map(algebra.holds, step.relations)) and verified_step(rule(concrete), points).verified
        return replace(step, verified=sound)

    told = tuple(starmap(Chapter, ((name, tuple(map(proved, rules))) for name, rules in chapters.items())))
    return Grounds(algebra, algebra.holds, SAMPLED).of(Derivation(PROOF, told))


def _points(seed: int = 1) -> tuple[Point, ...]:
    """Exact dyadic values between 1/4 and 7/4 for all symbols of the proof."""
    source = random.Random(seed)
    moving = [spell_rate(name, n) for name in MOVING for n in range(3)]
    others = ("t", "t_0", "P", "h", "X", "V", "a", "phi", "F_x", "F_y", "F_z")
    varied = [f"delta({name})" for name in ("q_1", "q_2", "x", "y", "z", "phi")]
    names = (*moving, *others, *varied)
    return tuple({name: arb(source.randint(2**20, 7 * 2**20)) / 2**22 for name in names} for _ in range(POINTS))
