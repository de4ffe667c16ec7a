"""Reading formulas back from what is said, by a grammar of its own: the words become a number, as the formula does.

Symbols stand for fixed random numbers. What computes nothing (a derivative, an integral, a name with arguments) is a
fixed function of its parts that no two of them share: other parts, or another order of them, give another number.
"""

from __future__ import annotations

import cmath
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from random import Random

FUNCTIONS: Mapping[str, Callable[[complex], complex]] = {
    "sin": cmath.sin, "cos": cmath.cos, "tan": cmath.tan, "asin": cmath.asin, "acos": cmath.acos, "atan": cmath.atan,
    "sinh": cmath.sinh, "cosh": cmath.cosh, "tanh": cmath.tanh, "log": cmath.log, "abs": lambda z: complex(abs(z)),
    "sign": lambda z: z / abs(z), "asinh": cmath.asinh,
}  # fmt: skip
ARTICLES = frozenset({"der", "die", "das", "dem", "den"})
PHRASE = 6  # words: more are a whole formula that the catalog has as one
DIGITS = re.compile(r"\d+([.,]\d+)?\Z")


def at_random(name: str) -> complex:
    """The number that a symbol stands for."""
    return complex(Random(name).uniform(0.2, 0.9), Random(name + "'").uniform(-0.05, 0.05))


def opaque(name: str, *parts: complex) -> complex:
    """A function of its parts that is nothing else."""
    weights = Random(f"{name} {len(parts)}")
    inside = sum((weights.uniform(0.3, 1.7) * part for part in parts), complex(weights.random()))
    return 2 + cmath.sin(inside) + inside / 7


