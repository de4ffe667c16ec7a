"""The order in which a person writes factors and terms.

Factors: numbers, parameters (masses, stiffnesses and forces, g, lengths, the rest), coordinates, functions, sums,
rates, accelerations, differentials, δ. Terms: by δ, then accelerations, rates, coordinates, highest power first.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import sympy

from .memory import cached_method
from .names import Names
from .numerals import base_exponent
from .spelling import GREEK_NAMES

_SYMBOL = re.compile(r"(?:(d{1,2}ot\(delta|d{1,4}ot|delta|d)\()?(\w+)\)*\Z")
_PREFIX_CLASS = {
    None: 0, "dot": 1, "ddot": 2, "dddot": 3, "d": 4, "delta": 5, "dot(delta": 6, "ddot(delta": 7, "ddddot": 8,
}  # fmt: skip
# Heads of parameter names in the order of a textbook's product: m g l, k l, F l, m l omega.
_HEADS = (("m", "M", "J", "I", "Theta", "mu", "rho"), ("k", "c", "d", "b", "E", "F", "P", "N", "Q", "G"), ("g",))
_LATE = ("omega", "Omega", "nu", "f", "alpha", "beta", "gamma", "eta", "tau", "T")

_FUNCTION_RANK: Mapping[str, int] = MappingProxyType({"sin": 0, "cos": 1})

_RATE = 1
_AFTER_SYMBOLS = (2,)
_AFTER_COORDINATES = ((2,),)  # x (1 − a/s)

Key = tuple[Any, ...]


@lru_cache(maxsize=1 << 12)
def split_symbol(name: str) -> tuple[int, str]:
    """Class and base of a symbol: "ddot(phi)" → (2, "phi"); 0 plain, 1–3, 8 rates, 4 differential, 5–7 δ of q, q̇, q̈."""
    match = _SYMBOL.match(name)
    return (_PREFIX_CLASS[match[1]], match[2]) if match else (0, name)


@lru_cache(maxsize=1 << 14)
def arguments_of(call: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """What a function is called with; SymPy's unit step carries its value at 0, too."""
    return call.args[:1] if isinstance(call, sympy.Heaviside) else tuple(call.args)


@lru_cache(maxsize=1 << 14)
def text_of(expr: sympy.Expr) -> str:
    """The expression as text, to sort or name by; making it takes long, and the same parts come again and again."""
    return str(expr)


def natural(name: str) -> Key:
    """m2 before m10, Latin before Greek (x, y, phi)."""
    words = re.findall(r"[A-Za-z]+|\d+", name) or [name]
    parts = tuple((0, int(w), "") if w.isdigit() else (1, 0, w) for w in words)
    return (words[0] in GREEK_NAMES, parts)


