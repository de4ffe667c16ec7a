"""Stability where all second derivatives of the potential vanish: by the form of lowest degree, V − V₀ = V_d + ….

If V_d is positive everywhere but at the origin, V has a strict minimum (Lagrange, Dirichlet). If V_d is negative
somewhere, the equilibrium is unstable, with or without dissipation: in the region where the energy is below V₀ and q·p
is positive, q·p grows, as its rate is 2 E_kin − q·∂V/∂q = 2 E_kin − d V_d + … (Chetaev). Where V_d is only not
negative, the next degrees decide, which are not looked at.
The sign is decided on the surface of a cube by subdivision, in ball arithmetic.
Source: Kozlov, Palamodov, Soviet Math. Dokl. 25 (1982), 335; Merkin, Introduction to the Theory of Stability, §3.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations_with_replacement, product

import sympy as sp
from flint import arb

from ..language.derivatives import diff
from .program import number

MOST_COORDINATES = 3
HIGHEST = 6  # degree of the form
NOTHING = arb(2) ** -200  # of the terms of a derivative, where the equilibrium is known to more than 400 bits
MOST_BOXES = 4000
KINKS = (sp.DiracDelta, sp.sign, sp.Heaviside, sp.Abs, sp.Max, sp.Min, sp.Derivative)
ENDS = (arb(-1), arb(1))

Form = Mapping[tuple[int, ...], arb]  # coefficients by exponents
Box = tuple[arb, ...]


def leading_form(forces: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], point: Mapping[str, arb]) -> Form | None:
    """V_d at the point, from the forces −∂V/∂q: V_d = −Σ xᵢ Fᵢ/d. None where there is none up to the highest degree."""
    if len(unknowns) > MOST_COORDINATES:
        return None
    known: dict[tuple[int, tuple[int, ...]], sp.Expr] = {(i, ()): force for i, force in enumerate(forces)}
    for degree in range(2, HIGHEST + 1):
        ways = list(combinations_with_replacement(range(len(unknowns)), degree - 1))
        known |= {(i, way): diff(known[i, way[:-1]], unknowns[way[-1]]) for i in range(len(forces)) for way in ways}
        slopes = {(i, way): _value(known[i, way], point) for i in range(len(forces)) for way in ways}
        if not all(value is not None and value.is_finite() for value in slopes.values()):
            return None
        present = {key: value for key, value in slopes.items() if value is not None and value != 0}
        if present:
            return _form(present, len(unknowns), degree)
    return None


def _value(slope: sp.Expr, point: Mapping[str, arb]) -> arb | None:
    """The number, 0 where it is rounding; None for what jumps."""
    if slope.has(*KINKS):
        return None
    value = number(slope, dict(point))
    size = sum((abs(number(term, dict(point))) for term in sp.Add.make_args(slope)), arb(0))
    return value if bool(abs(value) > NOTHING * size) or not value.is_finite() else arb(0)


def _form(slopes: Mapping[tuple[int, tuple[int, ...]], arb], size: int, degree: int) -> Form:
    found: dict[tuple[int, ...], arb] = {}
    for (i, way), value in slopes.items():
        powers = [way.count(k) for k in range(size)]
        part = -value / degree / math.prod(map(math.factorial, powers))
        powers[i] += 1
        found[tuple(powers)] = found.get(tuple(powers), arb(0)) + part
    return found


def sign_of(form: Form) -> int | None:
    """−1 if the form is negative somewhere, 1 if it is positive but at the origin; None if neither can be told."""
    size = len(next(iter(form)))
    boxes = list(_faces(size))
    for _ in range(MOST_BOXES):
        if not boxes:
            return 1
        box = boxes.pop()
        if bool(_over(form, tuple(side.mid() for side in box)) < 0):
            return -1
        if not bool(_over(form, box) > 0):
            boxes[:0] = _halves(box)  # widest first
    return None


def _faces(size: int) -> Iterator[Box]:
    """The surface of the cube from −1 to 1."""
    whole = arb(0, 1)
    for axis, end in product(range(size), ENDS):
        yield tuple(end if k == axis else whole for k in range(size))


def _halves(box: Box) -> list[Box]:
    axis = max(range(len(box)), key=lambda k: float(box[k].rad()))
    middle, radius = box[axis].mid(), box[axis].rad() / 2
    return [(*box[:axis], arb(centre, radius), *box[axis + 1 :]) for centre in (middle - radius, middle + radius)]


def _over(form: Form, box: Box) -> arb:
    """An enclosure of the values."""
    parts = (c * math.prod(map(_power, box, powers), start=arb(1)) for powers, c in form.items())
    return sum(parts, arb(0))


def _power(side: arb, exponent: int) -> arb:
    return (abs(side) if exponent % 2 == 0 else side) ** exponent
