"""The proof up to the generalized forces: directional derivative, first variation, virtual displacement and work.

Each function is a step: its docstring states the law and its source.
"""

from __future__ import annotations

import sympy as sp

from ..language.spelling import spell_rate
from .abstract_motion import FREEDOM, T0, AbstractMotion, each, q, summed, symbol, variation
from .calculus import column
from .formula import (
    AtTime,
    Called,
    Directional,
    Dot,
    Explicit,
    LimitOfQuotient,
    Named,
    Partial,
    Plus,
    Quantity,
    Summed,
    Term,
    Times,
)
from .general_quantities import (
    ALONG,
    VECTOR,
    H,
    T,
    V,
    X,
    displacement,
    displacement_by_coordinates,
    for_each,
    lever,
    position,
    times_variation,
    work_by_region,
)
from .step import Relation, Step

# Numbers need the rates as well: a function is known at t₀ from its value and rates at t.
JETS = {symbol(spell_rate("x", n)): symbol(spell_rate("v", n)) for n in range(3)}
AXES = ("x", "y", "z")
FORCES = tuple(symbol(f"F_{axis}") for axis in AXES)
DISPLACEMENTS = tuple(symbol(f"delta({axis})") for axis in AXES)
RADIUS, ANGLE, TURN = symbol("a"), symbol("phi"), symbol("delta(phi)")
FX, FY = symbol("F_x"), symbol("F_y")


def configuration(motion: AbstractMotion) -> Step:
    """Configuration: every particle's position is a function of particle, time and coordinates, r = r(P, t, qᵢ).

    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.38.
    """
    named = position(motion)
    lines = (
        Relation((Named(named.quantity, named.value), named)),
        for_each(lambda i: Explicit(q(i)), lambda i: Named(Quantity("coordinate", i), q(i), (T,))),
    )
    return Step("general-motion", "", lines)


def difference_quotient(motion: AbstractMotion) -> Step:
    """Ordinary derivative: df/dx = lim (f(x + h) − f(x))/h.

    For vectors there is no such number: it depends on the direction of h.
    One variable; then two unit vectors that give two limits.
    Source: the lecture; Forster, Analysis 2, §6.
    """
    scalar = Named(Quantity("function-of-vector"), motion.function(X), (X,))
    vector = Named(Quantity("function-of-vector"), motion.function(*VECTOR))
    unit = [{x: sp.Integer(int(x == chosen)) for x in VECTOR} for chosen in list(VECTOR)[:2]]
    limits = [
        Called(Quantity("limit-along", str(n)), LimitOfQuotient(vector, along, H)) for n, along in enumerate(unit, 1)
    ]
    ordinary = Called(Quantity("ordinary-derivative"), Partial(scalar, X))
    limit = Called(Quantity("ordinary-limit"), LimitOfQuotient(scalar, {X: sp.Integer(1)}, H))
    return Step("difference-quotient", "", (Relation((ordinary, limit)), Relation((limits[0], limits[1]), "≠")))


def directional_derivative(motion: AbstractMotion) -> Step:
    """Directional derivative: D_v f(x) = lim (f(x + h v) − f(x))/h = ∂/∂h f(x + h v) at h = 0.

    Source: the lecture; Forster, Analysis 2, §6.
    """
    field = field_of(motion)
    members = (derivative(motion), LimitOfQuotient(field, ALONG, H), Directional(field, ALONG, H))
    return Step("directional-derivative", "", (Relation(members),))


def field_of(motion: AbstractMotion) -> Named:
    """f(x) of a vector x"""
    return Named(Quantity("function-of-vector"), motion.function(*VECTOR), (symbol("X"),))


def derivative(motion: AbstractMotion) -> Called:
    """D_v f(x)"""
    return Called(Quantity("directional-derivative"), by_chain_rule(motion))


def by_chain_rule(motion: AbstractMotion) -> Summed:
    """∂f/∂xᵢ vᵢ"""
    return summed(
        lambda i: Times((Partial(field_of(motion), symbol(f"x_{i}")), Explicit(symbol(f"v_{i}")))), "i", len(VECTOR)
    )


def gateaux_definition(motion: AbstractMotion) -> Step:
    """First variation: δ_v f(x) = ∂/∂h f(x(t) + h v(t)) at h = 0.

    It is the Gâteaux differential of f at the function x in the direction of the function v.
    Source: the lecture; Gelfand, Fomin, Calculus of Variations, §3.
    """
    of = Named(Quantity("function-of-function"), motion.function(X), (X,))
    slope = Times((Partial(of, X), Explicit(V)))
    members = (Called(Quantity("first-variation"), slope), Directional(of, {X: V}, H))
    return Step("gateaux-definition", "", (Relation(members),))


def identity_functional(_motion: AbstractMotion) -> Step:
    """Identity functional: I(x) = x(t₀). Its first variation is the direction itself, v(t₀); hence the notation δx = v.

    Source: the lecture's example of the first variation.
    """
    value, moved = AtTime(Explicit(X), T0), AtTime(Explicit(V), T0)
    whole = Called(Quantity("identity-functional"), value, (X,))
    lines = (
        Relation((whole, value)),
        Relation(
            (
                Called(Quantity("variation-of-identity"), moved),
                Directional(whole, JETS, H),
                Directional(value, JETS, H),
                moved,
            )
        ),
        Relation((Called(Quantity("variation-of-function"), Explicit(V)), Explicit(V))),
    )
    return Step("identity-functional", "", lines)


