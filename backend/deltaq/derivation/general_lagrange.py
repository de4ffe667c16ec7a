"""The proof from d'Alembert's principle to Lagrange's equations of the second kind, for any motion r(P, t, q).

Each function is a step: its docstring states the law and its source.
"""

from __future__ import annotations

from .abstract_motion import AbstractMotion, q, rate, summed, variation
from .formula import (
    Called,
    Dot,
    Equation,
    Explicit,
    Formula,
    Named,
    Partial,
    Plus,
    Quantity,
    Rate,
    Summed,
    Term,
    Times,
    minus,
)
from .general_quantities import (
    ZERO,
    T,
    acceleration,
    by_mass,
    displacement,
    dissipative_force,
    for_each,
    generalized_force,
    half_square,
    inertia,
    kinetic_energy,
    lagrange_expression,
    lagrangian,
    lever,
    position,
    potential_energy,
    times_variation,
    velocity,
)
from .step import Relation, Step


def dalembert_principle(motion: AbstractMotion) -> Step:
    """d'Alembert's principle: δW_Mb = δW_a + δW_i for all virtual displacements; rigid bodies have δW_i = 0.

    Here δW_Mb = ∫ δr · dv/dt dm. The δqᵢ are independent, so the factors of each δqᵢ are equal.
    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.45.
    """
    inner = Called(Quantity("inner-virtual-work"), ZERO)
    inert = Called(Quantity("work-of-inertia"), by_mass(motion, Dot(displacement(motion), acceleration(motion))))
    outer = Called(Quantity("virtual-work"), _outer(motion))
    collected = summed(lambda i: times_variation(inertia(motion, i), i), "i")
    lines = (
        Relation((inner, ZERO)),
        Relation((inert, inert.of, collected)),
        Relation((Equation(inert, Plus((Term(outer), Term(inner)))), Equation(collected, _outer(motion))), "⇔"),
        for_each(
            lambda i: Equation(Partial(inert, variation(i)), Partial(outer, variation(i))),
            lambda i: Equation(inertia(motion, i), generalized_force(motion, i)),
            sign="⇔",
        ),
    )
    return Step("dalembert-principle", "", lines)


def _outer(motion: AbstractMotion) -> Summed:
    """Qᵢ δqᵢ"""
    return summed(lambda i: times_variation(generalized_force(motion, i), i), "i")


def product_rule(motion: AbstractMotion) -> Step:
    """Product rule: ∂r/∂qᵢ · dv/dt = d/dt (∂r/∂qᵢ · v) − d/dt (∂r/∂qᵢ) · v.

    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4.
    """
    v = velocity(motion)
    line = for_each(
        lambda i: Dot(lever(motion, i), acceleration(motion)),
        lambda i: Plus((Term(Rate(Dot(lever(motion, i), v))), minus(Dot(Rate(lever(motion, i)), v)))),
    )
    return Step("general-product-rule", "", (line,))


def cancellation(motion: AbstractMotion) -> Step:
    """Cancellation of the dots: v = dr/dt = ∂r/∂qₖ q̇ₖ + ∂r/∂t is affine in the rates, so ∂v/∂q̇ᵢ = ∂r/∂qᵢ.

    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.51.
    """
    r, v = position(motion), velocity(motion)
    along = summed(lambda k: Times((lever(motion, k), Explicit(rate(k)))))
    lines = (
        Relation((v, Rate(r), Plus((Term(along), Term(Partial(r, T), (), 1, "time-term"))))),
        for_each(lambda i: Partial(v, rate(i)), lambda i: lever(motion, i)),
    )
    return Step("general-cancellation", "", lines)


def exchange(motion: AbstractMotion) -> Step:
    """Exchange of derivatives: d/dt (∂r/∂qᵢ) = ∂/∂qᵢ (dr/dt) = ∂v/∂qᵢ, as mixed partial derivatives are equal.

    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4 (Schwarz's theorem).
    """
    line = for_each(
        lambda i: Rate(lever(motion, i)),
        lambda i: Partial(Rate(position(motion)), q(i)),
        lambda i: Partial(velocity(motion), q(i)),
    )
    return Step("general-exchange", "", (line,))


def integrand(motion: AbstractMotion) -> Step:
    """The integrand as kinetic energy: ∂r/∂qᵢ · dv/dt = d/dt ∂/∂q̇ᵢ (v · v/2) − ∂/∂qᵢ (v · v/2).

    The three rules before, put together; then ∂/∂q̇ (v · v/2) = ∂v/∂q̇ · v, and likewise for q.
    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.4.
    """
    line = for_each(
        lambda i: Dot(lever(motion, i), acceleration(motion)),
        lambda i: _by_velocities(motion, i),
        lambda i: lagrange_expression(half_square(motion), i),
    )
    return Step("general-integrand", "", (line,))


