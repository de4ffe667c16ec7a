"""Complex mode shapes: (λₖ²M₀ + λₖD₀ + K₀) aₖ = 0 with aₖ = uₖ + i wₖ and λₖ = −δₖ + iωₖ.

Its real and imaginary parts are P u − R w = 0 and P w + R u = 0 with P = (δ² − ω²)M₀ − δD₀ + K₀, R = −2δω M₀ + ωD₀. The
motion is x = e^−δt (u cos ωt − w sin ωt): unless w = 0, the parts of a mode are not in phase.
Source: Meirovitch, Methods of Analytical Dynamics, §6.6; Tisseur, Meerbergen, SIAM Review 43 (2001), 235.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..formula import Explicit, Formula, Inserted, MatrixTimes, Named, Plus, Quantity, Rounded, Term, Times, minus
from ..linearization import Linearization
from ..spectrum import ComplexMode, Spectrum
from ..step import Relation, Step
from ..system import System
from ._roots import Root, roots_of
from ._shape import matrices, numbers, premises, zero

RULE = "complex-mode-shapes"


def apply(system: System, linear: Linearization, spectrum: Spectrum, number: int) -> Step:
    """The law and the shape of each mode, at the scene's values."""
    roots = {root.eigenvalue: root for root in roots_of(system, spectrum)}
    lines = (
        line
        for index, mode in enumerate(spectrum.complex_modes, 1)
        for line in _lines(system, linear, mode, roots[mode.eigenvalue], index)
    )
    return Step(RULE, str(number), tuple(lines), (), {"number": str(number)}, premises=premises(linear, number))


def _lines(system: System, linear: Linearization, mode: ComplexMode, root: Root, index: int) -> Iterator[Relation]:
    real, imaginary = _law(linear, root)
    if len(root.symbols) == 1:
        shape = _part("mode", index, mode.real)
        yield Relation((_there(system, root, MatrixTimes(real, shape)), zero(linear.mass.rows)))
        yield Relation((shape, Rounded(shape.value)), "≈")
        return
    u, w = _part("mode-real", index, mode.real), _part("mode-imaginary", index, mode.imaginary)
    first = Plus((Term(MatrixTimes(real, u)), minus(MatrixTimes(imaginary, w))))
    second = Plus((Term(MatrixTimes(real, w)), Term(MatrixTimes(imaginary, u))))
    yield from (Relation((_there(system, root, law), zero(linear.mass.rows))) for law in (first, second))
    yield from (Relation((part, Rounded(part.value)), "≈") for part in (u, w))


def _part(kind: str, index: int, values: tuple[sp.Rational, ...]) -> Named:
    return Named(Quantity(kind, str(index)), sp.ImmutableMatrix([[value] for value in values]))


def _there(system: System, root: Root, law: Formula) -> Inserted:
    return Inserted(Inserted(law, root.known), numbers(system))


def _law(linear: Linearization, root: Root) -> tuple[Plus, Plus]:
    """The real and imaginary parts of λ²M₀ + λD₀ + K₀."""
    mass, damping, stiffness = matrices(linear)
    dragged = linear.is_damped
    if len(root.symbols) == 1:
        (exponent,) = root.symbols
        drag = (Term(Times((Explicit(exponent), damping))),) if dragged else ()
        return Plus((Term(Times((Explicit(exponent**2), mass))), *drag, Term(stiffness))), Plus(())
    decay, frequency = root.symbols
    held = (minus(Times((Explicit(decay), damping))),) if dragged else ()
    turned = (Term(Times((Explicit(frequency), damping))),) if dragged else ()
    real = Plus((Term(Times((Explicit(decay**2 - frequency**2), mass))), *held, Term(stiffness)))
    return real, Plus((minus(Times((Explicit(2 * decay * frequency), mass))), *turned))
