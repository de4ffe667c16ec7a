"""Expressions of a model in the language of scenes, for sentences."""

from __future__ import annotations

import symengine as se

from .functions import Expr, absolute, sign, step
from .parts import parts
from .symbols import Symbols


def spelt(expression: Expr, symbols: Symbols) -> str | None:
    """The expression with the scene's own names; None if it has pieces that the language has no word for."""
    names = {symbol: se.Symbol(name) for name, symbol in symbols.values.items() if name != "pi"}
    rates = {symbol: se.Symbol(f"dot({name})") for name, symbol in symbols.rates.items()}
    for piece in sorted(parts([expression], se.Piecewise), key=lambda each: len(str(each))):
        word = next((word for word, make in WORDS.items() if piece == make(_argument(piece))), None)
        if word is not None:
            expression = expression.subs({piece: se.Function(word)(_argument(piece))})
    text = str(se.sympify(expression).subs({**names, **rates}))
    return None if "Piecewise" in text else text.replace("**", "^")


def _argument(piece: Expr) -> Expr:
    """What a modulus, a sign or a step switches by."""
    smaller, larger = piece.args[1].args
    return larger - smaller


WORDS = {"abs": absolute, "sign": sign, "step": step}
