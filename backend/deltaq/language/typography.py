"""How the symbols of a scene are typeset, in which order and with which marks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from .names import Names
from .order import Order, split_symbol
from .spelling import latex_of

UNNAMED = Order()
Mark = Callable[[str, str], str]

_ACCENTS: Mapping[int, str] = MappingProxyType({1: r"\dot", 2: r"\ddot", 3: r"\dddot", 8: r"\ddddot"})


def unmarked(_symbol: str, latex: str) -> str:
    """The mark that leaves no mark."""
    return latex


@dataclass(frozen=True)
class Typography:
    """How symbols are typeset and in which order. `mark(symbol name, LaTeX)` may wrap each, in a colour say.

    `summands` wrap the terms of a sum that stands inside a formula. `decimals`: 0.7 or 7/10, None: each for itself.
    `roots` name the square roots of sums: {x² + y²: "s"} writes s, s³ and s² for √(x² + y²) and its powers.
    """

    names: Names
    mark: Mark = unmarked
    summands: Mapping[Any, Mapping[Any, Callable[[str], str]]] = field(default_factory=dict, compare=False)
    decimals: bool | None = None
    roots: Mapping[Any, str] = field(default_factory=dict, compare=False)
    base: Typography | None = field(default=None, repr=False, compare=False)  # the same without summands
    order: Order = field(default=UNNAMED, repr=False, compare=False)  # what remembers the keys of its terms

    def __post_init__(self) -> None:
        if self.order is UNNAMED:
            object.__setattr__(self, "order", Order(self.names))

    def with_summands(self, summands: Mapping[Any, Mapping[Any, Callable[[str], str]]]) -> Typography:
        """The same for one formula, in which terms of these sums are wrapped."""
        return replace(self, summands=summands, base=self)

    def symbol(self, name: str) -> str:
        """LaTeX of a SymPy symbol by its plain name: "dot(phi)" → \\dot{\\varphi}."""
        return self.mark(name, self._plain(name))

    def power(self, name: str, exponent: str) -> str:
        """A symbol and its exponent in one mark, so that the exponent stands above an index."""
        return self.mark(name, f"{self._plain(name)}^{{{exponent}}}")

    def summand(self, sum_: Any, term: Any, latex: str) -> str:
        """A term of a sum, wrapped where that is wanted; its sign stays outside."""
        wrap = self.summands.get(sum_, {}).get(term)
        if wrap is None:
            return latex
        sign = "-" if latex.startswith("-") else ""
        return sign + wrap(latex.removeprefix("-"))

    def _plain(self, name: str) -> str:
        kind, base = split_symbol(name)
        known = self.names.get(base)
        return _decorated(kind, known.typeset if known else latex_of(base))


def dotted(letter: str, accent: str = _ACCENTS[1]) -> str:
    """LaTeX of a rate: the dot stands above the letter, not above its index."""
    head, underscore, index = letter.partition("_")
    return f"{accent}{{{head}}}{underscore}{index}"


def _decorated(kind: int, letter: str) -> str:
    if kind in _ACCENTS:
        return dotted(letter, _ACCENTS[kind])
    if kind == 4:
        return rf"\mathrm{{d}}{letter}"
    return rf"\delta {_decorated(kind - 5, letter)}" if kind >= 5 else letter
