"""Sums whose terms remember the bodies and loads they come from."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from ..language.canonical import canonical
from .formula import Explicit, Term
from .memory import kept
from .provenance import of_equation
from .system import System


@kept
def terms_by_source(system: System, coordinate: str) -> tuple[Term, ...]:
    """d/dt ∂L/∂q̇ − ∂L/∂q − Qᵈ written out, ordered from accelerations to forces."""
    return terms_of(system, of_equation(system, coordinate))


def terms_of(system: System, shares: Iterable[tuple[str, sp.Expr]]) -> tuple[Term, ...]:
    """The sum of what each source adds, term by term.

    Terms of different sources that are alike are one term with several sources; those that cancel are gone.
    """
    total: dict[sp.Expr, sp.Expr] = {}
    sources: dict[sp.Expr, list[str]] = {}
    for source, share in shares:
        for term in sp.Add.make_args(canonical(share, system.symbols).expand()):
            number, rest = term.as_coeff_Mul()
            total[rest] = total.get(rest, sp.Integer(0)) + number
            sources.setdefault(rest, []).append(source)
    by_origin: dict[tuple[str, ...], sp.Expr] = {}
    for rest, number in total.items():
        origin = tuple(dict.fromkeys(sources[rest]))
        by_origin[origin] = by_origin.get(origin, sp.Integer(0)) + number * rest
    # Fourier terms of one origin may be shorter as products: sin φ sin ωt.
    shown = [
        (origin, *term.as_coeff_Mul())
        for origin, share in by_origin.items()
        for term in sp.Add.make_args(system.display(share).expand())
        if term != 0
    ]
    return tuple(
        Term(Explicit(abs(number) * rest), origin, 1 if number > 0 else -1)
        for origin, number, rest in sorted(shown, key=lambda part: _rank(system, part[2]))
    )


def _rank(system: System, term: sp.Expr) -> tuple[int, str]:
    """Accelerations first, then rates, then the rest; stable within each."""
    symbols = term.free_symbols
    if symbols & {system.acceleration(name) for name in system.coordinates}:
        return 0, sp.default_sort_key(term).__repr__()
    moving = symbols & {system.rate(name) for name in system.coordinates}
    return (1 if moving else 2), ""
