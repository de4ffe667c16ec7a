"""Roots λ of the characteristic equation under their symbols: −δₖ ± iωₖ in pairs, or real λₖ."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..spectrum import Eigenvalue, Spectrum
from ..system import System


@dataclass(frozen=True)
class Root:
    """A real root, or a pair of conjugate ones; `symbols` are (λₖ,) or (δₖ, ωₖ)."""

    eigenvalue: Eigenvalue
    symbols: tuple[sp.Symbol, ...]

    @property
    def known(self) -> dict[sp.Symbol, sp.Expr]:
        """What the symbols are in numbers."""
        value = self.eigenvalue
        parts = (value.real,) if len(self.symbols) == 1 else (-value.real, value.imaginary)
        return dict(zip(self.symbols, parts, strict=True))

    def factor(self, exponent: sp.Symbol) -> sp.Expr:
        """Its factor in the characteristic polynomial."""
        if len(self.symbols) == 1:
            return exponent - self.symbols[0]
        decay, frequency = self.symbols
        return (exponent + decay) ** 2 + frequency**2


def roots_of(system: System, spectrum: Spectrum) -> tuple[Root, ...]:
    """All roots in the order of the spectrum, a conjugate pair once."""
    upper = (value for value in spectrum.eigenvalues if value.imaginary >= 0)
    return tuple(Root(value, _symbols(system, value, k)) for k, value in enumerate(upper, 1))


def _symbols(system: System, value: Eigenvalue, k: int) -> tuple[sp.Symbol, ...]:
    if value.imaginary == 0:
        return (system.fresh(f"{system.exponent.name}_{k}", f"mu_{k}", f"lambda_{k}_0"),)
    decay = system.fresh(f"delta_{k}", f"beta_{k}", f"delta_{k}_0")
    return decay, system.fresh(f"{system.omega.name}_{k}", f"nu_{k}", f"omega_{k}_0")
