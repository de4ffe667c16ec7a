"""The catalogs: every sentence that a user reads, in each language, by key.

`locales/<language>/<section>.json` hold nested texts with {placeholders}; files `errors.<part>.json` are parts of the
section `errors`. The page reads the same catalogs.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from string import Formatter
from typing import cast

from ..errors import Problem
from .prose import CatalogText, joined, plain, words

LANGUAGES = ("en", "de")
_DECIMAL_POINT = re.compile(r"(?<=\d)\.(?=\d+(?!\d|\s*(?:em|ex|mu|pt)\b))")
Catalog = Mapping[str, object]


@cache
def catalog(language: str) -> Catalog:
    """All texts of a language by section."""
    merged: dict[str, dict[str, object]] = {}
    folder = files("deltaq") / "narration" / "locales" / language
    for file in sorted(folder.iterdir(), key=lambda file: file.name):
        if file.name.endswith(".json"):
            merged.setdefault(file.name.split(".")[0], {}).update(json.loads(file.read_text(encoding="utf-8")))
    return merged


def template(language: str, key: str) -> str:
    """The text under a key such as `rules.guide.title`. A key without a text is a KeyError: our bug."""
    entry = _entry(language, key)
    if entry is None:
        raise KeyError(f"no text for {key} in {language}")
    return str(entry)


def _entry(language: str, key: str) -> object | None:
    """What stands under a key, if anything does."""
    entry: object | None = catalog(language)
    for part in key.split("."):
        entry = entry.get(part) if isinstance(entry, Mapping) else None
    return entry


def text(language: str, key: str, **parameters: object) -> CatalogText:
    """The sentence under a key, its {placeholders} put in; where {count} is 1, the one under `KEY-one`, if there is.

    Floats have the decimal mark of the language: a sentence says them, and nobody has typed them.
    """
    is_one = str(parameters.get("count")) == "1" and _entry(language, f"{key}-one") is not None
    mark = template(language, "rules.decimal")
    told = {name: _told(value, mark) if isinstance(value, float) else value for name, value in parameters.items()}
    return filled(template(language, f"{key}-one" if is_one else key), told)


def with_decimal_mark(language: str, latex: str) -> str:
    """A formula whose numbers have the decimal mark of a language: 0{,}5 in German; lengths as 0.3em stay."""
    mark = template(language, "rules.decimal")
    return latex if mark == "." else _DECIMAL_POINT.sub(f"{{{mark}}}", latex)


def keys(language: str, key: str) -> tuple[str, ...]:
    """What there is under a key: `rules.proofs` names the proofs."""
    entry: object = catalog(language)
    for part in key.split("."):
        entry = cast("Catalog", entry)[part]
    return tuple(cast("Catalog", entry))


def filled(template: str, parameters: Mapping[str, object]) -> CatalogText:
    """The template with its {placeholders} put in, as words unless they are sentences or formulas of δq themselves."""
    pieces = (
        literal + ("" if field is None else words(parameters.get(field, "")))
        for literal, field, _, _ in Formatter().parse(template)
    )
    return CatalogText("".join(pieces))


def _told(value: float, mark: str) -> str:
    """A number in a sentence: 0 for 0.0, 1e-6 for 1e-06, and with the decimal mark of the language, 0,5 in German."""
    return re.sub(r"e([+-])0*", r"e\1", repr(value).removesuffix(".0")).replace(".", mark)


def sentence(language: str, problem: Problem) -> CatalogText:
    """What a problem says to the user: what is wrong, what may have been meant, and what else there is."""
    key, given = f"errors.{problem.code}", problem.parameters
    parts = [text(language, key, **given)]
    if given.get("suggestion"):
        parts.append(text(language, "errors.suggestion", suggestion=given["suggestion"]))
    if given.get("known") and "{known}" not in template(language, key):
        parts.append(text(language, "errors.known", known=given["known"]))
    return joined(" ", parts)


def message(language: str, problem: Problem) -> str:
    """The sentence of a problem for places where no formulas are typeset."""
    return plain(sentence(language, problem))


def language_of(wanted: str | None) -> str:
    """The language to answer in: the one wanted if there is a catalog for it, else English."""
    short = (wanted or "")[:2].lower()
    return short if short in LANGUAGES else LANGUAGES[0]
