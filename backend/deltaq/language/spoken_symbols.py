"""How the symbols of a scene are said: φ̇₁ is "phi one dot", ℓ is "l", Ω is "capital omega" where ω is there too.

A symbol is known by its LaTeX, which the scene gives or its name makes; only symbols are read here, never formulas.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from .memory import cached_method
from .names import Names
from .order import split_symbol
from .spelling import GREEK_NAMES, latex_of

TOKEN = re.compile(r"\\([A-Za-z]+)\s*|\\.|([^\W\d_]+|\d+)|([{}_^,'*+/=(-])|(\s+)|.")
ACCENTS = ("dot", "ddot", "dddot", "ddddot", "hat", "bar", "tilde", "vec")
UPRIGHT = frozenset({"mathrm", "text", "textrm", "operatorname", "mathit", "mathsf", "textit"})
SAME = {"ell": "l", "imath": "i", "jmath": "j"}
RATES: Mapping[int, str] = {1: "dot", 2: "ddot", 3: "dddot", 8: "ddddot"}
DIFFERENTIAL, VARIATION = 4, 5
LARGEST = 12  # greater numbers are said by their digits
LETTERS_OF_QUANTITIES = frozenset("rvthfds")


@dataclass(frozen=True)
class Vocabulary:
    """The words of one language, by key; patterns take their parts by number."""

    words: Mapping[str, str]
    point: str = "."

    def say(self, key: str, *parts: str) -> str:
        """The words under a key with the parts in their places, each noun in the case that is asked for."""
        declension = self._declension
        return declension.joint.sub(declension.declined, self.words[key].format(*parts))

    @cached_property
    def _declension(self) -> Declension:
        nouns = [self.words[key].split("|") for key in self.words if key.startswith("nouns.")]
        return Declension(nouns, *(frozenset(self.words[f"cases.{case}"].split()) for case in ("dative", "accusative")))

    def whole(self, number: int) -> str:
        """A whole number that is not negative."""
        return self.words[f"numbers.{number}"] if number <= LARGEST else str(number)


@dataclass(frozen=True)
class Declension:
    """Nouns in nominative, dative and accusative, and the words that ask for the latter: von der Ableitung."""

    nouns: Sequence[Sequence[str]]
    dative: frozenset[str]
    accusative: frozenset[str]

    @cached_property
    def joint(self) -> re.Pattern[str]:
        """A word that asks for a case, and a noun without it."""
        words, nouns = sorted(self.dative | self.accusative), [forms[0] for forms in self.nouns]
        return re.compile(rf"(?<!\w)({'|'.join(words)}) ({'|'.join(nouns)})(?!\w)")

    def declined(self, found: re.Match[str]) -> str:
        """Both with the noun in its case; von dem is vom."""
        _, dative, accusative = next(forms for forms in self.nouns if forms[0] == found[2])
        text = f"{found[1]} {dative if found[1] in self.dative else accusative}"
        return text.replace("von dem ", "vom ", 1)


@dataclass(frozen=True)
class SymbolReader:
    """Says symbols by their LaTeX. `lower` and `plain` are the letters that a capital or a vector is told from."""

    vocabulary: Vocabulary
    lower: frozenset[str] = frozenset()
    plain: frozenset[str] = frozenset()

    @cached_method
    def words(self, latex: str) -> str:
        """The symbol in words: `\\delta\\mathbf{r}_{\\text{bob}}` → delta r sub bob."""
        tokens = [match for match in TOKEN.finditer(latex) if not match[4]]
        return " ".join(self._read(iter(tokens), ""))

    def _read(self, tokens: Iterator[re.Match[str]], place: str, *, single: bool = False) -> Iterator[str]:
        """Words up to the brace that closes; `place` is what the group is: an index, upright words, a vector."""
        for token in tokens:
            if token[0] == "}":
                return
            if token[0] == "{":
                yield from self._read(tokens, place)
            elif single and token[2] and token[2].isalpha():  # without braces only one letter is the argument
                yield from (self._letter(letter, place) for letter in token[2])
            else:
                yield from self._one(token, tokens, place)
            if single:
                return

    def _one(self, token: re.Match[str], tokens: Iterator[re.Match[str]], place: str) -> Iterator[str]:
        if token[1]:
            yield from self._command(token[1], tokens, place)
        elif token[2] and token[2].isdigit():
            yield self.vocabulary.whole(int(token[2])) if len(token[2]) < 3 else " ".join(token[2])
        elif token[2]:
            yield from [token[2]] if place == "upright" else (self._letter(letter, place) for letter in token[2])
        elif token[0] in "_^":
            yield from self._index(token[0], tokens)
        elif place != "upright" and f"signs.{token[0]}" in self.vocabulary.words:
            yield self.vocabulary.say(f"signs.{token[0]}")

    def _command(self, command: str, tokens: Iterator[re.Match[str]], place: str) -> Iterator[str]:
        if command in UPRIGHT:
            yield from self._read(tokens, "upright", single=True)
        elif command in {"mathbf", "boldsymbol"}:
            yield from self._read(tokens, "bold", single=True)
        elif command == "mathcal":
            yield self.vocabulary.say("script", *self._read(tokens, place, single=True))
        elif command in ACCENTS:
            yield self.vocabulary.say(command, " ".join(self._read(tokens, place, single=True)))
        elif f"signs.{command}" in self.vocabulary.words:
            yield self.vocabulary.say(f"signs.{command}")
        else:
            yield self._letter(SAME.get(command, command.removeprefix("var")), place)

    def _index(self, sign: str, tokens: Iterator[re.Match[str]]) -> Iterator[str]:
        words = " ".join(self._read(tokens, "index", single=True))
        number = words in (self.vocabulary.words[f"numbers.{n}"] for n in range(LARGEST + 1)) or words[:1].isdigit()
        if sign == "^" and words == self.vocabulary.whole(2):
            yield self.vocabulary.say("power-2", "").strip()
        elif sign == "^":
            yield self.vocabulary.say("superscript", words)
        else:
            yield words if number else self.vocabulary.say("subscript", words)

    def _letter(self, letter: str, place: str) -> str:
        low = letter.lower()
        is_capital = low != letter and low in self.lower
        said = self.vocabulary.say("capital", self._name(low) if len(low) > 1 else letter) if is_capital else None
        said = said or (self._name(low) if low in GREEK_NAMES else letter)
        told = place == "bold" and (letter in self.plain)
        return self.vocabulary.say("matrix-letter" if letter in "MDK" else "vector-letter", said) if told else said

    def _name(self, greek: str) -> str:
        return self.vocabulary.words.get(f"greek.{greek}", greek)


def heads(latex: Iterable[str]) -> frozenset[str]:
    """The letters with which symbols begin, as they are heard."""
    found = (re.match(r"(\\mathbf\{)?\\?(?:var)?([A-Za-z]+)", text) for text in latex)
    return frozenset(SAME.get(match[2], match[2]) for match in found if match and not match[1])


@dataclass(frozen=True)
class SpokenSymbols:
    """How SymPy symbols are said by their plain names: "dot(phi)" is "phi dot"."""

    names: Names
    vocabulary: Vocabulary
    reader: SymbolReader = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        plain = heads(symbol.typeset for symbol in self.names.symbols)
        object.__setattr__(self, "reader", SymbolReader(self.vocabulary, plain | LETTERS_OF_QUANTITIES, plain))

    def symbol(self, name: str) -> str:
        """The words for a symbol by its plain name."""
        kind, base = split_symbol(name)
        return self.decorated(kind, self.letter(base))

    def is_atom(self, name: str) -> bool:
        """Whether nothing but the symbol is said; delta phi and d phi are said of a symbol."""
        return split_symbol(name)[0] in (0, *RATES)

    def letter(self, base: str) -> str:
        """The words for a name without dots and without δ."""
        known = self.names.get(base)
        return self.reader.words(known.typeset if known else latex_of(base))

    def decorated(self, kind: int, letter: str) -> str:
        """With its dots, or as what δ and d stand before."""
        if kind in RATES:
            return self.vocabulary.say(RATES[kind], letter)
        if kind == DIFFERENTIAL:
            return self.vocabulary.say("differential", letter)
        if kind >= VARIATION:
            return self.vocabulary.say("variation", self.decorated(kind - VARIATION, letter))
        return letter
