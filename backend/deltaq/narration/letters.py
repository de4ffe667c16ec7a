"""Letters that a scene has taken: where L is a length, the Lagrange function is not L but 𝓛.

Quantities have the letters of the lecture: E, V, L, h … A scene may use any of them itself; the quantity then gets
another one, in formulas and in sentences alike.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from ..language.names import Names

Letters = Mapping[str, str]  # of a quantity, to what stands for it in one scene, braces doubled as in all templates

OF_FUNCTIONALS = ("f", "F", "I", "H", "p")
OF_QUANTITIES = ("E", "V", "L", "S", "W", "R", "M", "h", "f", "x", "y", "I", "U", "H")
RELATED = {"x": r"\xi", "y": r"\eta"}  # the others become calligraphic
LEADING = re.compile(r"^(-?(?:\\d?dot\{\{|\\delta )?)([A-Za-z])(?![A-Za-z])")
MATHEMATICS = re.compile(r"\$[^$]+\$")
# Bold letters, of vectors and matrices, are none that a scene has taken.
WORD = re.compile(r"\\mathbf[ {]*[A-Za-z]+|\\?[A-Za-z]+")


def letters_of(names: Names, letters: tuple[str, ...] = OF_QUANTITIES) -> Letters:
    """What stands for each of the letters that is a name of the scene."""
    taken = {symbol.typeset for symbol in names.symbols}
    calligraphic = {letter: rf"\mathcal{{{{{letter.upper()}}}}}" for letter in letters}
    related = {letter: other for letter, other in RELATED.items() if letter in letters}
    return {letter: other for letter, other in (calligraphic | related).items() if letter in taken}


def in_symbol(pattern: str, letters: Letters) -> str:
    r"""The pattern of a symbol with another letter in front: `M_0`, `\dot{{x}}`, `\delta W{of}`."""
    return LEADING.sub(lambda found: found[1] + letters.get(found[2], found[2]), pattern, count=1)


def in_sentence(template: str, letters: Letters) -> str:
    """The sentence with the letters of its mathematics, which stands between dollar signs."""
    return MATHEMATICS.sub(lambda math: WORD.sub(lambda word: letters.get(word[0], word[0]), math[0]), template)
