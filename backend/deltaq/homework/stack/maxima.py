"""Expressions in Maxima, with names that a student can type: phi, phi_dot, phi_ddot, delta_phi."""

from __future__ import annotations

import sympy as sp

from ...language.order import split_symbol
from ...language.plain_printer import plain

# Words that Maxima or STACK keep for themselves.
RENAMED = {"lambda": "lam", "e": "e_0", "i": "i_0", "j": "j_0", "gamma": "gam", "beta": "bet", "zeta": "zet"}
PATTERNS = {1: "{}_dot", 2: "{}_ddot", 4: "d_{}", 5: "delta_{}"}


def maxima(expression: sp.Expr) -> str:
    """The expression as Maxima reads it: explicit products, ^ for powers, %pi."""
    renamed = {symbol: sp.Symbol(maxima_name(symbol.name)) for symbol in expression.free_symbols}
    pi = sp.Symbol("%pi")
    return plain(expression.xreplace({**renamed, sp.pi: pi}))


def maxima_name(name: str) -> str:
    """The name of a symbol: `dot(phi)` is phi_dot, `delta(phi)` is delta_phi."""
    kind, base = split_symbol(name)
    return PATTERNS.get(kind, "{}").format(RENAMED.get(base, base))
