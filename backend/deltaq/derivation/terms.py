"""Sums whose terms remember the bodies and loads they come from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TypeVar

import sympy as sp

from ..language import fourier
from ..language.canonical import canonical
from ..language.display import display_form
from ..language.form_calculus import plain_forms
from ..language.fourier import Form, TooLargeError
from ..language.kernel_reader import KernelReader
from ..language.memory import cached_method
from ..language.normal_form import Reader
from ..language.polynomial import Exponents
from ..language.textbook import Textbook
from .formula import Explicit, Owners, Term
from .provenance import Share, of_equation
from .system import System

Origin = tuple[str, ...]  # sources: bodies and loads
K = TypeVar("K")
V = TypeVar("V", bound=Any)


@cached_method
def terms_by_source(system: System, coordinate: str) -> tuple[Term, ...]:
    """d/dt ∂L/∂q̇ − ∂L/∂q − Qᵈ as it is read, from accelerations to forces: inertia as a whole, then load by load."""
    return terms_of(system, of_equation(system, coordinate), gathered=True)


def terms_of(system: System, shares: Iterable[Share], *, gathered: bool = False) -> tuple[Term, ...]:
    """The sum of what each source adds, term by term.

    What different sources have alike is one term with several sources; what cancels is gone. `gathered`: with brackets,
    and what comes from bodies as one sum, so that their masses are collected; else every product by itself.
    """
    given = tuple(share for share in shares if share[1] != 0)
    terms = _as_printed(system, given, gathered=gathered) or _split(system, given)
    return tuple(sorted(terms, key=lambda term: _rank(system, term.written_out)))


def _as_printed(system: System, shares: tuple[Share, ...], *, gathered: bool) -> tuple[Term, ...] | None:
    """Each group of sources in its shortest form; None if that would take too long."""
    reader = KernelReader()
    book = Textbook(reader, system.symbols.order, system.given_sums)
    whole = frozenset(system.body_sources) if gathered else frozenset[str]()
    try:
        forms = [(source, reader.read(share)) for source, share in shares]
        groups = _groups(forms, whole)
        if not gathered:
            return tuple(Term(Explicit(v), origin, sign) for origin, f in groups for v, sign in book.products(f))
        return tuple(term for origin, form in groups for term in _printed(book, origin, form, forms, whole))
    except TooLargeError:
        return None


def _groups(forms: list[tuple[str, Form]], whole: frozenset[str]) -> list[tuple[Origin, Form]]:
    """The sum by the sources that its Fourier terms come from; `whole` is one source."""
    total = fourier.add(form for _, form in forms)
    groups: dict[Origin, Form] = {}
    for term, number in total.items():
        origin = tuple(dict.fromkeys(source for source, form in forms if term in form))
        owner = tuple(sorted(whole)) if whole.intersection(origin) else origin
        groups.setdefault(owner, {})[term] = number
    return list(groups.items())


def _printed(
    book: Textbook, origin: Origin, form: Form, forms: list[tuple[str, Form]], whole: frozenset[str]
) -> Iterator[Term]:
    """The terms of one group, each with the sources of the products in it."""
    summands = book.summands(form, apart=bool(whole.intersection(origin)))
    owners: dict[Exponents | None, list[str]] = {}
    for source, share in forms:
        for mono in dict.fromkeys(mono for mono, _, _ in share):
            owners.setdefault(summands.key(mono), []).append(source)
    names = tuple(dict.fromkeys(source for source, _ in forms))

    def sources(keys: Iterable[Exponents]) -> Origin:
        found = {source for key in keys for source in owners.get(key, ())}
        return tuple(source for source in names if source in found) or origin

    for part in summands.terms:
        own = sources(part.keys)
        inside = book.inside(part, summands.alphabet) if len(own) > 1 else ()
        yield Term(Explicit(part.value, _owned((b, t, sources(keys)) for b, t, keys in inside)), own, part.sign)


def _owned(found: Iterable[tuple[sp.Expr, sp.Expr, Origin]]) -> Owners:
    """The summands of each bracket with their sources, whichever way round the bracket is written."""
    owners: dict[sp.Expr, dict[sp.Expr, Origin]] = {}
    for bracket, term, origin in found:
        for sign in (1, -1):
            owners.setdefault(sign * bracket, {})[sign * term] = origin
    return tuple((bracket, tuple(parts.items())) for bracket, parts in owners.items())


def _split(system: System, shares: tuple[Share, ...]) -> tuple[Term, ...]:
    """The terms multiplied out, for what is too long to be planned."""
    by_origin = _by_form(system, shares) or _by_expression(system, shares)
    shown = [
        (origin, *term.as_coeff_Mul())
        for origin, share in by_origin.items()
        for term in sp.Add.make_args(share.expand())
        if term != 0
    ]
    return tuple(Term(Explicit(abs(number) * rest), origin, 1 if number > 0 else -1) for origin, number, rest in shown)


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
