"""Small motions x = q − q₀ about an equilibrium: M₀ ẍ + D₀ ẋ + K₀ x = 0.

M₀ = M(q₀), D₀ = −∂f/∂q̇ and K₀ = −∂f/∂q at q₀ and at rest; terms with q̈ and ∂M/∂q are small of second order.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.2; Meirovitch, Methods of Analytical Dynamics, §6.4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import sympy as sp
from flint import arb, ctx

from ..language.derivatives import JUMPS, beside_jumps, diff
from ..language.memory import cached_method
from ..vocabulary import Stability
from .bound_equilibria import numbers_at, searched
from .calculus import column
from .equilibria import Equilibrium, start_point
from .evaluation import components
from .friction import Band
from .matrix_form import forces_at_rest, forcing, mass_matrix
from .program import number
from .refinement import rational
from .rest_sets import band_of, range_about
from .spectrum import Spectrum, spectrum
from .stability import Verdict, growth, verdict
from .system import System
from .tangent import Tangent, bound_stiffness, bound_verdict, projected

BITS = 512
UNDEFINED = (sp.nan, sp.zoo, sp.oo, -sp.oo)
SLOW, FALLEN = arb(2) ** -200, arb(2) ** -20  # of the rates; what falls even like a tenth root of them is far below
SWITCHED, MOST_JUMPS = arb(2) ** -200, 6  # what is zero, and how many may change their sign at one place
ORDER: tuple[Stability, ...] = ("stable", "undecided", "unstable")


@dataclass(frozen=True)
class Linearization:
    """The matrices about one equilibrium, in the parameters where it is exact, else in numbers.

    `spectrum` holds the numbers at the scene's parameter values; there is none where M₀ is singular or a force jumps.
    In a `band` dry friction holds the system. With constraints the matrices are those on the `tangent` space of them.
    """

    equilibrium: Equilibrium
    mass: sp.ImmutableMatrix
    damping: sp.ImmutableMatrix
    stiffness: sp.ImmutableMatrix
    spectrum: Spectrum | None
    verdict: Verdict
    is_smooth: bool
    band: Band | None = None
    tangent: Tangent | None = None

    @property
    def is_scalar(self) -> bool:
        """Whether there is one degree of freedom, so that M₀, D₀, K₀ and x are numbers."""
        return bool(self.mass.shape == (1, 1))

    def in_all_coordinates(self, *shapes: Sequence[sp.Expr]) -> tuple[tuple[sp.Expr, ...], ...]:
        """Shapes of a motion as they move all free coordinates: on constraints N a, its largest part 1 again."""
        if self.tangent is None:
            return tuple(map(tuple, shapes))
        wide = [self.tangent.spread * sp.ImmutableMatrix([[part] for part in shape]) for shape in shapes]
        sizes = [sum(part**2 for part in parts) for parts in zip(*wide, strict=True)]
        place = max(range(len(sizes)), key=sizes.__getitem__)
        first, *others = wide
        if not others:
            return (tuple(part / first[place] for part in first),)
        return _turned(first, others[0], place)

    @property
    def stability(self) -> Stability:
        """Whether small disturbances stay small, as far as that is known."""
        return self.verdict.stability

    @property
    def is_damped(self) -> bool:
        """Whether rates enter at all."""
        return any(entry != 0 for entry in self.damping)


def _turned(
    real: sp.ImmutableMatrix, imaginary: sp.ImmutableMatrix, place: int
) -> tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]:
    """A complex shape divided by one of its parts."""
    a, b = real[place], imaginary[place]
    size = a**2 + b**2
    first = tuple((x * a + y * b) / size for x, y in zip(real, imaginary, strict=True))
    return first, tuple((y * a - x * b) / size for x, y in zip(real, imaginary, strict=True))


@cached_method
def damping_at_rest(system: System) -> sp.ImmutableMatrix:
    """−∂f/∂q̇ at q̇ = 0, as a function of q; NaN where f has no slope there."""
    slopes = [[_at_rest(system, -system.slope(f, system.rate(q))) for q in system.free] for f in forcing(system)]
    return system.display(sp.ImmutableMatrix(slopes))


def _at_rest(system: System, slope: sp.Expr) -> sp.Expr:
    """The slope at q̇ = 0. What is 0/0 there is the limit, where that is zero: |v| vₓ has the slope 0 at rest."""
    rest = system.zero_rates
    value = slope.xreplace(rest)
    if not value.has(*UNDEFINED):
        return value
    terms = [(term.xreplace(rest), term) for term in sp.Add.make_args(slope.expand())]
    undefined = [term for value, term in terms if value.has(*UNDEFINED)]
    if not all(_vanishes_at_rest(system, term) for term in undefined):
        return sp.nan
    return sp.Add(*(value for value, _ in terms if not value.has(*UNDEFINED)))


def _vanishes_at_rest(system: System, term: sp.Expr) -> bool:
    """Whether a term falls with the rates, whichever way they tend to zero. A jump's slope is zero beside it only."""
    if term.has(sp.DiracDelta, sp.sign, sp.Heaviside):
        return False
    point = {symbol.name: number(value, {}) for symbol, value in system.parameter_values.items()}
    point |= {c.name: arb(c.value) + arb(1) / 7 for c in system.scene.free}

    def size(rate: arb, direction: int) -> arb:
        rates = {system.rate(q).name: rate * (1 + (direction * (i + 2)) % 7) for i, q in enumerate(system.free)}
        return abs(number(term, point | rates))

    with ctx.workprec(BITS):
        return all(bool(size(SLOW, way) <= FALLEN * size(arb(1), way)) for way in range(1, 7))


