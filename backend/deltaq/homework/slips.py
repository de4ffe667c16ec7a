"""One term got wrong: a sign, a factor 2 or ½, or the term left out, found from numbers and then confirmed exactly."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import sympy as sp

from ..language.canonical import display
from ..language.memory import cached_method
from ..vocabulary import SlipKind
from .equality import Parts
from .sampling import Sampler, Values, close

KINDS: Mapping[SlipKind, sp.Expr | int] = {"sign": -2, "missing": -1, "half": sp.Rational(-1, 2), "double": 1}
MOST_TERMS = 40


@dataclass(frozen=True)
class SlippedParts:
    """An answer with one term changed: which kind of slip, the term, and the parts that result."""

    kind: SlipKind
    term: sp.Expr
    parts: Parts


@dataclass(frozen=True, eq=False)
class Slips:
    """Finds the single slip by which an answer differs from a base."""

    sampler: Sampler
    form: str
    up_to_constant: bool = False

    @cached_method
    def _terms(self, base: Parts) -> tuple[tuple[int, sp.Expr, Values], ...]:
        """Every term of every part, with its values."""
        symbols = self.sampler.solution.symbols
        shown = [sp.expand(display(part, symbols)) for part in base]
        split = [(index, term) for index, part in enumerate(shown) for term in sp.Add.make_args(part)]
        return tuple((index, term, self.sampler.values(term)) for index, term in split[:MOST_TERMS])

    def between(self, given: Parts, base: Parts) -> Iterator[SlippedParts]:
        """The slips whose numbers fit, none if the answers do not have the same number of parts."""
        if len(given) != len(base) or self.form in ("set", "equations"):
            return
        own = [self.sampler.values(part) for part in given]
        right = [self.sampler.values(part) for part in base]
        for index, term, values in self._terms(base):
            for kind, factor in KINDS.items():
                changed = tuple(r + float(factor) * v for r, v in zip(right[index], values, strict=True))
                if self._fits(own, [*right[:index], changed, *right[index + 1 :]]):
                    parts = (*base[:index], base[index] + factor * term, *base[index + 1 :])
                    yield SlippedParts(kind, term, parts)

    def _fits(self, own: list[Values], slipped: list[Values]) -> bool:
        if self.up_to_constant:
            own, slipped = ([tuple(v - each[0] for v in each) for each in side] for side in (own, slipped))
        if self.form != "equation":
            return all(close(a, b) for a, b in zip(own, slipped, strict=True))
        (a,), (b,) = own, slipped
        return b[0] != 0 and a[0] != 0 and close([x * b[0] for x in a], [y * a[0] for y in b])
