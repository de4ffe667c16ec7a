"""Sums whose terms remember the bodies and loads they come from."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeVar

import sympy as sp

from ..language import fourier
from ..language.canonical import canonical
from ..language.display import display_form
from ..language.form_calculus import plain_forms
from ..language.fourier import TooLargeError
from ..language.memory import cached_method
from ..language.normal_form import Reader
from .formula import Explicit, Term
from .provenance import Share, of_equation
from .system import System

Origin = tuple[str, ...]  # sources: bodies and loads
K = TypeVar("K")
V = TypeVar("V", bound=Any)


@cached_method
def terms_by_source(system: System, coordinate: str) -> tuple[Term, ...]:
    """d/dt ∂L/∂q̇ − ∂L/∂q − Qᵈ written out, ordered from accelerations to forces."""
    return terms_of(system, of_equation(system, coordinate))


def terms_of(system: System, shares: Iterable[tuple[str, sp.Expr]]) -> tuple[Term, ...]:
    """The sum of what each source adds, term by term.

    Terms of different sources that are alike are one term with several sources; those that cancel are gone.
    """
    given = tuple(shares)
    by_origin = _by_form(system, given) or _by_expression(system, given)
    shown = [
        (origin, *term.as_coeff_Mul())
        for origin, share in by_origin.items()
        for term in sp.Add.make_args(share.expand())
        if term != 0
    ]
    return tuple(
        Term(Explicit(abs(number) * rest), origin, 1 if number > 0 else -1)
        for origin, number, rest in sorted(shown, key=lambda part: _rank(system, part[2]))
    )


def _by_form(system: System, shares: tuple[Share, ...]) -> dict[Origin, sp.Expr] | None:
    """The sum of all Fourier terms that have the same sources; None if the shares have no plain forms."""
    reader = Reader()
    forms = plain_forms((share for _, share in shares), reader)
    if forms is None:
        return None
    total = _gathered((source, form) for (source, _), form in zip(shares, forms, strict=True))
    try:
        return {origin: display_form(fourier.add(parts), reader, system.symbols) for origin, parts in total.items()}
    except TooLargeError:
        return None


def _by_expression(system: System, shares: tuple[Share, ...]) -> dict[Origin, sp.Expr]:
    """The same for what has roots and quotients in it."""
    parts = ((source, _numbers(canonical(share, system.symbols).expand())) for source, share in shares)
    total = _gathered(parts)
    sums = {o: sp.Add(*(n * rest for part in parts for rest, n in part.items())) for o, parts in total.items()}
    return {origin: system.display(share) for origin, share in sums.items()}


def _numbers(expanded: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The number in front of each product."""
    found: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(expanded):
        number, rest = term.as_coeff_Mul()
        found[rest] = found.get(rest, 0) + number
    return found


def _gathered(shares: Iterable[tuple[str, dict[K, V]]]) -> dict[Origin, list[dict[K, V]]]:
    """Terms with their numbers, by the sources that have them; each in a mapping of its own."""
    total: dict[K, V] = {}
    sources: dict[K, list[str]] = {}
    for source, numbers in shares:
        for term, number in numbers.items():
            total[term] = total[term] + number if term in total else number
            sources.setdefault(term, []).append(source)
    by_origin: dict[Origin, list[dict[K, V]]] = {}
    for term, number in total.items():
        if number != 0:
            by_origin.setdefault(tuple(dict.fromkeys(sources[term])), []).append({term: number})
    return by_origin


def _rank(system: System, term: sp.Expr) -> tuple[int, str]:
    """Accelerations first, then rates, then the rest; stable within each."""
    symbols = term.free_symbols
    if symbols & {system.acceleration(name) for name in system.coordinates}:
        return 0, repr(sp.default_sort_key(term))
    moving = symbols & {system.rate(name) for name in system.coordinates}
    return (1 if moving else 2), ""