def chain_rule_of_direction(motion: AbstractMotion) -> Step:
    """Chain rule: the directional derivative is the gradient times the direction, D_v f = grad f · v = ∂f/∂xᵢ vᵢ.

    Source: the lecture; Forster, Analysis 2, §6, Satz 5.
    """
    field = field_of(motion)
    gradient = Named(Quantity("gradient"), column(field.value.diff(x) for x in VECTOR))
    along = Named(Quantity("direction"), column(VECTOR.values()))
    members = (derivative(motion), Directional(field, ALONG, H), Dot(gradient, along), by_chain_rule(motion))
    return Step("chain-rule-of-direction", "", (Relation(members),))


def chain_rule_of_variation(motion: AbstractMotion) -> Step:
    """Chain rule of the first variation: δf(x(t)) = ∂f/∂xᵢ δxᵢ(t).

    Independent xᵢ have independent δxᵢ: coefficients may be compared.
    Source: the lecture; Lanczos, The Variational Principles of Mechanics, ch. II.
    """
    field = Named(Quantity("function-of-functions"), motion.function(*VECTOR), (symbol("X"),))
    total = _chain(field, "direction-component")
    variation = Called(Quantity("variation-of-field"), total)
    lines = (
        Relation((Called(Quantity("variation-of-field-along"), total), Directional(field, ALONG, H), total)),
        Relation((variation, _chain(field, "variation-component"))),
        Relation(
            (
                each(lambda i: Called(Quantity("coefficient", i), Partial(total, symbol(f"v_{i}"))), len(VECTOR)),
                each(lambda i: Partial(field, symbol(f"x_{i}")), len(VECTOR)),
            )
        ),
    )
    return Step("chain-rule-of-variation", "", lines)


def _chain(field: Named, component: str) -> Summed:
    """∂f/∂xᵢ vᵢ, with vᵢ(t) or δxᵢ(t) for the direction."""

    def term(i: str) -> Times:
        slope = Called(Quantity("slope-along", i), Partial(field, symbol(f"x_{i}")))
        return Times((slope, Named(Quantity(component, i), symbol(f"v_{i}"))))

    return summed(term, "i", len(VECTOR))


def variation_of_position(motion: AbstractMotion) -> Step:
    """Virtual displacement in general: δr = ∂r/∂qᵢ δqᵢ, the time held fixed.

    Source: the lecture; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., eq. 1.47.
    """
    along = {q(i): variation(i) for i in (*map(str, range(1, FREEDOM + 1)), "i")}
    return Step(
        "variation-of-position",
        "",
        (
            Relation(
                (displacement(motion), Directional(position(motion), along, H), displacement_by_coordinates(motion))
            ),
        ),
    )


def definition_of_generalized_force(motion: AbstractMotion) -> Step:
    """Generalized forces: δW_a = Qᵢ δqᵢ with Qᵢ = ∫ ∂r/∂qᵢ · f_S dS + ∫ ∂r/∂qᵢ · f_V dV over surface and volume.

    Source: the lecture's definition of Qᵢ.
    """
    work = Called(Quantity("virtual-work"), work_by_region(motion, displacement(motion)))

    def force(i: str) -> Called:
        return Called(Quantity("generalized-force", i), work_by_region(motion, lever(motion, i)))

    lines = (
        Relation(
            (
                work,
                work.of,
                summed(lambda i: times_variation(work_by_region(motion, lever(motion, i)), i), "i"),
                summed(lambda i: times_variation(force(i), i), "i"),
            )
        ),
        for_each(force, lambda i: Partial(work, variation(i)), lambda i: work_by_region(motion, lever(motion, i))),
    )
    return Step("definition-of-generalized-force", "", lines)


def single_force(_motion: AbstractMotion) -> Step:
    """Single force, Cartesian coordinates: δW = F · δr = F_x δx + F_y δy + F_z δz, so Q_x = F_x and likewise for y, z.

    Source: the lecture's first example of generalized forces.
    """
    force = Named(Quantity("force"), column(FORCES))
    displacement = Named(Quantity("virtual-displacement"), column(DISPLACEMENTS))
    pairs = zip(AXES, FORCES, DISPLACEMENTS, strict=True)
    written = Plus(
        tuple(Term(Times((Explicit(f), Named(Quantity("variation-along-axis", axis), d)))) for axis, f, d in pairs)
    )
    work = Called(Quantity("virtual-work"), Dot(force, displacement))
    lines = (
        Relation((force, Explicit(force.value))),
        Relation((work, Dot(force, displacement), written)),
        *(_force(work, axis, f, d) for axis, f, d in zip(AXES, FORCES, DISPLACEMENTS, strict=True)),
    )
    return Step("single-force", "", lines)


def _force(work: Called, axis: str, force: sp.Symbol, displacement: sp.Symbol) -> Relation:
    """The coefficient of δx is Q_x."""
    return Relation((Called(Quantity("generalized-force", axis), Partial(work, displacement)), Explicit(force)))


def free_moment(_motion: AbstractMotion) -> Step:
    """Free moment in the plane: forces that turn a body by δφ do the work δW = M δφ, with M = x F_y − y F_x; so Q = M.

    A particle of the body at the distance a from the axis; the moments of all particles add up.
    Source: the lecture's second example of generalized forces.
    """
    x, y = RADIUS * sp.cos(ANGLE), RADIUS * sp.sin(ANGLE)
    arm = Partial(Named(Quantity("position"), column((x, y))), ANGLE)
    force = Named(Quantity("force"), column((FX, FY)))
    moment = Called(Quantity("moment"), Explicit(x * FY - y * FX))
    work = Called(Quantity("virtual-work"), Times((Dot(force, arm), Explicit(TURN))))
    lines = (
        Relation((Dot(force, arm), Dot(force, Explicit(column((-y, x)))), moment)),
        Relation((work, work.of, Times((moment, Explicit(TURN))))),
        Relation((Called(Quantity("only-generalized-force"), Partial(work, TURN)), moment)),
    )
    return Step("free-moment", "", lines)
