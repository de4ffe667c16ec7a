"""How one letter is written in Unicode, in LaTeX and in plain text, and how a name becomes LaTeX."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

_RATES = ("{}", "dot({})", "ddot({})", "dddot({})", "ddddot({})")

GREEK: Mapping[str, str] = MappingProxyType(
    {
        "α": "alpha", "β": "beta", "γ": "gamma", "ε": "epsilon", "ϵ": "epsilon", "ζ": "zeta", "η": "eta",
        "θ": "theta", "ϑ": "vartheta", "ι": "iota", "κ": "kappa", "λ": "lambda", "μ": "mu", "µ": "mu", "ν": "nu",
        "ξ": "xi", "ο": "omicron", "π": "pi", "ρ": "rho", "ϱ": "varrho", "σ": "sigma", "ς": "varsigma", "τ": "tau",
        "υ": "upsilon", "φ": "phi", "ϕ": "phi", "χ": "chi", "ψ": "psi", "ω": "omega", "δ": "delta", "Γ": "Gamma",
        "Δ": "Delta", "Θ": "Theta", "Λ": "Lambda", "Ξ": "Xi", "Π": "Pi", "Σ": "Sigma", "Φ": "Phi", "Ψ": "Psi",
        "Ω": "Omega", "ℓ": "ell",
    }
)  # fmt: skip
GREEK_NAMES = frozenset(GREEK.values()) | {"varphi", "varepsilon", "varpi", "varkappa"}
SUBSCRIPTS: Mapping[str, str] = MappingProxyType(dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True)))
_LETTERS: Mapping[str, str] = MappingProxyType(
    {name: letter for letter, name in reversed(tuple(GREEK.items()))}
    | {"varphi": "φ", "varepsilon": "ε", "varkappa": "κ"}
)
_LOWERED: Mapping[int, str] = MappingProxyType({ord(digit): low for low, digit in SUBSCRIPTS.items()})
SUPERSCRIPTS: Mapping[str, str] = MappingProxyType(dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789", strict=True)))
# Letters on which two dots mean a second derivative; ä, ö and ü are letters of their own.
DOTTED_TWICE = "xywXYW"

# Variants that mean the same letter as long as a scene does not tell them apart.
_VARIANTS: Mapping[str, str] = MappingProxyType(
    {
        "varphi": "phi", "vartheta": "theta", "varepsilon": "epsilon", "varrho": "rho", "varsigma": "sigma",
        "varkappa": "kappa", "varpi": "pi", "ell": "l",
    }
)  # fmt: skip
_LATEX_OF: Mapping[str, str] = MappingProxyType({"phi": r"\varphi", "epsilon": r"\varepsilon", "ell": r"\ell"})


@lru_cache(maxsize=1 << 12)
def spell_rate(name: str, order: int) -> str:
    """The plain spelling of a time derivative; order 0 is the coordinate itself."""
    return _RATES[order].format(name)


def spelt_out(text: str) -> str:
    """Unicode letters and indices replaced by their plain names: φ₁ → phi1."""
    return "".join(GREEK.get(c) or SUBSCRIPTS.get(c) or unicodedata.normalize("NFKC", c) for c in text)


def key(spelling: str) -> str:
    """What all ways to write one symbol have in common: `q_2`, `q_{2}`, `q2`, `q₂` → q2; `\\varphi_1` → varphi1."""
    return re.sub(r"[\\{}_\s]", "", spelt_out(re.sub(r"\\(?:mathrm|mathit|text|operatorname)\b", "", spelling)))


def folded(spelling: str) -> str:
    """The key with variant letters made one: varphi → phi, ell → l."""
    return re.sub(r"[A-Za-z]+", lambda m: _VARIANTS.get(m[0], m[0]), key(spelling))


def latex_of(name: str) -> str:
    """LaTeX of a plain name: phi → \\varphi, y_0 and y0 → y_{0}, omega_max → \\omega_{\\mathrm{max}}."""
    head, *indices = re.findall(r"[A-Za-z]+|\d+", name.replace("_", " "))
    base = _letter(head)
    return base if not indices else f"{base}_{{{','.join(map(_index, indices))}}}"


def _letter(word: str) -> str:
    if word in _LATEX_OF:
        return _LATEX_OF[word]
    if word in GREEK_NAMES:
        return "\\" + word
    return word if len(word) == 1 else rf"\mathrm{{{word}}}"


def _index(word: str) -> str:
    return word if word.isdigit() else _letter(word)


def in_unicode(latex: str) -> str:
    """A symbol as one line of text: \\varphi_{1} → φ₁, \\omega → ω; what has no sign of its own is spelt out: c_d."""
    lettered = re.sub(r"\\([A-Za-z]+) ?", lambda found: _LETTERS.get(found[1], ""), latex)
    lowered = re.sub(r"_\{?(\d+)\}?", lambda found: found[1].translate(_LOWERED), lettered)
    return re.sub(r"[{}]", "", lowered)


def dotted(character: str) -> tuple[str, int]:
    """Base and number of dots of a letter such as ẋ; ä, ö and ü are letters of their own."""
    parts = unicodedata.normalize("NFD", character)
    base, marks = parts[0], parts[1:]
    if marks == "\u0307":
        return base, 1
    return (base, 2) if marks == "\u0308" and base in DOTTED_TWICE else (character, 0)
