"""Texts with numbers in them: how charts speak."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any, Protocol

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
DOTS = {"dot": "\u0307", "ddot": "\u0308"}
_NAMED = re.compile(r"(?:(d?dot)\()(\w+)\)|[^\W\d]\w*")
_UNTAGGED = str.maketrans("<>", "‹›")  # charts read tags in their texts
COMMA = frozenset({"de"})  # languages with a decimal comma


class Say(Protocol):
    """The text under a key of the catalogs, its placeholders filled; numbers are written as the language has them."""

    def __call__(self, key: str, **parameters: object) -> str: ...


def words(text: Callable[..., str], language: str) -> Say:
    """How to say things in a language, by its catalog: `text(language, key, **parameters)`."""

    def say(key: str, **parameters: object) -> str:
        return text(language, key, **{name: spoken(value, language) for name, value in parameters.items()})

    return say


def called(result: Mapping[str, Any], names: str) -> Any:
    """What the scene of a result calls something: a symbol, or a word by language; several as symbols."""
    known = result.get("names", {})
    several = names.split(", ")
    return known.get(names, names) if len(several) == 1 else ", ".join(str(known.get(name, name)) for name in several)


def in_symbols(result: Mapping[str, Any], text: str) -> str:
    """An expression as it was written, its names by the symbols of the scene: phi1 is φ₁, dot(x) ẋ, omega*t ω·t."""

    def symbol(found: re.Match[str]) -> str:
        rate, name = found.groups()
        known = result.get("names", {}).get(name or found[0])
        spelt = known if isinstance(known, str) else name or found[0]
        return f"{spelt[:1]}{DOTS[rate]}{spelt[1:]}" if rate else spelt

    named = _NAMED.sub(symbol, text).replace("*", "·")
    return re.sub(r"\^(\d+)", lambda found: found[1].translate(SUPERSCRIPTS), named)


def in_minimal(caption: str, result: Mapping[str, Any], say: Say) -> str:
    """A caption, and in which coordinates all of it was made where those are not the scene's own."""
    if not result.get("minimal"):
        return caption
    names = ", ".join(str(called(result, name)) for name in result["minimal"])
    return f"{caption} {say('labs.minimal', names=names)}"


def spoken(value: object, language: str) -> object:
    """Numbers with three digits, powers of ten as they are printed; a word by its language; others as they are."""
    if value is None:
        return "–"
    if isinstance(value, Mapping):
        return str(value.get(language) or next(iter(value.values()), "–")).translate(_UNTAGGED)
    return _written(value, language) if isinstance(value, float) else value


def written_date(date: str) -> str:
    """A date in ISO 8601 to the minute, as both languages read it."""
    return f"{date[:10]} {date[11:16]} UTC"


def taken(measured: Mapping[str, Any], say: Say) -> str:
    """When and at which load times were measured, as a sentence."""
    key = "labs.taken" if measured["repetitions"] > 1 else "labs.taken-once"
    return str(say(key, **{**measured, "date": written_date(measured["date"])}))


def _written(number: float, language: str) -> str:
    digits, _, power = f"{number or 0.0:.3g}".partition("e")  # never a negative zero
    shown = digits.replace("-", "−").replace(".", "," if language in COMMA else ".")
    return f"{shown}·10{str(int(power)).translate(SUPERSCRIPTS)}" if power else shown