ENGLISH = {
    "plus": "plus", "minus": "minus", "times": "times", "over": "over", "fraction": "the fraction",
    "end fraction": "end of fraction", "open": "open bracket", "close": "close bracket", "root": "the square root of",
    "end root": "end of root", "squared": "squared", "cubed": "cubed", "power": "to the power of", "of": "of",
    "and": "and", "rate": "d by d t of", "rate2": "the second derivative with respect to t of",
    "partial": "the partial derivative of", "by": "with respect to", "at zero": "the derivative at",
    "zero of": "equal to zero of", "limit": "the limit as", "to zero of": "goes to zero of",
    "dot": "the scalar product of", "with": "with", "value": "the value of", "for": "for", "is": "equal to",
    "at time": "at time", "end value": "end of value", "in equilibrium": "in the equilibrium",
    "boundary": "the boundary term", "from": "taken from", "to": "to", "end boundary": "end of boundary term",
    "integral": "the integral from", "integral over": "the integral over", "integrand": "of",
    "det": "the determinant of", "vector": "the vector with", "component": "component", "end vector": "end of vector",
    "matrix": "the matrix with", "row": "row", "next": "next", "end matrix": "end of matrix",
    "ten": "ten to the power of", "equals": "equals", "delta": "delta", "d": "d", "euler": "e to the power of",
}  # fmt: skip
GERMAN = {
    **ENGLISH, "times": "mal", "over": "durch", "fraction": "Bruch", "end fraction": "Ende des Bruchs",
    "open": "Klammer auf", "close": "Klammer zu", "root": "Wurzel aus", "end root": "Ende der Wurzel",
    "squared": "Quadrat", "cubed": "hoch dreimal", "power": "hoch", "of": "von", "and": "und",
    "rate": "d nach d t von", "rate2": "zweite Ableitung nach der Zeit von",
    "partial": "partielle Ableitung von", "by": "nach", "at zero": "Ableitung bei", "zero of": "gleich null von",
    "limit": "Grenzwert für", "to zero of": "gegen null von", "dot": "Skalarprodukt von", "with": "mit",
    "value": "Wert von", "for": "für", "is": "gleich", "at time": "zur Zeit", "end value": "Ende des Werts",
    "in equilibrium": "in der Ruhelage", "boundary": "Randterm", "from": "genommen von", "to": "bis",
    "end boundary": "Ende des Randterms", "integral": "Integral von", "integral over": "Integral über",
    "integrand": "über", "det": "Determinante von", "vector": "Vektor mit", "component": "Komponente",
    "end vector": "Ende des Vektors", "matrix": "Matrix mit", "row": "Zeile", "next": "dann",
    "end matrix": "Ende der Matrix", "ten": "zehn hoch", "equals": "gleich", "euler": "e hoch",
}  # fmt: skip
NUMBERS = {
    "en": ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"],
    "de": ["null", "eins", "zwei", "drei", "vier", "fünf", "sechs", "sieben", "acht", "neun", "zehn", "elf", "zwölf"],
}
PARTS = {
    "en": ["half", "third", "quarter", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth", "eleventh", "twelfth"],
    "de": [
        "halb",
        "drittel",
        "viertel",
        "fünftel",
        "sechstel",
        "siebtel",
        "achtel",
        "neuntel",
        "zehntel",
        "elftel",
        "zwölftel",
    ],
}
NAMES = {
    "en": {"sine": "sin", "cosine": "cos", "tangent": "tan", "arc sine": "asin", "arc cosine": "acos",
           "arc tangent": "atan", "hyperbolic sine": "sinh", "hyperbolic cosine": "cosh", "hyperbolic tangent": "tanh",
           "natural logarithm": "log", "absolute value": "abs", "sign": "sign", "inverse hyperbolic sine": "asinh"},
    "de": {"Sinus": "sin", "Kosinus": "cos", "Tangens": "tan", "Arkussinus": "asin", "Arkuskosinus": "acos",
           "Arkustangens": "atan", "Sinus hyperbolicus": "sinh", "Kosinus hyperbolicus": "cosh",
           "Tangens hyperbolicus": "tanh", "natürlicher Logarithmus": "log", "Betrag": "abs", "Signum": "sign",
           "Areasinus hyperbolicus": "asinh"},
}  # fmt: skip
UNITS = {
    "en": {"1/s": "per second", "rad/s": "radians per second"},
    "de": {"1/s": "pro Sekunde", "rad/s": "Radiant pro Sekunde"},
}


def words_of(text: str) -> tuple[str, ...]:
    """What is heard: no pauses, no capital letters; articles and endings of nouns tell nothing in formulas."""
    bare = re.sub(r"[,:](?= |$)", "", text).lower().replace("vom ", "von ")
    bare = re.sub(r"\b(partielle|zweite)n\b", r"\1", bare).replace("gradienten", "gradient")
    return tuple(word for word in bare.split() if word not in ARTICLES)


class UnreadableError(Exception):
    """The words are no formula."""


@dataclass
class Reader:
    """Reads one formula; `lexicon` has what is heard of each symbol, with the number that the symbol stands for."""

    language: str
    lexicon: Mapping[tuple[str, ...], complex]
    functions_of: frozenset[tuple[str, ...]] = frozenset()  # names that take arguments: x of t, never l of t
    words: tuple[str, ...] = ()
    at: int = 0
    keys: Mapping[str, tuple[str, ...]] = field(init=False)

    def __post_init__(self) -> None:
        table = ENGLISH if self.language == "en" else GERMAN
        self.keys = {key: words_of(text) for key, text in table.items()}
        self.calls = {words_of(text): name for text, name in NAMES[self.language].items()}
        self.numbers = {(word,): n for n, word in enumerate(NUMBERS[self.language])}
        self.units = {words_of(text): unit for unit, text in UNITS[self.language].items()}

    def read(self, text: str) -> complex:
        self.words, self.at = words_of(text), 0
        value = self._sum()
        while self._takes("equals"):
            value = opaque("=", value, self._sum())
        if self.at < len(self.words):
            raise UnreadableError(f"{' '.join(self.words[self.at :])!r} is left")
        return value

    def _sees(self, words: tuple[str, ...]) -> bool:
        return self.words[self.at : self.at + len(words)] == words

    def _takes(self, key: str) -> bool:
        if not self._sees(self.keys[key]):
            return False
        self.at += len(self.keys[key])
        return True

    def _needs(self, key: str) -> None:
        if not self._takes(key):
            raise UnreadableError(f"{key} is missing before {' '.join(self.words[self.at : self.at + 6])!r}")

    def _longest(self, table: Mapping[tuple[str, ...], object]) -> tuple[str, ...] | None:
        found = max((words for words in table if self._sees(words)), key=len, default=None)
        if found is not None:
            self.at += len(found)
        return found

    def _sum(self, *, divides: bool = True) -> complex:
        value = -self._term(divides=divides) if self._takes("minus") else self._term(divides=divides)
        while True:
            if self._takes("plus"):
                value += self._term(divides=divides)
            elif self._takes("minus"):
                value -= self._term(divides=divides)
            else:
                return value

    def _term(self, *, divides: bool = True) -> complex:
        """A product; over divides what stands before it by one symbol, and ends the term."""
        value = self._signed()
        while self._takes("times") or self._begins_letter():
            if self._takes("ten"):
                return value * 10 ** self._signed()
            value *= self._signed()
        if divides and self._takes("over"):
            value /= self._prefixed()
        return value

    def _begins_letter(self) -> bool:
        """Whether a symbol follows without a word between: letters side by side are a product."""
        if self._sees(self.keys["d"]) or self._sees(self.keys["delta"]):
            return False
        return any(self._sees(words) for words in self.lexicon if len(words) <= PHRASE)

    def _signed(self) -> complex:
        return -self._signed() if self._takes("minus") else self._power()

    def _power(self) -> complex:
        return self._raised(self._prefixed())

    def _raised(self, base: complex) -> complex:
        if self._takes("cubed"):
            return base**3
        if self._takes("squared"):
            return base**2
        return base ** self._signed_atom() if self._takes("power") else base

    def _signed_atom(self) -> complex:
        return -self._prefixed() if self._takes("minus") else self._prefixed()

    def _prefixed(self) -> complex:  # noqa: C901, PLR0911, PLR0912 - one case for each word that begins something
        phrase = self._longest({words: 0 for words in self.lexicon if len(words) > PHRASE})
        if phrase is not None:
            return self.lexicon[phrase]
        if self._takes("open"):
            value = self._sum()
            self._needs("close")
            return value
        if self._takes("fraction"):
            upper = self._sum(divides=False)
            self._needs("over")
            lower = self._sum(divides=False)
            self._needs("end fraction")
            return upper / lower
        if self._takes("root"):
            return self._root()
        for key in ("rate2", "rate", "det"):
            if self._takes(key):
                return opaque(key, self._prefixed())
        if self._takes("partial"):
            of = self._power()
            self._needs("by")
            return opaque("partial", of, self._prefixed())
        if self._takes("at zero"):
            h = self._prefixed()
            self._needs("zero of")
            return opaque("at zero", h, self._prefixed())
        if self._takes("limit"):
            h = self._prefixed()
            self._needs("to zero of")
            return opaque("limit", h, self._prefixed())
        if self._takes("dot"):
            left = self._prefixed()
            self._needs("with")
            return opaque("dot", left, self._prefixed())
        if self._takes("value"):
            return self._value()
        if self._takes("boundary"):
            of = self._sum()
            self._needs("from")
            lower = self._sum()
            self._needs("to")
            upper = self._sum()
            self._needs("end boundary")
            return opaque("boundary", of, lower, upper)
        if self._takes("integral over"):
            return self._integral_over()
        if self._takes("integral"):
            return self._integral()
        if self._takes("vector"):
            return self._listed("vector", "component", "end vector")
        if self._takes("matrix"):
            return self._listed("matrix", "row", "end matrix")
        return self._atom()

    def _root(self) -> complex:
        start = self.at
        value = self._sum()
        if self._takes("end root"):
            return cmath.sqrt(value)
        self.at = start
        return cmath.sqrt(self._prefixed())

    def _value(self) -> complex:
        of = self._sum()
        if self._takes("in equilibrium"):
            return opaque("equilibrium", of)
        if self._takes("at time"):
            value = opaque("at time", of, self._sum())
        else:
            self._needs("for")
            parts = [of]
            while len(parts) == 1 or self._takes("and"):
                parts.append(self._prefixed())
                self._needs("is")
                parts.append(self._sum())
            value = opaque("substituted", *parts)
        self._needs("end value")
        return value

    def _integral(self) -> complex:
        lower = self._sum()
        self._needs("to")
        upper = self._sum()
        self._needs("integrand")
        of = self._term()
        self._needs("d")
        return opaque("integral", lower, upper, of, self._prefixed())

    def _integral_over(self) -> complex:
        region = self.words[self.at]
        self.at += 1
        self._needs("of")
        of = self._term()
        self._needs("d")
        self.at += 1
        return opaque(f"integral over {region} d {self.words[self.at - 1]}", of)

    def _listed(self, kind: str, each: str, end: str) -> complex:
        parts: list[complex] = []
        while self._takes(each):
            if self._longest(self.numbers) is None:
                self.at += 1
            parts.append(self._sum())
            while self._takes("next"):
                parts.append(self._sum())
        self._needs(end)
        return opaque(kind, *parts)

    def _atom(self) -> complex:
        function = self._longest(self.calls)
        if function is not None:
            exponent = self._raised(complex(1.5))  # as a power of 1.5
            self._needs("of")
            argument = FUNCTIONS[self.calls[function]](self._prefixed())
            return argument ** (cmath.log(exponent) / cmath.log(1.5))
        if self._takes("euler"):
            return cmath.exp(self._signed_atom())
        known = self._longest(self.lexicon)
        if known is not None:
            return self._applied(self.lexicon[known], known)
        for key in ("delta", "d"):
            if self._takes(key):
                name = self._longest(self.lexicon)
                value = self._prefixed() if name is None else self.lexicon[name]
                return self._applied(opaque(key, value), name)
        return self._number()

    def _applied(self, name: complex, known: tuple[str, ...] | None) -> complex:
        """With what it depends on behind it."""
        if known not in self.functions_of or not self._takes("of"):
            return name
        if not self._takes("open"):
            arguments = [self._prefixed()]
            while self._takes("and"):
                arguments.append(self._prefixed())
            return opaque("of", name, *arguments)
        arguments = [self._sum()]
        while self._takes("and"):
            arguments.append(self._sum())
        self._needs("close")
        return opaque("of", name, *arguments)

    def _number(self) -> complex:
        count = self._longest(self.numbers)
        if count is None and self._sees(("pi",)):
            self.at += 1
            return cmath.pi
        if count is None and self._sees(("ein",)):
            self.at += 1
            value: complex = 1
        elif count is not None:
            value = self.numbers[count]
        elif self.at < len(self.words) and DIGITS.match(self.words[self.at]):
            value = float(self.words[self.at].replace(",", "."))
            self.at += 1
        else:
            raise UnreadableError(f"nothing is called {' '.join(self.words[self.at : self.at + 6])!r}")
        return self._measured(value / self._parts())

    def _parts(self) -> int:
        """Into how many parts it is divided: three halves."""
        word = self.words[self.at] if self.at < len(self.words) else ""
        for n, part in enumerate(PARTS[self.language], 2):
            if word in (part, part + "s", {"half": "halves", "halb": "halbe"}.get(part, part)):
                self.at += 1
                return n
        return 1

    def _measured(self, value: complex) -> complex:
        unit = self._longest(self.units)
        return value if unit is None else value * at_random(self.units[unit])