@cached_method
def stiffness_at_rest(system: System) -> sp.ImmutableMatrix:
    """−∂f/∂q at q̇ = 0, as a function of q."""
    return sp.ImmutableMatrix([[-diff(f, system.q(q)) for q in system.free] for f in forces_at_rest(system)])


@cached_method
def linearizations(system: System) -> tuple[Linearization, ...]:
    """One for each equilibrium, stable ones first."""
    known = searched(system)
    tried = [_afforded(system, each) for each in (known.found if known else ())]
    found = [each for each in tried if each is not None]
    return tuple(sorted(found, key=lambda each: ORDER.index(each.stability)))


def _afforded(system: System, equilibrium: Equilibrium) -> Linearization | None:
    about = on_constraints if system.conditions else _about
    return system.effort.afford("small-motions", lambda: about(system, equilibrium), None)


def on_constraints(system: System, equilibrium: Equilibrium) -> Linearization:
    """Small motions that keep the constraints."""
    law = projected(system, equilibrium, damping_at_rest(system))
    with ctx.workprec(BITS):
        smooth = all(part.is_finite() for values in law.numbers for part in values)
        smooth = smooth and len(_sides(bound_stiffness(system), numbers_at(system, equilibrium))) == 1
        found = spectrum(*law.numbers, len(law.tangent.independent)) if smooth else None
        judged = bound_verdict(system, equilibrium, law, growth(found) if found else 0)
    return Linearization(equilibrium, *law.shown, found, judged, smooth, tangent=law.tangent)


def _about(system: System, equilibrium: Equilibrium) -> Linearization:
    raw = (mass_matrix(system), damping_at_rest(system), stiffness_at_rest(system))
    with ctx.workprec(BITS):
        point = numeric_point(system, equilibrium)
        mass, damping, stiffness = numbers = [list(components(matrix, point)) for matrix in raw]
        sides = _sides(raw[2], point)
        smooth = all(part.is_finite() for values in numbers for part in values) and len(sides) == 1
        found = spectrum(mass, damping, stiffness, len(system.free)) if smooth else None
        held = range_about(system, equilibrium)
        told = [verdict(system, equilibrium, point, [mass, damping, side], found) for side in sides]
        alike = told[0] if all(each == told[0] for each in told) else Verdict("undecided")
        judged = Verdict("stable", kind="band") if held else alike
        if equilibrium.exact:
            there = (matrix.xreplace(dict(equilibrium.values)) for matrix in raw)
            matrices = [system.display(beside_jumps(matrix) if smooth else matrix) for matrix in there]
        else:
            matrices = [_rational(values, len(system.free)) for values in numbers]
    return Linearization(equilibrium, matrices[0], matrices[1], matrices[2], found, judged, smooth, band_of(held))


def _sides(matrix: sp.ImmutableMatrix, point: Mapping[str, arb]) -> list[list[arb]]:
    """The matrix in numbers, once where it is continuous: V″ of x² step(x) is 2 above x = 0 and 0 below."""
    jumping = [atom for atom in matrix.atoms(*JUMPS) if bool(abs(number(atom.args[0], dict(point))) < SWITCHED)]
    if not jumping or len(jumping) > MOST_JUMPS:
        return [list(components(matrix, point))]
    found: list[list[arb]] = []
    for signs in product((1, -1), repeat=len(jumping)):
        side = {atom: atom.func(sign) for atom, sign in zip(jumping, signs, strict=True)}
        values = list(components(matrix.xreplace(side), point))
        if not any(all(bool(abs(a - b) < SWITCHED) for a, b in zip(values, known, strict=True)) for known in found):
            found.append(values)
    return found


def _rational(values: list[arb], size: int) -> sp.ImmutableMatrix:
    """The numbers, exactly; NaN where a force has no slope."""
    return sp.ImmutableMatrix(size, size, [rational(value) if value.is_finite() else sp.nan for value in values])


def numeric_point(system: System, equilibrium: Equilibrium) -> dict[str, arb]:
    """The equilibrium in numbers; what is free there stands where the scene starts."""
    point = start_point(system)
    return point | {q.name: number(value, point) for q, value in equilibrium.values.items()}


def deviations(system: System, linear: Linearization) -> tuple[sp.ImmutableMatrix, ...]:
    """x, ẋ, ẍ: symbols that are free at the points of the verification stand for them."""
    kinds = (system.variation, system.rate, system.acceleration)
    names = linear.tangent.independent if linear.tangent else system.free
    return tuple(column(kind(q) for q in names) for kind in kinds)
