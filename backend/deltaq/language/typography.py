"""How the symbols of a scene are typeset, in which order and with which marks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from .names import Names
from .order import Order, split_symbol
from .spelling import latex_of

Mark = Callable[[str, str], str]

_ACCENTS: Mapping[int, str] = MappingProxyType({1: r"\dot", 2: r"\ddot", 3: r"\dddot"})


def unmarked(_symbol: str, latex: str) -> str:
    """The mark that leaves no mark."""
    return latex


@dataclass(frozen=True)
class Typography:
    """How symbols are typeset and in which order. `mark(symbol name, LaTeX)` may wrap each, in a colour say."""

    names: Names
    mark: Mark = unmarked
    order: Order = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "order", Order(self.names))

    def symbol(self, name: str) -> str:
        """LaTeX of a SymPy symbol by its plain name: "dot(phi)" → \\dot{\\varphi}."""
        kind, base = split_symbol(name)
        known = self.names.get(base)
        letter = known.typeset if known else latex_of(base)
        return self.mark(name, _decorated(kind, letter))


def _decorated(kind: int, letter: str) -> str:
    if kind in _ACCENTS:
        head, underscore, index = letter.partition("_")
        return f"{_ACCENTS[kind]}{{{head}}}{underscore}{index}"
    if kind == 4:
        return rf"\mathrm{{d}}{letter}"
    return rf"\delta {_decorated(kind - 5, letter)}" if kind >= 5 else letter
