"""The terms of an equation of motion, each with the bodies and loads it comes from."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..language.canonical import canonical
from .formula import Explicit, Term
from .system import System


def terms_by_source(system: System, coordinate: str) -> tuple[Term, ...]:
    """d/dt ∂L/∂q̇ − ∂L/∂q − Qᵈ written out, ordered from accelerations to forces.

    Terms of different sources that are alike are one term with several sources; those that cancel are gone.
    """
    total: dict[sp.Expr, sp.Expr] = {}
    sources: dict[sp.Expr, list[str]] = {}
    for source, part in _parts(system, coordinate):
        for term in sp.Add.make_args(canonical(part, system.symbols).expand()):
            number, rest = term.as_coeff_Mul()
            total[rest] = total.get(rest, sp.Integer(0)) + number
            sources.setdefault(rest, []).append(source)
    shares: dict[tuple[str, ...], sp.Expr] = {}
    for rest, number in total.items():
        origin = tuple(dict.fromkeys(sources[rest]))
        shares[origin] = shares.get(origin, sp.Integer(0)) + number * rest
    # Fourier terms of one origin may be shorter as products: sin φ sin ωt.
    shown = [
        (origin, *term.as_coeff_Mul())
        for origin, share in shares.items()
        for term in sp.Add.make_args(system.display(share).expand())
        if term != 0
    ]
    return tuple(
        Term(Explicit(abs(number) * rest), origin, 1 if number > 0 else -1)
        for origin, number, rest in sorted(shown, key=lambda part: _rank(system, part[2]))
    )


def _parts(system: System, coordinate: str) -> Iterator[tuple[str, sp.Expr]]:
    """What each body and load adds to the left side."""
    q, rate = system.q(coordinate), system.rate(coordinate)
    for body in system.scene.bodies:
        energy = system.kinetic_energy_of(body)
        yield f"body:{body.name}", system.time_derivative(energy.diff(rate)) - energy.diff(q)
    for load in system.load_names:
        if system.is_conservative(load):
            yield f"load:{load}", system.load_potential(load).diff(q)
        else:
            yield f"load:{load}", -system.load_force(load, coordinate)


def _rank(system: System, term: sp.Expr) -> tuple[int, str]:
    """Accelerations first, then rates, then the rest; stable within each."""
    symbols = term.free_symbols
    if symbols & {system.acceleration(name) for name in system.coordinates}:
        return 0, sp.default_sort_key(term).__repr__()
    moving = symbols & {system.rate(name) for name in system.coordinates}
    return (1 if moving else 2), ""
