"""Signs in place of pieces: what forces that bend or jump are while the argument of each condition keeps its sign.

A piece f₊ where s > 0, f₋ where s < 0 is (f₊ + f₋)/2 + σ (f₊ − f₋)/2 with σ = sign s. On s = 0 any σ from −1 to 1 is
one of Filippov's values. A force only bends there if what σ is multiplied by vanishes with s.
A piece without a jump that stands under a root or a logarithm stays as it is, and only its sign is told: a step that
ends behind s = 0 takes f₊ beyond its half, where √f₊ has no value.
Source: Filippov, Differential Equations with Discontinuous Righthand Sides, §4.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import symengine as se

from .functions import Expr
from .parts import parts
from .symbols import Symbols

HALF = se.Rational(1, 2)
NARROW = (se.log, se.asin, se.acos, se.acosh, se.atanh)  # functions without values for some numbers


class Smoothing:
    """Pieces of expressions replaced by signs, which `make` makes; those in `known` have theirs already.

    `values[i]` is the switching function whose sign `sigmas[i]` is.
    """

    def __init__(self, symbols: Symbols, known: Mapping[Expr, Expr], make: Callable[[], Expr]) -> None:
        count = len(symbols.free)
        self.values: list[Expr] = []
        self.sigmas: list[Expr] = []
        self._states, self._rates = (set(symbols.inputs[first : 2 * count]) for first in (0, count))
        self._places = self._states - self._rates
        self._symbols, self._known, self._make = symbols, known, make

    def smooth(self, expression: Expr) -> Expr:
        """The expression with every kink of the state replaced by its sign, innermost first."""
        return self._replaced(expression, self._is_switched)

    def by_known(self, expression: Expr) -> Expr:
        """The same of those kinks alone whose signs are known already."""
        return self._replaced(expression, lambda margin: self._known_sign(margin) is not None)

    def _replaced(self, expression: Expr, is_chosen: Callable[[Expr], bool]) -> Expr:
        """The expression with the kinks replaced at whose margins that is so."""
        kept: dict[Expr, Expr] = {}
        while True:
            found = [
                piece
                for piece in sorted(parts([expression], se.Piecewise), key=str)
                if not parts(_branches(piece), se.Piecewise) and _is_choice(piece)
            ]
            chosen = next((p for p in found if is_chosen(_restored(_margin(p), kept))), None)
            if chosen is None:
                return _restored(expression, kept)
            other = self._by_sign(_restored(chosen, kept))
            if _is_bent(chosen) and chosen in parts(_narrow(expression), se.Piecewise):
                other = se.Symbol(f"kept{len(kept)}")
                kept[other] = chosen
            expression = expression.subs({chosen: other})

    def _is_switched(self, margin: Expr) -> bool:
        """Whether a choice depends on the state; one by what jumps itself is left as it is."""
        if not margin.free_symbols & self._states:
            return False
        signs = [*((value, sigma) for value, sigma in self._known.items()), *zip(self.values, self.sigmas, strict=True)]
        return not any(sigma in margin.free_symbols and self._jumps([margin], sigma, value) for value, sigma in signs)

    def _by_sign(self, piece: Expr) -> Expr:
        sigma = self._sign(_margin(piece))
        above, below = _branches(piece)[:2]
        return HALF * (above + below) + sigma * HALF * (above - below)

    def _sign(self, margin: Expr) -> Expr:
        known = self._known_sign(margin)
        if known is not None:
            return known
        self.values.append(_without_number(margin))
        self.sigmas.append(self._make())
        return self.sigmas[-1]

    def _known_sign(self, margin: Expr) -> Expr | None:
        margin = _without_number(margin)
        for way in (1, -1):
            if way * margin in self._known:
                return way * self._known[way * margin]
            if way * margin in self.values:
                return way * self.sigmas[self.values.index(way * margin)]
        return None

    def jumping(self, expressions: Iterable[Expr]) -> tuple[list[int], list[int]]:
        """The switching functions at whose zeros an expression jumps: those of rates, and those of places alone."""
        several = list(expressions)
        signs = enumerate(zip(self.sigmas, self.values, strict=True))
        found = [i for i, (sigma, value) in signs if self._jumps(several, sigma, value)]
        of_rates = [i for i in found if self.values[i].free_symbols & self._rates]
        return of_rates, [i for i in found if i not in of_rates]

    def _jumps(self, expressions: Iterable[Expr], sigma: Expr, value: Expr) -> bool:
        variables = value.free_symbols & self._rates or value.free_symbols & self._places
        return any(not _vanishes(_jump(each, sigma), value, variables) for each in expressions)

    def spelt(self, index: int) -> str:
        """What has the zeros of a switching function, in the language of scenes."""
        symbols = self._symbols
        names = {symbol: se.Symbol(name) for name, symbol in symbols.values.items() if name != "pi"}
        rates = {symbol: se.Symbol(f"dot({name})") for name, symbol in symbols.rates.items()}
        inner = {
            sigma: se.Symbol(f"sign({self.spelt(i)})")
            for i, sigma in enumerate(self.sigmas)
            if i != index and sigma in self.values[index].free_symbols
        }
        value = se.expand(_without_number(self.values[index]).subs({**names, **rates, **inner}))
        text = str(value)
        return (str(se.expand(-value)) if text.startswith("-") else text).replace("**", "^")


def by_signs(expression: Expr, sigmas: Sequence[Expr]) -> Expr:
    """The expression made linear in each of the signs, the same where these are −1 or 1."""
    for sigma in sigmas:
        if expression.diff(sigma).diff(sigma) != 0:
            above, below = (expression.subs({sigma: se.Integer(way)}) for way in (1, -1))
            expression = HALF * (above + below) + sigma * HALF * (above - below)
    return expression


def _jump(expression: Expr, sigma: Expr) -> Expr:
    """What an expression differs by on both sides of s = 0."""
    above, below = (expression.subs({sigma: se.Integer(way)}) for way in (1, -1))
    return above - below


def _vanishes(jump: Expr, value: Expr, variables: set[Expr]) -> bool:
    """Whether a jump vanishes where a switching function is zero, as far as it is linear in one of some variables."""
    if se.expand(jump) == 0:
        return True
    for each in sorted(variables, key=str):
        slope = value.diff(each)
        if each not in slope.free_symbols:
            return bool(se.expand(jump.subs({each: each - value / slope})) == 0)
    return bool(jump.subs({value: se.Integer(0)}) == 0)


def _without_number(value: Expr) -> Expr:
    """A product without the size of its number."""
    number = value.args[0] if isinstance(value, se.Mul) else se.Integer(1)
    return value / abs(number) if isinstance(number, (se.Integer, se.Rational)) else value


def _restored(expression: Expr, kept: Mapping[Expr, Expr]) -> Expr:
    """With the pieces that were kept, the last of which may have earlier ones in it."""
    for symbol, piece in reversed(list(kept.items())):
        expression = expression.subs({symbol: piece})
    return expression


def _narrow(expression: Expr) -> list[Expr]:
    """What has to stay on one side of a bound: bases of roots, arguments of logarithms and inverse functions."""
    roots = (each.args[0] for each in parts([expression], se.Pow) if not each.args[1].is_Integer)
    return [*roots, *(each.args[0] for kind in NARROW for each in parts([expression], kind))]


def _is_bent(piece: Expr) -> bool:
    """Whether a piece only bends where its condition changes."""
    above, below = _branches(piece)[:2]
    margin = _margin(piece)
    return _vanishes(above - below, margin, margin.free_symbols)


def _branches(piece: Expr) -> tuple[Expr, ...]:
    return tuple(piece.args[::2])


def _is_choice(piece: Expr) -> bool:
    """Whether its condition compares two numbers."""
    return len(piece.args[1].args) == 2


def _margin(piece: Expr) -> Expr:
    """What is positive where the first branch holds."""
    smaller, larger = piece.args[1].args
    return larger - smaller