def _by_velocities(motion: AbstractMotion, index: str) -> Formula:
    """d/dt (∂v/∂q̇ᵢ · v) − ∂v/∂qᵢ · v"""
    v = velocity(motion)
    first = Rate(Dot(Partial(v, rate(index)), v))
    return Plus((Term(first), minus(Dot(Partial(v, q(index)), v))))


def integral(motion: AbstractMotion) -> Step:
    """Exchange of integral and derivative: the body does not depend on t and qᵢ, so ∫ ∂/∂q (v · v/2) dm = ∂E/∂q.

    Source: the lecture; Forster, Analysis 3, §11 (differentiation under the integral).
    """
    energy, half = kinetic_energy(motion), half_square(motion)
    lines = (
        for_each(
            lambda i: inertia(motion, i),
            lambda i: Plus(
                (
                    Term(Rate(by_mass(motion, Partial(half, rate(i))))),
                    minus(by_mass(motion, Partial(half, q(i)))),
                )
            ),
            lambda i: lagrange_expression(by_mass(motion, half), i),
            lambda i: lagrange_expression(energy, i),
        ),
        Relation((energy, energy.of)),
    )
    return Step("general-integral", "", lines)


def lagrange_equation(motion: AbstractMotion) -> Step:
    """Lagrange's equations of the second kind: d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ = Qᵢ for i = 1 … f.

    Source: Lagrange, Mécanique analytique (1788); the lecture.
    """
    line = for_each(
        lambda i: Equation(inertia(motion, i), generalized_force(motion, i)),
        lambda i: Equation(lagrange_expression(kinetic_energy(motion), i), generalized_force(motion, i)),
        sign="⇔",
    )
    return Step("general-lagrange-equation", "", (line,))


def decomposition(motion: AbstractMotion) -> Step:
    """Decomposition: Qᵢ = Qᵢᵖ + Qᵢᵈ with Qᵢᵖ = −∂V/∂qᵢ, so d/dt ∂E/∂q̇ᵢ − ∂E/∂qᵢ + ∂V/∂qᵢ = Qᵢᵈ.

    Source: the lecture; Szabó, Höhere Technische Mechanik, §I.6.
    """
    energy = kinetic_energy(motion)
    lines = (
        for_each(
            lambda i: generalized_force(motion, i),
            lambda i: Plus((Term(_conservative(motion, i)), Term(dissipative_force(motion, i)))),
        ),
        for_each(lambda i: _conservative(motion, i), lambda i: Plus((minus(_slope(motion, i)),))),
        for_each(
            lambda i: Equation(lagrange_expression(energy, i), generalized_force(motion, i)),
            lambda i: Equation(
                Plus((*lagrange_expression(energy, i).terms, Term(_slope(motion, i)))), dissipative_force(motion, i)
            ),
            sign="⇔",
        ),
    )
    return Step("general-decomposition", "", lines)


def _conservative(motion: AbstractMotion, index: str) -> Named:
    """Qᵢᵖ"""
    return Named(Quantity("conservative-force", index), -motion.potential.diff(q(index)))


def _slope(motion: AbstractMotion, index: str) -> Formula:
    """∂V/∂qᵢ"""
    return Partial(potential_energy(motion), q(index))


def lagrange_function(motion: AbstractMotion) -> Step:
    """Lagrange function: with L = E − V, d/dt ∂L/∂q̇ᵢ − ∂L/∂qᵢ = Qᵢᵈ, since ∂V/∂q̇ᵢ = 0.

    Source: Lagrange, Mécanique analytique (1788); the lecture.
    """
    energy, potential, function = kinetic_energy(motion), potential_energy(motion), lagrangian(motion)
    lines = (
        Relation((function, function.of)),
        for_each(lambda i: Partial(potential, rate(i)), lambda _: ZERO),
        for_each(lambda i: Partial(function, rate(i)), lambda i: Partial(energy, rate(i))),
        for_each(
            lambda i: Equation(
                Plus((*lagrange_expression(energy, i).terms, Term(Partial(potential, q(i))))),
                dissipative_force(motion, i),
            ),
            lambda i: Equation(lagrange_expression(function, i), dissipative_force(motion, i)),
            sign="⇔",
        ),
    )
    return Step("general-lagrange-function", "", lines)
