"""A derivation as a LaTeX file that compiles by itself with any engine."""

from __future__ import annotations

import re
from collections.abc import Iterator
from types import MappingProxyType
from unicodedata import normalize

from ..mechanics.units import dimension_of
from ..narration.prose import CatalogText, pieces
from .document import Handout, Line, Part, Value

PREAMBLE = r"""\documentclass[11pt,a4paper]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{lmodern}
\usepackage{amsmath,amssymb,graphicx}
\usepackage[%(babel)s]{babel}
\usepackage[a4paper,margin=25mm]{geometry}
\setlength{\parindent}{0pt}
\setlength{\parskip}{0.4em plus 0.2em}
%% A formula wider than the page is made to fit it.
\newsavebox{\formula}
\newcommand{\displayed}[1]{\sbox{\formula}{$\displaystyle #1$}\[\ifdim\wd\formula>\linewidth
  \resizebox{\linewidth}{!}{\usebox{\formula}}\else\usebox{\formula}\fi\]}
\newcommand{\step}[2]{\par\medskip\textbf{#1\quad #2}\par\nopagebreak}
\newcommand{\substep}[2]{\par\smallskip\hspace*{1.2em}\textit{#1\quad #2}\par\nopagebreak}
"""

SPECIAL = MappingProxyType(
    {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    | {sign: f"\\{sign}" for sign in "&%$#_{}"}
    | {
        '"': r"\textquotedbl{}",
        "[": "{[}",
        "]": "{]}",
    }  # a shorthand of babel; what a command before may take for its own
)
# Signs of sentences that 8-bit fonts lack, as mathematics.
MATHEMATICS = MappingProxyType(
    {
        "α": r"\alpha",
        "β": r"\beta",
        "γ": r"\gamma",
        "δ": r"\delta",
        "ε": r"\varepsilon",
        "ζ": r"\zeta",
        "η": r"\eta",
        "θ": r"\theta",
        "ϑ": r"\vartheta",
        "κ": r"\kappa",
        "λ": r"\lambda",
        "μ": r"\mu",
        "ν": r"\nu",
        "ξ": r"\xi",
        "π": r"\pi",
        "ρ": r"\rho",
        "σ": r"\sigma",
        "τ": r"\tau",
        "φ": r"\varphi",
        "χ": r"\chi",
        "ψ": r"\psi",
        "ω": r"\omega",
        "Δ": r"\Delta",
        "Θ": r"\Theta",
        "Λ": r"\Lambda",
        "Φ": r"\Phi",
        "Ψ": r"\Psi",
        "Ω": r"\Omega",
        "ℓ": r"\ell",
        "∂": r"\partial",
        "√": r"\surd",
        "∫": r"\int",
        "∑": r"\sum",
        "∞": r"\infty",
        "−": "-",
        "→": r"\to",
        "≈": r"\approx",
        "≠": r"\neq",
        "≤": r"\le",
        "≥": r"\ge",
        "⅔": r"\tfrac23",
        "⁴": "{}^4",
        "₀": "{}_0",
        "₁": "{}_1",
        "₂": "{}_2",
        "₃": "{}_3",
        "ᵢ": "{}_i",
        "⁻": "{}^-",
    }
)
SPACES = MappingProxyType({"\u00a0": "~", "\u2009": r"\,", "\u202f": r"\,"})
DOT_ABOVE = "\u0307"
_KEPT = re.compile(r"[\x20-\x7e\u00a1-\u00ff„“”‚‘’–—…]")
_UNIT = re.compile(r"(?:[A-Za-z0-9/.()-]|\^-?\d+(?![A-Za-z0-9]))+")
_FOREIGN = re.compile(r"[^\x00-\x7f]+")
_BABEL = MappingProxyType({"de": "ngerman", "en": "english"})


def latex_file(handout: Handout) -> str:
    """The whole file."""
    return "\n".join(
        [
            PREAMBLE % {"babel": _BABEL[handout.language]},
            f"\\title{{{escaped(handout.title.line)}}}",
            f"\\author{{{prose(handout.say('author'))}}}",
            "\\date{}",
            "\\begin{document}",
            "\\maketitle",
            escaped(handout.summary.line),
            "",
            *_values(handout),
            *(line for part in handout.parts for line in _part(part)),
            "\\end{document}",
            "",
        ]
    )


def prose(sentence: CatalogText) -> str:
    """A sentence with its formulas; everything else in it is text."""
    return "".join(
        f"${mathematics(each.text)}$" if each.is_formula else escaped(each.text) for each in pieces(sentence)
    )


def mathematics(latex: str) -> str:
    """LaTeX of δq in signs that every engine has; beyond ASCII it holds the words of names only."""
    return _FOREIGN.sub(lambda sign: escaped(sign[0]), latex)


def escaped(text: str) -> str:
    """Text as LaTeX: no sign of it means anything; what there is no way to write becomes a question mark."""
    spread = "".join(normalize("NFD", sign) if DOT_ABOVE in normalize("NFD", sign) else sign for sign in text)
    return "".join(_written(*found.groups()) for found in re.finditer(f"(.)({DOT_ABOVE}*)", spread, re.DOTALL))


def _written(sign: str, dots: str) -> str:
    mathematics = MATHEMATICS.get(sign, sign if dots and sign.isalpha() else "")
    if mathematics:
        return f"$\\dot{{{mathematics}}}$" if dots else f"${mathematics}$"
    return SPECIAL.get(sign) or SPACES.get(sign) or (sign if _KEPT.match(sign) else " " if sign.isspace() else "?")


def _values(handout: Handout) -> Iterator[str]:
    for key, values in (("parameters", handout.parameters), ("initial", handout.coordinates)):
        if values:
            yield f"\\paragraph{{{prose(handout.say(key))}}} {', '.join(map(_value, values))}."
            yield ""


def _value(value: Value) -> str:
    known = _UNIT.fullmatch(value.unit) and dimension_of(value.unit)
    unit = re.sub(r"\^(-?\d+)", r"^{\1}", value.unit) if known else ""
    equation = mathematics(value.equation)
    return f"${equation}\\,\\mathrm{{{unit}}}$" if unit else f"${equation}$ {escaped(value.unit)}".strip()


def _part(part: Part) -> Iterator[str]:
    yield f"\\section{{{prose(part.title)}}}"
    for line in part.lines:
        yield from _line(line)


def _line(line: Line) -> Iterator[str]:
    yield f"\\{'substep' if line.depth else 'step'}{{{line.number}}}{{{prose(line.title)}}}"
    if line.text:
        yield prose(line.text)
    if line.latex:
        yield f"\\displayed{{{mathematics(line.latex)}}}"
