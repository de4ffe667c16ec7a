"""The names of practice systems: how each is written, its unit, and values that one meets in textbooks."""

from __future__ import annotations

import re
from dataclasses import dataclass

GREEK = {
    "alpha": (r"\alpha", "α"),
    "beta": (r"\beta", "β"),
    "kappa": (r"\kappa", "κ"),
    "phi": (r"\varphi", "φ"),
    "psi": (r"\psi", "ψ"),
    "theta": (r"\vartheta", "ϑ"),
    "Omega": (r"\Omega", "Ω"),
    "l": (r"\ell", "ℓ"),
}
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
POWERS = {"^2": "²", "^3": "³", "^4": "⁴"}
NO_BREAK = "\u00a0"
NAME = re.compile(r"[A-Za-z]+\d*")
PARTS = re.compile(r"([A-Za-z]+)(\d*)")


@dataclass(frozen=True)
class Kind:
    """A physical quantity: its unit and the values that are drawn."""

    unit: str
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        if not self.values or min(self.values) <= 0:
            raise ValueError("values are positive")


MASS = Kind("kg", (0.5, 0.8, 1.0, 1.5, 2.0))
LARGE_MASS = Kind("kg", (2.0, 2.5, 3.0))
LENGTH = Kind("m", (0.6, 0.8, 1.0, 1.2))
SHORT = Kind("m", (0.4, 0.5, 0.6))
RADIUS = Kind("m", (0.2, 0.25, 0.3))
AMPLITUDE = Kind("m", (0.05, 0.1, 0.15))
CURVATURE = Kind("1/m", (0.5, 0.8, 1.0))
QUARTIC = Kind("1/m^3", (0.5, 0.8, 1.0))
INCLINATION = Kind("rad", (0.3, 0.4, 0.5, 0.6))
STIFFNESS = Kind("N/m", (10.0, 15.0, 20.0, 30.0))
TORSION = Kind("N m", (2.0, 3.0, 5.0))
DAMPING = Kind("N s/m", (0.2, 0.4, 0.6))
PIVOT_DAMPING = Kind("N m s", (0.1, 0.2, 0.3))
FORCE = Kind("N", (1.0, 2.0, 3.0))
MOMENT = Kind("N m", (1.0, 2.0, 3.0))
INERTIA = Kind("kg m^2", (0.1, 0.2, 0.4))
FREQUENCY = Kind("rad/s", (2.0, 2.5, 3.0, 4.0))
ACCELERATION = Kind("m/s^2", (0.4, 0.6, 0.8))
SPEED = Kind("m/s", (0.02, 0.03, 0.04))
GRAVITY = Kind("m/s^2", (9.81,))

# What a name means unless a part says otherwise.
USUAL = {
    **dict.fromkeys(("m", "m1", "m2", "m3"), MASS),
    "M": LARGE_MASS,
    **dict.fromkeys(("l", "l1", "l2", "R"), LENGTH),
    **dict.fromkeys(("a", "b", "l0"), SHORT),
    "x0": AMPLITUDE,
    "y0": AMPLITUDE,
    "alpha": INCLINATION,
    **dict.fromkeys(("k", "k1", "k2", "k3"), STIFFNESS),
    "kappa": TORSION,
    "c": DAMPING,
    "F": FORCE,
    "F0": FORCE,
    "J": INERTIA,
    "Omega": FREQUENCY,
    "a0": ACCELERATION,
    "v": SPEED,
    "g": GRAVITY,
}


def latex_of(name: str) -> str:
    """`phi1` as LaTeX."""
    letter, number = _split(name)
    written = GREEK.get(letter, (letter, letter))[0]
    return f"{written}_{number}" if number else written


def shown(expression: str) -> str:
    """An expression as it stands in a sentence that holds no markup: `a*x^2` is a x²."""
    for power, sign in POWERS.items():
        expression = expression.replace(power, sign)
    spelled = NAME.sub(lambda found: _letter(found[0]), expression)
    return spelled.replace("*", NO_BREAK).replace("-", "−")


def names_in(expression: str) -> tuple[str, ...]:
    """The names in an expression, functions among them."""
    return tuple(NAME.findall(expression))


def _letter(name: str) -> str:
    letter, number = _split(name)
    return GREEK.get(letter, (letter, letter))[1] + number.translate(SUBSCRIPTS)


def _split(name: str) -> tuple[str, str]:
    found = PARTS.fullmatch(name)
    return (found[1], found[2]) if found else (name, "")
