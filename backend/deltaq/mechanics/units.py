"""Units, and the dimensions they measure.

Source: Bureau international des poids et mesures, The International System of Units (SI Brochure), 9th ed., tables 2–7.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Dimension:
    """A product of powers of kg, m, s and A, with the scale of the unit in SI (cm: 1/100)."""

    mass: Fraction = Fraction(0)
    length: Fraction = Fraction(0)
    time: Fraction = Fraction(0)
    scale: float = 1.0
    current: Fraction = Fraction(0)

    def times(self, other: Dimension) -> Dimension:
        """The dimension of a product."""
        exponents = (self.mass + other.mass, self.length + other.length, self.time + other.time)
        return Dimension(*exponents, self.scale * other.scale, self.current + other.current)

    def to(self, exponent: Fraction) -> Dimension:
        """The dimension of a power."""
        exponents = (self.mass * exponent, self.length * exponent, self.time * exponent)
        return Dimension(*exponents, self.scale ** float(exponent), self.current * exponent)

    def fits(self, other: Dimension) -> bool:
        """Whether quantities of the two may be added as plain numbers."""
        same = (self.mass, self.length, self.time) == (other.mass, other.length, other.time)
        return same and self.current == other.current and abs(self.scale / other.scale - 1) < 1e-9

    def __str__(self) -> str:
        powers = {"kg": self.mass, "m": self.length, "s": self.time, "A": self.current}
        words = [unit + _raised(power) for unit, power in powers.items() if power]
        scale = [] if abs(self.scale - 1) < 1e-9 else [f"{self.scale:g}"]
        return " ".join(scale + words) or "1"


def _raised(power: Fraction) -> str:
    """As it is written at a unit: m, m², m⁻¹, m^(1/2)."""
    if power.denominator != 1:
        return f"^({power})"
    return "" if power == 1 else str(power).translate(RAISED)


RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
ONE = Dimension()


def _of(mass: int, length: int, time: int, scale: float = 1.0, current: int = 0) -> Dimension:
    return Dimension(Fraction(mass), Fraction(length), Fraction(time), scale, Fraction(current))


UNITS: Mapping[str, Dimension] = {
    "1": ONE,
    "rad": ONE,
    "deg": _of(0, 0, 0, 0.017453292519943295),
    "°": _of(0, 0, 0, 0.017453292519943295),
    "g": _of(1, 0, 0, 1e-3),
    "t": _of(1, 0, 0, 1e3),
    "m": _of(0, 1, 0),
    "s": _of(0, 0, 1),
    "min": _of(0, 0, 1, 60.0),
    "h": _of(0, 0, 1, 3600.0),
    "Hz": _of(0, 0, -1),
    "N": _of(1, 1, -2),
    "J": _of(1, 2, -2),
    "W": _of(1, 2, -3),
    "Pa": _of(1, -1, -2),
    "A": _of(0, 0, 0, current=1),
    "C": _of(0, 0, 1, current=1),
    "V": _of(1, 2, -3, current=-1),
    "T": _of(1, 0, -2, current=-1),
}
PREFIXES: Mapping[str, float] = {"": 1.0, "M": 1e6, "k": 1e3, "d": 1e-1, "c": 1e-2, "m": 1e-3, "µ": 1e-6, "μ": 1e-6}
LOWERED = {raised: digit for digit, raised in RAISED.items()}
FACTOR = re.compile(r"([A-Za-zµμ°]+|1)(?:\^?\(?(-?\d)\)?)?")


def dimension_of(unit: str) -> Dimension | None:
    """The dimension of a unit such as `kg`, `m/s^2`, `N m` or `kg·m²`; None if it is not given or not known."""
    text = unit.translate(LOWERED).replace("·", " ").replace("*", " ").strip()
    numerator, *denominators = text.split("/")
    parts = [(numerator, 1), *((part.strip("() "), -1) for part in denominators)]
    found = ONE
    for part, sign in parts:
        words = part.split()
        if not words:
            return None
        for word in words:
            factor = _factor(word, sign)
            if factor is None:
                return None
            found = found.times(factor)
    return found


def _factor(word: str, sign: int) -> Dimension | None:
    match = FACTOR.fullmatch(word)
    if match is None:
        return None
    symbol, exponent = match.group(1), int(match.group(2) or 1)
    unit = UNITS.get(symbol) or _prefixed(symbol)
    return None if unit is None else unit.to(Fraction(sign * exponent))


def _prefixed(symbol: str) -> Dimension | None:
    prefix, base = symbol[:1], symbol[1:]
    if prefix not in PREFIXES or base not in UNITS:
        return None
    unit = UNITS[base]
    return Dimension(unit.mass, unit.length, unit.time, unit.scale * PREFIXES[prefix], unit.current)