@dataclass(frozen=True)
class Order:
    """Sort keys. With `names` the coordinates come in their own order, without by their letters."""

    names: Names | None = None
    _places: Mapping[str, int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        coordinates = self.names.coordinates if self.names else ()
        object.__setattr__(self, "_places", {name: i for i, name in enumerate(coordinates)})

    @cached_method
    def is_moving(self, symbol: sympy.Symbol) -> bool:
        """Whether a symbol is a coordinate, time, a rate, dq or δq, and not a parameter."""
        kind, base = split_symbol(symbol.name)
        if kind or base == "t" or base in self._places:
            return True
        known = self.names.get(base) if self.names else None
        return known.kind == "material" if known else not symbol.is_positive

    def is_mass(self, base: str) -> bool:
        """Whether a parameter is named as masses, moments of inertia and densities are."""
        return _head_rank(base) == 0

    def place(self, base: str) -> Key:
        """Of a coordinate among the coordinates; time comes last."""
        return (base == "t", self._places.get(base, len(self._places)), natural(base))

    @cached_method
    def factor(self, factor: sympy.Expr) -> Key:
        """Sort key of a factor inside a product."""
        base, exponent = base_exponent(factor)
        if base.is_Symbol:
            return (*self._symbol(base), -float(exponent) if exponent.is_Rational else 0)
        if base.is_number:
            return (1, (), (), text_of(factor))
        moving = [split_symbol(s.name)[0] for s in base.free_symbols if self.is_moving(s)]
        if not moving:
            return self._bracket(base, factor) if base.is_Add else (6, (), (), text_of(factor))
        if base.is_Add and not max(moving):
            return (5, _AFTER_COORDINATES, (1,), text_of(factor))
        if base.is_Add:
            return (7 + max(moving), (1,), (), text_of(factor))
        return (6, (self._angle(base),), (_FUNCTION_RANK.get(type(base).__name__, 2),), text_of(base))

    def _bracket(self, base: sympy.Expr, factor: sympy.Expr) -> Key:
        """A bracket of parameters stands where the first of them would: (m₁ + m₂) l², m (R − r)²."""
        rank = min(_head_rank(symbol.name) for symbol in base.free_symbols)
        return (3, (rank,), _AFTER_SYMBOLS, text_of(factor))

    def _angle(self, function: sympy.Expr) -> Key:
        return tuple(sorted(self.place(split_symbol(s.name)[1]) for s in function.free_symbols if self.is_moving(s)))

    def _symbol(self, symbol: sympy.Symbol) -> Key:
        kind, base = split_symbol(symbol.name)
        if kind:
            return (7 + kind, (0, self.place(base)), ())
        if self.is_moving(symbol):
            return (5, (self.place(base),), ())
        return (3, (_head_rank(base),), natural(base))

    @cached_method
    def term(self, term: sympy.Expr) -> Key:
        """Sort key of a term inside a sum."""
        powers: dict[int, dict[Key, float]] = {}
        functions: list[str] = []
        parameters: list[Key] = []
        for factor in sympy.Mul.make_args(term):
            base, exponent = base_exponent(factor)
            if base.is_Symbol and exponent.is_Rational and self.is_moving(base):
                kind, name = split_symbol(base.name)
                powers.setdefault(kind, {})[self.place(name)] = float(exponent)
            elif base.is_Symbol:
                parameters.append(self.factor(factor))
            elif not base.is_number:
                functions.append(text_of(base))
        varies = any(kind in powers for kind in (5, 6, 7))  # q + h δq
        by_kind = tuple(_descending(powers.get(kind, {})) for kind in (5, 6, 7, 4, 8, 3))
        acceleration = (-sum(powers.get(2, {}).values()), len(functions) if 2 in powers else 0)
        rest = tuple(_descending(powers.get(kind, {})) for kind in (2, 1, 0))
        return (varies, *by_kind, acceleration, *rest, len(functions), sorted(functions), sorted(parameters))

    def terms(self, sum_: sympy.Expr) -> list[sympy.Expr]:
        """The terms of a sum in writing order; no needless minus in front, but δq, dq and q̈ keep their order."""
        terms = sorted(sympy.Add.make_args(sum_), key=self.term)
        leading = terms[0]
        fixed = any(split_symbol(s.name)[0] > _RATE for s in leading.free_symbols)
        if leading.could_extract_minus_sign() and not fixed:
            positive = next((t for t in terms if not t.could_extract_minus_sign()), leading)
            terms.remove(positive)
            terms.insert(0, positive)
        return terms

    def factors(self, factors: list[sympy.Expr]) -> list[sympy.Expr]:
        """Factors in writing order."""
        return sorted(factors, key=self.factor)


def _descending(powers: Mapping[Key, float]) -> Key:
    """Compares like the exponents of a monomial in lexicographic order, highest degree first."""
    total = sum(powers.values())
    return (-total, tuple(sorted((place, -exponent) for place, exponent in powers.items())))


def _head_rank(name: str) -> int:
    letters = re.sub(r"[^A-Za-z].*", "", name)
    for rank, heads in enumerate(_HEADS):
        if letters in heads:
            return rank
    return len(_HEADS) + (letters in _LATE)
