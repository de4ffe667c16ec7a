"""The symbols of a scene and every way to spell them."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from ..errors import InputError, Problem
from .functions import FREE_NAMES, OPERATORS, SPELLINGS
from .spelling import folded, key, latex_of

Kind = Literal["time", "constant", "parameter", "coordinate", "material", "multiplier"]

MAX_SYMBOLS = 200
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,31}\Z")


@dataclass(frozen=True)
class Symbol:
    """One symbol: its plain `name`, what it stands for, and how the lecture writes it (`latex`, "" = by its name)."""

    name: str
    kind: Kind
    latex: str = ""
    positive: bool = False

    @property
    def typeset(self) -> str:
        """Its LaTeX: as given, else made from the name."""
        return self.latex or latex_of(self.name)


TIME = Symbol("t", "time", "t")
PI = Symbol("pi", "constant", r"\pi", positive=True)


@dataclass(frozen=True)
class Names:
    """All symbols that an expression may use. Time `t` and `pi` are always among them.

    A spelling resolves to the symbol of this name, else of this LaTeX, else of the same letters in another script
    (`phi`, `φ`, `\\varphi`, `q_2`, `q2`), else to the coordinate of this number (`q_2` is the second coordinate).
    """

    symbols: tuple[Symbol, ...] = ()

    def __post_init__(self) -> None:
        own = tuple(s for s in self.symbols if s not in (TIME, PI))
        problems = tuple(_problems(own))
        if problems:
            raise InputError(*problems)
        object.__setattr__(self, "symbols", (*own, TIME, PI))

    def get(self, name: str) -> Symbol | None:
        """The symbol of exactly this name."""
        return self._by_name.get(name)

    def resolve(self, spelling: str) -> Symbol | None:
        """The one symbol that this spelling means; None if there is none or more than one."""
        match self.candidates(spelling):
            case (symbol,):
                return symbol
        return None

    def candidates(self, spelling: str) -> tuple[Symbol, ...]:
        """The symbols that this spelling can mean, by the closest way of spelling that finds any."""
        exact = self.get(spelling)
        if exact is not None:
            return (exact,)
        for table, look in zip(self._tables, (key, key, folded, key), strict=True):
            found = table.get(look(spelling), ())
            if found:
                return found
        return ()

    def suggestions(self, spelling: str) -> tuple[str, ...]:
        """Known names, functions included, that look like a misspelt one; the likeliest first."""
        known = [*self._by_name, *SPELLINGS, "dot", "ddot", "delta"]
        lowered = {name.lower(): name for name in reversed(known)}
        close = difflib.get_close_matches(folded(spelling[:40]).lower(), lowered, n=3, cutoff=0.6)
        return tuple(lowered[name] for name in close)

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The coordinates' names in order: q_1 … q_f."""
        return tuple(s.name for s in self.symbols if s.kind == "coordinate")

    @cached_property
    def _by_name(self) -> Mapping[str, Symbol]:
        return {s.name: s for s in self.symbols}

    @cached_property
    def _tables(self) -> tuple[Mapping[str, tuple[Symbol, ...]], ...]:
        numbered = [self._by_name[name] for name in self.coordinates]
        return (
            _table((key(s.typeset), s) for s in self.symbols),
            _table((key(s.name), s) for s in self.symbols),
            _table((folded(spelt), s) for s in self.symbols for spelt in (s.name, s.typeset)),
            _table((f"q{i}", s) for i, s in enumerate(numbered, 1)),
        )


def _table(entries: Iterable[tuple[str, Symbol]]) -> Mapping[str, tuple[Symbol, ...]]:
    table: dict[str, tuple[Symbol, ...]] = {}
    for spelling, symbol in entries:
        known = table.get(spelling, ())
        table[spelling] = known if symbol in known else (*known, symbol)
    return table


def is_reserved(name: str) -> bool:
    """Whether the language itself uses this word. d may be a distance: d(x) is a differential all the same."""
    is_function = name in SPELLINGS and name not in FREE_NAMES
    return (name in OPERATORS and name != "d") or is_function or name in (TIME.name, PI.name)


def is_name(name: str) -> bool:
    """Whether a symbol may be called so: a letter, then up to 31 letters, digits or underscores."""
    return _NAME.match(name) is not None


def _problems(symbols: tuple[Symbol, ...]) -> Iterable[Problem]:
    if len(symbols) > MAX_SYMBOLS:
        yield Problem("too-many-names", parameters={"count": len(symbols), "limit": MAX_SYMBOLS})
        return
    seen: set[str] = set()
    for symbol in symbols:
        if not is_name(symbol.name):
            yield Problem("malformed-name", parameters={"name": symbol.name[:40]})
        elif is_reserved(symbol.name):
            yield Problem("reserved-name", parameters={"name": symbol.name})
        elif symbol.name in seen:
            yield Problem("duplicate-name", parameters={"name": symbol.name})
        seen.add(symbol.name)


def is_differential(run: str, parts: Sequence[Symbol | None]) -> bool:
    """Whether letters are dx, which is a differential also where a symbol is called d."""
    return run[0] == "d" and len(parts) == 2 and parts[1] is not None and parts[1].kind in ("coordinate", "time")
